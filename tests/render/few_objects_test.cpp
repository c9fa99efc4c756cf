// Rays that scatter in scenes of few objects hit what Embree's single rays hit.
#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/probe.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

class FewObjectsScene {
 public:
  explicit FewObjectsScene(std::uint32_t seed) : bits_(seed) {}

  /// So many objects of all shapes and meshes, in and about a cube of that size around the point.
  std::string text(int objects, double size, const Vec3d& middle) {
    size_ = size;
    middle_ = middle;
    std::ostringstream out;
    out.precision(17);
    for (int i = 0; i < objects; ++i) out << object(i % 11);
    return scene_text(8, 8, 1,
                      "<lights><ambientlight/></lights><materials><mattes><matte><name>m</name><ka>1</ka><kd>1</kd>"
                      "<cd red='1' green='1' blue='1'/></matte></mattes></materials><objects>" +
                          out.str() + "</objects>",
                      "<eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/>");
  }

  /// To any points, or to edges.
  std::vector<ProbeRay> rays(int count, bool to_edges) {
    std::vector<ProbeRay> result;
    for (int i = 0; i < count; ++i) {
      const Vec3d from = point(), to = to_edges ? on_edge() : point();
      result.push_back({Vec3f(from), Vec3f(normalize(to - from))});
    }
    return result;
  }

  /// Away from what was hit, to its side.
  std::vector<ProbeRay> leaving(const std::vector<ProbeHit>& hits) {
    std::vector<ProbeRay> result;
    for (const ProbeHit& hit : hits) {
      if (!hit.hit) continue;
      Vec3d direction = normalize(Vec3d(between(-1, 1), between(-1, 1), between(-1, 1)));
      if (dot(direction, Vec3d(hit.normal)) < 0) direction = -direction;
      result.push_back({hit.offset_ray_origin, Vec3f(direction)});
    }
    return result;
  }

  bool has_edges() const { return !edges_.empty(); }

  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0; }

 private:
  Vec3d point() { return middle_ + Vec3d(between(-1, 1), between(-1, 1), between(-1, 1)) * size_; }
  /// Where roundings decide, and boxes of objects end.
  Vec3d on_edge() {
    const auto& [a, b] = edges_[bits_() % edges_.size()];
    return a + (b - a) * between(0, 1);
  }
  static std::string xyz(const std::string& name, const Vec3d& v) {
    std::ostringstream out;
    out.precision(17);
    out << "<" << name << " x='" << v.x << "' y='" << v.y << "' z='" << v.z << "'/>";
    return out.str();
  }
  static std::string number(const std::string& name, double value) {
    std::ostringstream out;
    out.precision(17);
    out << "<" << name << ">" << value << "</" << name << ">";
    return out.str();
  }
  static std::string item(const std::string& group, const std::string& name, const std::string& parts) {
    return "<" + group + "><" + name + ">" + parts + "<material>m</material></" + name + "></" + group + ">";
  }

  std::string object(int kind) {
    const Vec3d a = point(), b = point(), c = point();
    const double r = between(0.1, 0.5) * size_;
    switch (kind) {
      case 0:
        return item("spheres", "sphere", xyz("center", a) + number("radius", r));
      case 1:
        edges_.push_back({a, b});
        return item("triangles", "triangle",
                    xyz("vertexposition1", a) + xyz("vertexposition2", b) + xyz("vertexposition3", c));
      case 2:
        return item("cylinders", "cylinder", xyz("bottom", a) + xyz("top", b) + number("radius", r / 2));
      case 3:
        return item("toruses", "torus",
                    xyz("center", a) + xyz("axis", b - c) + number("sweptradius", r) + number("tuberadius", r / 3));
      case 4:
        return item("disks", "disk", xyz("center", a) + xyz("normal", b - c) + number("radius", r));
      case 5: {
        const Vec3d edge = b - a;
        edges_.push_back({a, b});
        return item("rectangles", "rectangle",
                    xyz("corner", a) + xyz("edge1", edge) + xyz("edge2", cross(edge, c - a) * (0.5 / size_)));
      }
      case 6:
        edges_.push_back({a, {a.x, a.y, b.z}});
        return item("boxes", "box",
                    xyz("min", Vec3d(std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z))) +
                        xyz("max", Vec3d(std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z))));
      case 7:
        return item("cones", "cone",
                    xyz("bottom", a) + xyz("top", b) + number("radius", r / 2) + number("topradius", r / 4));
      case 8:
        return item("annuli", "annulus",
                    xyz("center", a) + xyz("normal", b - c) + number("innerradius", r / 2) + number("outerradius", r));
      case 9: {  // a box of quads, which stands on the bottom of the cube
        const Vec3d from = middle_ + Vec3d(between(-1, 0), -1, between(-1, 0)) * size_;
        const Vec3d x = Vec3d(between(0.1, 0.9), 0, between(-0.2, 0.2)) * size_;
        const Vec3d y = Vec3d(0, between(0.2, 1.5), 0) * size_, z = Vec3d(-x.z, 0, x.x);
        return mesh({from, from + x, from + x + z, from + z, from + y, from + x + y, from + x + z + y, from + z + y},
                    "0 1 2 3, 4 7 6 5, 0 4 5 1, 1 5 6 2, 2 6 7 3, 3 7 4 0");
      }
      default:  // a fan of triangles
        return mesh({a, b, c, c + (c - b) * 0.5, c + (a - b) * 0.25}, "0 1 2, 0 2 3, 0 3 4");
    }
  }
  std::string mesh(const std::vector<Vec3d>& positions, const std::string& faces) {
    std::ostringstream out;
    out.precision(9);
    for (std::size_t i = 1; i < positions.size(); ++i)
      edges_.push_back({Vec3d(Vec3f(positions[i - 1])), Vec3d(Vec3f(positions[i]))});
    for (std::size_t i = 0; i < positions.size(); ++i)
      out << (i > 0 ? ", " : "") << positions[i].x << " " << positions[i].y << " " << positions[i].z;
    return item("meshes", "mesh", "<positions>" + out.str() + "</positions><faces>" + faces + "</faces>");
  }

  std::mt19937 bits_;
  std::vector<std::pair<Vec3d, Vec3d>> edges_;
  double size_ = 1;
  Vec3d middle_{0, 0, 0};
};

