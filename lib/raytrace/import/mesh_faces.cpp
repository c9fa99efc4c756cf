#include "raytrace/import/mesh_faces.h"

#include <algorithm>
#include <bit>
#include <string>

#include "raytrace/import/empty_files.h"
#include "raytrace/import/unique_items.h"
#include "raytrace/math/srgb.h"
#include "raytrace/math/vec3.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

constexpr float largest_coordinate = 1e18F;
constexpr std::size_t most_ears = 128;  // ears take time that grows with the square of the corners

Vec3d mesh_position(const float* positions, std::uint32_t vertex) {
  const float* const p = positions + std::size_t{3} * vertex;
  return {p[0], p[1], p[2]};
}

/// Twice the area of a triangle, positive if it runs counter-clockwise.
double signed_area(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Of each vertex, what its first corner has.
void gather_values(const UniqueItems& vertices, std::size_t numbers, const MeshBuffer<std::uint32_t>& of_corners,
                   int threads, MeshBuffer<float>& values) {
  if (values.empty()) return;
  MeshBuffer<float> gathered(numbers * vertices.first.size());
  for_each_chunk(vertices.first.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t from = of_corners[vertices.first[i]];
      for (std::size_t k = 0; k < numbers; ++k)
        gathered[numbers * i + k] = from == no_index ? 0 : values[numbers * std::size_t{from} + k];
    }
  });
  values = std::move(gathered);
}

}  // namespace

void join_vertices(MeshData& mesh, const MeshBuffer<std::uint32_t>& uvs, const MeshBuffer<std::uint32_t>& normals,
                   int threads) {
  const auto index = [](const MeshBuffer<std::uint32_t>& of_corners, std::size_t i) {
    return of_corners.empty() ? no_index : of_corners[i];
  };
  UniqueItems vertices = unique_items(
      mesh.indices.size(), threads,
      [&](std::size_t i) {
        return mixed_bits((std::uint64_t{mesh.indices[i]} << 32U | index(uvs, i)) + mixed_bits(index(normals, i)));
      },
      [&](std::size_t i, std::size_t j) {
        return mesh.indices[i] == mesh.indices[j] && index(uvs, i) == index(uvs, j) &&
               index(normals, i) == index(normals, j);
      });
  const auto gather = [&](MeshBuffer<float>& values, std::size_t numbers, const MeshBuffer<std::uint32_t>& of_corners) {
    gather_values(vertices, numbers, of_corners, threads, values);
  };
  gather(mesh.positions, 3, mesh.indices);
  gather(mesh.colors, 3, mesh.indices);
  gather(mesh.alphas, 1, mesh.indices);
  gather(mesh.uvs, 2, uvs);
  gather(mesh.normals, 3, normals);
  mesh.indices = std::move(vertices.number);
}

void join_vertices(MeshData& mesh, const MeshBuffer<float>& uvs, int threads) {
  const auto bits = [&](std::size_t i) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(uvs[2 * i])} << 32U |
           std::bit_cast<std::uint32_t>(uvs[2 * i + 1]);
  };
  UniqueItems vertices = unique_items(
      mesh.indices.size(), threads, [&](std::size_t i) { return mixed_bits(bits(i) + mixed_bits(mesh.indices[i])); },
      [&](std::size_t i, std::size_t j) { return mesh.indices[i] == mesh.indices[j] && bits(i) == bits(j); });
  for (MeshBuffer<float>* const values : {&mesh.positions, &mesh.colors, &mesh.normals})
    gather_values(vertices, 3, mesh.indices, threads, *values);
  gather_values(vertices, 1, mesh.indices, threads, mesh.alphas);
  mesh.uvs = MeshBuffer<float>(2 * vertices.first.size());
  for (std::size_t i = 0; i < vertices.first.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) mesh.uvs[2 * i + k] = uvs[2 * std::size_t{vertices.first[i]} + k];
  mesh.indices = std::move(vertices.number);
}

bool make_faces(const FaceCounts& counts, MeshData& mesh, Diagnostics& diagnostics) {
  const bool keeps = mesh.keeps_polygons && counts.quads + counts.cut > 0;
  mesh.corners = keeps ? 4 : counts.corners();
  const std::size_t faces = counts.faces(mesh.corners);
  if (faces >= std::numeric_limits<std::uint32_t>::max()) {
    diagnostics.error({}, "has more than 4294967294 faces");
    return false;
  }
  mesh.indices = MeshBuffer<std::uint32_t>(faces * static_cast<std::size_t>(mesh.corners));
  if (keeps && counts.cut > 0) mesh.continued = MeshBuffer<std::uint8_t>(faces);
  return true;
}

