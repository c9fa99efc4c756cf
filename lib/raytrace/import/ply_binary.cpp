// The values of a binary PLY file.
//
// Where no row of an element has a list, or all lists are as long as in the first row (all faces are triangles), rows
// have one length, and threads read blocks of them from the file straight into the mesh. Otherwise the file is read
// into memory, one thread looks for where blocks of rows begin, and then threads read these.
#include <algorithm>
#include <atomic>
#include <optional>
#include <string>

#include "raytrace/import/mesh_text.h"
#include "raytrace/import/ply_body.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/message.h"

namespace raytrace::ply {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 18U;  // stays in a processor's cache
constexpr std::size_t block_rows = 4096;

std::size_t rows_a_block(const FixedRows& rows) { return std::max<std::size_t>(1, block_bytes / rows.length); }

/// Where up to block_rows rows begin, and what faces are in them.
struct RowBlock {
  std::size_t start = 0;
  FaceCounts faces;
};

struct Fault {
  std::size_t offset;
  std::string message;
};
/// The first fault of each block.
using Faults = std::vector<std::optional<Fault>>;

class BinaryBody final : public Body {
 public:
  BinaryBody(MeshFile& file, const Header& header, int threads, Diagnostics& diagnostics)
      : file_(file),
        header_(header),
        big_endian_(header.format == Header::Format::big_endian),
        threads_(threads),
        diagnostics_(diagnostics),
        starts_{header.size} {}

  bool find_vertices() override { return start_of(header_.find("vertex") + 1).has_value(); }
  bool read_vertices(std::span<const Column> columns, float* positions, std::size_t& bad) override;
  bool read_faces(const FaceColumns& columns, MeshData& mesh, FaceValues& values, MeshFaults& faults,
                  bool& dented_quads) override;

 private:
  bool refuse(std::size_t offset, const std::string& message) {
    diagnostics_.error({}, "byte " + std::to_string(offset) + ": " + message);
    return false;
  }
  bool refuse_short(const Element& element, std::size_t offset, std::size_t rows) {
    return refuse(offset, "the file ends after " + std::to_string(rows) + " of the " + std::to_string(element.count) +
                              " elements " + in_quotes(element.name) + " that its head announces");
  }
  /// Whether there are none and all could be read; else reports the first.
  bool report(const Faults& faults, bool readable);
  Fault wrong_index(const char* at, const char* bytes, std::size_t offset, std::size_t vertices) const {
    return {offset + static_cast<std::size_t>(at - bytes),
            "an index is not that of one of the " + std::to_string(vertices) + " vertices"};
  }

  std::int64_t integer_at(Type type, const char* at) const {
    return with_loader(type, big_endian_, [&](auto load) { return static_cast<std::int64_t>(load(at)); });
  }

  /// The byte where the element begins. No value, and an error, if those before it are not all there.
  std::optional<std::size_t> start_of(std::size_t element);
  /// Finds the blocks of rows of any length, and their end. list: the property that has the faces.
  bool find_blocks(const Element& element, std::size_t start, std::optional<std::size_t> list,
                   std::vector<RowBlock>& blocks, std::size_t& end);
  /// Rows as long as the first one; no value if the file is too short for so many.
  std::optional<FixedRows> fixed_rows(const Element& element, std::size_t start) const;

  /// Calls on_scalar(property, address) and on_list(property, count, address of the first) for the row at `at`. The
  /// address behind it; null if it ends beyond `end` or a list has a negative count.
  template <class OnScalar, class OnList>
  const char* walk(const Element& element, const char* at, const char* end, const OnScalar& on_scalar,
                   const OnList& on_list) const;

  enum class Outcome : std::uint8_t { done, failed, other_lengths };
  template <std::size_t corners>
  Outcome read_fixed_faces(const Element& element, const FixedRows& rows, const FaceColumns& columns, MeshData& mesh,
                           FaceValues& values, MeshFaults& faults);
  bool read_face_blocks(const Element& element, std::size_t start, const FaceColumns& columns, MeshData& mesh,
                        FaceValues& values, MeshFaults& faults);

