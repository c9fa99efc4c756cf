// Textures in scene files, and their use in materials.
#include <string>

#include "raytrace/description/check_scene.h"
#include "raytrace/description/scene_description.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {

namespace {

/// A scene with two textures and a matte of these children.
std::string textured(const std::string& fields) {
  return R"(<raytracer>
  <viewplane> <hres>4</hres> <vres>3</vres> </viewplane>
  <camera> <eye x="0" y="0" z="9"/> <lookat x="0" y="0" z="0"/> <viewdistance>4</viewdistance> </camera>
  <materials> <mattes> <matte> <name>clay</name>
)" + fields +
         R"(
  </matte> </mattes> </materials>
  <textures>
    <checkers> <checker> <name>tiles</name> <scale>2</scale> </checker> </checkers>
    <images> <image> <name>wood</name> <file>wood.png</file> <wrap>clamp</wrap> <uvscale x="2" y="3"/> </image> </images>
  </textures>
</raytracer>
)";
}

const MaterialItem<Matte>& matte(const SceneDescription& scene) {
  return std::get<MaterialItems<Matte>>(scene.materials).at(0);
}

}  // namespace

TEST_CASE("a value with a texture is 1 where it has none of its own, which the texture multiplies") {
  const SceneDescription scene =
      accepted(textured(R"(<ka texture="tiles" channel="blue"/> <kd texture="wood">0.5</kd> <cd texture="wood"/>)"));
  const MaterialItem<Matte>& item = matte(scene);
  CHECK(item.parameters.ka == 1);
  CHECK(item.parameters.kd == 0.5);
  CHECK(item.parameters.cd.green == 1);
  REQUIRE(item.textures.size() == 3);
  CHECK(item.textures[0].field == 0);
  CHECK(item.textures[0].texture.type == index_of<Checker>(Textures{}));
  CHECK(item.textures[0].channel == TextureChannel::blue);
  CHECK(item.textures[1].field == 1);
  CHECK(item.textures[1].channel == TextureChannel::red);
  CHECK(item.textures[2].field == 2);
  CHECK(item.textures[2].texture.type == index_of<Image>(Textures{}));
}

TEST_CASE("of an opacity's texture the channel may be left open, as the printed scene says") {
  const std::string rest = R"(<ka>0</ka> <kd>1</kd> <cd red="1" green="1" blue="1"/>)";
  const SceneDescription open = accepted(textured(rest + R"(<opacity texture="wood"/>)"));
  REQUIRE(matte(open).textures.size() == 1);
  CHECK(matte(open).textures[0].channel == TextureChannel::automatic);
  CHECK(contains(print_scene(open), R"(<opacity texture="wood">1</opacity>)"));
  const SceneDescription red = accepted(textured(rest + R"(<opacity texture="wood" channel="red"/>)"));
  CHECK(matte(red).textures[0].channel == TextureChannel::red);
  CHECK(contains(print_scene(red), R"(<opacity texture="wood" channel="red">1</opacity>)"));
}

TEST_CASE("normal maps and bumps are textures with a number beside them") {
  const std::string rest = R"(<ka>0</ka> <kd>1</kd> <cd red="1" green="1" blue="1"/>)";
  const SceneDescription scene = accepted(textured(
      rest + R"(<normalmap texture="wood" strength="0.5"/> <bump texture="tiles" channel="green" height="2"/>)"));
  CHECK(matte(scene).parameters.normalmap == 0.5);
  CHECK(matte(scene).parameters.bump == 2);
  REQUIRE(matte(scene).textures.size() == 2);
  CHECK(matte(scene).textures[1].channel == TextureChannel::green);
  CHECK(contains(print_scene(scene), R"(<bump texture="tiles" channel="green" height="2"/>)"));
  CHECK(matte(accepted(textured(rest + R"(<bump texture="tiles"/>)"))).parameters.bump == 1);
  const auto error = [&](const std::string& fields) { return reported(textured(rest + fields)); };
  CHECK(contains(error(R"(<bump height="2"/>)"),
                 R"(missing attribute 'texture' in <bump>; write <bump texture="..."/>)"));
  CHECK(contains(error(R"(<bump texture="tiles">2</bump>)"), R"(write it as <bump texture="..." height="1"/>)"));
  CHECK(contains(error(R"(<normalmap texture="wood" channel="red"/>)"), "unknown attribute 'channel' in <normalmap>"));
  CHECK(contains(error(R"(<normalmap texture="wood" strenght="1"/>)"), "did you mean 'strength'?"));
}

