// Passes: the light by what scattered it first. They add up to the picture and do not change it, and each holds what
// its name says.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/film/light_pass.h"
#include "raytrace/film/splat_layer.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::vector<std::string> pass_names(std::begin(light_pass_names), std::end(light_pass_names));

Film film_of(const SceneDescription& description, const std::vector<std::string>& aovs, const std::string& isa = {},
             bool transparent = false) {
  const auto scene = build_scene(description, {1, isa});
  RenderSettings settings{1, 0, whole(description)};
  settings.aovs = aov_set(aovs);
  settings.transparent = transparent;
  RayCounts rays;
  return render(*scene, description, settings, rays);
}

Film film_of(const std::string& text) { return film_of(parsed_scene(text), pass_names); }

/// The mean of each pass over all pixels and channels.
std::array<double, light_pass_count> means_of(const Film& film) {
  std::array<double, light_pass_count> means{};
  for (std::size_t i = 0; i < means.size(); ++i)
    for_each_pixel(film.region(), [&](std::size_t, int x, int y) {
      const Pixel mean = film.light_pixel(film.lights()[i], x, y);
      means[i] +=
          (double{mean.red} + double{mean.green} + double{mean.blue}) / 3 / static_cast<double>(film.region().pixels());
    });
  return means;
}

/// The names of the passes that are not black.
std::vector<std::string> lit_passes(const std::string& text) {
  const std::array<double, light_pass_count> means = means_of(film_of(text));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < means.size(); ++i)
    if (means[i] != 0) names.push_back(pass_names[i]);
  return names;
}

using Names = std::vector<std::string>;

/// All that scatters light, in the light of all kinds of lights.
std::string room(const std::string& path, const std::string& more_objects = "", const std::string& viewplane = "") {
  const auto ball = [](const char* material, double x, double z) {
    return "<sphere><center x='" + std::to_string(x) + "' y='0.5' z='" + std::to_string(z) +
           "'/><radius>0.5</radius><material>" + material + "</material></sphere>";
  };
  return "<raytracer><integrator>" + path +
         "</integrator><viewplane><hres>24</hres><vres>16</vres><samples>8</samples>" + viewplane +
         "</viewplane><camera><eye x='0' y='3' z='6'/><lookat x='0' y='0.5' z='0'/><fov>40</fov></camera><lights>"
         "<ambientlight><scaleradiance>0.1</scaleradiance></ambientlight><pointlights><pointlight><location x='3' "
         "y='5' "
         "z='3'/><scaleradiance>2</scaleradiance><group>key</group></pointlight></pointlights><environmentlights>"
         "<environmentlight><scaleradiance>0.3</scaleradiance></environmentlight></environmentlights></lights>"
         "<materials><mattes><matte><name>floor</name><ka>0.5</ka><kd>0.7</kd><cd red='0.9' green='0.8' blue='0.7'/>"
         "</matte></mattes><phongs><phong><name>plastic</name><ka>0.3</ka><kd>0.5</kd><ks>0.3</ks><exp>20</exp><cd "
         "red='0.2' green='0.4' blue='0.8'/><cs red='1' green='1' blue='1'/></phong></phongs><mirrors><mirror><name>"
         "mirror</name><cr red='0.9' green='0.9' blue='0.9'/></mirror></mirrors><conductors><conductor><name>gold"
         "</name><metal>gold</metal><roughness>0.4</roughness></conductor></conductors><dielectrics><dielectric><name>"
         "glass</name></dielectric><dielectric><name>frosted</name><roughness>0.5</roughness></dielectric><dielectric>"
         "<name>pane</name><thinwalled>true</thinwalled></dielectric></dielectrics><emissives><emissive><name>lamp"
         "</name><ce red='1' green='0.5' blue='0.2'/><scaleradiance>5</scaleradiance></emissive></emissives><openpbrs>"
         "<openpbr><name>lacquer</name><coat_weight>1</coat_weight><specular_roughness>0.2</specular_roughness>"
         "</openpbr><openpbr><name>wax</name><subsurface_weight>0.8</subsurface_weight></openpbr></openpbrs><fogs><fog>"
         "<name>smoke</name><meanfreepath>0.6</meanfreepath></fog><fog><name>flame</name><meanfreepath>0.3</"
         "meanfreepath>"
         "<ce red='1' green='0.4' blue='0.1'/><density "
         "texture='puffs'/></fog></fogs></materials><textures><noises><noise>"
         "<name>puffs</name><color1 red='-1' green='0' blue='0'/><color2 red='3' green='0' blue='0'/><scale>0.4</scale>"
         "</noise></noises></textures><objects><rectangles><rectangle>"
         "<corner x='-5' y='0' z='5'/><edge1 x='10' y='0' z='0'/><edge2 x='0' y='0' z='-10'/><material>floor</material>"
         "</rectangle><rectangle><corner x='-1' y='0' z='-4'/><edge1 x='2' y='0' z='0'/><edge2 x='0' y='2.4' z='0'/>"
         "<material>pane</material></rectangle></rectangles><spheres>" +
         ball("floor", -2.5, 0) + ball("plastic", -1.5, 0) + ball("mirror", -0.5, 0) + ball("gold", 0.5, 0) +
         ball("glass", 1.5, 0) + ball("frosted", 2.5, 0) + ball("pane", -2, 1.2) + ball("lacquer", -1, 1.2) +
         ball("wax", 0, 1.2) + ball("lamp", 1, 1.2) + more_objects + "</spheres></objects></raytracer>";
}

