#include "random_description.h"
#include "raytrace/description/check_scene.h"
#include "reported.h"
#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("what is printed is read back as the same scene") {
  std::mt19937_64 random(2011);
  std::size_t objects = 0, warnings = 0;
  for (int i = 0; i < 300; ++i) {
    const SceneDescription scene = random_description(random);
    const std::string text = print_scene(scene);
    const SceneDescription again = accepted(text);
    REQUIRE(same_scene(scene, again));
    // Of what may be doubted, it says what it says of the scene itself.
    Diagnostics of_scene("s"), of_text("s");
    check_scene(scene, of_scene);
    parse_scene(text, of_text);
    REQUIRE(of_text.error_count() == 0);
    REQUIRE(of_text.warning_count() == of_scene.warning_count());
    warnings += of_text.warning_count();
    REQUIRE(print_scene(again) == text);
    objects += std::get<ObjectItems<Sphere>>(scene.objects).size();
  }
  CHECK(objects > 300);
  CHECK(warnings > 100);
}

TEST_CASE("scenes that differ are printed differently") {
  std::mt19937_64 random(7);
  SceneDescription a;
  do a = random_description(random);
  while (std::get<ObjectItems<Sphere>>(a.objects).empty());
  CHECK(same_scene(a, a));
  SceneDescription b = a;
  std::get<ObjectItems<Sphere>>(b.objects)[0].parameters.center.y += 1e20;
  CHECK_FALSE(same_scene(a, b));
  b = a;
  std::get<ObjectItems<Sphere>>(b.objects)[0].name += "x";
  CHECK_FALSE(same_scene(a, b));
  b = a;
  b.viewplane.samples += 1;
  CHECK_FALSE(same_scene(a, b));
}

TEST_CASE("a scene is printed with every value spelled out") {
  CHECK(print_scene(accepted(scene_with(""))) == R"(<raytracer>
  <viewplane>
    <hres>4</hres>
    <vres>3</vres>
    <pixelsize>1</pixelsize>
    <samples>1</samples>
    <background red="0" green="0" blue="0"/>
    <filter>box</filter>
    <filterwidth>0</filterwidth>
    <viewtransform>srgb</viewtransform>
    <exposure>0</exposure>
    <autoexposure>false</autoexposure>
    <whitebalance>0</whitebalance>
  </viewplane>
  <camera>
    <eye x="0" y="0" z="9"/>
    <lookat x="0" y="0" z="0"/>
    <up x="0" y="1" z="0"/>
    <shutteropen>0</shutteropen>
    <shutterclose>0</shutterclose>
    <nearclip>0</nearclip>
    <viewdistance>4</viewdistance>
    <shift x="0" y="0"/>
  </camera>
  <lights>
  </lights>
  <textures>
  </textures>
  <materials>
    <mattes>
      <matte>
        <name>clay</name>
        <ka>0</ka>
        <kd>1</kd>
        <cd red="1" green="1" blue="1"/>
        <opacity>1</opacity>
      </matte>
    </mattes>
    <phongs>
      <phong>
        <name>steel</name>
        <ka>0</ka>
        <kd>1</kd>
        <ks>1</ks>
        <cd red="1" green="1" blue="1"/>
        <cs red="1" green="1" blue="1"/>
        <exp>20</exp>
        <opacity>1</opacity>
      </phong>
    </phongs>
  </materials>
  <objects>
  </objects>
</raytracer>
)");
}

}  // namespace raytrace::test
