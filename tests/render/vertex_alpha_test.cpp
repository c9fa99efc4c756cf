// Alphas of meshes' vertices as opacity: a ramp from 0 to 1 against its closed form, for camera rays and shadow rays.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "raytrace/description/load_images.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/gltf.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// A rectangle from x -4 to 4 at z 1, with an alpha of 0 to 1; of two triangles or a quad.
std::string ramp_ply(bool quad, const std::string& left = "0", const std::string& right = "255") {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
      "red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float s\nproperty float t\n"
      "element face " +
      std::string(quad ? "1" : "2") + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const char* const corner : {"-4 -9", "4 -9", "4 9", "-4 9"})
    text += corner + std::string(" 1 255 255 255 ") + (corner[0] == '-' ? left : right) + " 0 0\n";
  return text + (quad ? "4 0 1 2 3\n" : "3 0 1 2\n3 0 2 3\n");
}

std::string light(bool ambient) {
  const std::string white = "<scaleradiance>1</scaleradiance><color red='1' green='1' blue='1'/>";
  return ambient ? "<ambientlight>" + white + "</ambientlight>"
                 : "<directionallights><directionallight><direction x='0' y='0' z='1'/>" + white +
                       "<shadows>true</shadows></directionallight></directionallights>";
}

/// Columns of 16 pixels that the rectangle just fills, from afar.
std::string text_of(const std::string& mesh, const std::string& opacity, const std::string& textures, bool shadows,
                    bool in_group) {
  const std::string of_mesh = "<meshes><mesh><file>" + mesh + "</file><material>veil</material></mesh></meshes>";
  const std::string matte = "<kd>1</kd><cd red='1' green='1' blue='1'/>";
  return "<raytracer><integrator><raycast/></integrator><viewplane><hres>16</hres><vres>32</vres>"
         "<pixelsize>0.5</pixelsize><samples>64</samples></viewplane><orthographiccamera><eye x='0' y='0' z='5'/>"
         "<lookat x='0' y='0' z='0'/></orthographiccamera><lights>" +
         light(!shadows) + "</lights><textures>" + textures + "</textures><materials><mattes><matte><name>veil</name>" +
         (shadows ? "<ka>0</ka><kd>0</kd><cd red='0' green='0' blue='0'/>" : "<ka>1</ka>" + matte) + opacity +
         "</matte><matte><name>floor</name><ka>0</ka>" + matte + "</matte></mattes></materials>" +
         (in_group ? "<groups><group><name>g</name><objects>" + of_mesh + "</objects></group></groups>" : "") +
         "<objects>" +
         (shadows ? std::string("<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' z='1'/>"
                                "<material>floor</material></plane></planes>")
                  : "") +
         (in_group ? "<instances><instance><group>g</group></instance></instances>" : of_mesh) +
         "</objects></raytracer>";
}

SceneDescription loaded(const std::string& text) {
  SceneDescription scene = parsed_scene(text);
  Diagnostics diagnostics("s");
  REQUIRE(load_images(scene, diagnostics, 1, {}));
  return scene;
}

constexpr int rows = 32;

/// The mean of each column.
std::vector<double> columns(const FloatPicture& picture) {
  std::vector<double> means(16);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < 16; ++x) means[static_cast<std::size_t>(x)] += double{picture.at(x, y).red} / rows;
  return means;
}

/// wanted: by the alpha at a place, of which a column has a sixteenth of all.
void check_columns(const FloatPicture& picture, double light, double tolerance,
                   const std::function<double(double alpha)>& wanted) {
  const std::vector<double> means = columns(picture);
  for (std::size_t i = 0; i < means.size(); ++i) {
    INFO("column " << i);
    double mean = 0;
    constexpr int steps = 1000;
    for (int k = 0; k < steps; ++k) mean += wanted((static_cast<double>(i) + (k + 0.5) / steps) / 16) / steps;
    CHECK(std::abs(means[i] / light - mean) < tolerance);
  }
}

/// A mask about that cutoff, as glTF's are.
double masked(double alpha, double factor, double cutoff) {
  return std::clamp(100 * (factor * alpha - cutoff) + 0.5, 0.0, 1.0);
}