const std::string smoke_ball =
    "<sphere><center x='2' y='0.5' z='1.2'/><radius>0.5</radius><material>smoke</material></sphere>";
const std::string flame_ball =
    "<sphere><center x='2' y='0.5' z='1.2'/><radius>0.5</radius><material>flame</material></sphere>";

/// Fails where the passes do not add up to the picture, or where the picture is not that without passes.
void check_sums(const SceneDescription& description, const std::string& isa, bool transparent) {
  const Film with = film_of(description, pass_names, isa, transparent),
             without = film_of(description, {"depth"}, isa, transparent);
  REQUIRE(with.lights().size() == light_pass_count);
  int changed = 0, negative = 0;
  double apart = 0;
  for_each_pixel(with.region(), [&](std::size_t, int x, int y) {
    changed += with.sum(x, y) != without.sum(x, y);
    if (with.splats() != nullptr) changed += with.splats()->sum(x, y) != without.splats()->sum(x, y);
    std::array<double, 3> sum{};
    for (const LightLayer& layer : with.lights()) {
      const Pixel mean = with.light_pixel(layer, x, y);
      negative += mean.red < 0 || mean.green < 0 || mean.blue < 0;
      sum = {sum[0] + double{mean.red}, sum[1] + double{mean.green}, sum[2] + double{mean.blue}};
    }
    const Pixel all = with.pixel(x, y);
    for (const auto& [part, of] : {std::pair(sum[0], all.red), {sum[1], all.green}, {sum[2], all.blue}})
      apart = std::max(apart, std::abs(part - double{of}) / (std::abs(double{of}) + 1e-3));
  });
  CHECK(changed == 0);
  CHECK(negative == 0);
  CHECK(apart < 1e-5);
}

}  // namespace

TEST_CASE("passes add up to the picture, which is the same without them, with each instruction set") {
  const std::string path = "<path><caustics>";
  for (const std::string& isa : usable_isas())
    for (const bool transparent : {false, true})
      for (const std::string& integrator :
           {std::string("<path/>"), path + "light</caustics></path>", path + "photons</caustics></path>",
            std::string("<path><clampindirect>0.3</clampindirect></path>"),
            std::string("<path><indirectsamples>3</indirectsamples></path>"), std::string("<raycast/>"),
            std::string("<normals/>")}) {
        INFO(isa << integrator << transparent);
        check_sums(parsed_scene(room(integrator)), isa, transparent);
        check_sums(parsed_scene(room(integrator, smoke_ball)), isa, transparent);
        check_sums(parsed_scene(room(integrator, flame_ball)), isa, transparent);
      }
}

