// A transform carries a shape's texture coordinates with it, and a mirrored surface keeps its front.
#include <algorithm>
#include <string>
#include <utility>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

using Element = std::pair<std::string, std::string>;  // of a group; its parameters

std::string object(const Element& shape, const std::string& material, const std::string& steps) {
  const auto& [name, parameters] = shape;
  const std::string group = name == "mesh"      ? "meshes"
                            : name == "torus"   ? "toruses"
                            : name == "box"     ? "boxes"
                            : name == "annulus" ? "annuli"
                                                : name + "s";
  return "<" + group + "><" + name + ">" + parameters + "<material>" + material + "</material>" +
         (steps.empty() ? "" : "<transform>" + steps + "</transform>") + "</" + name + "></" + group + ">";
}

std::string transforms_scene(const std::string& integrator, const std::string& objects, const std::string& groups = {},
                             const std::string& camera = "<eye x='1' y='2' z='12'/><lookat x='0' y='0' z='0'/>") {
  return scene_text(
      48, 36, 4,
      "<integrator>" + integrator +
          "</integrator><lights/><textures><checkers><checker><name>squares</name><uvscale x='0.3' "
          "y='0.3'/></checker><checker><name>cubes</name><scale>0.7</scale><space>object</space></checker></checkers>"
          "<noises><noise><name>clouds</name><scale>1.5</scale><space>object</space></noise></noises></textures>"
          "<materials><mattes><matte><name>squares</name><ka>0</ka><kd>1</kd><cd texture='squares'/></matte><matte>"
          "<name>cubes</name><ka>0</ka><kd>1</kd><cd texture='cubes'/></matte><matte><name>clouds</name><ka>0</ka>"
          "<kd>1</kd><cd texture='clouds'/></matte><matte><name>grey</name><ka>0</ka><kd>1</kd>"
          "<cd red='1' green='1' blue='1'/></matte></mattes><emissives><emissive><name>lamp</name>"
          "<ce red='3' green='3' blue='3'/></emissive></emissives></materials><objects>" +
          objects + "</objects>" +
          (groups.empty() ? "" : "<groups><group><name>g</name><objects>" + groups + "</objects></group></groups>"),
      camera);
}

std::string instance_under(const std::string& steps) {
  return "<instances><instance><group>g</group><transform>" + steps + "</transform></instance></instances>";
}

/// The share of pixels that differ: those where a coordinate jumps from 1 to 0 may.
double different_share(const FloatPicture& a, const FloatPicture& b) {
  double count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) count += difference(a.pixels()[i], b.pixels()[i]) > 2e-3 ? 1 : 0;
  return count / static_cast<double>(a.pixels().size());
}

const std::string turned = "<rotate x='1' y='2' z='0.5' angle='40'/><translate x='0.5' y='0' z='0'/>",
                  quarter = "<rotate x='0' y='0' z='1' angle='90'/>",
                  mirrored = "<matrix>-1 0 0 0.25  0 1 0 0  0 0 1 0  0 0 0 1</matrix>",
                  exchanged = "<matrix>0 0 1 0  0 1 0 0.5  1 0 0 0  0 0 0 1</matrix>",
                  grown = "<scale x='1.25' y='1.25' z='1.25'/><translate x='0' y='0' z='-2'/>";

}  // namespace

