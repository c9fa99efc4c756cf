// Curves: the pictures that they have, and that nothing but the scene decides their bits.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "raytrace/aovs/aov_table.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

const std::string curve_materials =
    "<lights><ambientlight><scaleradiance>0.3</scaleradiance></ambientlight><pointlights><pointlight>"
    "<location x='6' y='9' z='10'/><scaleradiance>2</scaleradiance></pointlight></pointlights></lights>"
    "<textures><checkers><checker><name>checks</name><uvscale x='8' y='8'/><color1 red='1' green='1' "
    "blue='1'/><color2 red='0.1' green='0.1' blue='0.3'/></checker></checkers></textures>"
    "<materials><mattes><matte><name>red</name><ka>1</ka><kd>1</kd><cd red='1' green='0.25' blue='0.125'/></matte>"
    "<matte><name>veil</name><ka>1</ka><kd>1</kd><cd red='1' green='1' blue='1'/><opacity>0.5</opacity></matte>"
    "<matte><name>checked</name><ka>1</ka><kd>1</kd><cd red='1' green='1' blue='1' texture='checks'/></matte>"
    "</mattes><dielectrics><dielectric><name>glass</name><ior>1.5</ior></dielectric></dielectrics></materials>";

std::string curve(const std::string& parameters, const std::string& material = "red") {
  return "<curve>" + parameters + (material.empty() ? "" : "<material>" + material + "</material>") + "</curve>";
}

std::string curves_scene(const std::string& objects, const std::string& integrator = "raycast",
                         const std::string& groups = {}, int samples = 4) {
  return scene_text(64, 48, samples,
                    "<integrator><" + integrator + "/></integrator>" + curve_materials + "<objects>" + objects +
                        "</objects>" + groups);
}

std::string in_list(const std::string& curves) { return "<curves>" + curves + "</curves>"; }

/// Of strands that bend much, thick and thin.
const std::string winding =
    "<points>-4 -3 0 -3 2 1 -1 -2 -1 1 3 0 2 -2 1 4 2 0, -3 3 0 0 3 1 3 3 0, 0 -4 0 1 0 4</points>";
const std::string veils = curve(winding + "<radius>0.4</radius><tipscale>0.25</tipscale>", "veil");

std::string messages_of(const std::string& scene, bool fails = true) {
  Diagnostics diagnostics("scene.xml");
  auto description = parse_scene(scene, diagnostics);
  if (description) CHECK(load_meshes(*description, diagnostics) == !fails);
  std::ostringstream printed;
  diagnostics.print(printed);
  return printed.str();
}

double mean_of(const FloatPicture& picture, float Pixel::* channel) {
  double sum = 0;
  for (const Pixel& pixel : picture.pixels()) sum += static_cast<double>(pixel.*channel);
  return sum / static_cast<double>(picture.pixels().size());
}

/// How many of the pixels differ by more than that.
int different_pixels(const FloatPicture& a, const FloatPicture& b, double most) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) count += difference(a.pixels()[i], b.pixels()[i]) > most ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("a straight strand is a cylinder with balls at its ends") {
  const std::string strand = curve("<points>-3 -1 0 -1 0 1 3 2 3</points><radius>0.5</radius><basis>linear</basis>");
  const std::string shapes =
      "<cylinders><cylinder><bottom x='-3' y='-1' z='0'/><top x='3' y='2' z='3'/><radius>0.5</radius><material>red"
      "</material></cylinder></cylinders><spheres><sphere><center x='-3' y='-1' z='0'/><radius>0.5</radius><material>"
      "red</material></sphere><sphere><center x='3' y='2' z='3'/><radius>0.5</radius><material>red</material></sphere>"
      "</spheres>";
  for (const std::string integrator : {"normals", "raycast", "path"}) {
    INFO(integrator);
    const FloatPicture wanted = rendered(curves_scene(shapes, integrator, "", 16)),
                       found = rendered(curves_scene(in_list(strand), integrator, "", 16));
    // Shadow rays that graze differ by roundings.
    CHECK(different_pixels(wanted, found, 1e-3) <= 8);
  }
}

