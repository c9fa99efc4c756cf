// How a model lies before a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "raytrace/description/scene_description.h"

namespace raytrace {

inline constexpr double degree = std::numbers::pi / 180;

/// From the model towards that place.
inline Vec3d towards(double azimuth, double elevation) {
  const double turn = azimuth * degree, rise = elevation * degree;
  return {std::sin(turn) * std::cos(rise), std::sin(rise), std::cos(turn) * std::cos(rise)};
}

/// The directions of a picture: to the right, upwards, and towards the viewer.
struct Directions {
  Vec3d right, up, back;

  Directions(double azimuth, double elevation)
      : right(std::cos(azimuth * degree), 0, -std::sin(azimuth * degree)),
        up(0, 0, 0),
        back(towards(azimuth, elevation)) {
    up = cross(back, right);
  }
  Vec3d of(const Vec3d& p) const { return {dot(p, right), dot(p, up), dot(p, back)}; }
};

/// What a picture shows of a model, in its directions.
struct Extent {
  Vec3d lower{1e300, 1e300, 1e300}, upper{-1e300, -1e300, -1e300};

  void add(const Vec3d& p) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  Vec3d middle() const { return (lower + upper) * 0.5; }
  double radius() const { return length(upper - lower) / 2; }
};

template <class Function>
void for_each_vertex(const MeshData& mesh, const Function& f) {
  const float* const p = mesh.positions.data();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    f(Vec3d{double{p[3 * i]}, double{p[3 * i + 1]}, double{p[3 * i + 2]}} + mesh.origin);
}

/// f(vertex), as its transform has it. Of each copy the corners of a box around it, since copies may be very many.
template <class Function>
void for_each_vertex(const SceneDescription& description, const Function& f) {
  for (const auto& mesh : std::get<ObjectItems<Mesh>>(description.objects)) {
    const Affine affine = mesh.transform.affine();
    for_each_vertex(*mesh.data, [&](const Vec3d& p) { f(affine.point(p)); });
    for (const MeshCopies& copies : mesh.data->copies) {
      Extent box;
      for_each_vertex(*copies.mesh, [&](const Vec3d& p) { box.add(p); });
      for (const MeshCopies::Place& place : copies.places)
        for (const double x : {box.lower.x, box.upper.x})
          for (const double y : {box.lower.y, box.upper.y})
            for (const double z : {box.lower.z, box.upper.z}) f(affine.point(place.affine.point({x, y, z})));
    }
  }
}

/// Of a scene that is a model.
inline const MeshData& data_of(const SceneDescription& description) {
  return *std::get<ObjectItems<Mesh>>(description.objects).front().data;
}

}  // namespace raytrace