TEST_CASE("a transform carries texture coordinates with it, as that of an instance does") {
  const Element shape = GENERATE(
      Element{"sphere", "<center x='0.5' y='0' z='0'/><radius>3</radius>"},
      Element{"cylinder", "<bottom x='0' y='-2' z='0'/><top x='0' y='2' z='1'/><radius>2</radius>"},
      Element{"cone", "<bottom x='0' y='-2' z='0'/><top x='0' y='2' z='1'/><radius>3</radius>"},
      Element{"torus",
              "<center x='0' y='0' z='0'/><axis x='0' y='1' z='1'/><sweptradius>2.5</sweptradius>"
              "<tuberadius>1</tuberadius>"},
      Element{"disk", "<center x='0' y='0' z='0'/><normal x='0.2' y='0.5' z='1'/><radius>3</radius>"},
      Element{"annulus",
              "<center x='0' y='0' z='0'/><normal x='0.2' y='0.5' z='1'/><innerradius>1</innerradius>"
              "<outerradius>3</outerradius>"},
      Element{"box", "<min x='-2' y='-2' z='-2'/><max x='2' y='2' z='2'/>"},
      Element{"rectangle", "<corner x='-2' y='-2' z='0'/><edge1 x='4' y='1' z='0'/><edge2 x='0' y='4' z='1'/>"},
      Element{"triangle",
              "<vertexposition1 x='-3' y='-3' z='0'/><vertexposition2 x='3' y='-2' z='0'/>"
              "<vertexposition3 x='0' y='3' z='0'/>"},
      Element{"mesh", "<positions>-3 -3 0, 3 -2 0, 1 2 0.5, -2 3 0</positions><faces>0 1 2, 0 2 3</faces>"},
      Element{"mesh", "<positions>-3 -3 0, 3 -2 0, 1 2 0.5, -2 3 0</positions><faces>0 1 2 3,</faces>"},
      Element{"mesh",
              "<positions>-3 -3 0, 3 -2 0, 1 2 0.5, -2 3 0</positions><faces>0 1 2, 0 2 3</faces>"
              "<uvs>0 0, 1 0, 1 1, 0 1</uvs>"});
  const std::string steps = GENERATE(turned, quarter, mirrored, exchanged, grown);
  INFO(shape.first << " under " << steps);
  const FloatPicture picture = rendered(transforms_scene("<uv/>", object(shape, "grey", steps)));
  CHECK(different_share(picture, rendered(transforms_scene("<uv/>", ""))) > 0.015);
  CHECK(different_share(picture,
                        rendered(transforms_scene("<uv/>", instance_under(steps), object(shape, "grey", "")))) < 0.012);
}

TEST_CASE("texture coordinates move with a plane") {
  // A mesh has those of the plane before the transform, and may be an instance.
  const Element plane{"plane", "<point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/>"};
  const Element mesh{"mesh",
                     "<positions>-400 -1 400, 400 -1 400, 400 -1 -400, -400 -1 -400</positions>"
                     "<faces>0 1 2 3,</faces><uvs>-400 -400, 400 -400, 400 400, -400 400</uvs>"};
  const std::string steps =
      GENERATE(as<std::string>(), "<rotate x='0' y='1' z='0' angle='40'/>", "<translate x='0.5' y='0.25' z='-0.75'/>",
               "<scale x='2' y='1' z='3'/><rotate x='1' y='0' z='0' angle='20'/>",
               "<scale x='-1' y='1' z='1'/><translate x='0.25' y='0' z='0'/>");
  INFO(steps);
  // Looked at from close by: far away, floats are coarse.
  const std::string camera = "<eye x='1' y='3' z='4'/><lookat x='0' y='-2' z='0'/>";
  CHECK(different_share(rendered(transforms_scene("<uv/>", object(plane, "grey", steps), {}, camera)),
                        rendered(transforms_scene("<uv/>", instance_under(steps), object(mesh, "grey", ""), camera))) <
        0.02);
}

TEST_CASE("far from the origin a plane has the texture coordinates that it has in the world") {
  // Squares of 10/3: there are 2400 up to 8000.
  const auto around = [](double x) {
    return rendered(transforms_scene(
        "<albedo/>", object({"plane", "<point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/>"}, "squares", ""), {},
        vector_text("eye", x + 1, 3, 4) + vector_text("lookat", x, -2, 0)));
  };
  CHECK(different_share(around(8000), around(0)) < 0.05);
}

TEST_CASE("a texture in the object's space goes with the object") {
  const Element shape =
      GENERATE(Element{"sphere", "<center x='0.5' y='0' z='0'/><radius>3</radius>"},
               Element{"torus",
                       "<center x='0' y='0' z='0'/><axis x='0' y='1' z='1'/><sweptradius>2.5</sweptradius>"
                       "<tuberadius>1</tuberadius>"},
               Element{"triangle",
                       "<vertexposition1 x='-3' y='-3' z='0'/><vertexposition2 x='3' y='-2' z='0'/>"
                       "<vertexposition3 x='0' y='3' z='0.1'/>"},
               Element{"plane", "<point x='0' y='-1' z='0.1'/><normal x='0' y='1' z='0.3'/>"},
               Element{"mesh", "<positions>-3 -3 0.2, 3 -2 0.2, 1 2 0.5, -2 3 0.2</positions><faces>0 1 2 3,</faces>"});
  const std::string texture = GENERATE("cubes", "clouds");
  const bool is_plane = shape.first == "plane";
  INFO(shape.first << ", " << texture);
  const std::string camera = "<eye x='1' y='2' z='12'/><lookat x='0' y='0' z='0'/>",
                    beside = "<eye x='6.3' y='2' z='12.4'/><lookat x='5.3' y='0' z='0.4'/>",
                    step = "<translate x='5.3' y='0' z='0.4'/>";
  const FloatPicture wanted = rendered(transforms_scene("<albedo/>", object(shape, texture, ""), {}, camera));
  CHECK(different_share(wanted, rendered(transforms_scene("<albedo/>", object(shape, "grey", ""), {}, camera))) > 0.02);
  CHECK(different_share(wanted, rendered(transforms_scene("<albedo/>", object(shape, texture, step), {}, beside))) <
        0.01);
  if (is_plane) return;  // which no group has
  CHECK(different_share(wanted, rendered(transforms_scene("<albedo/>", instance_under(step), object(shape, texture, ""),
                                                          beside))) < 0.01);
  for (const std::string& steps : {turned, mirrored, exchanged, grown})
    CHECK(different_share(rendered(transforms_scene("<albedo/>", object(shape, texture, steps), {}, camera)),
                          rendered(transforms_scene("<albedo/>", instance_under(steps), object(shape, texture, ""),
                                                    camera))) < 0.015);
}