void PolygonCutter::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  faces_.insert(faces_.end(), {a, b, c});
  if (corners_ == 4) faces_.push_back(c);
}

bool PolygonCutter::find_dents(std::span<const std::uint32_t> polygon) {
  const std::size_t count = polygon.size();
  const auto at = [&](std::size_t i) { return mesh_position(positions_, polygon[i % count]); };
  // Newell's normal: the sum of the triangles' around any point, here the first corner.
  Vec3d normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < count; ++i) normal += cross(at(i) - at(0), at(i + 1) - at(0));
  dents_.assign(count, 0);
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d corner = at(i);
    dents_[i] = dot(cross(corner - at(i + count - 1), at(i + 1) - corner), normal) < 0;
    any = any || dents_[i] != 0;
  }
  if (!any || count <= 4 || count > most_ears) return any;

  // For the ears: the polygon in the coordinate plane that it faces most, counter-clockwise.
  const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const bool mirrored = component(normal, axis) < 0;
  plane_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d corner = at(i);
    const double u = component(corner, (axis + 1) % 3), v = component(corner, (axis + 2) % 3);
    plane_[i] = mirrored ? std::array{v, u} : std::array{u, v};
  }
  return any;
}

void PolygonCutter::cut_ears(std::span<const std::uint32_t> polygon) {
  const auto count = static_cast<std::uint32_t>(polygon.size());
  next_.resize(count);
  previous_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    next_[i] = (i + 1) % count;
    previous_[i] = (i + count - 1) % count;
  }
  const auto is_ear = [&](std::uint32_t b) {
    const std::uint32_t a = previous_[b], c = next_[b];
    if (signed_area(plane_[a], plane_[b], plane_[c]) <= 0) return false;
    for (std::uint32_t i = next_[c]; i != a; i = next_[i]) {
      const auto& p = plane_[i];
      if (p == plane_[a] || p == plane_[b] || p == plane_[c]) continue;
      if (signed_area(plane_[a], plane_[b], p) >= 0 && signed_area(plane_[b], plane_[c], p) >= 0 &&
          signed_area(plane_[c], plane_[a], p) >= 0)
        return false;
    }
    return true;
  };
  std::uint32_t corner = 0;
  for (std::uint32_t left = count; left > 3; --left) {
    // A polygon that crosses itself may have no ear; then any corner does.
    std::uint32_t tries = 0;
    while (tries < left && !is_ear(corner)) corner = next_[corner], ++tries;
    const std::uint32_t a = previous_[corner], c = next_[corner];
    add(a, corner, c);
    next_[a] = c;
    previous_[c] = a;
    corner = c;
  }
  add(previous_[corner], corner, next_[corner]);
}

std::span<const std::uint32_t> PolygonCutter::cut(std::span<const std::uint32_t> polygon) {
  faces_.clear();
  const std::size_t count = polygon.size();
  if (count == 3) {
    add(0, 1, 2);
    return faces_;
  }
  const bool dented = find_dents(polygon);
  if (count == 4) {
    const std::uint32_t first = dented && (dents_[0] != 0 || dents_[2] != 0) ? 1 : 0;
    const std::uint32_t a = first, b = first + 1, c = first + 2, d = (first + 3) % 4;
    if (corners_ == 4) {
      faces_.insert(faces_.end(), {a, b, c, d});
    } else {
      add(a, b, d);
      add(c, d, b);
    }
  } else if (dented && count <= most_ears) {
    cut_ears(polygon);
  } else {
    for (std::uint32_t i = 1; i + 1 < count; ++i) add(0, i, i + 1);
  }
  return faces_;
}

float srgb_to_linear(double value, double most) {
  const auto linear = [](double encoded) { return static_cast<float>(linear_of_srgb(encoded)); };
  static const auto of_byte = [&] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = linear(static_cast<double>(i) / 255);
    return table;
  }();
  const double inside = value > 0 ? std::min(value, most) : 0;
  return most == 255 ? of_byte[static_cast<std::size_t>(inside)] : linear(inside / most);
}

