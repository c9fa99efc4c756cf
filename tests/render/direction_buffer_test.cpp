// What is seen from a point, against Embree: the same answers for rays that start or end there.
#include "raytrace/accel/direction_buffer.h"

#include <cmath>
#include <random>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/probe.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : bits_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0; }
  int below(int n) { return static_cast<int>(bits_() % static_cast<unsigned>(n)); }
  Vec3d in_box(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Vec3d direction() {
    for (;;) {
      const Vec3d v = in_box(1);
      if (length(v) > 0.1 && length(v) < 1) return normalize(v);
    }
  }

 private:
  std::mt19937 bits_;
};

std::string text_of(const std::string& element, const Vec3d& v) { return vector_text(element, v.x, v.y, v.z); }

std::string group(const std::string& name, const std::string& items) {
  return items.empty() ? "" : "<" + name + ">" + items + "</" + name + ">";
}

const std::string materials =
    "<lights/><materials><mattes><matte><name>m</name><ka>1</ka><kd>1</kd><cd red='1' green='1' "
    "blue='1'/></matte></mattes></materials>";

/// `count` objects of each shape that has bounds, in a box of +-10 around the center.
SceneDescription cloud(Draw& draw, int count, double size, const Vec3d& center) {
  const std::string material = "<material>m</material>";
  std::string spheres, triangles, cylinders, tori, disks;
  const auto radius = [&](const std::string& name, double largest) {
    return "<" + name + ">" + std::to_string(draw.between(0.1, 1) * largest) + "</" + name + ">";
  };
  for (int i = 0; i < count; ++i) {
    const auto place = [&] { return center + draw.in_box(10); };
    spheres += "<sphere>" + text_of("center", place()) + radius("radius", size) + material + "</sphere>";
    const Vec3d corner = place();
    triangles += "<triangle>" + text_of("vertexposition1", corner) +
                 text_of("vertexposition2", corner + draw.direction() * size) +
                 text_of("vertexposition3", corner + draw.direction() * size) + material + "</triangle>";
    const Vec3d bottom = place();
    cylinders += "<cylinder>" + text_of("bottom", bottom) + text_of("top", bottom + draw.direction() * (2 * size)) +
                 radius("radius", size / 2) + material + "</cylinder>";
    tori += "<torus>" + text_of("center", place()) + text_of("axis", draw.direction()) + radius("sweptradius", size) +
            radius("tuberadius", size / 3) + material + "</torus>";
    disks += "<disk>" + text_of("center", place()) + text_of("normal", draw.direction()) + radius("radius", size) +
             material + "</disk>";
  }
  return parsed_scene(scene_text(64, 48, 1,
                                 materials + "<objects>" + group("spheres", spheres) + group("triangles", triangles) +
                                     group("cylinders", cylinders) + group("toruses", tori) + group("disks", disks) +
                                     "<planes><plane><point x='0' y='-500' z='0'/><normal x='0' y='1' z='0.1'/>" +
                                     material + "</plane></planes>" + "</objects>"));
}

/// Directions packet by packet: some narrow, some wide, some to all sides, some along the axes and the diagonals that
/// the faces of a cube meet in.
std::vector<Vec3d> directions(Draw& draw, const Vec3d& towards, int packets) {
  std::vector<Vec3d> result;
  for (int packet = 0; packet < packets; ++packet) {
    const Vec3d center = normalize(towards + draw.direction() * draw.between(0, length(towards)));
    const double spread = std::pow(10, draw.between(-5, 0.5));
    const bool straight = draw.below(8) == 0;
    for (int i = 0; i < 16; ++i) {
      Vec3d direction = normalize(center + draw.in_box(spread));
      if (straight) direction = {draw.below(3) - 1.0, draw.below(3) - 1.0, draw.below(3) - 1.0};
      if (straight && length(direction) == 0) direction.x = 1;
      result.push_back(normalize(direction));
    }
  }
  return result;
}

struct Situation {
  int count;
  double size;
  Vec3d center;  ///< of the objects
  Vec3d point;
};

const std::vector<Situation> situations = {
    {1, 2, {0, 0, 0}, {0, 3, 30}},        {2, 1, {0, 0, 0}, {-40, 0, 0}},
    {20, 1, {0, 0, 0}, {0, 0, 25}},       {200, 0.5, {0, 0, 0}, {20, 40, 30}},
    {200, 0.3, {0, 0, 0}, {0, 0, 0}},     {200, 0.3, {0, 0, 0}, {3, -4, 5}},
    {50, 0.5, {500, 0, 0}, {0, 0, 0}},    {50, 0.5, {0, 3000, 20}, {9, 2990, 25}},
    {300, 0.1, {0, 0, 0}, {10, 10, 10}},  {20, 1, {0, 0, 0}, {2000, 3000, 1000}},
    {8000, 0.1, {0, 0, 0}, {5, 30, -20}},  // so many that the buffer is made in pieces, by several threads
};

