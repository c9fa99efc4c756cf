// Scenes at the limits of what the format takes.
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::string white =
    "<materials><phongs><phong><name>m</name><ka>0.5</ka><kd>0.5</kd><ks>0.5</ks><cd red='1' green='1' blue='1'/>"
    "<cs red='1' green='1' blue='1'/><exp>20</exp></phong></phongs></materials>";

int not_finite(const FloatPicture& film) {
  int count = 0;
  for (const Pixel& pixel : film.pixels())
    count += !std::isfinite(pixel.red) || !std::isfinite(pixel.green) || !std::isfinite(pixel.blue) ||
             !(pixel.alpha >= 0 && pixel.alpha <= 1);
  return count;
}

}  // namespace

TEST_CASE("a scene without objects is its background, which is opaque") {
  for (const std::string& isa : usable_isas()) {
    const FloatPicture film =
        rendered(parsed_scene(scene_text(33, 17, 3,
                                         "<lights><pointlights><pointlight><location x='0' y='0' z='0'/></pointlight>"
                                         "</pointlights></lights>")),
                 1, isa);
    int wrong = 0;
    for (const Pixel& pixel : film.pixels())
      wrong += std::abs(pixel.red - 0.1f) > 1e-7f || std::abs(pixel.green - 0.2f) > 1e-7f ||
               std::abs(pixel.blue - 0.4f) > 1e-7f || pixel.alpha != 1;
    CHECK(wrong == 0);
  }
}

TEST_CASE("a scene without objects is what is around it, by every integrator") {
  const std::string integrator =
      GENERATE("<raycast/>", "<normals/>", "<uv/>", "<albedo/>", "<ambientocclusion/>", "<path/>",
               "<path><caustics>light</caustics></path>", "<path><caustics>photons</caustics></path>",
               "<path><indirectsamples>2</indirectsamples></path>");
  const bool has_sky = GENERATE(false, true);
  const std::string sky =
      "<environmentlights><environmentlight><color red='0.5' green='0.5' blue='0.5'/>"
      "</environmentlight></environmentlights>";
  // One that is left out with a warning is none, either.
  const std::string objects =
      GENERATE("",
               "<objects><triangles><triangle><vertexposition1 x='0' y='0' z='0'/><vertexposition2 x='1' y='0' z='0'/>"
               "<vertexposition3 x='2' y='0' z='0'/><material>m</material></triangle></triangles></objects>");
  const SceneDescription description =
      parsed_scene(scene_text(9, 5, 4,
                              "<integrator>" + integrator + "</integrator><lights>" + (has_sky ? sky : "") +
                                  "</lights>" + (objects.empty() ? "" : white + objects)));
  for (const std::string& isa : usable_isas()) {
    INFO(integrator << (has_sky ? " with a sky, " : ", ") << isa);
    const FloatPicture film = rendered(description, 1, isa);
    int wrong = 0;
    for (const Pixel& pixel : film.pixels())
      wrong += std::abs(pixel.red - (has_sky ? 0.5F : 0.1F)) > 1e-6F ||
               std::abs(pixel.blue - (has_sky ? 0.5F : 0.4F)) > 1e-6F || pixel.alpha != 1;
    CHECK(wrong == 0);
  }
}

TEST_CASE("coordinates and sizes as large and as small as the format takes give finite pictures") {
  const auto objects = [](const std::string& far, const std::string& size, const std::string& tube) {
    const auto at = [&](const std::string& element, const std::string& x, const std::string& y, const std::string& z) {
      return "<" + element + " x='" + x + "' y='" + y + "' z='" + z + "'/>";
    };
    const std::string material = "<material>m</material>";
    return "<objects><planes><plane>" + at("point", "0", "-" + far, "0") + "<normal x='0' y='1' z='0'/>" + material +
           "</plane><plane>" + at("point", far, far, "-" + far) + "<normal x='1e-16' y='1e-16' z='1e-16'/>" + material +
           "</plane></planes><spheres><sphere>" + at("center", far, "0", "-" + far) + "<radius>" + size + "</radius>" +
           material + "</sphere><sphere>" + at("center", "0", "0", "-3") + "<radius>" + size + "</radius>" + material +
           "</sphere></spheres><triangles><triangle>" + at("vertexposition1", "-" + far, "-" + far, "-5") +
           at("vertexposition2", far, "-" + far, "-5") + at("vertexposition3", "0", far, "-" + far) + material +
           "</triangle></triangles><cylinders><cylinder>" + at("bottom", "-" + far, "-" + far, "-" + far) +
           at("top", far, far, "-5") + "<radius>" + size + "</radius>" + material +
           "</cylinder></cylinders><toruses><torus>" + at("center", "0", "0", "-" + far) +
           at("axis", "1e-16", "1e16", "0") + "<sweptradius>" + size + "</sweptradius><tuberadius>" + tube +
           "</tuberadius>" + material + "</torus></toruses><disks><disk>" + at("center", far, "0", "-" + far) +
           at("normal", far, "0", far) + "<radius>" + size + "</radius>" + material + "</disk></disks></objects>";
  };
  const std::string lights =
      "<lights><ambientlight/><pointlights><pointlight><location x='1e17' y='1e17' z='1e17'/></pointlight><pointlight>"
      "<location x='0' y='1e-17' z='0'/></pointlight></pointlights><directionallights><directionallight>"
      "<direction x='1e17' y='1e17' z='0'/></directionallight><directionallight><direction x='1e-16' y='0' z='1e-16'/>"
      "</directionallight></directionallights></lights>";
  const std::vector<std::string> cameras{
      "<eye x='0' y='2' z='12'/><lookat x='0' y='0' z='0'/>",
      "<eye x='1e17' y='1e17' z='1e17'/><lookat x='0' y='0' z='0'/>",
      "<eye x='0' y='0' z='0'/><lookat x='0' y='0' z='-1e17'/><up x='1e-16' y='0' z='0'/>"};
  for (const std::string& isa : usable_isas())
    for (const std::string& camera : cameras)
      for (const auto& [far, size, tube] : std::vector<std::array<std::string, 3>>{{"1e17", "1e17", "1e16"},
                                                                                   {"1e17", "1e-17", "1e-17"},
                                                                                   {"1e9", "1e17", "1e-17"},
                                                                                   {"1e-17", "1e-17", "1e-17"},
                                                                                   {"3", "1e9", "1e3"}}) {
        INFO(isa << ", camera " << camera << ", far " << far << ", size " << size);
        CHECK(not_finite(rendered(
                  parsed_scene(scene_text(24, 24, 2, lights + white + objects(far, size, tube), camera)), 1, isa)) ==
              0);
      }
}