TEST_CASE("far from the origin, an object's space is its own") {
  const auto around = [](double x) {
    const std::string step = "<translate x='" + std::to_string(x) + "' y='0' z='0'/>";
    return rendered(transforms_scene(
        "<albedo/>", object({"sphere", "<center x='0.5' y='0' z='0'/><radius>3</radius>"}, "cubes", step), {},
        vector_text("eye", x + 1, 2, 12) + vector_text("lookat", x, 0, 0)));
  };
  CHECK(different_share(around(8000.3), around(0)) < 0.03);
}

TEST_CASE("a mirrored surface keeps its front") {
  // One that shines on its front.
  const Element shape = GENERATE(
      Element{"rectangle", "<corner x='-4' y='-4' z='0'/><edge1 x='8' y='0' z='0'/><edge2 x='0' y='8' z='0'/>"},
      Element{"triangle",
              "<vertexposition1 x='-4' y='-4' z='0'/><vertexposition2 x='4' y='-4' z='0'/>"
              "<vertexposition3 x='0' y='6' z='0'/>"},
      Element{"disk", "<center x='0' y='0' z='0'/><normal x='0' y='0' z='1'/><radius>4</radius>"},
      Element{"mesh", "<positions>-4 -4 0, 4 -4 0, 0 6 0</positions><faces>0 1 2</faces>"},
      Element{"mesh", "<positions>-4 -4 0, 4 -4 0, 4 4 0, -4 4 0</positions><faces>0 1 2 3,</faces>"},
      Element{"mesh",
              "<positions>-4 -4 0, 4 -4 0, 4 4 0, -4 4 0</positions><faces>0 1 2 3,</faces>"
              "<normals>smooth</normals>"});
  INFO(shape.first);
  const auto middle = [&](const std::string& steps, const std::string& camera) {
    return rendered(transforms_scene("<path/>", object(shape, "lamp", steps), {}, camera)).at(24, 18).red;
  };
  const std::string before = "<eye x='0' y='0' z='12'/><lookat x='0' y='0' z='0'/>",
                    behind = "<eye x='0' y='0' z='-12'/><lookat x='0' y='0' z='0'/>";
  CHECK(middle("", before) == 3);
  CHECK(middle("<scale x='-1' y='1' z='1'/>", before) == 3);
  CHECK(middle("<scale x='-1' y='1' z='1'/>", behind) == 0);
  CHECK(middle("<scale x='1' y='1' z='-1'/>", before) == 0);
  CHECK(middle("<scale x='1' y='1' z='-1'/>", behind) == 3);
}

TEST_CASE("pictures of turned, textured shapes depend on no cut") {
  std::string objects;
  for (const Element& shape :
       {Element{"sphere", "<center x='-3' y='0' z='0'/><radius>2</radius>"},
        Element{"box", "<min x='1' y='-2' z='-2'/><max x='4' y='2' z='2'/>"},
        Element{"plane", "<point x='0' y='-3' z='0'/><normal x='0' y='1' z='0'/>"},
        Element{"mesh", "<positions>-3 3 0, 3 3 0, 1 5 0.5, -2 6 0</positions><faces>0 1 2 3,</faces>"}})
    for (const std::string& steps : {turned, exchanged}) objects += object(shape, "grey", steps);
  check_same_bits(parsed_scene(transforms_scene("<uv/>", objects)));
  check_same_bits(parsed_scene(transforms_scene(
      "<albedo/>", objects + object({"box", "<min x='-1' y='-1' z='3'/><max x='1' y='1' z='4'/>"}, "cubes", turned) +
                       object({"sphere", "<center x='0' y='3' z='3'/><radius>1</radius>"}, "clouds", turned))));
}

}  // namespace raytrace::test
