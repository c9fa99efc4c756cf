#include "exactness/shape_cases.h"

#include <cstdio>

#include "reference/scene.h"

namespace raytrace::test {

using reference::Real;
using reference::Vector;

namespace {

float as_float(Real x) { return static_cast<float>(x); }
Vector in_float(const Vector& v) { return {as_float(v.x), as_float(v.y), as_float(v.z)}; }

/// Two unit vectors that make a right-angled frame with a third.
struct Frame {
  Vector a, b;
  explicit Frame(const Vector& axis) : a(reference::perpendicular(axis)), b(cross(axis, a)) {}
  Vector circle(double angle) const { return std::cos(Real(angle)) * a + std::sin(Real(angle)) * b; }
};

double random_angle(Random& random) { return random.between(0, 6.283185307179586); }

ShapeCase plane_case(Random& random, const Vector& place, double size) {
  Vector direction = random.direction();
  if (random.chance(0.3)) {  // along an axis
    const int number = static_cast<int>(random.below(3));
    direction = random.sign() * Vector{Real(number == 0), Real(number == 1), Real(number == 2)};
  }
  const Vector normal = in_float(random.log_between(0.01, 100) * direction);
  const Vector axis = reference::unit(normal);
  const Frame frame(axis);
  return {std::make_shared<reference::Plane>(place, normal),
          place,
          size,
          [=](Random& r) { return place + r.between(0, size) * frame.circle(random_angle(r)); },
          {}};
}

ShapeCase sphere_case(Random&, const Vector& place, double size) {
  const Real radius = as_float(size);
  return {std::make_shared<reference::Sphere>(place, radius),
          place,
          size,
          [=](Random& r) { return place + radius * r.direction(); },
          {}};
}

ShapeCase triangle_case(Random& random, const Vector& place, double size) {
  const auto corner = [&] { return in_float(place + size * random.in_cube(0.5)); };
  // From one corner: some triangles are slivers.
  const Vector a = corner(), b = corner();
  const Vector c =
      random.chance(0.8)
          ? corner()
          : in_float(a + random.unit() * (b - a) + random.log_between(1e-3, 1) * size * random.direction());
  const auto inside = [=](Random& r) {
    double u = r.unit(), v = r.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return a + u * (b - a) + v * (c - a);
  };
  const auto border = [=](Random& r) {
    const int side = r.below(3);
    const Real t = r.unit();
    return side == 0 ? a + t * (b - a) : side == 1 ? b + t * (c - b) : c + t * (a - c);
  };
  return {std::make_shared<reference::Triangle>(a, b, c), a, size, inside, border};
}

ShapeCase disk_case(Random& random, const Vector& place, double size) {
  const Vector normal = in_float(random.log_between(0.01, 100) * random.direction());
  const Frame frame(reference::unit(normal));
  const Real radius = as_float(size);
  return {std::make_shared<reference::Disk>(place, normal, radius), place, size,
          [=](Random& r) { return place + radius * std::sqrt(r.unit()) * frame.circle(random_angle(r)); },
          [=](Random& r) { return place + radius * frame.circle(random_angle(r)); }};
}

ShapeCase annulus_case(Random& random, const Vector& place, double size) {
  const Vector normal = in_float(random.log_between(0.01, 100) * random.direction());
  const Frame frame(reference::unit(normal));
  const Real outer = as_float(size), inner = as_float(size * (1 - random.log_between(0.01, 1)));
  return {std::make_shared<reference::Annulus>(place, normal, outer, inner), place, size,
          [=](Random& r) { return place + (inner + (outer - inner) * r.unit()) * frame.circle(random_angle(r)); },
          [=](Random& r) { return place + (r.chance(0.5) ? inner : outer) * frame.circle(random_angle(r)); }};
}

ShapeCase box_case(Random& random, const Vector& place, double size) {
  // Cubes, slabs and beams.
  const auto extent = [&] { return size * (random.chance(0.5) ? 1 : random.log_between(0.01, 1)); };
  Vector far = in_float(place + Vector{extent(), extent(), extent()});
  far = {std::fmax(far.x, std::nextafter(as_float(place.x), 2e4F)),
         std::fmax(far.y, std::nextafter(as_float(place.y), 2e4F)),
         std::fmax(far.z, std::nextafter(as_float(place.z), 2e4F))};
  const Vector span = far - place;
  const auto inside = [=](Random& r) { return Vector{r.unit() * span.x, r.unit() * span.y, r.unit() * span.z}; };
  // Of a point inside, one coordinate or two are moved to their ends.
  const auto moved = [=](Random& r, int ends) {
    Vector p = inside(r);
    for (int axis = r.below(3); ends > 0; --ends, axis = (axis + 1) % 3)
      (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = r.below(2) * (axis == 0 ? span.x : axis == 1 ? span.y : span.z);
    return place + p;
  };
  return {std::make_shared<reference::Box>(place, far), place + 0.5L * span, size,
          [=](Random& r) { return moved(r, 1); }, [=](Random& r) { return moved(r, 2); }};
}

ShapeCase rectangle_case(Random& random, const Vector& place, double size) {
  // Squares, slabs and parallelograms.
  const Vector first = random.direction();
  const Frame frame(first);
  const Vector across = frame.circle(random_angle(random));
  const Vector edge1 = in_float(size * first);
  const Vector edge2 = in_float(size * random.log_between(0.01, 1) * (random.chance(0.7) ? across : across + first));
  return {std::make_shared<reference::Rectangle>(place, edge1, edge2), place, size,
          [=](Random& r) { return place + r.unit() * edge1 + r.unit() * edge2; },
          [=](Random& r) {
            const Real along = r.unit(), end = r.below(2);
            return r.chance(0.5) ? place + along * edge1 + end * edge2 : place + end * edge1 + along * edge2;
          }};
}

ShapeCase cylinder_case(Random& random, const Vector& place, double size) {
  // Thick rings and thin wires.
  const bool tall = random.chance(0.7);
  const double height = tall ? size : size * random.log_between(1e-3, 1);
  const Real radius = as_float(tall ? size * random.log_between(1e-3, 1) : size);
  const Vector wanted = random.chance(0.3) ? Vector{0, 1, 0} : random.direction();
  Vector top = in_float(place + height * wanted);
  if (length(top - place) == 0) top.y = std::nextafter(as_float(place.y), 2e4F);
  const Vector along = top - place;
  const Frame frame(reference::unit(along));
  return {std::make_shared<reference::Cylinder>(place, top, radius), place, size,
          [=](Random& r) { return place + r.unit() * along + radius * frame.circle(random_angle(r)); },
          [=](Random& r) { return place + (r.chance(0.5) ? 1 : 0) * along + radius * frame.circle(random_angle(r)); }};
}

/// Closed ones, or open ones; a cylinder if both radii are one.
ShapeCase cone_case(Random& random, const Vector& place, double size, bool caps, bool cylinder) {
  const bool tall = random.chance(0.7);
  const double height = tall ? size : size * random.log_between(1e-2, 1);
  const Real radius = as_float(tall ? size * random.log_between(1e-2, 1) : size);
  Real top_radius = cylinder ? radius : random.chance(0.5) ? 0 : as_float(radius * random.log_between(1e-2, 1));
  Vector bottom = place;
  Vector top = in_float(place + height * (random.chance(0.3) ? Vector{0, 1, 0} : random.direction()));
  if (length(top - place) == 0) top.y = std::nextafter(as_float(place.y), 2e4F);
  Real bottom_radius = radius;
  if (random.chance(0.5)) std::swap(bottom_radius, top_radius), std::swap(bottom, top);
  const Vector along = top - bottom;
  const Frame frame(reference::unit(along));
  const auto ring = [=](Random& r, Real part, Real share) {  // part: of the way up
    return bottom + part * along +
           share * (bottom_radius + part * (top_radius - bottom_radius)) * frame.circle(random_angle(r));
  };
  reference::ShapePointer shape;
  if (cylinder) {
    shape = std::make_shared<reference::CappedCylinder>(bottom, top, radius);
  } else {
    shape = std::make_shared<reference::Cone>(bottom, top, bottom_radius, top_radius, caps);
  }
  return {shape, bottom + 0.5L * along, size,
          [=](Random& r) {
            const bool cap = caps && r.chance(0.4);
            return cap ? ring(r, r.below(2), std::sqrt(r.unit())) : ring(r, r.unit(), 1);
          },
          [=](Random& r) { return ring(r, r.below(2), 1); }};
}

ShapeCase torus_case(Random& random, const Vector& place, double size, double least_ratio, double most_ratio) {
  const double ratio = random.log_between(least_ratio, most_ratio);
  const Real swept = as_float(size / (1 + ratio)), tube = as_float(ratio * size / (1 + ratio));
  const Vector axis =
      in_float(random.chance(0.2) ? Vector{0, 1, 0} : random.log_between(0.01, 100) * random.direction());
  const Vector up = reference::unit(axis);
  const Frame frame(up);
  return {std::make_shared<reference::Torus>(place, axis, swept, tube),
          place,
          size,
          [=](Random& r) {
            const Vector out = frame.circle(random_angle(r));
            const Real angle = random_angle(r);
            return place + swept * out + tube * (std::cos(angle) * out + std::sin(angle) * up);
          },
          {}};
}

/// Wires, spindles and tips.
ShapeCase strand_case(Random& random, const Vector& place, double size) {
  const double thickness = random.log_between(1e-3, 0.3);
  const Real radius = as_float(size * thickness);
  const Real scales[] = {0, 0.25L, 0.5L, 1, 2};
  const Real tip_scale = scales[random.below(5)];
  Vector tip = in_float(place + size * (random.chance(0.3) ? Vector{0, 1, 0} : random.direction()));
  // Where floats are coarse, one sphere might be in the other.
  if (length(tip - place) < 1.5L * radius) tip.y = as_float(place.y + 2 * size);
  const Vector along = tip - place;
  const Frame frame(reference::unit(along));
  return {std::make_shared<reference::RoundCone>(place, tip, radius, tip_scale),
          place + 0.5L * along,
          size,
          [=](Random& r) {
            if (r.chance(0.2)) return place + radius * r.direction();
            if (r.chance(0.2)) return tip + radius * tip_scale * r.direction();
            const Real part = r.unit();
            return place + part * along + radius * (1 + part * (tip_scale - 1)) * frame.circle(random_angle(r));
          },
          {}};
}

}  // namespace

ShapeCase random_shape_case(const std::string& kind, Random& random) {
  const Vector place = in_float(random.chance(0.1) ? Vector{} : random.log_between(1e-3, 1e4) * random.direction());
  const double size = random.log_between(1e-3, 1e4);
  if (kind == "plane") return plane_case(random, place, size);
  if (kind == "sphere") return sphere_case(random, place, size);
  if (kind == "triangle") return triangle_case(random, place, size);
  if (kind == "disk") return disk_case(random, place, size);
  if (kind == "rectangle") return rectangle_case(random, place, size);
  if (kind == "cylinder") return cylinder_case(random, place, size);
  if (kind == "annulus") return annulus_case(random, place, size);
  if (kind == "box") return box_case(random, place, size);
  if (kind == "cone") return cone_case(random, place, size, false, false);
  if (kind == "capped cone") return cone_case(random, place, size, true, false);
  if (kind == "capped cylinder") return cone_case(random, place, size, true, true);
  if (kind == "strand") return strand_case(random, place, size);
  if (kind == "torus") return torus_case(random, place, size, 1e-4, 1);
  return torus_case(random, place, size, 1, 10);
}

ProbeRay random_ray(const ShapeCase& shape, Random& random) {
  const Real size = shape.size;
  Vector target = shape.point(random);
  Vector direction = random.direction();
  double distance = random.log_between(1e-3 * shape.size, 1e4);
  switch (random.below(8)) {
    case 0:  // grazing
    case 1: {
      const Vector normal = shape.shape->normal(target);
      direction = direction - dot(direction, normal) * normal;
      target = target + random.sign() * random.log_between(1e-7, 0.1) * size * normal;
      break;
    }
    case 2:  // at the border
      if (shape.edge) target = shape.edge(random) + random.log_between(1e-7, 0.1) * size * random.direction();
      break;
    case 3:  // from inside
      target = shape.center + size * random.in_cube(0.7);
      distance = 0;
      break;
    case 4: {  // along an axis of the world
      const Real sign = random.sign();
      const int axis = random.below(3);
      direction = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
      break;
    }
    case 5:  // missing closely, or hitting somewhere else
      target = target + random.log_between(1e-5, 1) * size * random.direction();
      break;
    default:
      break;
  }
  const Vector along = reference::unit(direction);
  const double speed = random.chance(0.5) ? 1 : random.log_between(1e-3, 1e3);
  ProbeRay ray;
  ray.origin = rounded(target - distance * along);
  ray.direction = rounded(speed * along);
  if (random.chance(0.1)) {
    ray.near = as_float(distance / speed * random.between(0, 1.5));
    ray.far = as_float(ray.near + distance / speed * random.between(0.001, 1.5));
  }
  return ray;
}

Vector exact_vector(const Vec3f& v) { return {v.x, v.y, v.z}; }
reference::Ray exact_ray(const ProbeRay& ray) { return {exact_vector(ray.origin), exact_vector(ray.direction)}; }
Vec3f rounded(const Vector& v) { return {as_float(v.x), as_float(v.y), as_float(v.z)}; }

std::string scene_of(std::span<const reference::ShapePointer> shapes) {
  reference::Scene scene;
  scene.hres = scene.vres = 1;
  scene.eye = {0, 0, 1};
  scene.materials.push_back({});
  scene.materials[0].name = "m";
  for (const auto& shape : shapes) scene.objects.push_back({shape, 0});
  return reference::scene_text(scene);
}

std::string replay(const reference::Shape& shape, const ProbeRay& ray) {
  char text[400];
  std::snprintf(text, sizeof text, "ProbeRay{{%.9gf, %.9gf, %.9gf}, {%.9gf, %.9gf, %.9gf}, %.9gf, %.9gf}",
                static_cast<double>(ray.origin.x), static_cast<double>(ray.origin.y), static_cast<double>(ray.origin.z),
                static_cast<double>(ray.direction.x), static_cast<double>(ray.direction.y),
                static_cast<double>(ray.direction.z), static_cast<double>(ray.near), static_cast<double>(ray.far));
  return "<" + shape.element() + ">" + shape.parameters() + "</" + shape.element() + ">\n  " + text;
}

}  // namespace raytrace::test