struct Use {
  const char* name;
  std::string opacity, textures;
  std::function<double(double)> wanted;  ///< of a vertex alpha
};

std::vector<Use> uses(const std::string& half_image) {
  const auto vertices = [](const std::string& more = "") {
    return "<vertexcolors><vertexcolor><name>t</name>" + more + "</vertexcolor></vertexcolors>";
  };
  const auto image = [&](const std::string& more) {
    return "<images><image><name>t</name><file>" + half_image + "</file>" + more + "</image></images>";
  };
  const double half = 128 / 255.0;
  return {{"the alpha alone", "<opacity texture='t' channel='alpha'/>", vertices(), [](double a) { return a; }},
          {"times a number", "<opacity texture='t' channel='alpha'>0.5</opacity>", vertices(),
           [](double a) { return a / 2; }},
          {"a mask", "<opacity texture='t' channel='alpha'/>",
           vertices("<valuescale>100</valuescale><valueoffset>-49.5</valueoffset>"),
           [](double a) { return masked(a, 1, 0.5); }},
          {"times an image", "<opacity texture='t'/>", image("<vertexalpha>true</vertexalpha>"),
           [=](double a) { return half * a; }},
          {"times an image and a number", "<opacity texture='t'>0.5</opacity>",
           image("<vertexalpha>true</vertexalpha>"), [=](double a) { return half * a / 2; }},
          {"a mask of the product with an image", "<opacity texture='t'/>",
           image("<valuescale>100</valuescale><valueoffset>-24.5</valueoffset><vertexalpha>true</vertexalpha>"),
           [=](double a) { return masked(a, half, 0.25); }},
          {"an image that does not ask", "<opacity texture='t'/>", image(""), [=](double) { return half; }},
          {"no image at all", "<opacity>0.5</opacity>", "", [](double) { return 0.5; }},
          {"the colour", "<opacity texture='t'/>", vertices(), [](double) { return 1.0; }}};
}

}  // namespace

TEST_CASE("alphas of vertices are opacity where a material asks for them, camera rays and shadow rays alike") {
  const TemporaryFolder folder;
  write_text(folder.file("half.pgm"), "P5\n1 1\n255\n\x80");
  for (const bool quad : {false, true}) {
    const std::string mesh = folder.file(quad ? "quad.ply" : "two.ply");
    write_text(mesh, ramp_ply(quad));
    for (const Use& use : uses(folder.file("half.pgm")))
      for (const bool in_group : {false, true}) {
        INFO(use.name << (quad ? ", a quad" : "") << (in_group ? ", in an instance" : ""));
        for (const std::string& isa : usable_isas())
          check_columns(rendered(loaded(text_of(mesh, use.opacity, use.textures, false, in_group)), 1, isa), 1, 0.01,
                        use.wanted);
        // What comes from the floor passes the veil twice, by numbers that have nothing to do with each other.
        const double bare = columns(rendered(loaded(text_of(mesh, "<opacity>0</opacity>", "", true, in_group))))[0];
        check_columns(rendered(loaded(text_of(mesh, use.opacity, use.textures, true, in_group))), bare, 0.05,
                      [&](double alpha) { return std::pow(1 - use.wanted(alpha), 2); });
      }
  }
}

