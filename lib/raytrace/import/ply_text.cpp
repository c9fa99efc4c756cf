// The values of an ASCII PLY file: a row of each element in a line of its own, read by threads in chunks of lines.
#include <atomic>
#include <optional>
#include <string>

#include "raytrace/import/mesh_text.h"
#include "raytrace/import/ply_body.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/message.h"

namespace raytrace::ply {
namespace {

class TextBody final : public Body {
 public:
  TextBody(MeshFile& file, const Header& header, int threads, Diagnostics& diagnostics)
      : file_(file), header_(header), threads_(threads), diagnostics_(diagnostics) {}

  bool find_vertices() override { return count_rows() && find_rows(header_.find("vertex")); }
  bool read_vertices(std::span<const Column> columns, float* positions, std::size_t& bad) override;
  bool read_faces(const FaceColumns& columns, MeshData& mesh, FaceValues& values, MeshFaults& faults,
                  bool& dented_quads) override;

 private:
  bool count_rows();
  /// Whether the file has the rows of an element, and which they are.
  bool find_rows(std::size_t element);

  std::size_t chunks() const { return starts_.size() - 1; }
  std::string_view chunk(std::size_t i) const { return body_.substr(starts_[i], starts_[i + 1] - starts_[i]); }

  /// Calls f(chunk, row, words of the line) for each row of the element that find_rows() found.
  template <class Function>
  void for_rows(const Function& f) const {
    for_each_index(static_cast<int>(chunks()), threads_, [&](int index) {
      const auto c = static_cast<std::size_t>(index);
      std::size_t row = rows_before_[c];
      if (rows_before_[c + 1] <= first_row_ || row >= last_row_) return;
      for_each_line<false>(chunk(c), [&](const char* start, const char* end) {
        LineWords words(start, end, '\0');
        if (!words.skip_space()) return true;
        if (row >= first_row_) f(c, row - first_row_, words);
        return ++row < last_row_;
      });
    });
  }

  /// Calls on_list(property, count, words), which moves behind the list's values, and on_scalar(property, value). An
  /// empty text, or what is wrong with the row.
  template <class OnScalar, class OnList>
  static std::string walk(const Element& element, LineWords& words, const OnScalar& on_scalar, const OnList& on_list);
  static bool skip_list(LineWords& words, std::size_t count) {
    for (; count > 0; --count)
      if (words.word().empty()) return false;
    return true;
  }
  static std::optional<std::size_t> list_count(LineWords& words) {
    std::int64_t count = 0;
    if (!words.skip_space() || !words.integer(count) || !words.at_word_end() || count < 0) return std::nullopt;
    return static_cast<std::size_t>(count);
  }

  std::size_t offset_of(const LineWords& words) const {
    return static_cast<std::size_t>(words.at() - file_.text(false).data());
  }

  MeshFile& file_;
  const Header& header_;
  int threads_;
  Diagnostics& diagnostics_;
  std::string_view body_;
  std::vector<std::size_t> starts_, rows_before_;
  std::size_t first_row_ = 0, last_row_ = 0;
};

bool TextBody::count_rows() {
  if (!file_.load(threads_, diagnostics_)) return false;
  body_ = file_.text(true).substr(header_.size);
  starts_ = line_chunks(body_);
  std::vector<std::size_t> rows(chunks());
  for_each_index(static_cast<int>(chunks()), threads_, [&](int index) {
    const auto c = static_cast<std::size_t>(index);
    for_each_line<false>(chunk(c), [&](const char* start, const char* end) {
      rows[c] += LineWords(start, end, '\0').skip_space() ? 1U : 0U;
      return true;
    });
  });
  rows_before_ = sums_before(rows);
  return true;
}

bool TextBody::find_rows(std::size_t number) {
  const std::size_t all = rows_before_.back();
  first_row_ = 0;
  for (std::size_t i = 0; i <= number; ++i) {
    const Element& element = header_.elements[i];
    const std::size_t count = element.properties.empty() ? 0 : element.count;  // which would be an empty line
    if (all - first_row_ < count) {
      diagnostics_.error({locate(file_.text(false), file_.size()).line, 0},
                         "the file ends after " + std::to_string(all - first_row_) + " of the " +
                             std::to_string(count) + " elements " + in_quotes(element.name) +
                             " that its head announces");
      return false;
    }
    last_row_ = first_row_ + count;
    if (i < number) first_row_ = last_row_;
  }
  return true;
}

template <class OnScalar, class OnList>
std::string TextBody::walk(const Element& element, LineWords& words, const OnScalar& on_scalar, const OnList& on_list) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    double value = 0;
    if (property.count_type) {
      const std::optional<std::size_t> count = list_count(words);
      if (!count) return in_quotes(property.name) + " does not begin with the number of its values";
      if (!on_list(i, *count, words)) return in_quotes(property.name) + " has a value that is missing or wrong";
    } else if (words.number(value)) {
      on_scalar(i, value);
    } else {
      const std::string_view word = words.word();
      return in_quotes(property.name) +
             (word.empty() ? " is missing" : " is " + in_quotes(word) + ", which is no number");
    }
  }
  return words.skip_space() ? "more values than the properties of " + in_quotes(element.name) : std::string();
}

