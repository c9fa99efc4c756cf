// Cameras that see nothing nearer than a plane, against closed forms and against scenes without what is nearer.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string near_clip(double distance) { return "<nearclip>" + std::to_string(distance) + "</nearclip>"; }

/// 23 x 17 pixels, seen from `eye` on the z axis; of a pinhole, with 90 degrees from top to bottom.
struct Cut {
  std::string clip;
  std::string objects;
  std::string camera = "camera", in_camera = "<fov>90</fov>";
  std::string integrator = "<raycast/>";
  std::string lights =
      "<ambientlight/><pointlights><pointlight><location x='0' y='0' z='9'/><shadows>false</shadows>"
      "</pointlight></pointlights>";
  std::string viewplane = "<samples>4</samples>";
  std::string eye = "<eye x='0' y='0' z='10'/><lookat x='0' y='0' z='0'/>";
  std::string materials = "";
};

std::string text_of(const Cut& cut) {
  return "<raytracer><viewplane><hres>23</hres><vres>17</vres>" + cut.viewplane + "</viewplane><" + cut.camera + ">" +
         cut.eye + cut.in_camera + cut.clip + "</" + cut.camera + "><integrator>" + cut.integrator +
         "</integrator><lights>" + cut.lights +
         "</lights><materials><mattes><matte><name>grey</name><ka>0.5</ka><kd>0.5</kd><cd red='1' green='0.8' "
         "blue='0.6'/></matte></mattes><emissives><emissive><name>lamp</name><ce red='4' green='4' blue='4'/>"
         "</emissive></emissives>" +
         cut.materials + "</materials><objects>" + cut.objects + "</objects></raytracer>";
}

/// Across the view.
std::string wall(double z, const std::string& material = "grey", double half = 60) {
  return "<rectangles><rectangle>" + vector_text("corner", -half, -half, z) + vector_text("edge1", 2 * half, 0, 0) +
         vector_text("edge2", 0, 2 * half, 0) + "<material>" + material + "</material></rectangle></rectangles>";
}

std::string ball(double z, double radius) {
  return "<spheres><sphere>" + vector_text("center", 0, 0, z) + "<radius>" + std::to_string(radius) +
         "</radius><material>grey</material></sphere></spheres>";
}

const Cut thin_lens{.clip = "",
                    .objects = "",
                    .camera = "thinlenscamera",
                    .in_camera = "<fov>90</fov><lensradius>0.5</lensradius><focaldistance>7</focaldistance>"};
const Cut orthographic{.clip = "",
                       .objects = "",
                       .camera = "orthographiccamera",
                       .in_camera = "",
                       .viewplane = "<samples>4</samples><pixelsize>0.5</pixelsize>"};

std::vector<float> depths(const Cut& cut, const std::string& isa = {}) {
  return std::get<std::vector<float>>(picture_aovs(parsed_scene(text_of(cut)), {"depth"}, isa).planes.at(0));
}

double mean_alpha(const Cut& cut) {
  const SceneDescription description = parsed_scene(text_of(cut));
  RenderSettings settings{1, 0, whole(description)};
  settings.transparent = true;
  RayCounts rays;
  double sum = 0;
  const FloatPicture picture = render(*build_scene(description, {1, {}}), description, settings, rays);
  for (const Pixel& pixel : picture.pixels()) sum += double{pixel.alpha};
  return sum / static_cast<double>(picture.pixels().size());
}

}  // namespace

TEST_CASE("what is nearer than the camera sees is not in the picture, as if it were not there") {
  for (Cut cut : {Cut{}, thin_lens, orthographic})
    for (const std::string integrator : {"<raycast/>", "<normals/>", "<albedo/>", "<path/>"}) {
      cut.integrator = integrator;
      cut.clip = near_clip(4.001);
      cut.objects = ball(0, 4);
      const FloatPicture without = rendered(text_of(cut));
      for (const std::string& isa : usable_isas()) {
        INFO(cut.camera << integrator << isa);
        // Behind the light, and between the camera and the plane.
        cut.objects = wall(9.5, "grey", 0.01) + wall(6.01) + ball(0, 4);
        if (integrator == "<path/>") cut.objects = wall(9.5, "grey", 0.01) + ball(0, 4);  // light goes everywhere
        CHECK(identical(rendered(parsed_scene(text_of(cut)), 1, isa), without));
      }
      cut.clip = "";
      cut.objects = wall(6.01) + ball(0, 4);
      CHECK_FALSE(identical(rendered(text_of(cut)), without));
    }
}

TEST_CASE("the plane is across the view, and depths are from the eye") {
  for (const Cut& camera : {Cut{}, thin_lens, orthographic})
    for (const std::string& isa : usable_isas()) {
      Cut cut = camera;
      INFO(cut.camera << isa);
      cut.objects = wall(5) + wall(2);
      for (const auto& [clip, depth] : {std::pair(0.0, 5.0), std::pair(4.999, 5.0), std::pair(5.001, 8.0)}) {
        cut.clip = near_clip(clip);
        for (const float found : depths(cut, isa)) CHECK(std::abs(double{found} - depth) < 1e-5);
      }
      cut.clip = near_clip(8.001);
      for (const float found : depths(cut, isa)) CHECK(found == 1e30F);
    }
}