TEST_CASE("the alphas of a glTF file's vertices are opacity by its alphaMode") {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& material) {
    GltfFile file;
    file.add(std::vector<float>{-4, -9, 1, 4, -9, 1, 4, 9, 1, -4, 9, 1}, "VEC3", 5126, 4);
    file.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 6);
    file.add(std::vector<float>{1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0}, "VEC4", 5126, 4);
    write_text(folder.file("a.gltf"),
               file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[
                 {"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0}]}],"materials":[{)" +
                         material + R"(,"extensions":{"KHR_materials_unlit":{}}}])"));
    std::string text = text_of(folder.file("a.gltf"), "", "", false, false);
    text.erase(text.find("<material>veil</material>"), std::string("<material>veil</material>").size());
    text.replace(text.find("<raycast/>"), std::string("<raycast/>").size(), "<path/>");
    return rendered(loaded(text));
  };
  const std::string half = R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]})";
  check_columns(picture(R"("alphaMode":"BLEND")"), 1, 0.01, [](double a) { return a; });
  check_columns(picture(R"("alphaMode":"BLEND",)" + half), 1, 0.01, [](double a) { return a / 2; });
  check_columns(picture(R"("alphaMode":"MASK")"), 1, 0.01, [](double a) { return masked(a, 1, 0.5); });
  check_columns(picture(R"("alphaMode":"MASK","alphaCutoff":0.125,)" + half), 1, 0.01,
                [](double a) { return masked(a, 0.5, 0.125); });
  check_columns(picture(R"("alphaMode":"OPAQUE",)" + half), 1, 0.01, [](double) { return 1.0; });
  check_columns(picture(R"("doubleSided":true)"), 1, 0.01, [](double) { return 1.0; });
}

TEST_CASE("a veil by its vertices' alphas is the veil of that number, to light paths and photons as well") {
  const TemporaryFolder folder;
  write_text(folder.file("veil.ply"), ramp_ply(true, "51", "51"));
  for (const char* const caustics : {"light", "photons"}) {
    const auto picture = [&](const std::string& opacity) {
      return rendered(loaded(
          "<raytracer><integrator><path><caustics>" + std::string(caustics) +
          "</caustics></path></integrator><viewplane><hres>16</hres><vres>8</vres><samples>32</samples></viewplane>"
          "<camera><eye x='0' y='0' z='8'/><lookat x='0' y='0' z='0'/><fov>50</fov></camera><lights><pointlights>"
          "<pointlight><location x='0' y='1' z='5'/><scaleradiance>40</scaleradiance><color red='1' green='1' "
          "blue='1'/></pointlight></pointlights></lights><textures><vertexcolors><vertexcolor><name>t</name>"
          "</vertexcolor></vertexcolors></textures><materials><mattes><matte><name>veil</name><ka>0</ka><kd>1</kd>"
          "<cd red='1' green='1' blue='1'/>" +
          opacity +
          "</matte><matte><name>floor</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte>"
          "</mattes><dielectrics><dielectric><name>glass</name></dielectric></dielectrics></materials><objects>"
          "<planes><plane><point x='0' y='0' z='-2'/><normal x='0' y='0' z='1'/><material>floor</material></plane>"
          "</planes><spheres><sphere><center x='0' y='0' z='3'/><radius>0.8</radius><material>glass</material>"
          "</sphere></spheres><meshes><mesh><file>" +
          folder.file("veil.ply") + "</file><material>veil</material></mesh></meshes></objects></raytracer>"));
    };
    const FloatPicture by_number = picture("<opacity>0.2</opacity>"),
                       by_vertices = picture("<opacity texture='t' channel='alpha'/>");
    double sum = 0, off = 0;
    for (std::size_t i = 0; i < by_number.pixels().size(); ++i) {
      sum += double{by_number.pixels()[i].green};
      off += std::abs(double{by_number.pixels()[i].green} - double{by_vertices.pixels()[i].green});
    }
    INFO(caustics);
    CHECK(sum > 0);
    CHECK(off < 1e-5 * sum);  // but for the last digit of 0.2 between the vertices
  }
}

TEST_CASE("what passes between vertices does not depend on threads, or how the picture is cut") {
  const TemporaryFolder folder;
  write_text(folder.file("a.ply"), ramp_ply(true));
  write_text(folder.file("half.pgm"), "P5\n1 1\n255\n\x80");
  for (const Use& use : uses(folder.file("half.pgm")))
    if (use.opacity.find("0.5") != std::string::npos && !use.textures.empty()) {
      std::string text = text_of(folder.file("a.ply"), use.opacity, use.textures, true, true);
      const std::string size = "<hres>16</hres><vres>32</vres><pixelsize>0.5";
      text.replace(text.find(size), size.size(), "<hres>61</hres><vres>47</vres><pixelsize>0.13");
      text.replace(text.find("<samples>64"), 11, "<samples>16");
      check_same_bits(loaded(text));
    }
}

}  // namespace raytrace::test