bool TextBody::read_vertices(std::span<const Column> columns, float* positions, std::size_t& bad) {
  const Element& element = header_.elements[header_.find("vertex")];
  std::vector<const Column*> column_of(element.properties.size());
  for (const Column& column : columns) column_of[column.property] = &column;
  std::vector<ChunkErrors> errors(chunks());
  for_rows([&](std::size_t chunk, std::size_t row, LineWords& words) {
    const std::size_t start = offset_of(words);
    const std::string fault = walk(
        element, words,
        [&](std::size_t property, double value) {
          if (const Column* const column = column_of[property])
            with_conversion(*column, element.properties[property].type,
                            [&](auto convert) { column->out[row * column->step] = convert(value); });
        },
        [&](std::size_t, std::size_t count, LineWords& values) { return skip_list(values, count); });
    if (!fault.empty()) errors[chunk].add(start, fault);
  });
  if (!ChunkErrors::report(errors, file_.text(false), diagnostics_)) return false;
  std::atomic<std::size_t> bad_ones{0};
  for_each_chunk(element.count, threads_, [&](std::size_t, std::size_t first, std::size_t last) {
    bad_ones += mark_bad_positions(positions + 3 * first, last - first);
  });
  bad = bad_ones;
  return true;
}

bool TextBody::read_faces(const FaceColumns& columns, MeshData& mesh, FaceValues& values, MeshFaults& faults,
                          bool& dented_quads) {
  const std::size_t number = header_.find("face");
  if (!find_rows(number)) return false;
  dented_quads = false;
  const Element& element = header_.elements[number];

  std::vector<FaceCounts> counts(chunks());
  for_rows([&](std::size_t chunk, std::size_t, LineWords& words) {
    const auto longest = static_cast<std::size_t>(words.end() - words.at());
    for (std::size_t i = 0; i < columns.vertices; ++i) {
      const std::optional<std::size_t> count = element.properties[i].count_type ? list_count(words) : 1;
      if (!count || !skip_list(words, *count)) return;
    }
    // No list has more values than its line has bytes; what claims so is an error of the second pass.
    if (const std::optional<std::size_t> count = list_count(words); count && *count < longest)
      counts[chunk].add(*count);
  });
  counts = sums_before(counts);
  if (!make_faces(counts.back(), mesh, diagnostics_)) return false;
  values.allocate(columns, mesh);

  std::vector<ChunkErrors> errors(chunks());
  std::vector<FaceValuesWriter> writers;
  for (std::size_t i = 0; i < chunks(); ++i) writers.emplace_back(mesh, counts[i].faces(mesh.corners), values);
  for_rows([&](std::size_t chunk, std::size_t, LineWords& words) {
    FaceValuesWriter& face = writers[chunk];
    const std::size_t start = offset_of(words);
    bool in_range = true;
    face.clear();
    const std::string fault = walk(
        element, words,
        [&](std::size_t which, double value) {
          if (which == columns.texture) face.texture = value;
        },
        [&](std::size_t which, std::size_t count, LineWords& list) {
          if (which == columns.uvs) {
            for (; count > 0; --count) {
              double value = 0;
              if (!list.number(value)) return false;
              face.uvs.push_back(finite_or_zero(rounded(value)));
            }
            return true;
          }
          if (which != columns.vertices) return skip_list(list, count);
          for (; count > 0; --count) {
            std::int64_t vertex = 0;
            if (!list.skip_space() || !list.integer(vertex) || !list.at_word_end()) return false;
            in_range = in_range && vertex >= 0 && static_cast<std::size_t>(vertex) < mesh.vertex_count();
            face.polygon.push_back(static_cast<std::uint32_t>(vertex));
          }
          return true;
        });
    if (!fault.empty()) {
      errors[chunk].add(start, fault);
    } else if (!in_range) {
      errors[chunk].add(start,
                        "an index is not that of one of the " + std::to_string(mesh.vertex_count()) + " vertices");
    } else {
      face.add();
    }
  });
  for (const FaceValuesWriter& writer : writers) {
    faults.degenerate_faces += writer.degenerate();
    values.other_counts += writer.other_counts();
  }
  faults.too_small_polygons = counts.back().too_small;
  return ChunkErrors::report(errors, file_.text(false), diagnostics_);
}

}  // namespace

std::unique_ptr<Body> text_body(MeshFile& file, const Header& header, int threads, Diagnostics& diagnostics) {
  return std::make_unique<TextBody>(file, header, threads, diagnostics);
}

}  // namespace raytrace::ply
