// STL: https://en.wikipedia.org/wiki/STL_(file_format). Facets' normals are not kept: they follow from the corners.
#include <atomic>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/import/mesh_text.h"
#include "raytrace/import/unique_items.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace stl {
namespace {

constexpr std::size_t head_bytes = 84, facet_bytes = 50;
constexpr std::size_t most_corners = std::size_t{1} << 31U;

std::uint32_t little_endian_at(const char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
  return value;
}

bool refuse_too_many(Diagnostics& diagnostics) {
  diagnostics.error({}, "has more than 715827882 facets");
  return false;
}

/// Rounds a coordinate as the others; 0 has no sign, so that equal positions have equal bits.
float coordinate(double value, double origin) { return rounded(value - origin) + 0.0F; }

bool read_binary(const MeshFile& file, std::size_t facets, const MeshReadSettings& settings, Diagnostics& diagnostics,
                 MeshBuffer<float>& corners) {
  if (3 * facets >= most_corners) return refuse_too_many(diagnostics);
  corners = MeshBuffer<float>(9 * facets);
  constexpr std::size_t block = 4096;
  std::atomic<bool> readable{true};
  for_each_index(static_cast<int>((facets + block - 1) / block), settings.threads, [&](int index) {
    thread_local MeshFile::Scratch scratch;
    const std::size_t first = static_cast<std::size_t>(index) * block, count = std::min(block, facets - first);
    const char* facet = file.bytes(head_bytes + facet_bytes * first, facet_bytes * count, scratch);
    if (facet == nullptr) {
      readable = false;
      return;
    }
    float* out = corners.data() + 9 * first;
    constexpr std::size_t normal_bytes = 12;
    for (std::size_t i = 0; i < count; ++i, facet += facet_bytes)
      for (std::size_t k = 0; k < 9; ++k)
        *out++ = coordinate(double{std::bit_cast<float>(little_endian_at(facet + normal_bytes + 4 * k))},
                            component(settings.origin, static_cast<int>(k % 3)));
  });
  if (!readable) MeshFile::report_changed(diagnostics);
  return readable;
}

bool is_word(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((word[i] | 0x20) != lower_case[i]) return false;
  return true;
}

bool read_text(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics, MeshBuffer<float>& corners) {
  if (!file.load(settings.threads, diagnostics)) return false;
  const std::string_view text = file.text(true);
  const std::vector<std::size_t> starts = line_chunks(text);
  const std::size_t chunks = starts.size() - 1;
  /// Calls f(word, rest of the line) for each line that has any.
  const auto for_words = [&](std::size_t chunk, const auto& f) {
    for_each_line<false>(text.substr(starts[chunk], starts[chunk + 1] - starts[chunk]),
                         [&](const char* start, const char* end) {
                           LineWords words(start, end, '\0');
                           if (const std::string_view word = words.word(); !word.empty()) f(word, words);
                           return true;
                         });
  };
  std::vector<std::size_t> counts(chunks);
  for_each_index(static_cast<int>(chunks), settings.threads, [&](int index) {
    const auto chunk = static_cast<std::size_t>(index);
    for_words(chunk, [&](std::string_view word, LineWords&) { counts[chunk] += is_word(word, "vertex") ? 1U : 0U; });
  });
  counts = sums_before(counts);
  if (counts.back() >= most_corners) return refuse_too_many(diagnostics);

  corners = MeshBuffer<float>(3 * counts.back());
  std::vector<ChunkErrors> errors(chunks);
  for_each_index(static_cast<int>(chunks), settings.threads, [&](int index) {
    const auto chunk = static_cast<std::size_t>(index);
    std::size_t corner = counts[chunk];
    for_words(chunk, [&](std::string_view word, LineWords& words) {
      const auto refuse = [&](const std::string& message) {
        errors[chunk].add(static_cast<std::size_t>(word.data() - text.data()), message);
      };
      if (is_word(word, "vertex")) {
        float* const position = &corners[3 * corner++];
        for (int axis = 0; axis < 3; ++axis) {
          double value = 0;
          if (!words.number(value)) return refuse("a vertex needs three numbers");
          position[axis] = coordinate(value, component(settings.origin, axis));
        }
      } else if (is_word(word, "endloop")) {
        if (corner % 3 != 0) refuse("a facet with other than three vertices, here or before");
      } else if (!is_word(word, "facet") && !is_word(word, "outer") && !is_word(word, "endfacet") &&
                 !is_word(word, "solid") && !is_word(word, "endsolid")) {
        refuse("unknown word " + in_quotes(word) + " in an STL file");
      }
    });
  });
  if (!ChunkErrors::report(errors, text, diagnostics)) return false;
  if (counts.back() % 3 == 0) return true;
  diagnostics.error({locate(text, text.size()).line, 0}, "the file ends within a facet");
  return false;
}

/// Makes vertices and faces of the corners of facets.
void make_mesh(MeshBuffer<float> corners, bool weld, int threads, MeshData& mesh) {
  const std::size_t count = corners.size() / 3;
  if (!weld) {
    mesh.indices = MeshBuffer<std::uint32_t>(count);
    for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
    });
    mesh.positions = std::move(corners);
    return;
  }
  const auto bits = [&](std::size_t corner) {
    std::array<std::uint32_t, 3> of_corner;
    std::memcpy(of_corner.data(), &corners[3 * corner], sizeof of_corner);
    return of_corner;
  };
  UniqueItems vertices = unique_items(
      count, threads,
      [&](std::size_t i) {
        const auto [x, y, z] = bits(i);
        return mixed_bits((std::uint64_t{x} << 32U | y) + mixed_bits(z));
      },
      [&](std::size_t i, std::size_t j) { return bits(i) == bits(j); });
  mesh.positions = MeshBuffer<float>(3 * vertices.first.size());
  for_each_chunk(vertices.first.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      std::memcpy(&mesh.positions[3 * i], &corners[std::size_t{3} * vertices.first[i]], 3 * sizeof(float));
  });
  mesh.indices = std::move(vertices.number);
}

}  // namespace
}  // namespace stl

