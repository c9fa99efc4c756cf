// A scene for the reference renderer, in the terms of the scene format.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shapes.h"

namespace reference {

struct Material {
  std::string name;
  bool phong = false;  ///< a matte otherwise: ks, cs and exponent do not count
  Real ka = 0, kd = 0, ks = 0;
  Vector cd, cs;  ///< red, green, blue
  Real exponent = 20;
};

struct Light {
  enum class Kind { point, directional };
  Kind kind = Kind::point;
  Vector place;  ///< of a point light: where it is; of a directional one: the direction towards it
  Real scale = 1;
  Vector color{1, 1, 1};
  bool shadows = true;
};

struct Object {
  ShapePointer shape;
  std::size_t material = 0;  ///< index into Scene::materials
  bool visible = true;       ///< to the camera
};

/// For instances: a shape in a group of its own.
struct Group {
  std::string name;
  ShapePointer shape;
};

struct Scene {
  int hres = 160, vres = 120;
  Real pixel_size = 1;
  int samples = 1;
  Vector background;

  Vector eye, look_at;
  Vector up{0, 1, 0};  ///< not parallel to the view: the scene format leaves open what happens then
  Real view_distance = 1;
  Real near_clip = 0;  ///< the camera sees nothing nearer, along its view

  enum class Projection { pinhole, thin_lens, fisheye, spherical };
  Projection projection = Projection::pinhole;
  Real lens_radius = 0, focal_distance = 1;  ///< of a thin lens
  int blades = 0;
  Real blade_rotation = 0;  ///< in degrees
  Real angle = 180;         ///< of a fisheye, in degrees
  /// The point of the unit square that a pixel (column from the left, row from the bottom) has for its lens.
  std::function<std::array<Real, 2>(int column, int row)> lens_sample;

  // What moves while the shutter is open (moving.h), from 0 to 1.
  std::string shutter, eye_keys;                  ///< elements of the scene format
  Vector eye_way;                                 ///< of the eye, in that time
  std::function<Real(int column, int row)> time;  ///< of a pixel's rays; empty: nothing moves
  std::shared_ptr<Real> now;                      ///< where it is known

  bool has_ambient = false;
  Real ambient_scale = 1;
  Vector ambient_color{1, 1, 1};

  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Object> objects;
  std::vector<Group> groups;
};

/// The scene as a file of the scene format; every number reads back as the same double.
std::string scene_text(const Scene& scene);

/// Scene number `seed` of an endless series: one to two dozen objects of all shapes around the view, matte and Phong,
/// up to four lights, coloured, some without shadows, at scales from 0.01 to 1000, some far from the origin, some with
/// the eye inside an object. All its numbers are exact in float.
Scene random_scene(unsigned seed);

}  // namespace reference