/// Rays that go to the vantage.
void check_blocked(const SceneDescription& scene, const BufferOrigin& vantage, const std::vector<ProbeRay>& rays) {
  for (const std::string& isa : usable_isas()) {
    const Probe probe(scene, isa);
    const auto seen = probe.occluded_seen_from(vantage.position, vantage.infinitely_far, rays);
    INFO(isa);
    REQUIRE(seen.has_value());
    const std::vector<bool> wanted = probe.occluded_packet(rays);
    int blocked = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      blocked += wanted[i];
      wrong += (*seen)[i] != wanted[i];
    }
    CHECK(blocked > 100);
    CHECK(wrong == 0);
  }
}

/// Calls check(seen, wanted) for each instruction set: hits of rays from a point, found as seen from there and by
/// Embree.
template <class Check>
void compare_hits(const SceneDescription& scene, const Vec3f& point, const std::vector<ProbeRay>& rays,
                  const Check& check) {
  for (const std::string& isa : usable_isas()) {
    const Probe probe(scene, isa);
    const auto seen = probe.intersect_seen_from(point, rays);
    INFO(isa);
    REQUIRE(seen.has_value());
    check(*seen, probe.intersect_packet(rays));
  }
}

/// Rays from a point, at objects of one shape.
void check_hits(const SceneDescription& scene, const Vec3f& point, const std::vector<ProbeRay>& rays) {
  compare_hits(scene, point, rays, [&](const auto& seen, const auto& wanted) {
    int hits = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const ProbeHit &a = seen[i], &b = wanted[i];
      hits += b.hit;
      // Of two at one distance, either may be met.
      wrong += a.hit != b.hit || (b.hit && a.index != b.index && a.distance != b.distance);
    }
    CHECK(hits > 1000);
    CHECK(wrong == 0);
  });
}

}  // namespace

TEST_CASE("rays from a point meet what they meet in Embree") {
  unsigned seed = 1;
  for (const Situation& situation : situations) {
    Draw draw(seed++);
    const SceneDescription scene = cloud(draw, situation.count, situation.size, situation.center);
    const Vec3f point(situation.point);
    std::vector<ProbeRay> rays;
    for (const Vec3d& direction : directions(draw, situation.center - situation.point, 2000))
      rays.push_back({point, Vec3f(direction)});
    INFO("situation " << seed - 2);
    compare_hits(scene, point, rays, [&](const auto& seen, const auto& wanted) {
      int hits = 0, wrong = 0;
      double worst = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const ProbeHit &a = seen[i], &b = wanted[i];
        hits += b.hit;
        wrong += a.hit != b.hit || (b.hit && (a.kind != b.kind || a.index != b.index));
        if (a.hit && b.hit)
          worst = std::max({worst, std::abs(a.distance - b.distance) / static_cast<double>(b.distance),
                            length(Vec3d(a.position) - Vec3d(b.position)) / static_cast<double>(b.distance)});
      }
      CHECK(hits > 100);
      CHECK(wrong == 0);
      CHECK(worst < 1e-6);
    });
  }
}

TEST_CASE("what touches the floor is met where it is in Embree, be it by less than a rounding") {
  const SceneDescription scene = parsed_scene(
      scene_text(64, 48, 1,
                 materials + "<objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/>"
                             "<material>m</material></plane></planes><cylinders><cylinder>"
                             "<bottom x='0.7' y='0.5' z='1.2'/><top x='1.7' y='0.5' z='-0.8'/>"
                             "<radius>0.5</radius><material>m</material></cylinder></cylinders></objects>"));
  const Vec3f eye(0, 2.2f, 8);
  Draw draw(2);
  std::vector<ProbeRay> rays;
  for (int i = 0; i < 100000; ++i) {
    const Vec3d touching = Vec3d{0.7, 0, 1.2} + Vec3d{1, 0, -2} * draw.between(0, 1);
    rays.push_back({eye, Vec3f(normalize(touching + draw.in_box(1e-5) - Vec3d(eye)))});
  }
  compare_hits(scene, eye, rays, [&](const auto& seen, const auto& wanted) {
    int wrong = 0, same_distance = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      wrong += seen[i].kind != wanted[i].kind;
      same_distance += seen[i].distance == wanted[i].distance;
    }
    CHECK(wrong == 0);
    CHECK(same_distance == static_cast<int>(rays.size()));
  });
}