TEST_CASE("a sphere that is cut shows its inside, from near and from very far away") {
  for (const double away : {10.0, 1e6}) {
    Cut cut = orthographic;
    INFO(away);
    const std::string z = std::to_string(away);
    cut.eye = "<eye x='0' y='0' z='" + z + "'/><lookat x='0' y='0' z='0'/>";
    cut.objects = ball(0, 4);
    cut.viewplane = "<samples>1</samples><pixelsize>0.1</pixelsize>";
    const double uncut = away - 4, inside = away + 4;
    const auto in_the_middle = [&] { return double{depths(cut)[8 * 23 + 11]}; };
    const double tolerance = away * 1e-6;
    CHECK(std::abs(in_the_middle() - uncut) < tolerance);
    cut.clip = near_clip(away / 2);  // before where rays of a camera far away begin
    CHECK(std::abs(in_the_middle() - uncut) < tolerance);
    cut.clip = near_clip(away - 2);
    CHECK(std::abs(in_the_middle() - inside) < tolerance);
    cut.clip = near_clip(away + 5);
    CHECK(in_the_middle() > 1e29);
  }
  // What is near the eye of such a camera, and before the plane.
  Cut far{.clip = near_clip(50), .objects = ball(0, 4)};
  far.eye = "<eye x='0' y='0' z='100000'/><lookat x='0' y='0' z='0'/>";
  far.in_camera = "<fov>0.004</fov>";
  const std::vector<float> without = depths(far);
  far.objects +=
      "<planes><plane><point x='0' y='0' z='99970'/><normal x='0' y='0' z='1'/><material>grey</material>"
      "</plane></planes>";
  CHECK(depths(far) == without);
  far.clip = near_clip(29);
  far.objects +=
      "<planes><plane><point x='0' y='0' z='99980'/><normal x='0' y='0' z='1'/><material>grey</material>"
      "</plane></planes>";
  for (const float depth : depths(far)) CHECK(std::abs(depth - 30) < 0.1F);
}

TEST_CASE("what the camera does not see for being near throws shadows and lights the scene") {
  const std::string sun =
      "<directionallights><directionallight><direction x='0' y='0' z='1'/></directionallight></directionallights>";
  Cut cut{.clip = near_clip(6), .objects = wall(5, "grey", 1) + wall(0), .lights = sun};
  cut.viewplane = "<samples>1</samples>";
  const FloatPicture picture = rendered(text_of(cut));
  // 10 away, a pixel is 20/17 wide.
  CHECK(picture.at(11, 8).green == 0);
  CHECK(picture.at(14, 8).green > 0.1F);
  cut.objects = ball(5, 0.7) + wall(0);
  cut.objects.replace(cut.objects.find("grey"), 4, "lamp");
  cut.lights = "";
  cut.integrator = "<path/>";
  const FloatPicture lit = rendered(text_of(cut));
  CHECK(lit.at(11, 8).green > 0.01F);
  CHECK(lit.at(11, 8).green < 4);
}

TEST_CASE("the plane goes with a camera that moves") {
  // The eye goes from z 10 to 8, and the plane from 6 to 4: half of the time the wall at 5 is before it.
  Cut cut{.clip = near_clip(4) + "<shutteropen>0</shutteropen><shutterclose>1</shutterclose>", .objects = wall(5)};
  cut.viewplane = "<samples>16</samples>";
  cut.eye =
      "<eye><key frame='1' x='0' y='0' z='10'/><key frame='2' x='0' y='0' z='8'/></eye><lookat x='0' y='0' "
      "z='-90'/>";
  CHECK(std::abs(mean_alpha(cut) - 0.5) < 0.01);
  cut.clip = near_clip(0) + "<shutteropen>0</shutteropen><shutterclose>1</shutterclose>";
  CHECK(mean_alpha(cut) == 1);
}