  MeshFile& file_;
  const Header& header_;
  bool big_endian_;
  int threads_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> starts_;      ///< of the first elements
  std::vector<RowBlock> vertex_blocks_;  ///< if the vertices have lists
};

bool BinaryBody::report(const Faults& faults, bool readable) {
  if (!readable) MeshFile::report_changed(diagnostics_);
  for (const auto& fault : faults)
    if (fault) return refuse(fault->offset, fault->message);
  return readable;
}

template <class OnScalar, class OnList>
const char* BinaryBody::walk(const Element& element, const char* at, const char* end, const OnScalar& on_scalar,
                             const OnList& on_list) const {
  const auto left = [&] { return static_cast<std::size_t>(end - at); };
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    const std::size_t size = size_of(property.type);
    if (!property.count_type) {
      if (left() < size) return nullptr;
      on_scalar(i, at);
      at += size;
      continue;
    }
    if (left() < size_of(*property.count_type)) return nullptr;
    const std::int64_t count = integer_at(*property.count_type, at);
    at += size_of(*property.count_type);
    if (count < 0 || left() / size < static_cast<std::size_t>(count)) return nullptr;
    on_list(i, static_cast<std::size_t>(count), at);
    at += static_cast<std::size_t>(count) * size;
  }
  return at;
}

std::optional<FixedRows> BinaryBody::fixed_rows(const Element& element, std::size_t start) const {
  FixedRows rows{start, element.count, 0, {}, {}};
  MeshFile::Scratch scratch;
  for (const Property& property : element.properties) {
    rows.offsets.push_back(rows.length);
    std::int64_t count = 0;
    std::size_t bytes = size_of(property.type);
    if (property.count_type) {
      const std::size_t count_bytes = size_of(*property.count_type);
      if (file_.size() - start < rows.length + count_bytes) return std::nullopt;
      const char* const value = file_.bytes(start + rows.length, count_bytes, scratch);
      count = value != nullptr ? integer_at(*property.count_type, value) : -1;
      if (count < 0) return std::nullopt;
      bytes = count_bytes + static_cast<std::size_t>(count) * bytes;
    }
    rows.list_counts.push_back(count);
    rows.length += bytes;
  }
  if (rows.length > 0 && (file_.size() - start) / rows.length < element.count) return std::nullopt;
  return rows;
}

bool BinaryBody::find_blocks(const Element& element, std::size_t start, std::optional<std::size_t> list,
                             std::vector<RowBlock>& blocks, std::size_t& end) {
  if (!file_.load(threads_, diagnostics_)) return false;
  const std::string_view all = file_.text(false);
  const char* at = all.data() + start;
  const auto offset = [&] { return static_cast<std::size_t>(at - all.data()); };
  for (std::size_t row = 0; row < element.count; ++row) {
    if (row % block_rows == 0) blocks.push_back({offset(), {}});
    const char* const next = walk(
        element, at, all.data() + all.size(), [](std::size_t, const char*) {},
        [&](std::size_t property, std::size_t count, const char*) {
          if (property == list) blocks.back().faces.add(count);
        });
    if (next == nullptr) return refuse_short(element, offset(), row);
    at = next;
  }
  end = offset();
  return true;
}

std::optional<std::size_t> BinaryBody::start_of(std::size_t element) {
  while (starts_.size() <= element) {
    const Element& before = header_.elements[starts_.size() - 1];
    const std::size_t start = starts_.back();
    std::size_t end = start;
    if (before.has_lists()) {
      std::vector<RowBlock> blocks;
      if (!find_blocks(before, start, std::nullopt, blocks, end)) return std::nullopt;
      if (before.name == "vertex") vertex_blocks_ = std::move(blocks);
    } else {
      std::size_t length = 0;
      for (const Property& property : before.properties) length += size_of(property.type);
      if (length > 0 && (file_.size() - start) / length < before.count) {
        refuse_short(before, start, (file_.size() - start) / length);
        return std::nullopt;
      }
      end += length * before.count;
    }
    starts_.push_back(end);
  }
  return starts_[element];
}

