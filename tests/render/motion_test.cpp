// Pictures of what moves while the shutter is open: the mean of those of its moments.
#include "raytrace/description/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

const std::string shutter_open = "<shutteropen>-0.25</shutteropen><shutterclose>0.75</shutterclose>";
const std::string still_eye = "<eye x='0' y='2' z='12'/><lookat x='0' y='0' z='0'/>";

/// A floor and a wall under a lamp, with objects. Keys are around frame 1.
std::string motion_scene(const std::string& objects, const std::string& camera, int samples,
                         const std::string& groups = {}) {
  return scene_text(
      48, 32, samples,
      "<lights><ambientlight><scaleradiance>0.2</scaleradiance></ambientlight><pointlights><pointlight>"
      "<location x='4' y='9' z='6'/><scaleradiance>2</scaleradiance></pointlight></pointlights></lights>"
      "<materials><mattes><matte><name>grey</name><ka>1</ka><kd>0.8</kd><cd red='0.8' green='0.8' blue='0.8'/></matte>"
      "<matte><name>red</name><ka>1</ka><kd>0.8</kd><cd red='1' green='0.1' blue='0.1'/></matte></mattes></materials>"
      "<objects><planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' z='0'/><material>grey</material></plane>"
      "</planes>" +
          objects + "</objects><groups>" + groups + "</groups>",
      camera);
}

/// The mean over all channels and pixels of the difference between the picture with an open shutter and the mean of
/// pictures of still scenes, and the largest difference of a pixel.
struct Differences {
  double mean, largest;
};
Differences compare_with_moments(const std::string& objects, const std::string& camera,
                                 const std::string& groups = {}) {
  const FloatPicture moving = rendered(parsed_scene(motion_scene(objects, camera + shutter_open, 1024, groups)));
  constexpr int moments = 64;
  std::vector<double> mean(moving.pixels().size() * 3);
  for (int i = 0; i < moments; ++i) {
    const FloatPicture still =
        rendered(at_moment(motion_scene(objects, camera, 16, groups), -0.25 + (i + 0.5) / moments));
    for (std::size_t pixel = 0; pixel < still.pixels().size(); ++pixel) {
      mean[3 * pixel] += double{still.pixels()[pixel].red} / moments;
      mean[3 * pixel + 1] += double{still.pixels()[pixel].green} / moments;
      mean[3 * pixel + 2] += double{still.pixels()[pixel].blue} / moments;
    }
  }
  Differences result{0, 0};
  for (std::size_t pixel = 0; pixel < moving.pixels().size(); ++pixel) {
    const double red = double{moving.pixels()[pixel].red} - mean[3 * pixel];
    const double green = double{moving.pixels()[pixel].green} - mean[3 * pixel + 1];
    const double blue = double{moving.pixels()[pixel].blue} - mean[3 * pixel + 2];
    result.mean += (red + green + blue) / static_cast<double>(mean.size());
    result.largest = std::max({result.largest, std::abs(red), std::abs(green), std::abs(blue)});
  }
  return result;
}

const std::string moving_ball = "<spheres><sphere>" + keys("center", "x='-4' y='0' z='0'", "x='4' y='0' z='0'") +
                                "<radius>1.5</radius><material>red</material></sphere></spheres>";
const std::string turning_box =
    "<boxes><box><min x='-2' y='-1' z='-1'/><max x='2' y='1' z='1'/><material>red</material><transform>" +
    keys("rotate", "x='0' y='1' z='0' angle='0'", "x='0' y='1' z='0' angle='90'") +
    keys("translate", "x='0' y='-1' z='0'", "x='0' y='1' z='0'") + "</transform></box></boxes>";
const std::string mesh_group =
    "<group><name>thing</name><objects><meshes><mesh><positions>1 0 0, -1 0 0, 0 1 0, 0 -1 0, 0 0 1, 0 0 -1</positions>"
    "<faces>0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5</faces><normals>smooth</normals><material>red</material>"
    "</mesh></meshes><spheres><sphere><center x='1' y='1' z='0'/><radius>0.5</radius><material>grey</material>"
    "<transform><scale x='1' y='2' z='1'/></transform></sphere></spheres></objects></group>";
