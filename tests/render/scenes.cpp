#include "render/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <utility>

#include "raytrace/aovs/aov_selection.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

SceneDescription at_moment(const std::string& text, double after_frame) {
  Diagnostics diagnostics("scene.xml");
  SceneSettings settings;
  settings.after_frame = after_frame;
  auto scene = parse_scene(text, diagnostics, 1, settings);
  REQUIRE(scene.has_value());
  REQUIRE(load_meshes(*scene, diagnostics, 1));
  return std::move(*scene);
}

std::string busy_scene(int width, int height, int samples) {
  std::mt19937 bits(3);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits()) / 4294967296.0;
  };
  std::string spheres;
  for (int i = 0; i < 1000; ++i)
    spheres += "<sphere>" + vector_text("center", between(-6, 6), between(-1, 4), between(-6, 4)) + "<radius>" +
               std::to_string(between(0.02, 0.2)) + "</radius><material>" + (i % 2 == 0 ? "red" : "shiny") +
               "</material></sphere>";
  return scene_text(
      width, height, samples,
      "<lights><ambientlight><scaleradiance>0.3</scaleradiance></ambientlight>"
      "<pointlights><pointlight><location x='5' y='8' z='9'/><scaleradiance>2</scaleradiance></pointlight>"
      "<pointlight><location x='-7' y='3' z='4'/><color red='0.3' green='0.5' "
      "blue='1'/><shadows>false</shadows></pointlight></pointlights>"
      "<directionallights><directionallight><direction x='0.2' y='1' "
      "z='0.1'/></directionallight></directionallights></lights>"
      "<materials><mattes>"
      "<matte><name>red</name><ka>0.5</ka><kd>0.8</kd><cd red='1' green='0.2' blue='0.1'/></matte>"
      "<matte><name>floor</name><ka>0.5</ka><kd>0.7</kd><cd red='0.7' green='0.8' blue='0.6'/></matte></mattes>"
      "<phongs><phong><name>shiny</name><ka>0.4</ka><kd>0.5</kd><ks>0.5</ks><cd red='0.2' green='0.3' blue='1'/>"
      "<cs red='1' green='1' blue='0.9'/><exp>30</exp></phong></phongs></materials>"
      "<objects><planes><plane><point x='0' y='-1.2' z='0'/><normal x='0' y='1' "
      "z='0.02'/><material>floor</material></plane></planes>"
      "<spheres>" +
          spheres +
          "</spheres>"
          "<triangles><triangle><vertexposition1 x='-4' y='-1' z='-3'/><vertexposition2 x='4' y='-1' z='-4'/>"
          "<vertexposition3 x='0' y='5' z='-3.5'/><material>shiny</material></triangle></triangles>"
          "<cylinders><cylinder><bottom x='-3' y='-1' z='1'/><top x='-2.5' y='1' "
          "z='0'/><radius>0.6</radius><material>red</material></cylinder></cylinders>"
          "<toruses><torus><center x='2' y='0' z='2'/><axis x='0.3' y='1' "
          "z='0.4'/><sweptradius>1</sweptradius><tuberadius>0.3</tuberadius>"
          "<material>shiny</material></torus></toruses></objects>");
}

bool identical(const Pixel& a, const Pixel& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool identical(const FloatPicture& a, const FloatPicture& b) {
  return a.region() == b.region() && std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin(),
                                                [](const Pixel& p, const Pixel& q) { return identical(p, q); });
}

void check_same_bits(const SceneDescription& description, bool transparent) {
  const auto all_samples = static_cast<std::uint32_t>(description.viewplane.samples);
  const Region all = whole(description);
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    const auto scene = build_scene(description, {1, isa});
    RayCounts rays;
    const auto rendered_part = [&](int threads, const Region& region) {
      RenderSettings settings{threads, 0, region};
      settings.transparent = transparent;
      return render(*scene, description, settings, rays);
    };
    const FloatPicture picture = rendered_part(1, all);
    CHECK(identical(rendered_part(3, all), picture));
    RenderSettings settings{1, 0, all};
    settings.transparent = transparent;
    Film film(film_settings(*scene, description, settings), FilmContent::sums);
    for (const std::uint32_t samples : {1U, 3U, all_samples / 2 - 1, all_samples}) render(*scene, film, samples, 1);
    CHECK(identical(film, picture));
    const Region part{all.x1 / 3, all.y1 / 4, all.x1 * 4 / 5, all.y1 * 5 / 6};
    const FloatPicture cut = rendered_part(1, part);
    int wrong = 0;
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) wrong += !identical(cut.at(x, y), picture.at(x, y));
    CHECK(wrong == 0);
  }
}

void check_same_bits_of_balls(const std::string& materials, const std::vector<std::string>& names,
                              const std::string& checks, const std::string& more_objects) {
  std::string balls;
  for (std::size_t i = 0; i < 18; ++i)
    balls += "<sphere>" +
             vector_text("center", static_cast<double>(i % 6) * 1.1 - 2.7, static_cast<double>(i / 6) * 1.1 - 1,
                         static_cast<double>(i % 4) * 0.5) +
             "<radius>0.55</radius><material>" + names[i % names.size()] + "</material></sphere>";
  check_same_bits(parsed_scene(scene_text(
      53, 41, 8,
      "<lights><pointlights><pointlight><location x='5' y='7' z='9'/></pointlight></pointlights></lights><textures>"
      "<checkers><checker><name>checks</name>" +
          checks + "<scale>0.4</scale></checker></checkers></textures><materials>" + materials +
          "</materials><objects><spheres>" + balls + "</spheres>" + more_objects + "</objects>",
      "<eye x='0' y='2' z='9'/><lookat x='0' y='0' z='0'/>")));
}

std::string row_of_pixels(int pixels, const std::string& objects, const std::string& groups) {
  return "<raytracer><viewplane><hres>" + std::to_string(pixels) +
         "</hres><vres>1</vres><samples>1</samples></viewplane><orthographiccamera><eye x='" +
         std::to_string(pixels / 2.0) + "' y='0.5' z='9'/><lookat x='" + std::to_string(pixels / 2.0) +
         "' y='0.5' z='0'/></orthographiccamera><lights/><materials><mattes><matte><name>m</name>"
         "<ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes></materials>" +
         groups + "<objects>" + objects + "</objects></raytracer>";
}

ImageBand picture_aovs(const SceneDescription& description, const std::vector<std::string>& aovs,
                       const std::string& isa) {
  RenderSettings settings{1, 0, whole(description)};
  settings.aovs = aov_set(aovs);
  RayCounts rays;
  ImageBand band{settings.region, {}};
  fill_aovs(band, 0, render(*build_scene(description, {1, isa}), description, settings, rays));
  return band;
}

std::vector<std::uint32_t> object_ids(const SceneDescription& description, const std::string& isa) {
  return std::get<std::vector<std::uint32_t>>(picture_aovs(description, {"object_id"}, isa).planes.at(0));
}

double mean_green(const FloatPicture& picture) {
  double sum = 0;
  for (const Pixel& pixel : picture.pixels()) sum += double{pixel.green};
  return sum / static_cast<double>(picture.pixels().size());
}

double difference(const Pixel& a, const Pixel& b) {
  const auto of = [](float p, float q) { return std::abs(static_cast<double>(p) - static_cast<double>(q)); };
  return std::max({of(a.red, b.red), of(a.green, b.green), of(a.blue, b.blue), of(a.alpha, b.alpha)});
}

}  // namespace raytrace::test