TEST_CASE("rays to a point are blocked where they are in Embree, from however far they come") {
  unsigned seed = 1;
  for (const Situation& situation : situations) {
    Draw draw(seed++);
    const SceneDescription scene = cloud(draw, situation.count, situation.size, situation.center);
    const Vec3f point(situation.point);
    std::vector<ProbeRay> rays;
    for (const Vec3d& direction : directions(draw, situation.center - situation.point, 2000)) {
      const double distance = std::pow(10, draw.between(-1, 6));
      const Vec3f origin(situation.point + direction * distance);
      rays.push_back({origin, point - origin, 0, 1});
    }
    INFO("situation " << seed - 2);
    check_blocked(scene, {point, false}, rays);
  }
}

TEST_CASE("parallel rays are blocked where they are in Embree, from wherever they come") {
  unsigned seed = 1;
  for (const Situation& situation : situations) {
    Draw draw(seed++);
    const SceneDescription scene = cloud(draw, situation.count, situation.size, situation.center);
    // Every other time along an axis, as scenes have it.
    const Vec3d towards = seed % 2 == 0 ? draw.direction() : Vec3d{0, seed % 4 == 1 ? 1.0 : -1.0, 0};
    std::vector<ProbeRay> rays;
    for (int packet = 0; packet < 2000; ++packet) {
      const Vec3d around = situation.center + draw.in_box(12) - towards * draw.between(0, 20);
      const double spread = std::pow(10, draw.between(-4, packet % 10 == 0 ? 6 : 1));
      for (int i = 0; i < 16; ++i)
        rays.push_back(
            {Vec3f(around + draw.in_box(spread)), Vec3f(towards), 0, std::numeric_limits<float>::infinity()});
    }
    INFO("situation " << seed - 2);
    check_blocked(scene, {Vec3f(towards), true}, rays);
  }
}

TEST_CASE("small objects far away are met where they are in Embree") {
  // Their cones differ from their axes by no more than a float's rounding. They are larger than the cells, and so many
  // that most rays that pass one by meet another one behind it.
  Draw draw(7);
  const Vec3d point = Vec3d(Vec3f(180, 200, 150)), away = normalize(-point);
  std::string spheres;
  std::vector<ProbeRay> from_point, to_point;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d center = draw.in_box(0.5) + away * draw.between(0, 20);
    const double radius = draw.between(0.01, 0.05);
    spheres += "<sphere>" + text_of("center", center) + "<radius>" + std::to_string(radius) +
               "</radius><material>m</material></sphere>";
    for (int ray = 0; ray < 64; ++ray) {
      const Vec3d aside = normalize(cross(away, draw.direction()));
      const Vec3d target = center + aside * (radius * (1 + std::pow(10, draw.between(-4, 0))));
      const Vec3f beyond(point + (target - point) * draw.between(1, 1.1));
      from_point.push_back({Vec3f(point), Vec3f(normalize(target - point))});
      to_point.push_back({beyond, Vec3f(point) - beyond, 0, 1});
    }
  }
  const SceneDescription scene =
      parsed_scene(scene_text(64, 48, 1, materials + "<objects>" + group("spheres", spheres) + "</objects>"));
  check_hits(scene, Vec3f(point), from_point);
  check_blocked(scene, {Vec3f(point), false}, to_point);
}