TEST_CASE("rays begin on the plane in the medium that is there") {
  // Of a block from z 4 to -4, half is cut away: neither its surface nor what it absorbs there is seen.
  const std::string materials =
      "<dielectrics><dielectric><name>amber</name><ior>1.5</ior><attenuationcolor red='0.5' green='0.5' blue='0.5'/>"
      "<attenuationdistance>1</attenuationdistance></dielectric></dielectrics><fogs><fog><name>fog</name>"
      "<meanfreepath>1</meanfreepath><color red='0' green='0' blue='0'/></fog></fogs>";
  const auto brightness = [&](const std::string& material, double clip) {
    Cut cut{.clip = near_clip(clip), .objects = wall(-3, "lamp"), .lights = "", .materials = materials};
    cut.in_camera = "<fov>0.01</fov>";
    cut.viewplane = "<samples>64</samples>";
    cut.integrator = "<path/>";
    cut.objects += "<boxes><box><min x='-50' y='-50' z='-4'/><max x='50' y='50' z='4'/><material>" + material +
                   "</material></box></boxes>";
    return mean_green(rendered(text_of(cut)));
  };
  CHECK(std::abs(brightness("amber", 10) - 4 * 0.125) < 1e-4);
  CHECK(std::abs(brightness("amber", 9) - 4 * 0.0625) < 1e-4);
  CHECK(std::abs(brightness("fog", 11) - 4 * std::exp(-2)) < 0.02);
  CHECK(std::abs(brightness("fog", 3) - 4 * std::exp(-7)) < 0.01);
}

TEST_CASE("a clip that has keys is blurred while the shutter is open") {
  // It passes a wall at a distance of 5 in the middle, or from 0 on after five sixths of the time.
  for (const auto& [first, wanted] : {std::pair{4.0, 0.5}, std::pair{0.0, 5 / 6.0}}) {
    const Cut cut{.clip = "<nearclip><key frame='1' value='" + std::to_string(first) +
                          "'/><key frame='2' value='6'/></nearclip><shutteropen>0</shutteropen><shutterclose>1"
                          "</shutterclose>",
                  .objects = wall(5, "lamp"),
                  .integrator = "<path/>",
                  .viewplane = "<samples>64</samples>"};
    double sum = 0;
    const FloatPicture picture = rendered(text_of(cut));
    for (const Pixel& pixel : picture.pixels()) sum += double{pixel.red};
    CHECK(std::abs(sum / static_cast<double>(picture.pixels().size()) / 4 - wanted) < 0.02);
  }
}

TEST_CASE("media beside each other that a plane cuts are as each alone") {
  const auto half = [](double left, double right, const std::string& material) {
    return "<boxes><box><min x='" + std::to_string(left) + "' y='-60' z='0'/><max x='" + std::to_string(right) +
           "' y='60' z='7'/><material>" + material + "</material></box></boxes>";
  };
  const std::string media =
      "<openpbrs><openpbr><name>milk</name><transmission_weight>1</transmission_weight><specular_ior>1.0001"
      "</specular_ior><transmission_depth>1</transmission_depth><transmission_color red='0.9' green='0.9' blue='0.9'/>"
      "<transmission_scatter red='0.5' green='0.5' "
      "blue='0.5'/></openpbr></openpbrs><dielectrics><dielectric><name>amber"
      "</name><ior>1.0001</ior><attenuationcolor red='0.7' green='0.6' blue='0.5'/><attenuationdistance>1"
      "</attenuationdistance></dielectric></dielectrics>";
  const auto picture = [&](const std::string& objects) {
    return rendered(text_of({.clip = near_clip(6),
                             .objects = objects + wall(-1, "lamp"),
                             .integrator = "<path/>",
                             .viewplane = "<samples>1</samples>",
                             .materials = media}));
  };
  // The eye is at z = 10, the plane at 4, where a pixel is 0.7 wide. Columns 12 to 15 are in one packet, half of which
  // is milk.
  const FloatPicture both = picture(half(-60, 1.6, "milk") + half(1.601, 60, "amber"));
  const FloatPicture amber = picture(half(-60, 60, "amber"));
  int compared = 0;
  for (int row = 0; row < 17; ++row)
    for (int column = 14; column < 23; ++column, ++compared) {
      INFO(column << ", " << row);
      CHECK(std::abs(both.at(column, row).red - amber.at(column, row).red) < 1e-3F);
    }
  CHECK(compared == 153);
  CHECK(amber.at(14, 8).red > 0.5F);
}

TEST_CASE("a picture that a plane cuts has the same bits however it is divided") {
  std::string mirror = ball(1, 1.5);
  mirror.replace(mirror.find("grey"), 4, "mirror");
  const auto text_by = [&](const std::string& path) {
    return text_of({.clip = near_clip(8.5),
                    .objects = wall(-3) + wall(7) + ball(0, 2) + mirror,
                    .integrator = path,
                    .materials = "<mirrors><mirror><name>mirror</name><cr red='0.9' green='0.9' blue='0.9'/></mirror>"
                                 "</mirrors>"});
  };
  check_same_bits(parsed_scene(text_by("<path><caustics>light</caustics></path>")), true);
  std::string text = text_by("<path/>");
  const std::string moves = "<shutteropen>0</shutteropen><shutterclose>1</shutterclose>",
                    still = "<eye x='0' y='0' z='10'/>";
  text.replace(text.find(still), still.size(),
               "<eye><key frame='1' x='0' y='0' z='10'/><key frame='2' x='1' y='0' z='9'/></eye>" + moves);
  check_same_bits(parsed_scene(text));
}

}  // namespace raytrace::test