TEST_CASE("a map of tangents is a texture alone") {
  const auto with_conductor = [](const std::string& fields) {
    std::string scene = textured("<ka>0</ka> <kd>1</kd> <cd texture=\"wood\"/>");
    scene.insert(scene.find("</materials>"), "<conductors> <conductor> <name>m</name> <metal>gold</metal> " + fields +
                                                 " </conductor> </conductors>");
    return scene;
  };
  const SceneDescription scene = accepted(with_conductor(R"(<tangentmap texture="wood"/>)"));
  const auto& conductor = std::get<MaterialItems<Conductor>>(scene.materials).at(0);
  REQUIRE(conductor.textures.size() == 1);
  CHECK(element_type<Conductor>().fields[conductor.textures[0].field].name == "tangentmap");
  const std::string printed = print_scene(scene);
  CHECK(contains(printed, R"(<tangentmap texture="wood"/>)"));
  CHECK(print_scene(accepted(printed)) == printed);
  const auto error = [&](const std::string& fields) { return reported(with_conductor(fields)); };
  CHECK(contains(error("<tangentmap>1</tangentmap>"), R"(write it as <tangentmap texture="..."/>)"));
  CHECK(
      contains(error(R"(<tangentmap texture="wood" channel="red"/>)"), "unknown attribute 'channel' in <tangentmap>"));
}

TEST_CASE("a coat's normal map is a texture with a strength") {
  const auto with_openpbr = [](const std::string& fields) {
    std::string scene = textured("<ka>0</ka> <kd>1</kd> <cd texture=\"wood\"/>");
    scene.insert(scene.find("</materials>"), "<openpbrs> <openpbr> <name>m</name> <coat_weight>1</coat_weight> " +
                                                 fields + " </openpbr> </openpbrs>");
    return scene;
  };
  const SceneDescription scene = accepted(with_openpbr(R"(<coatnormalmap texture="wood" strength="0.5"/>)"));
  const auto& item = std::get<MaterialItems<OpenPbr>>(scene.materials).at(0);
  CHECK(item.parameters.coatnormalmap == 0.5);
  REQUIRE(item.textures.size() == 1);
  const std::string printed = print_scene(scene);
  CHECK(contains(printed, R"(<coatnormalmap texture="wood" strength="0.5"/>)"));
  CHECK(print_scene(accepted(printed)) == printed);
  CHECK(contains(reported(with_openpbr("<coatnormalmap>1</coatnormalmap>")),
                 R"(write it as <coatnormalmap texture="..." strength="1"/>)"));
}

TEST_CASE("a colour may have its own value beside a texture, and keys") {
  const SceneDescription colour =
      accepted(textured(R"(<ka>0</ka> <kd>1</kd> <cd red="1" green="0.5" blue="0" texture="wood"/>)"));
  CHECK(matte(colour).parameters.cd.green == 0.5);
  CHECK(matte(colour).textures.size() == 1);
  const SceneDescription keys =
      accepted(textured(R"(<ka>0</ka> <kd texture="tiles"> <key frame="1" value="0.25"/> </kd> <cd texture="wood"/>)"));
  CHECK(matte(keys).parameters.kd == 0.25);
  CHECK(matte(keys).textures.size() == 2);
}

