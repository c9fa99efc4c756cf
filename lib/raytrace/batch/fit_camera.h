// A camera that has all of a scene in view.
#pragma once

#include <algorithm>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// What is in view reaches to so much of the way from the picture's middle to its edge.
inline constexpr double part_in_view = 0.92;

/// How far all points p reach to either side in a picture of half width `tangent` at distance 1, whose middle is
/// `shift` beside the view's axis: the largest p.across + (tangent + shift) p.back, and (tangent - shift) p.back -
/// p.across, where back is the way towards the viewer.
struct Reach {
  double tangent, shift = 0, right = -1e300, left = -1e300;

  void add(double across, double back) {
    right = std::max(right, across + (tangent + shift) * back);
    left = std::max(left, (tangent - shift) * back - across);
  }
  /// Of the picture, at the eye's distance from there.
  double middle() const { return (right - left) / 2; }
  /// Where the eye is to have the middle there, at that distance.
  double eye(double eye_distance) const { return middle() - shift * eye_distance; }
  /// Of the eye that has just all of them in view, in the direction towards the viewer.
  double distance() const { return (right + left) / (2 * tangent); }
};

/// Moves the scene's camera so that all objects of `shown` are just in view. It keeps its direction and its angle of
/// view, or, where it is orthographic, gets larger or smaller pixels; a thin lens is focused on the middle of what is
/// in view. Planes, which have no end, do not count; nor do objects of an emissive material, which are lamps, if there
/// are others. shown: loaded (load_meshes()); a scene, perhaps the same one. Throws SettingsError if there is nothing
/// to be in view, or if the camera sees all around, or moves while its shutter is open.
void fit_camera(const SceneDescription& shown, SceneDescription& scene);

/// How far a scene's objects reach: the largest dot(p, along). What counts is as for fit_camera(), and so is what is
/// thrown.
double reach_along(const SceneDescription& scene, const Vec3d& along);

}  // namespace raytrace