const std::string moving_instance = "<instances><instance><group>thing</group><transform><scale x='2' y='2' z='2'/>" +
                                    keys("rotate", "x='0' y='0' z='1' angle='-40'", "x='0' y='0' z='1' angle='80'") +
                                    keys("translate", "x='-2' y='0' z='0'", "x='2' y='1' z='0'") +
                                    "</transform></instance></instances>";
const std::string moving_eye = keys("eye", "x='-2' y='2' z='12'", "x='2' y='2' z='12'") +
                               keys("lookat", "x='0' y='-1' z='0'", "x='0' y='1' z='0'");

}  // namespace

TEST_CASE("what moves by its own numbers, a transform, as an instance or as the camera is blurred as it moves") {
  struct Case {
    const char* what;
    std::string objects, camera, groups;
  };
  for (const Case& one :
       {Case{"a ball", moving_ball, still_eye, ""}, Case{"a box that turns", turning_box, still_eye, ""},
        Case{"an instance", moving_instance, still_eye, mesh_group}, Case{"the camera", turning_box, moving_eye, ""}}) {
    INFO(one.what);
    const Differences found = compare_with_moments(one.objects, one.camera, one.groups);
    CHECK(std::abs(found.mean) < 2e-4);
    CHECK(found.largest < 0.04);
  }
}

TEST_CASE("glass that turns throws light where it does at each moment") {
  const auto scene = [](const std::string& shutter, int samples) {
    std::string text = scene_text(
        32, 32, samples,
        "<lights><pointlights><pointlight><location x='1' y='6' z='0.5'/><scaleradiance>60</scaleradiance>"
        "<color red='1' green='1' blue='1'/><falloff>inversesquare</falloff></pointlight></pointlights></lights>"
        "<materials><mattes><matte><name>grey</name><ka>0</ka><kd>0.7</kd><cd red='1' green='1' blue='1'/></matte>"
        "</mattes><dielectrics><dielectric><name>glass</name><ior>1.5</ior></dielectric></dielectrics></materials>"
        "<objects><planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' "
        "z='0'/><material>grey</material></plane>"
        "</planes><boxes><box><min x='-1' y='-0.5' z='-1'/><max x='1' y='0.5' z='1'/><material>glass</material>"
        "<transform>" +
            keys("rotate", "x='1' y='0' z='0.3' angle='-60'", "x='1' y='0' z='0.3' angle='90'") +
            "</transform></box></boxes></objects>",
        "<eye x='0' y='5' z='7'/><lookat x='0' y='-1' z='0'/>" + shutter);
    const std::string root = "<raytracer>";
    return text.insert(text.find(root) + root.size(),
                       "<integrator><path><maxdepth>5</maxdepth><caustics>light</caustics></path></integrator>");
  };
  constexpr std::size_t blocks = 4;
  const auto add_blocks = [](const FloatPicture& picture, double share, std::array<double, blocks * blocks>& means) {
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
      means[i / 32 / 8 * blocks + i % 32 / 8] += share * double{picture.pixels()[i].red} / 64;
  };
  std::array<double, blocks * blocks> moving{}, still{};
  add_blocks(rendered(parsed_scene(scene(shutter_open, 512))), 1, moving);
  constexpr int moments = 32;
  for (int i = 0; i < moments; ++i)
    add_blocks(rendered(at_moment(scene("", 32), -0.25 + (i + 0.5) / moments)), 1.0 / moments, still);
  double worst = 0, most = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    worst = std::max(worst, std::abs(moving[i] - still[i]));
    most = std::max(most, still[i]);
  }
  INFO(worst << " of " << most);
  CHECK(worst < 0.01 * most);
}

TEST_CASE("the bits of what moves do not depend on how the work is cut") {
  check_same_bits(parsed_scene(
      motion_scene(moving_ball + turning_box + moving_instance, moving_eye + shutter_open, 16, mesh_group)));
}

