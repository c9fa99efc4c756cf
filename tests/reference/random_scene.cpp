#include "random.h"
#include "scene.h"

namespace reference {

namespace {

/// Rounds to float, so that a renderer that keeps floats reads the very same scene.
Real exact(Real x) { return static_cast<float>(x); }
Vector exact(Vector v) { return {exact(v.x), exact(v.y), exact(v.z)}; }

Material random_material(Random& random, std::size_t number) {
  Material material;
  material.name = "material" + std::to_string(number);
  material.phong = random.chance(0.5L);
  material.ka = exact(random.between(0, 0.5L));
  material.kd = exact(random.between(0.1L, 1));
  material.ks = exact(random.between(0, 0.8L));
  material.cd = exact(random.color());
  material.cs = exact(random.color());
  material.exponent = exact(random.log_between(1, 200));
  return material;
}

/// A shape of about `size` about `place`.
ShapePointer random_shape(Random& random, int kind, Vector place, Real size) {
  const auto number = [&](Real low, Real high) { return exact(size * random.between(low, high)); };
  const auto near_place = [&](Real reach) { return exact(place + reach * size * random.in_cube(1)); };
  switch (kind) {
    case 0:
      return std::make_shared<Sphere>(exact(place), number(0.3L, 1));
    case 1:
      return std::make_shared<Triangle>(near_place(2), near_place(2), near_place(2));
    case 2:
      return std::make_shared<Cylinder>(near_place(1), near_place(1), number(0.1L, 0.6L));
    case 3: {
      const Vector axis =
          exact(random.chance(0.3L) ? Vector{0, 1, 0} : random.log_between(0.1L, 10) * random.direction());
      return std::make_shared<Torus>(exact(place), axis, number(0.4L, 1),
                                     number(0.05L, random.chance(0.1L) ? 1.2L : 0.4L));
    }
    case 4:
      return std::make_shared<Rectangle>(near_place(1), exact(size * random.direction()),
                                         exact(size * random.direction()));
    case 5: {
      const Vector corner = near_place(1);
      return std::make_shared<Box>(corner,
                                   exact(corner + Vector{number(0.2L, 1.5L), number(0.2L, 1.5L), number(0.2L, 1.5L)}));
    }
    case 6:
      return std::make_shared<Cone>(near_place(1), near_place(1), number(0.1L, 0.6L),
                                    random.chance(0.5L) ? 0 : number(0.1L, 0.6L), random.chance(0.5L));
    case 7:
      return std::make_shared<Annulus>(exact(place), exact(random.direction()), number(0.6L, 1), number(0.1L, 0.5L));
    case 8:
      return std::make_shared<CappedCylinder>(near_place(1), near_place(1), number(0.1L, 0.6L));
    default:
      return std::make_shared<Disk>(exact(place), exact(random.direction()), number(0.3L, 1));
  }
}

Light random_light(Random& random, Vector middle, Real scale) {
  Light light;
  const bool point = random.chance(0.6L);
  light.kind = point ? Light::Kind::point : Light::Kind::directional;
  const Vector towards = random.direction() + Vector{0, 0.7L, 0};
  light.place =
      exact(point ? middle + random.between(2, 10) * scale * towards : random.log_between(0.1L, 10) * towards);
  light.scale = exact(random.between(0.3L, 2));
  light.color = exact(random.chance(0.4L) ? Vector{1, 1, 1} : random.color());
  light.shadows = random.chance(0.75L);
  return light;
}

}  // namespace

Scene random_scene(unsigned seed) {
  Random random(seed);
  Scene scene;
  const Real scale = random.log_between(0.01L, 1000);
  const Real offset = random.chance(0.3L) ? 100 * scale : scale;  // of the whole scene from the origin
  const Vector middle = exact(offset * random.in_cube(1));

  scene.background = exact(0.5L * random.color());
  scene.look_at = middle;
  scene.eye = exact(middle + random.between(3, 8) * scale * random.direction());
  scene.up = exact(random.chance(0.5L) ? Vector{0, 1, 0} : random.log_between(0.1L, 10) * random.direction());
  scene.view_distance = exact(random.log_between(0.1L, 10) * scale);
  // The picture's height on the view plane over the view distance: from a long lens to a very wide one.
  scene.pixel_size = exact(scene.view_distance * random.log_between(0.3L, 2.5L) / scene.vres);

  scene.has_ambient = random.chance(0.8L);
  scene.ambient_scale = exact(random.between(0, 2));
  scene.ambient_color = exact(random.color());
  for (int i = 1 + random.below(4); i > 0; --i) scene.lights.push_back(random_light(random, middle, scale));
  for (std::size_t i = 0; i < 5; ++i) scene.materials.push_back(random_material(random, i));

  const auto add = [&](ShapePointer shape) {
    scene.objects.push_back(
        {std::move(shape), static_cast<std::size_t>(random.below(static_cast<int>(scene.materials.size())))});
  };
  for (int i = 8 + random.below(12); i > 0; --i) {
    const Vector place = middle + 2.5L * scale * random.in_cube(1);
    add(random_shape(random, random.below(10), place, scale * random.log_between(0.3L, 1)));
  }
  for (int i = random.below(3); i > 0; --i) {
    add(std::make_shared<Plane>(exact(middle + random.between(2, 5) * scale * random.direction()),
                                exact(random.direction())));
  }
  // A room around the eye, seen from inside.
  if (random.chance(0.2L)) add(random_shape(random, random.chance(0.5L) ? 0 : 3, scene.eye, 6 * scale));
  return scene;
}

}  // namespace reference