std::optional<MeshData> read_stl(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  // Some binary files begin with "solid" as well; then their size tells that they are.
  MeshFile::Scratch scratch;
  const std::size_t head = std::min(file.size(), stl::head_bytes);
  const char* const first = file.bytes(0, head, scratch);
  if (first == nullptr) {
    MeshFile::report_changed(diagnostics);
    return std::nullopt;
  }
  const std::string_view begin(first, head);
  const std::size_t claimed = head == stl::head_bytes ? stl::little_endian_at(first + 80) : 0;
  const std::size_t room = head == stl::head_bytes ? (file.size() - head) / stl::facet_bytes : 0;
  const bool exact = head == stl::head_bytes && file.size() == head + claimed * stl::facet_bytes;
  const std::size_t word = begin.find_first_not_of(" \t\r\n");
  const bool solid = word != std::string_view::npos && stl::is_word(begin.substr(word, 5), "solid");

  MeshBuffer<float> corners;
  if (!exact && solid) {
    if (!stl::read_text(file, settings, diagnostics, corners)) return std::nullopt;
  } else if (head < stl::head_bytes) {
    diagnostics.error({},
                      "byte 0: this is no STL file: it neither begins with 'solid', nor has it the 84 bytes of a "
                      "binary file's head");
    return std::nullopt;
  } else if (claimed > room) {
    diagnostics.error(
        {}, "byte 80: claims " + std::to_string(claimed) + " facets, and has room for " + std::to_string(room));
    return std::nullopt;
  } else {
    if (!exact) {
      const std::size_t end = head + claimed * stl::facet_bytes;
      diagnostics.warning({}, "byte " + std::to_string(end) + ": " + std::to_string(file.size() - end) +
                                  " bytes behind the last facet are not read");
    }
    if (!stl::read_binary(file, claimed, settings, diagnostics, corners)) return std::nullopt;
  }

  MeshFaults faults;
  std::atomic<std::size_t> bad{0}, degenerate{0};
  for_each_chunk(corners.size() / 3, settings.threads, [&](std::size_t, std::size_t from, std::size_t to) {
    bad += mark_bad_positions(corners.data() + 3 * from, to - from);
  });
  MeshData mesh;
  stl::make_mesh(std::move(corners), settings.weld, settings.threads, mesh);
  for_each_chunk(mesh.face_count(), settings.threads, [&](std::size_t, std::size_t from, std::size_t to) {
    std::size_t flat = 0;
    for (std::size_t i = from; i < to; ++i) flat += is_degenerate(&mesh.indices[3 * i], 3) ? 1U : 0U;
    degenerate += flat;
  });
  faults.bad_vertices = bad;
  faults.degenerate_faces = degenerate;
  if (!finish_mesh(mesh, faults, false, settings.threads, diagnostics)) return std::nullopt;
  return mesh;
}

}  // namespace raytrace