std::size_t mark_bad_positions(float* positions, std::size_t count) {
  const auto is_bad = [](float value) { return !(std::abs(value) <= largest_coordinate); };
  unsigned any = 0;
  for (std::size_t i = 0; i < 3 * count; ++i) any |= static_cast<unsigned>(is_bad(positions[i]));
  if (any == 0) return 0;
  std::size_t bad = 0;
  for (float* p = positions; p != positions + 3 * count; p += 3) {
    if (!is_bad(p[0]) && !is_bad(p[1]) && !is_bad(p[2])) continue;
    p[0] = p[1] = p[2] = std::numeric_limits<float>::quiet_NaN();
    ++bad;
  }
  return bad;
}

void leave_out_ones(MeshBuffer<float>& alphas) {
  if (std::all_of(alphas.begin(), alphas.end(), [](float alpha) { return alpha >= 1; })) alphas = {};
}

void leave_out_faults(MeshData& mesh, MeshFaults& faults) {
  if (faults.bad_vertices == 0 && faults.degenerate_faces == 0) return;
  const auto corners = static_cast<std::size_t>(mesh.corners);
  const std::size_t all = mesh.face_count();
  std::size_t kept = 0;
  bool follows_kept = false;  // that the first triangle of its polygon is there
  faults.degenerate_faces = 0;
  auto next_part = mesh.parts.begin();
  for (std::size_t i = 0; i < all; ++i) {
    for (; next_part != mesh.parts.end() && next_part->first_face == i; ++next_part) next_part->first_face = kept;
    const std::uint32_t* const face = &mesh.indices[corners * i];
    const bool continues = !mesh.continued.empty() && mesh.continued[i] != 0;
    follows_kept = follows_kept && continues;
    if (is_degenerate(face, mesh.corners)) {
      ++faults.degenerate_faces;
      continue;
    }
    if (std::any_of(face, face + corners,
                    [&](std::uint32_t v) { return std::isnan(mesh.positions[3 * std::size_t{v}]); }))
      continue;
    std::copy(face, face + corners, &mesh.indices[corners * kept]);
    if (!mesh.face_materials.empty()) mesh.face_materials[kept] = mesh.face_materials[i];
    if (!mesh.continued.empty()) mesh.continued[kept] = follows_kept ? 1 : 0;
    follows_kept = true;
    ++kept;
  }
  for (; next_part != mesh.parts.end(); ++next_part) next_part->first_face = kept;
  mesh.indices.shorten_to(corners * kept);
  if (!mesh.face_materials.empty()) mesh.face_materials.shorten_to(kept);
  if (!mesh.continued.empty()) mesh.continued.shorten_to(kept);
  if (faults.bad_vertices > 0)
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (std::isnan(mesh.positions[i])) mesh.positions[i] = 0;
  faults.faces_at_bad_vertices = all - kept - faults.degenerate_faces;
}

void report_faults(const MeshFaults& faults, Diagnostics& diagnostics) {
  const auto warn = [&](std::size_t count, const std::string& what) {
    if (count > 0) diagnostics.warning({}, std::to_string(count) + what);
  };
  warn(faults.bad_vertices, " vertices are not finite or beyond 1e18; " + std::to_string(faults.faces_at_bad_vertices) +
                                " faces at them are left out");
  warn(faults.degenerate_faces + faults.too_small_polygons,
       " faces have less than three different corners and are left out");
}

bool finish_mesh(MeshData& mesh, MeshFaults faults, bool dented_quads, int threads, Diagnostics& diagnostics) {
  if (dented_quads && mesh.corners == 4) {
    for_each_chunk(mesh.face_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
      PolygonCutter cutter(mesh.positions.data(), 4);
      for (std::uint32_t* face = &mesh.indices[4 * first]; face != &mesh.indices[4 * last]; face += 4)
        if (face[2] != face[3] && cutter.cut({face, 4})[0] == 1) std::rotate(face, face + 1, face + 4);
    });
  }
  const bool has_faces = mesh.face_count() > 0;
  leave_out_faults(mesh, faults);
  report_faults(faults, diagnostics);
  if (mesh.face_count() == 0) diagnostics.error({}, has_faces ? "has no faces that can be rendered" : no_faces);
  return mesh.face_count() > 0;
}

}  // namespace raytrace