TEST_CASE("the bits of paths that branch among what moves do not depend on how the work is cut") {
  std::string text =
      motion_scene(moving_ball + turning_box + moving_instance, moving_eye + shutter_open, 8, mesh_group);
  const std::string root = "<raytracer>";
  text.insert(text.find(root) + root.size(),
              "<integrator><path><maxdepth>3</maxdepth><indirectsamples>3</indirectsamples></path></integrator>");
  check_same_bits(parsed_scene(text));
}

TEST_CASE("a scene in which nothing moves is the same with an open shutter") {
  const std::string ball =
      "<spheres><sphere><center x='0' y='0' z='0'/><radius>1.5</radius><material>red</material></sphere></spheres>";
  const SceneDescription open = parsed_scene(motion_scene(ball, still_eye + shutter_open, 4));
  const SceneDescription closed = parsed_scene(motion_scene(ball, still_eye, 4));
  CHECK(identical(rendered(open), rendered(closed)));
  CHECK(scene_hash(open) == scene_hash(closed));
  CHECK(scene_hash(parsed_scene(motion_scene(moving_ball, still_eye + shutter_open, 4))) !=
        scene_hash(parsed_scene(motion_scene(moving_ball, still_eye, 4))));
}

TEST_CASE("a shutter that opens and closes at one moment shows what stands still then") {
  const std::string objects = moving_ball + turning_box + moving_instance;
  const auto scene = [&](const std::string& eye, const std::string& shutter) {
    return motion_scene(objects, eye + shutter, 4, mesh_group);
  };
  const std::string instant = "<shutteropen>0.5</shutteropen><shutterclose>0.5</shutterclose>";
  for (const std::string& eye : {still_eye, moving_eye}) {
    const SceneDescription then = parsed_scene(scene(eye, instant));
    CHECK(then.moving_camera.empty());
    const FloatPicture picture = rendered(then);
    CHECK(identical(picture, rendered(at_moment(scene(eye, ""), 0.5))));
    CHECK_FALSE(identical(picture, rendered(parsed_scene(scene(eye, "")))));
    CHECK(scene_hash(then) == scene_hash(at_moment(scene(eye, ""), 0.5)));
    CHECK(scene_hash(then) != scene_hash(parsed_scene(scene(eye, ""))));
  }
  const std::string at_frame = "<shutteropen>0</shutteropen><shutterclose>0</shutterclose>";
  CHECK(identical(rendered(parsed_scene(scene(moving_eye, at_frame))), rendered(parsed_scene(scene(moving_eye, "")))));
  // A form that changes is that of the moment.
  const std::string growing =
      "<spheres><sphere><center x='0' y='0' z='0'/><radius><key frame='1' value='1'/><key frame='2' "
      "value='2'/></radius>"
      "<material>red</material></sphere></spheres>";
  const SceneDescription grown = parsed_scene(motion_scene(growing, still_eye + instant, 1));
  CHECK(std::get<ObjectItems<Sphere>>(grown.objects).at(0).parameters.radius == 1.5);
}

TEST_CASE("a lamp that moves lights what it passes") {
  const std::string lamp = "<spheres><sphere>" + keys("center", "x='-4' y='1' z='0'", "x='4' y='1' z='0'") +
                           "<radius>1.5</radius><material>lamp</material></sphere></spheres>";
  const auto scene = [&](const std::string& camera, int samples) {
    return scene_text(
        48, 32, samples,
        "<integrator><path><maxdepth>2</maxdepth></path></integrator><lights/>"
        "<materials><mattes><matte><name>grey</name><ka>0</ka><kd>0.8</kd><cd red='1' green='1' blue='1'/></matte>"
        "</mattes><emissives><emissive><name>lamp</name><ce red='3' green='2' blue='1'/></emissive>"
        "</emissives></materials><objects><planes><plane><point x='0' y='-2' z='0'/>"
        "<normal x='0' y='1' z='0'/><material>grey</material></plane></planes>" +
            lamp + "</objects>",
        camera);
  };
  const auto mean_of = [](const FloatPicture& picture) {
    double sum = 0;
    for (const auto& pixel : picture.pixels()) sum += double{pixel.red} + double{pixel.green} + double{pixel.blue};
    return sum / (3 * static_cast<double>(picture.pixels().size()));
  };
  const double moving = mean_of(rendered(parsed_scene(scene(still_eye + shutter_open, 256))));
  double still = 0;
  constexpr int moments = 16;
  for (int i = 0; i < moments; ++i)
    still += mean_of(rendered(at_moment(scene(still_eye, 16), -0.25 + (i + 0.5) / moments))) / moments;
  CHECK(still > 0.1);
  CHECK(std::abs(moving / still - 1) < 0.01);
}

