// Shadow catchers: a transparent picture shows the shadows on them alone.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

const std::string catching = "<shadowcatcher>true</shadowcatcher>";

/// Seen from above, four pixels for a unit: x from -5 to 5, z from -3 to 3.
std::string seen_from_above(const std::string& integrator, int samples, const std::string& lights,
                            const std::string& objects, const std::string& more = {}) {
  return "<raytracer><viewplane><hres>40</hres><vres>24</vres><pixelsize>0.25</pixelsize><samples>" +
         std::to_string(samples) +
         "</samples></viewplane><orthographiccamera><eye x='0' y='20' z='0'/><lookat x='0' y='0' z='0'/>"
         "<up x='0' y='0' z='-1'/></orthographiccamera><integrator>" +
         integrator + "</integrator><lights>" + lights +
         "</lights><materials><mattes><matte><name>grey</name><ka>1</ka><kd>0.5</kd><cd red='1' green='1' blue='1'/>"
         "</matte></mattes><emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/></emissive>"
         "</emissives></materials><objects>" +
         objects + "</objects>" + more + "</raytracer>";
}

std::string rectangle(double x0, double x1, double z0, double z1, double y, const std::string& more = {}) {
  return "<rectangles><rectangle>" + vector_text("corner", x0, y, z0) + vector_text("edge1", 0, 0, z1 - z0) +
         vector_text("edge2", x1 - x0, 0, 0) + "<material>grey</material>" + more + "</rectangle></rectangles>";
}

std::string plane(const std::string& more = catching) {
  return "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>grey</material>" + more +
         "</plane></planes>";
}

std::string disk(double y, double radius, double normal = 1, const std::string& material = "grey") {
  return "<disks><disk>" + vector_text("center", 0, y, 0) + vector_text("normal", 0, normal, 0) + "<radius>" +
         std::to_string(radius) + "</radius><material>" + material + "</material></disk></disks>";
}

FloatPicture transparent(const std::string& text) {
  const SceneDescription description = parsed_scene(text);
  RenderSettings settings{1, 0, whole(description)};
  settings.transparent = true;
  RayCounts rays;
  return render(*build_scene(description, {1, {}}), description, settings, rays);
}

const std::string slanted_sun =
    "<directionallights><directionallight><direction x='-1' y='1' z='0'/></directionallight></directionallights>";
const std::string near_lamp = "<pointlights><pointlight><location x='-4' y='6' z='0'/></pointlight></pointlights>";
const std::string by_raycast = "<raycast/>", by_paths = "<path/>";

/// Whether a pixel's middle is in the rectangle.
bool is_in(int column, int row, double x0, double x1, double z0, double z1) {
  const double x = (column + 0.5) / 4 - 5, z = (row + 0.5) / 4 - 3;
  return x > x0 && x < x1 && z > z0 && z < z1;
}

/// Alpha is `shadow` in the shadow from x = 0 to 2, z = -1 to 1, and 0 elsewhere but on the object that casts it, which
/// alone has any light.
void check_shadow(const FloatPicture& picture, double x0, double x1, double z, double shadow = 1) {
  int wrong = 0;
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 40; ++column) {
      const Pixel& pixel = picture.at(column, row);
      const bool light = pixel.red != 0 || pixel.green != 0 || pixel.blue != 0;
      if (is_in(column, row, x0, x1, -z, z))
        wrong += pixel.alpha != 1 || !light;
      else
        wrong += light || std::abs(pixel.alpha - (is_in(column, row, 0, 2, -1, 1) ? shadow : 0)) > 1e-6;
    }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("under a light without size, alpha is 1 in shadows on a shadow catcher and 0 elsewhere") {
  const std::string integrator = GENERATE(by_raycast, by_paths);
  const int samples = GENERATE(1, 3, 16);  // packets of all shapes
  INFO(integrator << ", " << samples << " samples");
  std::string lamp_in_group = near_lamp;
  lamp_in_group.insert(lamp_in_group.find("<location"), "<group>key</group>");
  check_shadow(transparent(seen_from_above(integrator, samples, slanted_sun, rectangle(-3, -1, -1, 1, 3) + plane())),
               -3, -1, 1);
  for (const std::string& light : {near_lamp, lamp_in_group})
    check_shadow(transparent(seen_from_above(integrator, samples, light, rectangle(-2, -1, -0.5, 0.5, 3) + plane())),
                 -2, -1, 0.5);
}