TEST_CASE("what is wrong with a texture's use is said where it stands") {
  const auto error = [](const std::string& fields) { return reported(textured(fields)); };
  const std::string rest = R"(<ka>0</ka> <kd>1</kd> )";
  CHECK(contains(error(rest + R"(<cd texture="woad"/>)"),
                 ":5:27: error: unknown texture 'woad' in <cd>; did you mean 'wood'?"));
  CHECK(contains(error(rest + R"(<cd texture="granite"/>)"),
                 "unknown texture 'granite' in <cd>; add one of that name to <textures>"));
  CHECK(contains(error(rest + R"(<cd texture=""/>)"), "is empty"));
  CHECK(contains(error(rest + R"(<cd red="1" texture="wood"/>)"), "missing attributes 'green' and 'blue' in <cd>"));
  CHECK(contains(error(rest + R"(<cd texture="wood" channel="red"/>)"), "unknown attribute 'channel' in <cd>"));
  CHECK(contains(error(R"(<ka channel="red">1</ka> <kd>1</kd> <cd texture="wood"/>)"),
                 "unexpected attribute 'channel' in <ka>"));
  CHECK(
      contains(error(R"(<ka texture="wood" channel="rde"/> <kd>1</kd> <cd texture="wood"/>)"), "did you mean 'red'?"));
  CHECK(contains(error(R"(<ka texture="wood" chanel="red"/> <kd>1</kd> <cd texture="wood"/>)"),
                 "did you mean 'channel'?"));
}

TEST_CASE("textures are for materials alone") {
  const std::string text = textured(R"(<ka>0</ka> <kd>1</kd> <cd red="1" green="1" blue="1"/>)");
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string changed = text;
    return changed.replace(changed.find(before), before.size(), after);
  };
  CHECK(contains(reported(with(R"(<eye x="0" y="0" z="9"/>)", R"(<eye x="0" y="0" z="9" texture="wood"/>)")),
                 "unknown attribute 'texture' in <eye>"));
  CHECK(contains(reported(with("<viewdistance>", R"(<viewdistance texture="wood">)")),
                 "unexpected attribute 'texture' in <viewdistance>"));
  CHECK(contains(reported(with("<scale>2</scale>", R"(<scale>2</scale> <color1 texture="wood"/>)")),
                 "unknown attribute 'texture' in <color1>"));
}

TEST_CASE("what is wrong with a texture is said where it stands") {
  const auto error = [](const std::string& texture) {
    std::string text = textured(R"(<ka>0</ka> <kd>1</kd> <cd texture="wood"/>)");
    return reported(text.insert(text.find("<images>"), texture));
  };
  CHECK(contains(error("<checkers><checker><name>wood</name></checker></checkers>"),
                 "the texture name 'wood' is taken by the"));
  CHECK(contains(error("<images><image><name>x</name></image></images>"), "missing <file> in <image>"));
  CHECK(contains(error("<images><image><name>x</name><file>a</file><wrap>mirrored</wrap></image></images>"),
                 "did you mean 'mirror'?"));
  CHECK(contains(error("<images><image><name>x</name><file>a</file><uvscale x=\"1\"/></image></images>"),
                 "missing attribute 'y' in <uvscale>; write <uvscale x=\"1\" y=\"1\"/>"));
  CHECK(contains(
      error("<checkers><checker><name>x</name><scale>1</scale><uvscale x=\"2\" y=\"1\"/></checker></checkers>"),
      "remove one"));
  CHECK(contains(error("<noises><noise><name>x</name><octaves>17</octaves></noise></noises>"), "at most 16"));
}

TEST_CASE("a made description's textures are checked") {
  const SceneDescription good = accepted(textured(R"(<ka>0</ka> <kd>1</kd> <cd texture="wood"/>)"));
  const auto error = [&](const TextureUse& use) {
    SceneDescription scene = good;
    std::get<TextureItems<Image>>(scene.textures).at(0).image.hash = "loaded";
    std::get<MaterialItems<Matte>>(scene.materials).at(0).textures.push_back(use);
    Diagnostics diagnostics("scene");
    check_scene(scene, diagnostics);
    return diagnostics.has_errors() ? diagnostics.kept().front().message : std::string();
  };
  const TextureReference tiles{static_cast<std::uint32_t>(index_of<Checker>(Textures{})), 0};
  CHECK(error({0, tiles, {}}) == "");
  CHECK(contains(error({2, tiles, {}}), "texture for field 2"));
  CHECK(contains(error({6, tiles, {}}), "texture for field 6"));
  CHECK(contains(error({0, {tiles.type, 1}, {}}), "refers to texture 1 of type 1, which is not there"));
  CHECK(contains(error({0, {9, 0}, {}}), "nor is that type"));
  CHECK(contains(error({0, tiles, static_cast<TextureChannel>(4)}), "channel 4"));
}

}  // namespace raytrace::test