TEST_CASE("the bits of curves depend on the scene alone") {
  const std::string objects =
      in_list(
          veils + curve("<points>-4 0 2 -2 1 0 0 -1 3 2 1 0 4 0 2</points><radius>0.2</radius>", "checked") +
          curve("<points>-4 2 2 -2 3 0 0 1 3 2 3 0 4 2 2</points><radius>0.3</radius><basis>bspline</basis>", "glass") +
          curve("<points>-2 -3 3 -1 -2 3 0 -3 3</points><radius>0.2</radius><basis>linear</basis>") +
          "<curve><points>0 0 0 1 1 0 0 2 0</points><radius>0.1</radius><material>red</material><transform>" +
          keys("translate", "x='-3' y='0' z='4'", "x='-2' y='1' z='4'") + "</transform></curve>") +
      "<instances><instance><group>tuft</group><transform><scale x='1' y='2' z='0.5'/><rotate x='0' y='0' z='1' "
      "angle='40'/></transform></instance></instances>";
  const std::string groups =
      "<groups><group><name>tuft</name><objects>" +
      in_list(
          curve("<points>1 0 0 1 1 0 2 2 0, 2 0 0 2 1 1 1 2 0</points><radius>0.2</radius><tipscale>0</tipscale>")) +
      "</objects></group></groups>";
  SceneDescription scene = parsed_scene(curves_scene(objects, "path", groups, 8));
  check_same_bits(scene);
}

TEST_CASE("the surface of a strand has no walls inside: a veil is crossed twice") {
  // Of a transparent picture, the alpha of what is crossed twice is three quarters of what is covered.
  const auto alpha = [](const std::string& material) {
    SceneDescription scene = parsed_scene(
        curves_scene(in_list(curve("<points>-3 -2 0 -2 2 0 2 2 0 3 -2 0</points><radius>0.7</radius>", material)),
                     "raycast", "", 64));
    const auto built = build_scene(scene, {1, {}});
    RayCounts rays;
    RenderSettings settings{1, 0, whole(scene)};
    settings.transparent = true;
    return mean_of(render(*built, scene, settings, rays), &Pixel::alpha);
  };
  const double covered = alpha("red"), veiled = alpha("veil");
  CHECK(covered > 0.1);
  // Rays along the strand's ends cross its outside more than twice.
  CHECK(veiled / covered == Approx(0.75).margin(0.01));
}

TEST_CASE("strands stay where they are under transforms, which may not stretch them") {
  const std::string points = "<points>0 0 0 1 1 0 0 2 0 1 3 1</points>";
  const std::string moved = curve(points +
                                  "<radius>0.2</radius><tipscale>0.5</tipscale><transform><scale x='0.5' "
                                  "y='0.5' z='-0.5'/><translate x='1' y='-1' z='2'/></transform>");
  const std::string placed =
      curve("<points>1 -1 2 1.5 -0.5 2 1 0 2 1.5 0.5 1.5</points><radius>0.1</radius><tipscale>0.5</tipscale>");
  CHECK(different_pixels(rendered(curves_scene(in_list(moved))), rendered(curves_scene(in_list(placed))), 1e-4) == 0);
  const std::string stretch = "<transform><scale x='1' y='2' z='1'/></transform>";
  CHECK(contains(messages_of(curves_scene(in_list(curve(points + "<radius>1</radius>" + stretch)))),
                 "cannot stretch it; put it into a <group>"));
  // Far from the origin, their points are as precise.
  const std::string there = curve(
                        "<points>100000 0 0 100001 1 0 100000 2 0 100001 3 1</points><radius>0.2</radius>"
                        "<transform><translate x='-100000' y='0' z='0'/></transform>"),
                    here = curve(points + "<radius>0.2</radius>");
  CHECK(different_pixels(rendered(curves_scene(in_list(there))), rendered(curves_scene(in_list(here))), 1e-4) == 0);
}

TEST_CASE("radii are those of the scene where it has one, scaled, and narrower at the tip") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  std::ofstream(file) << "-3 0 0 0.5\n3 0 0 0.5\n";
  const std::string of_file = "<file>" + file + "</file>", points = "<points>-3 0 0 3 0 0</points>";
  const auto picture = [&](const std::string& parameters) {
    return rendered(curves_scene(in_list(curve(parameters)), "normals"));
  };
  const FloatPicture half = picture(points + "<radius>0.5</radius>");
  CHECK(identical(picture(of_file), half));
  CHECK(identical(picture(of_file + "<radius>0.25</radius><radiusscale>2</radiusscale>"), half));
  const auto wide = [&](const std::string& more) { return mean_of(picture(of_file + more), &Pixel::red); };
  const double background = mean_of(picture("<points>0 99 0 0 98 0</points><radius>1</radius>"), &Pixel::red);
  CHECK(std::abs(wide("<tipscale>0</tipscale>") - background) < std::abs(wide("") - background));
  CHECK(contains(messages_of(curves_scene(in_list(curve("<file>" + file + "</file>" + points)))), "remove <points>"));
  CHECK(contains(messages_of(curves_scene(in_list(curve(points)))), "needs a <radius>"));
  CHECK(contains(messages_of(curves_scene(in_list(curve("<points>1 2 3 4</points><radius>1</radius>")))),
                 "a strand of 4 numbers"));
  CHECK(contains(messages_of(curves_scene(in_list(curve("")))), "needs <file> or <points>"));
  CHECK(
      contains(messages_of(curves_scene(in_list(curve(points + "<radius>1e17</radius><radiusscale>20</radiusscale>")))),
               "has no strand that can be rendered"));
  std::ofstream(file) << "-3 0 0\n3 0 0\n\n1 1 1\n1 1 1\n";
  CHECK(contains(messages_of(curves_scene(in_list(curve(of_file)))), "has no radii; add <radius> to the <curve>"));
  CHECK(contains(messages_of(curves_scene(in_list(curve(of_file + "<radius>1</radius>"))), false),
                 "1 of 2 strands are left out"));
  CHECK(contains(messages_of(curves_scene(in_list(curve(of_file + "<radius>1</radius><basis>bspline</basis>")))),
                 "has no strand that can be rendered"));
}

