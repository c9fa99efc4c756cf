// Objects projected from a direction buffer's origin: the parts of a cube's faces around it that they are behind.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "raytrace/math/bounds.h"
#include "raytrace/math/vec3.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// Where an object is: all that a direction buffer wants to know.
struct BoundedObject {
  std::uint16_t shape_type;  ///< as in Hits
  bool is_sphere;  ///< whether it is the sphere of `radius` itself, so that no ray leads through that and misses it
  std::uint32_t primitive;
  Bounds bounds;
  double radius;                   ///< of a sphere around it, whose center is that of the bounds
  const Vec3f* corners = nullptr;  ///< of a triangle, three; it must stay where it is
};

struct Interval {
  double low, high;
};

/// A part of a face: of a direction, `across` is the component along the axis after the normal's (x, y, z, x, ...) and
/// `up` that along the one after it, divided by the size of the component along the normal.
struct FaceRectangle {
  Interval across, up;
};

/// An object as seen from the origin, which is at (0, 0, 0) here.
struct ProjectedBounds {
  std::array<Interval, 3> along;  ///< its box
  double nearest;                 ///< DirectionBuffer::depth(), which no part of it has less of
  Vec3d center;                   ///< of a sphere around it
  double distance;                ///< of that center
  bool in_cone;                   ///< whether that sphere says more than the box does; then
  double sine = 0, cosine = 1;    ///< of the angle between the axis of the cone around the sphere and its sides
  // Of an object that is a sphere, seen as large as it is at least: a cone whose rays all meet it. 0: there is none.
  double inner_sine = 0, inner_cosine = 1;
  double behind = 0;  ///< what is as deep as that or deeper is behind the surface that those rays meet
};

/// The directions to a triangle lie between three planes through the origin and an edge each.
struct EdgePlanes {
  std::array<Vec3f, 3> inward;  ///< the planes' normals, of unit length; 0 where an edge is seen end on
  float slack;  ///< how far, times its length, a direction that leads to the triangle may be on a plane's other side
};

/// From infinitely far, all directions are the same, and what is seen is a picture across them. To have but one way
/// from there on, positions on it become directions: those from (0, 0, 0) to that picture on a face of the cube.
class CubeProjection {
 public:
  /// threads: so many at most share the work; 0: all that the machine has. The result does not depend on it.
  CubeProjection(const BufferOrigin& origin, std::span<const BoundedObject> objects, int threads);

  /// None from inside the sphere around it, or from so close that a cone says little.
  std::optional<ProjectedBounds> view(const BoundedObject& object) const;

  /// Of an object with corners that there is a view of.
  EdgePlanes edge_planes(const BoundedObject& object) const;

  bool infinitely_far() const { return infinitely_far_; }

  /// How far the rays of a direction buffer may come: from a point, their length; parallel ones, how far from
  /// (0, 0, 0) they start.
  double reach() const { return reach_; }

  /// A box around all objects, a part of the reach wider than they are.
  Bounds surroundings() const;

  /// Whether floats hold such distances, and their squares. There are no views where they do not.
  bool is_within_floats() const;

  /// From infinitely far: a point's place in the picture is (across . point, up . point) - start, and its depth start.z
  /// less its distance towards the origin. Exact in float.
  const Vec3d& across() const { return across_; }
  const Vec3d& up() const { return up_; }
  const Vec3d& start() const { return start_; }

 private:
  void lay_picture(std::span<const BoundedObject> objects, int threads);
  Interval extent(const BoundedObject& object, const Vec3d& axis) const;
  Vec3d direction_to(const Vec3f& point) const;

  bool infinitely_far_;
  Vec3d place_;  ///< or, of unit length, the direction towards it
  double farthest_ = 0, reach_ = 0, slack_ = 0;
  Bounds around_all_ = empty_bounds;
  Vec3d across_{}, up_{}, start_{};
};

/// The part of a face that the object is behind; none if it is behind others only. face: twice the axis of its normal,
/// and one more on the negative side. As large as the rounding of a quotient of floats may make it.
std::optional<FaceRectangle> face_rectangle(int face, const ProjectedBounds& view);

}  // namespace raytrace