bool BinaryBody::read_vertices(std::span<const Column> columns, float* positions, std::size_t& bad) {
  const std::size_t number = header_.find("vertex");
  const Element& element = header_.elements[number];
  std::atomic<std::size_t> bad_ones{0};
  std::atomic<bool> readable{true};
  if (element.has_lists()) {
    const std::string_view all = file_.text(false);
    for_each_index(static_cast<int>(vertex_blocks_.size()), threads_, [&](int index) {
      const auto block = static_cast<std::size_t>(index);
      const std::size_t first = block * block_rows, last = std::min(first + block_rows, element.count);
      const char* at = all.data() + vertex_blocks_[block].start;
      for (std::size_t row = first; row < last; ++row)
        at = walk(
            element, at, all.data() + all.size(),
            [&](std::size_t property, const char* from) {
              for (const Column& column : columns)
                if (column.property == property)
                  with_loader(element.properties[property].type, big_endian_, [&](auto load) {
                    with_conversion(column, element.properties[property].type, [&](auto convert) {
                      column.out[row * column.step] = convert(static_cast<double>(load(from)));
                    });
                  });
            },
            [](std::size_t, std::size_t, const char*) {});
      bad_ones += mark_bad_positions(positions + 3 * first, last - first);
    });
  } else if (const std::optional<FixedRows> rows = fixed_rows(element, starts_[number]); rows && rows->length > 0) {
    const std::size_t block = rows_a_block(*rows);
    for_each_index(static_cast<int>((rows->count + block - 1) / block), threads_, [&](int index) {
      thread_local MeshFile::Scratch scratch;
      const std::size_t first = static_cast<std::size_t>(index) * block, count = std::min(block, rows->count - first);
      const char* const bytes = file_.bytes(rows->start + first * rows->length, count * rows->length, scratch);
      if (bytes == nullptr) {
        readable = false;
        return;
      }
      for (const Column& column : columns) {
        const Type type = element.properties[column.property].type;
        with_loader(type, big_endian_, [&](auto load) {
          with_conversion(column, type, [&](auto convert) {
            const char* at = bytes + rows->offsets[column.property];
            float* out = column.out + first * column.step;
            for (std::size_t i = 0; i < count; ++i, at += rows->length, out += column.step)
              *out = convert(static_cast<double>(load(at)));
          });
        });
      }
      bad_ones += mark_bad_positions(positions + 3 * first, count);
    });
  }
  bad = bad_ones;
  return report({}, readable);
}

template <std::size_t corners>
BinaryBody::Outcome BinaryBody::read_fixed_faces(const Element& element, const FixedRows& rows,
                                                 const FaceColumns& columns, MeshData& mesh, FaceValues& values,
                                                 MeshFaults& faults) {
  FaceCounts all;
  (corners == 3 ? all.triangles : all.quads) = rows.count;
  if (!make_faces(all, mesh, diagnostics_)) return Outcome::failed;
  values.allocate(columns, mesh);
  if (columns.uvs && static_cast<std::size_t>(rows.list_counts[*columns.uvs]) != 2 * corners)
    values.other_counts = rows.count;
  const Property& list = element.properties[columns.vertices];
  const std::size_t offset = rows.offsets[columns.vertices] + size_of(*list.count_type), block = rows_a_block(rows);
  const std::size_t blocks = (rows.count + block - 1) / block;
  std::atomic<std::size_t> degenerate{0};
  const FixedFaces fixed_faces{element, rows, columns, big_endian_};
  std::atomic<bool> readable{true}, fixed{true};
  Faults wrong(blocks);
  for_each_index(static_cast<int>(blocks), threads_, [&](int index) {
    thread_local MeshFile::Scratch scratch;
    const std::size_t first = static_cast<std::size_t>(index) * block, count = std::min(block, rows.count - first);
    const std::size_t start = rows.start + first * rows.length;
    if (!fixed) return;
    const char* const bytes = file_.bytes(start, count * rows.length, scratch);
    if (bytes == nullptr) {
      readable = false;
    } else if (!have_same_lists(fixed_faces, bytes, count)) {
      fixed = false;
    } else {
      with_loader(list.type, big_endian_, [&](auto load) {
        const char* at = bytes + offset;
        std::uint32_t* face = mesh.indices.data() + corners * first;
        std::uint32_t largest = 0;
        std::size_t flat = 0;
        constexpr std::size_t size = sizeof load(at);
        for (std::size_t i = 0; i < count; ++i, at += rows.length, face += corners) {
          for (std::size_t k = 0; k < corners; ++k) {
            // Widened with its sign: a negative one becomes large.
            face[k] = static_cast<std::uint32_t>(static_cast<std::int64_t>(load(at + k * size)));
            largest = std::max(largest, face[k]);
          }
          flat += is_degenerate(face, corners) ? 1U : 0U;
        }
        degenerate += flat;
        read_fixed_values(fixed_faces, bytes, first, count, values);
        if (largest < mesh.vertex_count()) return;
        face = mesh.indices.data() + corners * first;
        std::size_t corner = 0;
        while (face[corner] < mesh.vertex_count()) ++corner;
        wrong[static_cast<std::size_t>(index)] =
            wrong_index(bytes + corner / corners * rows.length + offset + corner % corners * size, bytes, start,
                        mesh.vertex_count());
      });
    }
  });
  if (!fixed) return Outcome::other_lengths;
  faults.degenerate_faces = degenerate;
  return report(wrong, readable) ? Outcome::done : Outcome::failed;
}