TEST_CASE("no ray that Embree stops passes between the triangles of a surface, seen from a point") {
  // A bumpy sheet, aimed at exactly in its vertices and along its edges. Where there is no fused multiply-add, Embree
  // itself lets some through.
  constexpr int edge = 24;
  Draw draw(5);
  std::vector<Vec3d> vertices;
  for (int y = 0; y <= edge; ++y)
    for (int x = 0; x <= edge; ++x) vertices.push_back({x - edge / 2.0, y - edge / 2.0, draw.between(-0.5, 0.5)});
  std::string triangles;
  for (Vec3d& v : vertices) v = Vec3d(Vec3f(v));
  const auto vertex = [&](int x, int y) {
    return vertices[static_cast<std::size_t>(y) * (edge + 1) + static_cast<std::size_t>(x)];
  };
  const auto triangle = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto corner = [](const char* name, const Vec3d& v) {
      char text[200];
      std::snprintf(text, sizeof text, "<%s x='%.9g' y='%.9g' z='%.9g'/>", name, v.x, v.y, v.z);
      return std::string(text);
    };
    triangles += "<triangle>" + corner("vertexposition1", a) + corner("vertexposition2", b) +
                 corner("vertexposition3", c) + "<material>m</material></triangle>";
  };
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      triangle(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1));
      triangle(vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1));
    }
  const SceneDescription scene =
      parsed_scene(scene_text(64, 48, 1, materials + "<objects>" + group("triangles", triangles) + "</objects>"));
  const Vec3f point(3, 2, 30);
  std::vector<ProbeRay> rays;
  for (int y = 1; y + 1 < edge; ++y)
    for (int x = 1; x + 1 < edge; ++x)
      for (const Vec3d& end : {vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)})
        for (int i = 0; i <= 20; ++i) {
          const double part = i == 0 ? 0 : draw.between(0, 1);
          const Vec3d target = vertex(x, y) + (end - vertex(x, y)) * part;
          rays.push_back({point, Vec3f(normalize(target - Vec3d(point)))});
        }
  compare_hits(scene, point, rays, [&](const auto& seen, const auto& in_embree) {
    int passed = 0, passed_in_embree = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      passed += !seen[i].hit;
      passed_in_embree += !in_embree[i].hit;
    }
    CHECK(passed <= passed_in_embree);
    CHECK(passed < static_cast<int>(rays.size()) / 1000);
  });
}

TEST_CASE("thin triangles, and those seen from the side, are met where they are in Embree") {
  Draw draw(6);
  const Vec3d point = Vec3d(Vec3f(3, 2, 30)), towards = normalize(Vec3d{1, 2, -1});
  std::string triangles;
  std::vector<ProbeRay> from_point, to_point, parallel;
  for (int i = 0; i < 400; ++i) {
    const Vec3d corner = draw.in_box(10);
    const Vec3d along = draw.direction() * std::pow(10, draw.between(-2, 0.5));
    // Aside: anywhere, or almost in one plane with the way to the point or with the parallel rays. They look wider than
    // the rounding of a ray, and are not met close to their edges: there, who is right is a matter of it.
    const Vec3d way = i % 3 == 0 ? draw.direction() : i % 3 == 1 ? normalize(point - corner) : towards;
    const Vec3d aside =
        (way + draw.direction() * std::pow(10, draw.between(-1.5, 0))) * std::pow(10, draw.between(-2, 0));
    triangles += "<triangle>" + text_of("vertexposition1", corner) + text_of("vertexposition2", corner + along) +
                 text_of("vertexposition3", corner + aside) + "<material>m</material></triangle>";
    for (int ray = 0; ray < 64; ++ray) {
      const double u = draw.between(0.1, 0.8), v = draw.between(0.1, 0.9 - u);
      const Vec3d target = corner + along * u + aside * v;
      const Vec3f beyond(point + (target - point) * draw.between(1.01, 4));
      from_point.push_back({Vec3f(point), Vec3f(normalize(target - point))});
      to_point.push_back({beyond, Vec3f(point) - beyond, 0, 1});
      parallel.push_back({Vec3f(target - towards * draw.between(0.01, 30)), Vec3f(towards), 0,
                          std::numeric_limits<float>::infinity()});
    }
  }
  const SceneDescription scene =
      parsed_scene(scene_text(64, 48, 1, materials + "<objects>" + group("triangles", triangles) + "</objects>"));
  check_hits(scene, Vec3f(point), from_point);
  check_blocked(scene, {Vec3f(point), false}, to_point);
  check_blocked(scene, {Vec3f(towards), true}, parallel);
}

TEST_CASE("where nothing is to be gained, rays go to Embree") {
  Draw draw(3);
  const auto sees = [](const SceneDescription& scene, const Vec3f& point) {
    return Probe(scene, usable_isas().back()).intersect_seen_from(point, {}).has_value();
  };
  const SceneDescription some = cloud(draw, 20, 1, {0, 0, 0});
  CHECK(sees(some, {0, 0, 30}));
  // From within one of them.
  const auto& sphere = std::get<ObjectItems<Sphere>>(some.objects).front().parameters;
  CHECK(!sees(some, Vec3f(sphere.center)));
  // All behind each other.
  const SceneDescription crowd = cloud(draw, 300, 10, {0, 0, 0});
  CHECK(!sees(crowd, {0, 0, 300}));
}

}  // namespace raytrace::test
