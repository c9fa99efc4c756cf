#include "moving.h"

#include <cstdio>

namespace reference {

namespace {

constexpr const char* opening = "0.5";
constexpr const char* closing = "1.25";

Vector between(Vector a, Vector b, Real part) { return (1 - part) * a + part * b; }

/// angle: an attribute more, if there is one.
std::string key(const char* frame, Vector v, const std::string& angle = {}) {
  std::string text = vector_element("key", v);
  return text.insert(4, std::string(" frame=\"") + frame + "\"" + angle);
}

std::string angle_attribute(Real degrees) {
  char text[60];
  std::snprintf(text, sizeof text, " angle=\"%.17g\"", static_cast<double>(degrees));
  return text;
}

}  // namespace

Moving::Map Moving::map() const {
  const int before = *now_ < 1 ? static_cast<int>(*now_ * 16) : 15;
  const auto at = [&](int moment) {
    Transform transform = opens_;
    transform.degrees = transform.degrees + turn_ * moment / 16;
    transform.move = transform.move + Real(moment) / 16 * way_;
    return Map{transform.vector({1, 0, 0}), transform.vector({0, 1, 0}), transform.vector({0, 0, 1}),
               transform.point({0, 0, 0})};
  };
  const Map a = at(before), b = at(before + 1);
  const Real part = *now_ * 16 - before;
  return {between(a.x, b.x, part), between(a.y, b.y, part), between(a.z, b.z, part), between(a.origin, b.origin, part)};
}

Vector Moving::inverse_vector(const Map& map, Vector v) {
  // Cramer's rule.
  const Real volume = dot(map.x, cross(map.y, map.z));
  return {dot(v, cross(map.y, map.z)) / volume, dot(v, cross(map.z, map.x)) / volume,
          dot(v, cross(map.x, map.y)) / volume};
}

Crossings Moving::crossings(const Ray& ray) const {
  const Map now = map();
  Crossings result = shape_->crossings({inverse_point(now, ray.origin), inverse_vector(now, ray.direction)});
  result.clearance = result.clearance * opens_.smallest_scale() / 2;
  return result;
}

Vector Moving::normal(Vector point) const {
  const Map now = map();
  const Vector n = shape_->normal(inverse_point(now, point));
  const Vector turned = n.x * cross(now.y, now.z) + n.y * cross(now.z, now.x) + n.z * cross(now.x, now.y);
  return unit(dot(now.x, cross(now.y, now.z)) < 0 ? -turned : turned);
}

std::string Moving::parameters() const {
  const std::string own = group_.empty() ? shape_->parameters() : "<group>" + group_ + "</group>";
  return own + "<transform>" + vector_element("translate", -opens_.center) + vector_element("scale", opens_.scale) +
         "<rotate>" + key(opening, opens_.axis, angle_attribute(opens_.degrees)) +
         key(closing, opens_.axis, angle_attribute(opens_.degrees + turn_)) + "</rotate>" +
         vector_element("translate", opens_.center) + "<translate>" + key(opening, opens_.move) +
         key(closing, opens_.move + way_) + "</translate></transform>";
}

void set_in_motion(Scene& scene, unsigned seed) {
  Random random(seed + 7000);
  const Real size = length(scene.eye - scene.look_at) / 6;
  const auto exact = [](Real x) { return Real(static_cast<float>(x)); };
  scene.shutter = "<shutteropen>-0.5</shutteropen><shutterclose>0.25</shutterclose>";
  scene.now = std::make_shared<Real>(0);
  if (random.chance(0.5L)) {
    const Vector way = size * random.in_cube(1);
    scene.eye_way = {exact(way.x), exact(way.y), exact(way.z)};
    scene.eye_keys = "<eye>" + key(opening, scene.eye) + key(closing, scene.eye + scene.eye_way) + "</eye>";
  }
  for (Object& object : scene.objects) {
    if (object.shape->element() == "plane" || random.chance(0.3L)) continue;
    const Transform opens = random_transform(random, scene.look_at, size);
    const Vector way = size * random.in_cube(1);
    std::string group;
    if (random.chance(0.4L)) {
      group = "group" + std::to_string(scene.groups.size());
      scene.groups.push_back({group, object.shape});
    }
    object.shape = std::make_shared<Moving>(object.shape, opens, exact(random.between(-200, 200)),
                                            Vector{exact(way.x), exact(way.y), exact(way.z)}, scene.now, group);
  }
}

}  // namespace reference