bool BinaryBody::read_face_blocks(const Element& element, std::size_t start, const FaceColumns& columns, MeshData& mesh,
                                  FaceValues& values, MeshFaults& faults) {
  std::vector<RowBlock> blocks;
  std::size_t end = 0;
  if (!find_blocks(element, start, columns.vertices, blocks, end)) return false;
  std::vector<FaceCounts> counts;
  for (const RowBlock& block : blocks) counts.push_back(block.faces);
  counts = sums_before(counts);
  if (!make_faces(counts.back(), mesh, diagnostics_)) return false;
  values.allocate(columns, mesh);
  values.other_counts = 0;

  const std::string_view all = file_.text(false);
  Faults wrong(blocks.size());
  std::atomic<std::size_t> degenerate{0}, other_counts{0};
  for_each_index(static_cast<int>(blocks.size()), threads_, [&](int index) {
    const auto block = static_cast<std::size_t>(index);
    FaceValuesWriter face(mesh, counts[block].faces(mesh.corners), values);
    const auto on_scalar = [&](std::size_t which, const char* from) {
      if (which == columns.texture)
        face.texture = with_loader(element.properties[which].type, big_endian_,
                                   [&](auto load) { return static_cast<double>(load(from)); });
    };
    const auto on_list = [&](std::size_t which, std::size_t count, const char* from) {
      const auto with_values = [&](const auto& f) { with_loader(element.properties[which].type, big_endian_, f); };
      const std::size_t step = size_of(element.properties[which].type);
      if (which == columns.vertices) {
        face.polygon.resize(count);
        with_values([&](auto load) {
          for (std::uint32_t& corner : face.polygon) {
            corner = static_cast<std::uint32_t>(static_cast<std::int64_t>(load(from)));
            if (corner >= mesh.vertex_count() && !wrong[block])
              wrong[block] = wrong_index(from, all.data(), 0, mesh.vertex_count());
            from += step;
          }
        });
      } else if (which == columns.uvs) {
        face.uvs.resize(count);
        with_values([&](auto load) {
          for (float& value : face.uvs) {
            value = finite_or_zero(rounded(static_cast<double>(load(from))));
            from += step;
          }
        });
      }
    };
    const char* at = all.data() + blocks[block].start;
    const std::size_t last = std::min((block + 1) * block_rows, element.count);
    for (std::size_t row = block * block_rows; row < last && !wrong[block]; ++row) {
      face.clear();
      at = walk(element, at, all.data() + all.size(), on_scalar, on_list);
      if (!wrong[block]) face.add();
    }
    degenerate += face.degenerate();
    other_counts += face.other_counts();
  });
  values.other_counts = other_counts;
  faults.degenerate_faces = degenerate;
  faults.too_small_polygons = counts.back().too_small;
  return report(wrong, true);
}

bool BinaryBody::read_faces(const FaceColumns& columns, MeshData& mesh, FaceValues& values, MeshFaults& faults,
                            bool& dented_quads) {
  const std::size_t number = header_.find("face");
  const Element& element = header_.elements[number];
  const std::optional<std::size_t> start = start_of(number);
  if (!start) return false;
  if (element.count == 0) return make_faces({}, mesh, diagnostics_);
  if (const std::optional<FixedRows> rows = fixed_rows(element, *start)) {
    const std::int64_t corners = rows->list_counts[columns.vertices];
    Outcome outcome = Outcome::other_lengths;
    if (corners == 3) outcome = read_fixed_faces<3>(element, *rows, columns, mesh, values, faults);
    if (corners == 4) outcome = read_fixed_faces<4>(element, *rows, columns, mesh, values, faults);
    dented_quads = corners == 4;
    if (outcome != Outcome::other_lengths) return outcome == Outcome::done;
  }
  dented_quads = false;
  return read_face_blocks(element, *start, columns, mesh, values, faults);
}

}  // namespace

std::unique_ptr<Body> binary_body(MeshFile& file, const Header& header, int threads, Diagnostics& diagnostics) {
  return std::make_unique<BinaryBody>(file, header, threads, diagnostics);
}

}  // namespace raytrace::ply
