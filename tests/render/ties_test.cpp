// Surfaces at equal distances: the first by shape, in registry order, and place in the file wins, however it is found.
#include <functional>
#include <map>
#include <random>

#include "raytrace/aovs/aov_selection.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/probe.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

struct Tied {
  std::string group;
  std::string element;  ///< all of it but its name, which rays along -z hit at exactly z = 1
};

/// One of each shape, in registry order.
const std::vector<Tied> tied_shapes = {
    {"planes", "<plane><point x='0' y='0' z='1'/><normal x='0' y='0' z='1'/>"},
    {"triangles",
     "<triangle><vertexposition1 x='-4' y='-4' z='1'/><vertexposition2 x='4' y='-4' z='1'/>"
     "<vertexposition3 x='0' y='4' z='1'/>"},
    {"spheres", "<sphere><center x='0' y='0' z='0'/><radius>1</radius>"},
    {"cylinders", "<cylinder><bottom x='0' y='-1' z='0'/><top x='0' y='1' z='0'/><radius>1</radius>"},
    {"toruses", "<torus><axis x='0' y='1' z='0'/><sweptradius>0.75</sweptradius><tuberadius>0.25</tuberadius>"},
    {"disks", "<disk><center x='0' y='0' z='1'/><normal x='0' y='0' z='1'/><radius>2</radius>"},
    {"rectangles", "<rectangle><corner x='-1' y='-1' z='1'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2' z='0'/>"},
    {"boxes", "<box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/>"},
    {"cones",
     "<cone><bottom x='0' y='-1' z='0'/><top x='0' y='1' z='0'/><radius>1.5</radius><topradius>0.5</topradius>"},
    {"annuli",
     "<annulus><center x='2' y='0' z='1'/><normal x='0' y='0' z='1'/><innerradius>1</innerradius>"
     "<outerradius>3</outerradius>"},
    {"meshes", "<mesh><positions>-4 -4 1, 4 -4 1, 0 4 1</positions><faces>0 1 2</faces>"}};

std::uint32_t registry_index(const std::string& group) {
  std::uint32_t index = 0, result = 0;
  for_each_type(Objects{}, [&](auto type) {
    if (decltype(type)::type::group == group) result = index;
    ++index;
  });
  return result;
}

std::string tied_object(const Tied& shape, const std::string& material) {
  const std::string end = "</" + shape.element.substr(1, shape.element.find('>') - 1) + ">";
  return "<" + shape.group + ">" + shape.element + "<material>" + material + "</material>" + end + "</" + shape.group +
         ">";
}

std::string tied_scene(const std::string& objects, int samples = 1) {
  return scene_text(24, 16, samples,
                    "<lights><ambientlight/></lights><materials><mattes>"
                    "<matte><name>red</name><ka>1</ka><kd>0</kd><cd red='1' green='0' blue='0'/></matte>"
                    "<matte><name>blue</name><ka>1</ka><kd>0</kd><cd red='0' green='0' blue='1'/></matte>"
                    "</mattes></materials><objects>" +
                        objects + "</objects>",
                    "<eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/>");
}

bool same_hit(const ProbeHit& a, const ProbeHit& b) {
  return a.hit == b.hit && (!a.hit || (a.distance == b.distance && a.kind == b.kind && a.index == b.index));
}

/// Checks that hits found in all ways are those of packets; the result: those. There need not be a direction buffer.
std::vector<ProbeHit> hits_of(const Probe& probe, const Vec3f& origin, const std::vector<ProbeRay>& rays) {
  const std::vector<ProbeHit> wanted = probe.intersect_packet(rays);
  const auto check = [&](const char* way, const std::vector<ProbeHit>& hits) {
    int wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) wrong += !same_hit(hits[i], wanted[i]);
    INFO(way);
    CHECK(wrong == 0);
  };
  check("single rays", probe.intersect_single(rays));
  check("scattered rays", probe.intersect_scattered(rays));
  for (const int size : {4, 8, 16})
    check(("Embree's packets of " + std::to_string(size)).c_str(), probe.intersect_embree(rays, size));
  const auto from_buffer = probe.intersect_seen_from(origin, rays);
  if (from_buffer) check("a direction buffer", *from_buffer);
  return wanted;
}

