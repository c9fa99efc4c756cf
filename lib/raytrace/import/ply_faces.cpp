#include "raytrace/import/ply_faces.h"

#include <algorithm>

#include "raytrace/import/ply_body.h"

namespace raytrace::ply {

bool have_same_lists(const FixedFaces& faces, const char* bytes, std::size_t count) {
  const auto& [element, rows, columns, big_endian] = faces;
  const std::size_t length = rows.length;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (!element.properties[i].count_type) continue;
    const std::int64_t wanted = rows.list_counts[i];
    const char* const first = bytes + rows.offsets[i];
    const bool same = with_loader(*element.properties[i].count_type, big_endian, [&](auto load) {
      std::size_t others = 0;
      const char* at = first;
      for (std::size_t row = 0; row < count; ++row, at += length)
        others += static_cast<std::int64_t>(load(at)) == wanted ? 0U : 1U;
      return others == 0;
    });
    if (!same) return false;
  }
  return true;
}

void read_fixed_values(const FixedFaces& faces, const char* bytes, std::size_t first, std::size_t count,
                       FaceValues& values) {
  const auto& [element, rows, columns, big_endian] = faces;
  const auto corners = static_cast<std::size_t>(rows.list_counts[columns.vertices]);
  const std::size_t length = rows.length;
  if (columns.uvs) {
    const Property& list = element.properties[*columns.uvs];
    float* out = values.uvs.data() + 2 * corners * first;
    const char* row = bytes + rows.offsets[*columns.uvs] + size_of(*list.count_type);
    if (static_cast<std::size_t>(rows.list_counts[*columns.uvs]) == 2 * corners)
      with_loader(list.type, big_endian, [&](auto load) {
        for (std::size_t i = 0; i < count; ++i, row += length)
          for (std::size_t k = 0; k < 2 * corners; ++k)
            *out++ = finite_or_zero(rounded(static_cast<double>(load(row + k * sizeof load(row)))));
      });
    else
      std::fill_n(out, 2 * corners * count, 0.0F);
  }
  if (columns.texture)
    with_loader(element.properties[*columns.texture].type, big_endian, [&](auto load) {
      const char* row = bytes + rows.offsets[*columns.texture];
      for (std::size_t i = 0; i < count; ++i, row += length)
        values.set_texture(first + i, static_cast<double>(load(row)));
    });
}

}  // namespace raytrace::ply
