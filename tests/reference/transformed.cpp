#include "transformed.h"

#include <algorithm>
#include <cstdio>

namespace reference {

namespace {

Vector turned(Vector v, Vector axis, Real degrees) {
  // Rodrigues' formula.
  const Vector a = unit(axis);
  const Real angle = degrees / 180 * pi, c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(a, v) + ((1 - c) * dot(a, v)) * a;
}

std::string numbers(Vector v) {
  char text[120];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g", static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
  return text;
}

constexpr int faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

}  // namespace

Vector Transform::vector(Vector v) const {
  return turned({scale.x * v.x, scale.y * v.y, scale.z * v.z}, axis, degrees);
}

Vector Transform::inverse_vector(Vector v) const {
  const Vector back = turned(v, axis, -degrees);
  return {back.x / scale.x, back.y / scale.y, back.z / scale.z};
}

Vector Transform::normal(Vector n) const {
  return unit(turned({n.x / scale.x, n.y / scale.y, n.z / scale.z}, axis, degrees));
}

Real Transform::smallest_scale() const {
  return std::min({std::fabs(scale.x), std::fabs(scale.y), std::fabs(scale.z)});
}
Real Transform::largest_scale() const { return std::max({std::fabs(scale.x), std::fabs(scale.y), std::fabs(scale.z)}); }

std::string Transform::element() const {
  char angle[60];
  std::snprintf(angle, sizeof angle, " angle=\"%.17g\"/>", static_cast<double>(degrees));
  std::string rotate = vector_element("rotate", axis);
  rotate.replace(rotate.size() - 2, 2, angle);
  return "<transform>" + vector_element("translate", -center) + vector_element("scale", scale) + rotate +
         vector_element("translate", center) + vector_element("translate", move) + "</transform>";
}

Crossings Transformed::crossings(const Ray& ray) const {
  Crossings result =
      shape_->crossings({transform_.inverse_point(ray.origin), transform_.inverse_vector(ray.direction)});
  result.clearance = result.clearance * transform_.smallest_scale();
  return result;
}

std::string Transformed::parameters() const {
  const std::string own = group_.empty() ? shape_->parameters() : "<group>" + group_ + "</group>";
  return own + transform_.element();
}

Vector Octahedron::corner(int i) const {
  const Real side = i % 2 == 0 ? radius_ : -radius_;
  return center_ + Vector{i / 2 == 0 ? side : 0, i / 2 == 1 ? side : 0, i / 2 == 2 ? side : 0};
}

Crossings Octahedron::crossings(const Ray& ray) const {
  Crossings result;
  for (const auto& face : faces) {
    const Crossings crossing = Triangle(corner(face[0]), corner(face[1]), corner(face[2])).crossings(ray);
    result.limit_clearance(crossing.clearance);
    if (crossing.count > 0 && result.count < 2) result.add(crossing.distances[0]);
  }
  if (result.count == 2 && result.distances[0] > result.distances[1])
    std::swap(result.distances[0], result.distances[1]);
  return result;
}

Real Octahedron::distance(Vector point) const {
  const Vector v = point - center_;
  return (std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z) - radius_) / std::sqrt(Real(3));
}

Vector Octahedron::normal(Vector point) const {
  const Vector v = point - center_;
  const auto sign = [](Real x) { return x < 0 ? Real(-1) : Real(1); };
  return unit({sign(v.x), sign(v.y), sign(v.z)});
}

std::string Octahedron::parameters() const {
  std::string text = "<positions>";
  for (int i = 0; i < 6; ++i) text += (i > 0 ? ", " : "") + numbers(corner(i));
  text += "</positions><faces>";
  for (const auto& face : faces)
    text += (text.back() == '>' ? "" : ", ") + std::to_string(face[0]) + " " + std::to_string(face[1]) + " " +
            std::to_string(face[2]);
  return text + "</faces>";
}

Transform random_transform(Random& random, Vector center, Real size) {
  const auto exact = [](Real x) { return Real(static_cast<float>(x)); };
  Transform transform;
  transform.center = center;
  const auto factor = [&] { return exact(random.between(0.6L, 1.6L) * (random.chance(0.2L) ? -1 : 1)); };
  const Real uniform = factor();
  transform.scale = random.chance(0.4L) ? Vector{uniform, uniform, uniform} : Vector{factor(), factor(), factor()};
  transform.axis = {exact(random.between(-1, 1)), exact(random.between(-1, 1)), exact(random.between(0.1L, 1))};
  transform.degrees = exact(random.between(-180, 180));
  transform.move = {exact(size * random.between(-1, 1)), exact(size * random.between(-1, 1)),
                    exact(size * random.between(-1, 1))};
  return transform;
}

void transform_objects(Scene& scene, unsigned seed) {
  Random random(seed + 5000);
  const Real size = length(scene.eye - scene.look_at) / 6;
  for (Object& object : scene.objects) {
    const bool is_plane = object.shape->element() == "plane";
    if (!is_plane && random.chance(0.2L)) {
      const Vector center = scene.look_at + 2 * size * random.in_cube(1);
      object.shape = std::make_shared<Octahedron>(center, size * random.between(0.3L, 1));
    }
    if (random.chance(0.2L)) continue;
    const Transform transform = random_transform(random, scene.look_at, size);
    std::string group;
    if (!is_plane && random.chance(0.4L)) {
      group = "group" + std::to_string(scene.groups.size());
      scene.groups.push_back({group, object.shape});
    }
    object.shape = std::make_shared<Transformed>(object.shape, transform, group);
  }
}

}  // namespace reference
