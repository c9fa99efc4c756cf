// The rays that a render says it traced.
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// A wall z = 0 seen from the front by 37 x 23 pixels, 3 samples each; its left half is open where `half`.
RayCounts counted(const std::string& lights, const std::string& isa, bool half = false) {
  const std::string wall =
      half ? "<triangles><triangle><vertexposition1 x='0' y='-1000' z='0'/><vertexposition2 x='0' y='1000' z='0'/>"
             "<vertexposition3 x='1000' y='0' z='0'/><material>m</material></triangle></triangles>"
           : "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' "
             "z='1'/><material>m</material></plane></planes>";
  const SceneDescription description =
      parsed_scene(scene_text(37, 23, 3,
                              "<lights>" + lights +
                                  "</lights><materials><mattes><matte><name>m</name><ka>1</ka><kd>1</kd><cd red='1' "
                                  "green='1' blue='1'/></matte></mattes>"
                                  "</materials><objects>" +
                                  wall + "</objects>",
                              "<eye x='0' y='0' z='10'/><lookat x='0' y='0' z='0'/>"));
  const auto scene = build_scene(description, {1, isa});
  RayCounts rays;
  render(*scene, description, {1, 0, whole(description)}, rays);
  return rays;
}

std::string point_light(double z, bool shadows = true) {
  return "<pointlights><pointlight>" + vector_text("location", 1, 2, z) + "<shadows>" + (shadows ? "true" : "false") +
         "</shadows></pointlight></pointlights>";
}

constexpr std::uint64_t all = 37 * 23 * 3;

}  // namespace

TEST_CASE("there is a camera ray for each sample of each pixel, also where packets reach over the edge") {
  for (const std::string& isa : usable_isas()) {
    CHECK(counted("", isa).camera == all);
    CHECK(counted(point_light(5), isa, true).camera == all);
  }
}

TEST_CASE("there is a shadow ray for each hit and light that could light it") {
  const std::string directional =
      "<directionallights><directionallight><direction x='0' y='0' z='1'/></directionallight></directionallights>";
  for (const std::string& isa : usable_isas()) {
    CHECK(counted("", isa).shadow == 0);
    CHECK(counted("<ambientlight/>", isa).shadow == 0);
    CHECK(counted(point_light(5), isa).shadow == all);
    CHECK(counted(point_light(5) + directional, isa).shadow == 2 * all);
    CHECK(counted(point_light(5, false), isa).shadow == 0);
    CHECK(counted(point_light(-5), isa).shadow == 0);  // behind the wall
    // Only where something is hit: 18 columns and a half, of which the middle one's samples fall on either side.
    const std::uint64_t right = counted(point_light(5), isa, true).shadow;
    CHECK(right >= 18 * 23 * 3);
    CHECK(right <= 19 * 23 * 3);
  }
}

}  // namespace raytrace::test