/// Whose sums a film keeps, so that it can be rendered in passes.
SampleRange whole_range(int count) { return {0, static_cast<std::uint32_t>(count), false}; }

}  // namespace

TEST_CASE("of two surfaces at the same distance, that of the first shape is hit, or of the first object of the shape") {
  const Vec3f eye(0, 0, 5);
  const std::vector<ProbeRay> ahead(16, ProbeRay{eye, {0, 0, -1}});
  for (const std::string& isa : usable_isas())
    for (const Tied& a : tied_shapes)
      for (const Tied& b : tied_shapes) {
        INFO(isa << ": " << a.group << ", then " << b.group);
        const Probe probe(parsed_scene(tied_scene(tied_object(a, "red") + tied_object(b, "blue"))), isa);
        const ProbeHit first = hits_of(probe, eye, ahead).front();
        CHECK(first.distance == 4);
        CHECK(first.kind == std::min(registry_index(a.group), registry_index(b.group)));
        CHECK(first.index == 0);
      }
}

TEST_CASE("wherever rays come from, copies of a surface are hit in the same order in every way") {
  std::mt19937 bits(3);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits()) / 4294967296.0;
  };
  for (const std::string& isa : usable_isas())
    for (const Tied& shape : tied_shapes) {
      if (shape.group == "planes") continue;
      std::string objects;
      for (int i = 0; i < 40; ++i) objects += tied_object(shape, "red");
      const Probe probe(parsed_scene(tied_scene(objects)), isa);
      const Vec3f eye(1, 2, 6);
      std::vector<ProbeRay> rays;
      for (int i = 0; i < 4000; ++i) {
        const Vec3d target{between(-1.5, 1.5), between(-1.5, 1.5), between(0, 1)};
        rays.push_back({eye, Vec3f(normalize(target - Vec3d(eye)))});
      }
      INFO(isa << ": " << shape.group);
      int hits = 0, others = 0;
      // So many in one place are for Embree: there is no direction buffer of them.
      const std::vector<ProbeHit> wanted = probe.intersect_packet(rays), single = probe.intersect_single(rays),
                                  scattered = probe.intersect_scattered(rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        hits += wanted[i].hit;
        others += wanted[i].hit && (wanted[i].index != 0 || wanted[i].kind != registry_index(shape.group));
        CHECK(same_hit(single[i], wanted[i]));
        CHECK(same_hit(scattered[i], wanted[i]));
      }
      CHECK(hits > 500);
      CHECK(others == 0);
    }
}

TEST_CASE("a picture of nothing but equal distances has the same bits in passes, with AOVs and without") {
  std::string objects;
  for (int i = 0; i < 12; ++i)
    for (const Tied& shape : tied_shapes) objects += tied_object(shape, i % 2 == 0 ? "red" : "blue");
  for (const int samples : {2, 3, 8, 32}) {
    const SceneDescription description = parsed_scene(tied_scene(objects, samples));
    for (const std::string& isa : usable_isas()) {
      INFO(isa << ", " << samples << " samples");
      const auto scene = build_scene(description, {1, isa});
      RayCounts rays;
      RenderSettings settings{1, 0, whole(description)};
      const FloatPicture wanted = render(*scene, description, settings, rays);
      settings.aovs = aov_set({"object_id", "depth"});
      CHECK(identical(FloatPicture(render(*scene, description, settings, rays)), wanted));
      settings.aovs = {};
      settings.samples = whole_range(samples);
      Film film(film_settings(*scene, description, settings));
      for (int done = 1; done <= samples; ++done) render(*scene, film, static_cast<std::uint32_t>(done), 1);
      CHECK(identical(FloatPicture(film), wanted));
    }
  }
}

}  // namespace raytrace::test