TEST_CASE("curves are one object each, behind the clouds, and count in the hash by what they are") {
  const std::string strand = "<points>-3 0 0 3 0 0</points><radius>0.5</radius>";
  const SceneDescription scene = parsed_scene(curves_scene(
      "<meshes><mesh><positions>-1 1 3, 1 1 3, 0 3 3</positions><faces>0 1 2</faces><material>red</material></mesh>"
      "</meshes>" +
      in_list("<curve><name>wire</name>" + strand + "<material>red</material></curve>" +
              curve("<points>-3 -2 0 3 -2 0</points><radius>0.5</radius>"))));
  CHECK(object_names(scene) == std::vector<std::string>{"mesh#1", "wire", "curve#2"});
  const std::vector<std::uint32_t> ids = object_ids(scene, {});
  CHECK(std::set<std::uint32_t>(ids.begin(), ids.end()) == std::set<std::uint32_t>{0, 1, 2, 3});

  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  const auto hash_of = [&](const std::string& text, const std::string& more) {
    std::ofstream(file) << text;
    return scene_hash(parsed_scene(curves_scene(in_list(curve("<file>" + file + "</file>" + more)))));
  };
  const std::string text = "0 0 0 1\n0 1 0 1\n0 1 1 1\n", hash = hash_of(text, "");
  CHECK(hash_of(text, "") == hash);
  CHECK(hash_of("0 0 0 1\n0 1 0 1\n0 1 2 1\n", "") != hash);
  CHECK(hash_of("0 0 0 1\n0 1 0 1\n0 1 1 2\n", "") != hash);
  CHECK(hash_of("1 0 0 1\n1 1 0 1\n1 1 1 1\n", "") != hash);
  for (const std::string more : {"<radius>2</radius>", "<tipscale>0.5</tipscale>", "<basis>linear</basis>"})
    CHECK(hash_of(text, more) != hash);
}

TEST_CASE("strands without a material have the colours of their file, evenly from point to point") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.hair");
  std::string bytes = "HAIR";
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const std::uint32_t number : {1U, 2U, 2U | 16U, 1U}) add(number);
  add(1.0F);
  bytes.resize(128);
  for (const float number : {-4.0F, 0.0F, 0.0F, 4.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F, 0.0F}) add(number);
  std::ofstream(file, std::ios::binary) << bytes;
  const FloatPicture picture =
      rendered(curves_scene(in_list(curve("<file>" + file + "</file>", "")), "albedo", "", 16));
  const auto at = [&](int column) { return picture.pixels()[std::size_t{24} * 64 + static_cast<std::size_t>(column)]; };
  for (const int column : {16, 32, 48}) {
    INFO(column);
    const double share = ((column + 0.5 - 32) / 64 * 11.7 + 4) / 8;
    CHECK(double{at(column).red / at(column).green} == Approx(share).margin(0.02));
    CHECK(at(column).blue == 0);
  }
}

TEST_CASE("u goes from the root to the tip, v around the strand") {
  const FloatPicture picture = rendered(curves_scene(
      in_list(curve("<points>-4 0 0 -2 0 0 4 0 0</points><radius>1</radius><basis>linear</basis>")), "uv", "", 4));
  const auto at = [&](int column, int row) {
    return picture.pixels()[static_cast<std::size_t>(row) * 64 + static_cast<std::size_t>(column)];
  };
  for (const int column : {16, 24, 32, 40, 48}) {
    INFO(column);
    // By lengths, and not by points.
    const double x = (column + 0.5 - 32) / 64 * 11.2;
    CHECK(double{at(column, 26).red} == Approx((x + 4) / 8).margin(0.03));
    CHECK(double{at(column, 24).green} == Approx(double{at(16, 24).green}).margin(0.01));
  }
  CHECK(double{at(32, 22).green - at(32, 28).green} > 0.1);
}

}  // namespace raytrace::test
