// What moves while the shutter is open.
#pragma once

#include <memory>

#include "transformed.h"

namespace reference {

/// A shape under a transform whose turn and move change evenly from the shutter's opening to its closing, in the scene
/// format by keys. As the format says it, the map is that at 17 moments, and between two of them a part of each.
class Moving : public Shape {
 public:
  /// now: when it is asked, from 0 to 1. group: as of Transformed.
  Moving(ShapePointer shape, const Transform& opens, Real turn, Vector way, std::shared_ptr<const Real> now,
         std::string group)
      : shape_(std::move(shape)),
        opens_(opens),
        turn_(turn),
        way_(way),
        now_(std::move(now)),
        group_(std::move(group)) {}
  Crossings crossings(const Ray& ray) const override;
  Real distance(Vector point) const override { return shape_->distance(inverse_point(map(), point)); }
  Vector normal(Vector point) const override;
  Real smallest_extent() const override { return shape_->smallest_extent() * opens_.smallest_scale(); }
  Real largest_extent() const override { return shape_->largest_extent() * opens_.largest_scale(); }
  std::string element() const override { return group_.empty() ? shape_->element() : "instance"; }
  std::string group() const override { return group_.empty() ? shape_->group() : "instances"; }
  std::string parameters() const override;

 private:
  /// Where the axes' unit vectors and the origin go.
  struct Map {
    Vector x, y, z, origin;
  };
  Map map() const;
  static Vector inverse_vector(const Map& map, Vector v);
  static Vector inverse_point(const Map& map, Vector p) { return inverse_vector(map, p - map.origin); }

  ShapePointer shape_;
  Transform opens_;
  Real turn_;  ///< in degrees
  Vector way_;
  std::shared_ptr<const Real> now_;
  std::string group_;
};

/// Opens the scene's shutter from half a frame before frame 1 to a quarter after it, and moves the camera and most
/// objects in that time, some of them as instances. The scene's time is to be set.
void set_in_motion(Scene& scene, unsigned seed);

}  // namespace reference
