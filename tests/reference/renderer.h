// Renders a scene by the formulas of the scene format, ray by ray and object by object.
#pragma once

#include <optional>
#include <vector>

#include "scene.h"

namespace reference {

struct Hit {
  std::size_t object = 0;
  Real distance = 0;  ///< in multiples of the ray's direction
};

/// The nearest object of the scene in front of the ray's origin.
std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray);

/// Of all crossings of a shape with a ray that starts at a point of it: those in front, without that point itself.
Crossings crossings_leaving(const Shape& shape, const Ray& ray);

/// Whether there is a ray through that point of the pixel: outside of a fisheye's circle the picture is black.
bool has_ray(const Scene& scene, int column, int row, Real px, Real py);

/// The ray through point (px, py), (0, 0) the lower left corner, of the pixel in `column` from the left and `row` from
/// the bottom.
Ray camera_ray(const Scene& scene, int column, int row, Real px, Real py);

/// The radiance that comes back along a ray: red, green, blue.
Vector radiance(const Scene& scene, const Ray& ray);

/// The picture at one sample a pixel, through its centre; the top row first.
std::vector<Vector> render(const Scene& scene);

/// A pixel's mean over a grid of side x side points; x, y from the top left corner of the picture.
Vector supersampled_pixel(const Scene& scene, int x, int y, int side);

}  // namespace reference