TEST_CASE("direct passes are those of a picture without more bounces, which has no others") {
  const Film one = film_of(room("<path><maxdepth>1</maxdepth></path>", smoke_ball)),
             many = film_of(room("<path/>", smoke_ball));
  const std::array<double, light_pass_count> means = means_of(many);
  for (std::size_t i = 0; i < pass_names.size(); ++i) {
    INFO(pass_names[i]);
    if (pass_names[i].ends_with("_indirect")) {
      CHECK(means_of(one)[i] == 0);
      CHECK(means[i] > 0);
      continue;
    }
    double apart = 0;
    for_each_pixel(one.region(), [&](std::size_t, int x, int y) {
      const Pixel a = one.light_pixel(one.lights()[i], x, y), b = many.light_pixel(many.lights()[i], x, y);
      // Light that comes out from below a surface is direct, though two scatterings bring it.
      if (pass_names[i] != "diffuse_direct") apart = std::max(apart, difference(a, b));
    });
    CHECK(apart == 0);
    CHECK(means[i] > 0);
  }
}

TEST_CASE("each material's light is in the passes of its own") {
  const auto picture = [](const std::string& material, const std::string& path = "<maxdepth>1</maxdepth>") {
    std::string text = room("<path>" + path + "</path>");
    const std::size_t begin = text.find("<objects>");
    return text.substr(0, begin) +
           "<objects><spheres><sphere><center x='0' y='0.5' z='0'/><radius>1.2</radius><material>" + material +
           "</material></sphere></spheres></objects></raytracer>";
  };
  CHECK(lit_passes(picture("floor")) == Names{"diffuse_direct", "background"});
  CHECK(lit_passes(picture("plastic")) == Names{"diffuse_direct", "specular_direct", "background"});
  CHECK(lit_passes(picture("lacquer")) == Names{"diffuse_direct", "specular_direct", "background"});
  CHECK(lit_passes(picture("mirror")) == Names{"specular_direct", "background"});
  CHECK(lit_passes(picture("gold")) == Names{"specular_direct", "background"});
  CHECK(lit_passes(picture("pane")) == Names{"specular_direct", "background"});  // the sphere's back is a second one
  CHECK(lit_passes(picture("lamp")) == Names{"emission", "background"});
  CHECK(lit_passes(picture("smoke")) == Names{"volume_direct", "background"});
  CHECK(lit_passes(picture("flame")) == Names{"volume_direct", "emission", "background"});
  // Out again is a second scattering: of glass an indirect one, below a surface the same.
  CHECK(lit_passes(picture("glass", "<maxdepth>2</maxdepth>")) ==
        Names{"specular_direct", "transmission_indirect", "background"});
  CHECK(lit_passes(picture("wax", "<maxdepth>2</maxdepth>")) ==
        Names{"diffuse_direct", "specular_direct", "background"});
}

TEST_CASE("a Phong surface's diffuse pass is that of its diffuse lobe alone") {
  const std::string both = room("<raycast/>"), alone = [&] {
    std::string text = both;
    text.replace(text.find("<ks>0.3"), 7, "<ks>0.0");
    return text;
  }();
  for (const char* const integrator : {"<raycast/>", "<path><maxdepth>1</maxdepth></path>"}) {
    const auto with = [&](std::string text) {
      text.replace(text.find("<raycast/>"), 10, integrator);
      // What shines is drawn by chance, which the lobes share.
      text.replace(text.find("<environmentlights>"), text.find("</lights>") - text.find("<environmentlights>"), "");
      text.replace(text.find("<ce red='1' green='0.5' blue='0.2'/>"), 36, "<ce red='0' green='0' blue='0'/>");
      return film_of(text);
    };
    const Film a = with(both), b = with(alone);
    double apart = 0, gloss = 0;
    for_each_pixel(a.region(), [&](std::size_t, int x, int y) {
      apart = std::max(apart, difference(a.light_pixel(a.lights()[0], x, y), b.light_pixel(b.lights()[0], x, y)));
      gloss = std::max(gloss, double{a.light_pixel(a.lights()[2], x, y).red});
    });
    INFO(integrator);
    CHECK(apart < 1e-6);
    CHECK(gloss > 0.01);
  }
}