bool is_same(const ProbeHit& a, const ProbeHit& b) {
  return a.hit == b.hit &&
         (!a.hit || (a.distance == b.distance && a.kind == b.kind && a.index == b.index &&
                     a.position.x == b.position.x && a.position.y == b.position.y && a.position.z == b.position.z));
}

struct Place {
  double size;
  Vec3d middle;
};

/// Calls check(scene, probe) for scenes of various sizes.
template <class Check>
void for_each_scene(const Check& check) {
  for (const std::string& isa : usable_isas())
    for (const Place& place : {Place{1, {0, 0, 0}}, Place{1000, {20, -300, 7}}, Place{0.01, {1, 2, 3}}})
      for (std::uint32_t seed = 0; seed < 12; ++seed) {
        INFO(isa << ", size " << place.size << ", seed " << seed);
        FewObjectsScene scene(seed);
        check(scene, Probe(parsed_scene(scene.text(1 + static_cast<int>(seed), place.size, place.middle)), isa),
              place.size);
      }
}

}  // namespace

TEST_CASE("in scenes of few objects, rays that scatter hit what single rays of Embree's hit, and are hidden by it") {
  for_each_scene([](FewObjectsScene& scene, const Probe& probe, double size) {
    std::vector<ProbeRay> rays = scene.rays(10000, false);
    long hits = 0, wrong = 0, wrongly_hidden = 0;
    for (int bounce = 0; bounce < 3 && !rays.empty(); ++bounce) {
      const std::vector<ProbeHit> wanted = probe.intersect_single(rays), found = probe.intersect_scattered(rays);
      std::vector<ProbeRay> shadows = rays;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        wrong += !is_same(found[i], wanted[i]);
        hits += wanted[i].hit;
        shadows[i].far = static_cast<float>(scene.between(0.1, 2) * size);
      }
      const std::vector<bool> occluded = probe.occluded_single(shadows), hidden = probe.occluded_scattered(shadows);
      for (std::size_t i = 0; i < rays.size(); ++i) wrongly_hidden += hidden[i] != occluded[i];
      rays = scene.leaving(wanted);
    }
    CHECK(hits > 500);
    CHECK(wrong == 0);
    CHECK(wrongly_hidden == 0);
  });
}

// There, Embree's boxes may let a ray pass that an object's own test, which is more precise, would find to hit.
TEST_CASE("in scenes of few objects, rays that scatter to edges miss nothing that Embree finds") {
  for_each_scene([](FewObjectsScene& scene, const Probe& probe, double) {
    if (!scene.has_edges()) return;
    const std::vector<ProbeRay> rays = scene.rays(10000, true);
    const std::vector<ProbeHit> known = probe.intersect_single(rays), found = probe.intersect_scattered(rays);
    const std::vector<bool> occluded = probe.occluded_single(rays), hidden = probe.occluded_scattered(rays);
    long missed = 0, open = 0, others = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      missed += known[i].hit && (!found[i].hit || found[i].distance > known[i].distance);
      open += occluded[i] && !hidden[i];
      others += !is_same(known[i], found[i]);
    }
    CHECK(missed == 0);
    CHECK(open == 0);
    CHECK(others * 100 < static_cast<long>(rays.size()));
  });
}

}  // namespace raytrace::test