TEST_CASE("objects of all kinds are shadow catchers") {
  const std::string blocker = rectangle(-3, -1, -1, 1, 3);
  const auto group = [&](const std::string& more) {
    return "<groups><group><name>ground</name><objects>" + rectangle(-1, 1, -1, 1, 0, more) +
           "</objects></group></groups>";
  };
  const auto instance = [&](const std::string& more) {
    return "<instances><instance><group>ground</group><transform><scale x='20' y='1' z='20'/></transform>" + more +
           "</instance></instances>";
  };
  const std::string mesh = "<meshes><mesh><positions>-9 0 -9, -9 0 9, 9 0 9, 9 0 -9</positions><faces>0 1 2 3</faces>" +
                           catching + "</mesh></meshes>";
  // Under its transform it is an instance of its own.
  const std::string turned_box =
      "<boxes><box><min x='-20' y='-1' z='-20'/><max x='20' y='0' z='20'/><material>grey</material><transform>"
      "<rotate x='0' y='1' z='0' angle='30'/></transform>" +
      catching + "</box></boxes>";
  for (const std::string& integrator : {by_raycast, by_paths})
    for (const std::string& scene :
         {seen_from_above(integrator, 4, slanted_sun, blocker + mesh),
          seen_from_above(integrator, 4, slanted_sun, blocker + turned_box),
          seen_from_above(integrator, 4, slanted_sun, blocker + instance(catching), group("")),
          seen_from_above(integrator, 4, slanted_sun, blocker + instance(""), group(catching))}) {
      INFO(scene);
      check_shadow(transparent(scene), -3, -1, 1);
    }
  const FloatPicture ordinary =
      transparent(seen_from_above(by_raycast, 4, slanted_sun, blocker + instance(""), group("")));
  CHECK(ordinary.at(0, 0).alpha == 1);
}

TEST_CASE("light that nothing hides makes shadows on shadow catchers weaker") {
  const std::string blocker = rectangle(-3, -1, -1, 1, 3);
  const std::string unshadowed =
      "<directionallights><directionallight><direction x='-1' y='1' z='0'/><shadows>false</shadows></directionallight>"
      "</directionallights>";
  check_shadow(transparent(seen_from_above(by_raycast, 4, unshadowed, blocker + plane())), -3, -1, 1, 0);
  // From all around, as much as from the light: the sun's cosine is a half's square root.
  const std::string ambient = "<ambientlight><scaleradiance>" + std::to_string(std::sqrt(0.5) / std::acos(-1.0)) +
                              "</scaleradiance></ambientlight>";
  const int samples = is_sanitized ? 64 : 512;
  for (const std::string& integrator : {by_raycast, by_paths}) {
    const FloatPicture picture =
        transparent(seen_from_above(integrator, samples, ambient + slanted_sun, blocker + plane()));
    double sum = 0;
    for (int row = 8; row < 16; ++row)
      for (int column = 20; column < 28; ++column) sum += double{picture.at(column, row).alpha} / 64;
    CHECK(std::abs(sum - 0.5) < 0.01);
    CHECK(picture.at(39, 23).alpha == 0);
  }
}

TEST_CASE("on a shadow catcher, alpha is the share of the light from all around that is hidden") {
  // In the middle below a disk of radius r at height h, r^2 / (r^2 + h^2) of what an even sky sends is hidden.
  const int samples = is_sanitized ? 256 : 4096;
  const double tolerance = is_sanitized ? 0.05 : 0.012;
  const std::string sky = "<environmentlights><environmentlight/></environmentlights>";
  // From below the disk, of a thousandth of its size.
  const auto scene = [&](const std::string& lights, const std::string& objects, const std::string& background = {}) {
    std::string text = seen_from_above(by_paths, samples, lights, plane() + objects);
    const std::string eye = "y='20'", size = "<pixelsize>0.25</pixelsize>", hres = "<hres>40</hres><vres>24</vres>";
    text.replace(text.find(eye), eye.size(), "y='0.5'");
    text.replace(text.find(size), size.size(), "<pixelsize>0.001</pixelsize>" + background);
    text.replace(text.find(hres), hres.size(), "<hres>4</hres><vres>4</vres>");
    return text;
  };
  const auto alpha = [](const FloatPicture& picture) {
    double sum = 0;
    for (const Pixel& pixel : picture.pixels()) sum += double{pixel.alpha};
    return sum / 16;
  };
  for (const double radius : {0.5, 1.0, 2.0}) {
    const double hidden = radius * radius / (radius * radius + 1);
    INFO("radius " << radius);
    CHECK(std::abs(alpha(transparent(scene(sky, disk(1, radius)))) - hidden) < tolerance);
    CHECK(std::abs(alpha(transparent(scene("", disk(1, radius), "<background red='0.3' green='0.2' blue='0.1'/>"))) -
                   hidden) < tolerance);
  }
  // Of a shining disk's, by the same formula, what a smaller one has in front of it.
  const std::string ceiling = disk(3, 3, -1, "lamp");
  for (const double radius : {0.3, 0.6}) {
    const double hidden = radius * radius / (radius * radius + 1) / 0.5;
    INFO("radius " << radius << " below a lamp");
    CHECK(std::abs(alpha(transparent(scene("", ceiling + disk(1, radius)))) - hidden) < 2 * tolerance);
  }
  // What catchers hide does not count: around a disk that hides a fifth, a ring of them that hides as much again and a
  // half; and one above it that hides all that the disk hides, and more.
  const std::string ring = "<annuli><annulus>" + vector_text("center", 0, 1, 0) + vector_text("normal", 0, 1, 0) +
                           "<innerradius>0.5</innerradius><outerradius>1</outerradius><material>grey</material>" +
                           catching + "</annulus></annuli>";
  CHECK(std::abs(alpha(transparent(scene(sky, ring + disk(1, 0.5)))) - 0.2 / 0.7) < 1.5 * tolerance);
  std::string cover = disk(2, 2);
  cover.insert(cover.find("</disk>"), catching);
  CHECK(alpha(transparent(scene(sky, cover + disk(1, 0.5)))) == 0);
  CHECK(alpha(transparent(scene(sky, ring))) == 0);
}