namespace {

/// The mean of a pass of a ball of OpenPBR in the light of a lamp, and of its image in a mirror.
double mean_gloss(LightPass pass, const std::string& base, const std::string& more, const std::string& path) {
  const std::string text =
      "<raytracer><integrator><path>" + path +
      "</path></integrator><viewplane><hres>32</hres><vres>32</vres><samples>2048</samples></viewplane><camera><eye "
      "x='0' y='0' z='6'/><lookat x='0' y='0' z='0'/><fov>22</fov></camera><materials><openpbrs><openpbr><name>m"
      "</name><base_color " +
      base + "/>" + more +
      "</openpbr></openpbrs><emissives><emissive><name>lamp</name><ce red='4' green='4' blue='4'/></emissive>"
      "</emissives><mirrors><mirror><name>mirror</name><cr red='1' green='1' blue='1'/></mirror></mirrors></materials>"
      "<objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material></sphere><sphere>"
      "<center x='3' y='2' z='4'/><radius>1.6</radius><material>lamp</material></sphere></spheres><disks><disk>"
      "<center x='-2' y='0' z='1'/><normal x='1' y='0.2' z='0.2'/><radius>2</radius><material>mirror</material></disk>"
      "</disks></objects></raytracer>";
  return means_of(film_of(text))[static_cast<std::size_t>(pass)];
}
const std::string black = "red='0' green='0' blue='0'", white = "red='1' green='1' blue='1'";

}  // namespace

TEST_CASE("the gloss of OpenPBR's layers is the same over any base, drawn from lights or by the surface") {
  for (const std::string more :
       {"<specular_roughness>0.5</specular_roughness>", "<specular_roughness>0.15</specular_roughness>",
        "<specular_roughness>0</specular_roughness>",
        "<specular_weight>0</specular_weight><coat_weight>1</coat_weight><coat_roughness>0.4</coat_roughness>"}) {
    INFO(more);
    const std::string path = "<maxdepth>1</maxdepth>";
    const double over_black = mean_gloss(LightPass::specular_direct, black, more, path),
                 over_white = mean_gloss(LightPass::specular_direct, white, more, path);
    CHECK(over_black > 0.001);
    // A smooth surface finds the lamp by chance alone.
    CHECK(std::abs(over_white / over_black - 1) < (more.find(">0</specular_roughness") < more.size() ? 0.06 : 0.03));
  }
}

TEST_CASE("gloss is in its pass whether paths from the camera bring what it reflects, or light paths") {
  for (const std::string roughness : {"0.15", "0.5"})
    for (const std::string caustics : {"none", "light"}) {
      INFO(roughness << caustics);
      const std::string more = "<specular_roughness>" + roughness + "</specular_roughness>",
                        path = "<maxdepth>2</maxdepth><caustics>" + caustics + "</caustics>";
      const double over_black = mean_gloss(LightPass::specular_indirect, black, more, path),
                   over_white = mean_gloss(LightPass::specular_indirect, white, more, path);
      CHECK(over_black > 0.001);
      CHECK(std::abs(over_white / over_black - 1) < 0.03);
    }
}

TEST_CASE("passes have the same bits whatever the number of threads and the region") {
  const SceneDescription description = parsed_scene(room("<path><caustics>photons</caustics></path>", smoke_ball));
  const Film all = film_of(description, pass_names);
  const auto scene = build_scene(description, {2, {}});
  RenderSettings settings{2, 0, {3, 2, 19, 13}};
  settings.aovs = aov_set(pass_names);
  RayCounts rays;
  const Film part = render(*scene, description, settings, rays);
  int apart = 0;
  for_each_pixel(part.region(), [&](std::size_t, int x, int y) {
    for (std::size_t i = 0; i < light_pass_count; ++i)
      apart += part.lights()[i].samples->sum(x, y) != all.lights()[i].samples->sum(x, y);
  });
  CHECK(apart == 0);
}

}  // namespace raytrace::test