TEST_CASE("a scene may be read as it stands at its frame") {
  Diagnostics diagnostics("scene.xml");
  SceneSettings settings;
  settings.still = true;
  const auto scene = parse_scene(motion_scene(moving_ball, moving_eye + shutter_open, 4), diagnostics, 1, settings);
  REQUIRE(scene.has_value());
  CHECK(diagnostics.warning_count() == 1);
  CHECK(scene->moving_camera.empty());
  CHECK(scene->groups.empty());
  CHECK(contains(print_scene(*scene), "<shutteropen>-0.25</shutteropen>"));
}

TEST_CASE("a shutter that opens before the frame and closes at it is open, also where the file names one of both") {
  TemporaryFolder folder;
  for (const std::string shutter : {"<shutteropen>-0.5</shutteropen>", "<shutterclose>0.5</shutterclose>"}) {
    write_text(folder.file("scene.xml"), motion_scene(moving_ball, still_eye + shutter, 4));
    Diagnostics diagnostics("scene.xml");
    const auto scene = load_scene(folder.file("scene.xml"), diagnostics, 1);
    REQUIRE(scene.has_value());
    INFO(shutter);
    CHECK(scene->groups.size() == 1);  // of what moves
  }
}

TEST_CASE("what cannot be blurred is an error") {
  const auto message = [](const std::string& text) {
    Diagnostics diagnostics("scene.xml");
    (void)parse_scene(text, diagnostics);
    return diagnostics.kept().empty() ? std::string() : diagnostics.kept().front().message;
  };
  const auto with_objects = [&](const std::string& objects) {
    return message(motion_scene(objects, still_eye + shutter_open, 4));
  };
  const auto with_camera = [&](const std::string& camera) { return message(motion_scene(moving_ball, camera, 4)); };
  CHECK(contains(with_objects("<spheres><sphere><center x='0' y='0' z='0'/><radius><key frame='0' value='1'/>"
                              "<key frame='2' value='2'/></radius><material>red</material></sphere></spheres>"),
                 "this <sphere> changes its form while the shutter is open"));
  CHECK(contains(with_objects("<planes><plane>" + keys("point", "x='0' y='0' z='0'", "x='0' y='1' z='0'") +
                              "<normal x='0' y='1' z='0'/><material>red</material></plane></planes>"),
                 "a plane has no end"));
  CHECK(contains(
      with_objects(
          "<boxes><box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/><material>red</material><transform>" +
          keys("rotate", "x='0' y='1' z='0' angle='0'", "x='0' y='1' z='0' angle='5000'") +
          "</transform></box></boxes>"),
      "too fast to be followed"));
  CHECK(contains(with_camera(still_eye + "<shutteropen>1</shutteropen>"), "closes before it opens"));
  CHECK(contains(with_camera(keys("eye", "x='0' y='0' z='-9'", "x='0' y='0.1' z='9'") + "<lookat x='0' y='0' z='1'/>" +
                             shutter_open),
                 "the camera turns too fast"));
  CHECK(contains(with_camera(keys("eye", "x='0' y='0' z='9'", "x='0' y='0' z='-5.4'") + "<lookat x='0' y='0' z='0'/>" +
                             shutter_open),
                 "while the shutter is open: the camera's <eye> and <lookat> are the same point"));
  for (const std::string caustics : {"light", "photons"}) {
    const std::string path =
        "</objects><integrator><path><caustics>" + caustics + "</caustics></path></integrator><objects>";
    CHECK(contains(message(motion_scene(path, moving_eye + shutter_open, 4)),
                   "light paths (<caustics>) cannot reach it"));
  }
}

}  // namespace raytrace::test