TEST_CASE("shadows on a shadow catcher have the same bits however the picture is cut") {
  const std::string integrator = GENERATE(by_raycast, by_paths);
  const std::string lights =
      "<ambientlight><scaleradiance>0.1</scaleradiance></ambientlight><environmentlights><environmentlight/>"
      "</environmentlights><directionallights><directionallight><direction x='-1' y='1' z='0.3'/><angle>10</angle>"
      "</directionallight></directionallights>" +
      near_lamp;
  const std::string half_there =
      "<boxes><box><min x='-1' y='1' z='-1'/><max x='1' y='2' z='1'/><material>veil</material></box></boxes>";
  std::string text = seen_from_above(integrator, 16, lights,
                                     plane() + half_there + rectangle(-3, -1, -2, 1, 3) + disk(4, 0.5, -1, "lamp") +
                                         rectangle(2, 4, -2, 2, 0.5, catching));
  const std::string end = "</mattes>", light = "<location";
  text.insert(text.find(end),
              "<matte><name>veil</name><ka>1</ka><kd>0.5</kd><cd red='1' green='1' blue='1'/><opacity>0.5</opacity>"
              "</matte>");
  check_same_bits(parsed_scene(text), true);
  text.insert(text.find(light), "<group>key</group>");
  check_same_bits(parsed_scene(text), true);
  int in_part = 0;
  const FloatPicture picture = transparent(text);
  for (const Pixel& pixel : picture.pixels()) in_part += pixel.alpha > 0 && pixel.alpha < 1;
  CHECK(in_part > 100);
}

TEST_CASE("where a shadow catcher has no part in the picture, it is a surface like any other") {
  for (const std::string& integrator : {by_raycast, by_paths}) {
    const auto scene = [&](const std::string& more) {
      return seen_from_above(integrator, 4, slanted_sun + near_lamp, rectangle(-3, -1, -1, 1, 3) + plane(more));
    };
    CHECK(identical(rendered(scene(catching)), rendered(scene(""))));
    CHECK(identical(transparent(scene("<shadowcatcher>false</shadowcatcher>")), transparent(scene(""))));
  }
  const auto normals = [&](const std::string& more) {
    return transparent(seen_from_above("<normals/>", 4, slanted_sun, rectangle(-3, -1, -1, 1, 3) + plane(more)));
  };
  CHECK(identical(normals(catching), normals("")));
}

TEST_CASE("light paths show no light on a shadow catcher") {
  const std::string caustics = "<path><caustics>light</caustics></path>";
  const auto scene = [&](const std::string& more) {
    std::string text = seen_from_above(caustics, 16, near_lamp,
                                       plane(more) +
                                           "<spheres><sphere><center x='-2' y='1.5' z='0'/><radius>1</radius>"
                                           "<material>glass</material></sphere></spheres>");
    const std::string end = "</mattes>";
    text.insert(text.find(end) + end.size(), "<dielectrics><dielectric><name>glass</name></dielectric></dielectrics>");
    return text;
  };
  const auto brightness = [&](const FloatPicture& picture) {
    double sum = 0;
    for (int row = 0; row < 24; ++row)
      for (int column = 0; column < 40; ++column)
        if (!is_in(column, row, -3.25, -0.75, -1.25, 1.25)) sum += double{picture.at(column, row).red};
    return sum;
  };
  CHECK(brightness(transparent(scene(""))) > 1);
  CHECK(brightness(transparent(scene(catching))) == 0);
}

}  // namespace raytrace::test