TEST_CASE("more light than floats can hold is set aside where it falls, told, and nothing elsewhere") {
  const std::string text =
      scene_text(16, 16, 1,
                 "<lights><pointlights><pointlight><location x='20' y='0' "
                 "z='0'/><scaleradiance>1e17</scaleradiance><color red='1e17' green='1' blue='1'/>"
                 "<shadows>false</shadows></pointlight></pointlights></lights><materials><mattes><matte><name>m</"
                 "name><ka>1</ka><kd>1e17</kd>"
                 "<cd red='1e17' green='1' blue='1'/></matte></mattes></materials><objects><spheres><sphere><center "
                 "x='0' y='0' z='0'/><radius>4</radius>"
                 "<material>m</material></sphere></spheres></objects>");
  for (const std::string& isa : usable_isas()) {
    const SceneDescription description = parsed_scene(text);
    const auto scene = build_scene(description, {1, isa});
    Film film(film_settings(*scene, description, {1, 0, whole(description), {}}));
    const InvalidSamples told = render(*scene, film, 1, 1).invalid_samples;
    std::uint64_t lit = 0, hit = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        hit += film.sum(x, y).hits;
        CHECK(film.sum(x, y).samples == 1);
        if (film.sum(x, y).hits == 1) CHECK(film.sum(x, y).red == 0);
      }
    lit = told.count;
    INFO(isa);
    CHECK(lit > 20);
    CHECK(lit < hit - 20);  // the sphere's far side is dark, and fine
    REQUIRE(told.listed.size() == InvalidSamples::most_listed);
    for (std::size_t i = 1; i < told.listed.size(); ++i) {
      const SampleId &a = told.listed[i - 1], &b = told.listed[i];
      CHECK((a.y < b.y || (a.y == b.y && a.x < b.x)));
    }
    for (const SampleId& id : told.listed) CHECK(film.sum(id.x, id.y).hits == 1);
  }
}

TEST_CASE("ten thousand planes: each pixel sees the nearest") {
  constexpr int count = 10000, edge = 40, colors = 7;
  std::mt19937 bits(23);
  const auto unit = [&] { return static_cast<double>(bits()) / 4294967296.0; };
  struct Plane {
    Vec3d normal;
    double height;  // along the normal, above the eye
  };
  std::vector<Plane> planes;
  std::string objects, materials;
  for (int i = 0; i < colors; ++i)
    materials += "<matte><name>m" + std::to_string(i) + "</name><ka>" + std::to_string(0.1 + 0.1 * i) +
                 "</ka><kd>0</kd><cd red='1' green='1' blue='1'/></matte>";
  for (int i = 0; i < count; ++i) {
    const Vec3d direction{std::round(2000 * (unit() - 0.5)) / 1000, std::round(2000 * (unit() - 0.5)) / 1000,
                          std::round(2000 * (unit() - 0.5)) / 1000 + 0.0005};
    const double distance = std::round(1000 * (20 + 500 * unit())) / 1000;
    planes.push_back({direction, distance * dot(direction, direction)});
    objects += "<plane><point x='" + std::to_string(direction.x * distance) + "' y='" +
               std::to_string(direction.y * distance) + "' z='" + std::to_string(direction.z * distance) + "'/>" +
               vector_text("normal", direction.x, direction.y, direction.z) + "<material>m" +
               std::to_string(i % colors) + "</material></plane>";
  }
  const FloatPicture film =
      rendered(scene_text(edge, edge, 1,
                          "<lights><ambientlight/></lights><materials><mattes>" + materials +
                              "</mattes></materials><objects><planes>" + objects + "</planes></objects>",
                          "<eye x='0' y='0' z='0'/><lookat x='0' y='0' z='-1'/>"));
  int wrong = 0;
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      const Vec3d ray{x - edge / 2 + 0.5, edge / 2 - 0.5 - y, -edge};
      double nearest = std::numeric_limits<double>::infinity();
      int seen = 0;
      for (int i = 0; i < count; ++i) {
        const Plane& plane = planes[static_cast<std::size_t>(i)];
        const double distance = plane.height / dot(plane.normal, ray);
        if (distance <= 0 || distance >= nearest) continue;
        nearest = distance;
        seen = i % colors;
      }
      wrong += std::abs(static_cast<double>(film.at(x, y).red) - (0.1 + 0.1 * seen)) > 1e-5;
    }
  CHECK(wrong <= edge * edge / 200);  // where two planes meet
}

}  // namespace raytrace::test
