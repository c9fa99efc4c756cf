// Paths by mirrors, metals and glass against closed forms, and their bits against themselves.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <initializer_list>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

const std::string looking_at_a_ball =
    "<camera><eye x='0' y='0.2' z='3'/><lookat x='0' y='0' z='0'/><fov>36</fov></camera>";
/// Straight down, on what is at the origin.
const std::string looking_straight_down =
    "<orthographiccamera><eye x='0' y='5' z='0'/><lookat x='0' y='0' z='0'/><up x='0' y='0' z='-1'/>"
    "</orthographiccamera>";

/// Under a white sky.
std::string under_the_sky(int size, int samples, const std::string& camera, const std::string& material,
                          const std::string& objects) {
  const std::string edge = std::to_string(size);
  return "<raytracer><integrator><path><maxdepth>200</maxdepth></path></integrator><viewplane><hres>" + edge +
         "</hres><vres>" + edge + "</vres><pixelsize>0.05</pixelsize><samples>" + std::to_string(samples) +
         "</samples><background red='1' green='1' blue='1'/></viewplane>" + camera + "<materials>" + material +
         "</materials><objects>" + objects + "</objects></raytracer>";
}

std::string ball_under_the_sky(int size, int samples, const std::string& material) {
  std::string text = under_the_sky(size, samples, looking_at_a_ball, material,
                                   "<spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius>"
                                   "<material>m</material></sphere></spheres>");
  const std::string pixelsize = "<pixelsize>0.05</pixelsize>";
  return text.erase(text.find(pixelsize), pixelsize.size());
}

std::string element(const std::string& name, double value) {
  return "<" + name + ">" + std::to_string(value) + "</" + name + ">";
}
std::string white(const std::string& name) { return "<" + name + " red='1' green='1' blue='1'/>"; }

std::string dielectric(const std::string& more) {
  return "<dielectrics><dielectric><name>m</name>" + more + "</dielectric></dielectrics>";
}
std::string conductor(const std::string& more) {
  return "<conductors><conductor><name>m</name>" + more + "</conductor></conductors>";
}

struct Spread {
  double least = 1e30, most = -1e30, mean = 0;
};

Spread spread_of(const FloatPicture& picture) {
  Spread result;
  for (const Pixel& pixel : picture.pixels()) {
    result.least = std::min(result.least, double{pixel.green});
    result.most = std::max(result.most, double{pixel.green});
    result.mean += double{pixel.green} / static_cast<double>(picture.pixels().size());
  }
  return result;
}

}  // namespace

TEST_CASE("what is smooth and loses nothing cannot be seen under a white sky") {
  const std::string mirror = "<mirrors><mirror><name>m</name>" + white("cr") + "</mirror></mirrors>";
  for (const std::string& material : {mirror, conductor(white("cr")), dielectric(""), dielectric(element("ior", 0.7)),
                                      dielectric("<thinwalled>true</thinwalled>")}) {
    const Spread all = spread_of(rendered(ball_under_the_sky(16, 64, material)));
    INFO(material << " " << all.least << " " << all.most);
    CHECK(all.least > 1 - 1e-4);
    CHECK(all.most < 1 + 1e-4);
  }
}

TEST_CASE("nor can glass of any closed shape: light comes in by its front, and out by its back") {
  const std::string ends = "<bottom x='-0.3' y='-0.8' z='0.1'/><top x='0.2' y='0.7' z='-0.2'/><radius>0.6</radius>",
                    last = "<caps>true</caps><material>m</material>";
  for (const std::string& shape : std::initializer_list<std::string>{
           "<boxes><box><min x='-0.6' y='-0.5' z='-0.7'/><max x='0.5' y='0.6' "
           "z='0.4'/><material>m</material></box></boxes>",
           "<cylinders><cylinder>" + ends + last + "</cylinder></cylinders>",
           "<cones><cone>" + ends + "<topradius>0.3</topradius>" + last + "</cone></cones>",
           "<toruses><torus><axis x='0.3' y='0.5' z='1'/><sweptradius>0.7</sweptradius><tuberadius>0.25</tuberadius>"
           "<material>m</material></torus></toruses>"}) {
    std::string text = ball_under_the_sky(16, 16, dielectric(""));
    const std::size_t from = text.find("<spheres>"), to = text.find("</objects>");
    const Spread all = spread_of(rendered(text.replace(from, to - from, shape)));
    INFO(shape << " " << all.least << " " << all.most);
    CHECK(all.least > 1 - 1e-3);
    CHECK(all.most < 1 + 1e-3);
  }
}

TEST_CASE("nor can what is rough, in the mean of many samples") {
  for (const double roughness : {0.1, 0.3, 0.6, 1.0})
    for (const std::string& material :
         {conductor(white("cr") + element("roughness", roughness)), dielectric(element("roughness", roughness)),
          dielectric(element("roughness", roughness) + "<thinwalled>true</thinwalled>")}) {
      // Where the ball is, which covers about seven tenths of the picture.
      const Spread all = spread_of(rendered(ball_under_the_sky(24, is_sanitized ? 25 : 400, material)));
      INFO(material << " " << all.mean);
      CHECK(std::abs(all.mean - 1) < (is_sanitized ? 0.02 : 0.005) * 0.7);
    }
}

TEST_CASE("through a slab: both faces, and the attenuation between them") {
  const double ior = 1.5, r = std::pow((ior - 1) / (ior + 1), 2);
  const std::string slab =
      "<boxes><box><min x='-9' y='-3' z='-9'/><max x='9' y='0' z='9'/><material>m</material></box></boxes>";
  const auto through = [&](const std::string& more) {
    const std::string black = "<cr red='0' green='0' blue='0'/>";
    return spread_of(
        rendered(under_the_sky(8, 4, looking_straight_down, dielectric(element("ior", ior) + black + more), slab)));
  };
  const Spread clear = through(""),
               colored =
                   through("<attenuationcolor red='1' green='0.25' blue='1'/>" + element("attenuationdistance", 2)),
               thin = through("<thinwalled>true</thinwalled>");
  CHECK(clear.least == Approx((1 - r) * (1 - r)).epsilon(1e-5));
  CHECK(clear.most == Approx((1 - r) * (1 - r)).epsilon(1e-5));
  CHECK(colored.mean == Approx((1 - r) * (1 - r) * std::pow(0.25, 3.0 / 2)).epsilon(1e-4));
  // Its six faces are panes of their own.
  CHECK(thin.mean == Approx(std::pow(1 - 2 * r / (1 + r), 2)).epsilon(1e-5));
}

TEST_CASE("a pane without color reflects what Fresnel's equations say of both its faces") {
  const double r = 0.04;
  const std::string pane =
      "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>m</material></plane></planes>";
  const std::string black = "<ct red='0' green='0' blue='0'/>";
  const Spread reflected = spread_of(
      rendered(under_the_sky(8, 4, looking_straight_down, dielectric(black + "<thinwalled>true</thinwalled>"), pane)));
  CHECK(reflected.least == Approx(2 * r / (1 + r)).epsilon(1e-5));
  CHECK(reflected.most == Approx(2 * r / (1 + r)).epsilon(1e-5));
}

TEST_CASE("two mirrors show what a camera sees from where they move it to") {
  const auto scene = [](const std::string& eye, const std::string& mirrors) {
    const std::string balls =
        "<spheres><sphere><center x='0.5' y='6.2' z='-12'/><radius>1</radius><material>red</material></sphere>"
        "<sphere><center x='-1' y='5.5' z='-15'/><radius>1.4</radius><material>blue</material></sphere></spheres>";
    return "<raytracer><viewplane><hres>40</hres><vres>30</vres><samples>4</samples><background red='0.1' green='0.2' "
           "blue='0.4'/></viewplane><camera>" +
           eye +
           "<fov>18</fov></camera><materials><mirrors><mirror><name>m</name><cr red='1' green='1' blue='1'/></mirror>"
           "</mirrors><emissives><emissive><name>red</name><ce red='1' green='0' blue='0'/></emissive><emissive>"
           "<name>blue</name><ce red='0' green='0.5' blue='1'/></emissive></emissives></materials><objects>" +
           balls + mirrors + "</objects></raytracer>";
  };
  const std::string periscope =
      "<rectangles><rectangle><corner x='-3' y='-2' z='-2'/><edge1 x='6' y='0' z='0'/><edge2 x='0' y='4' z='-4'/>"
      "<material>m</material></rectangle><rectangle><corner x='-4' y='3' z='-1'/><edge1 x='8' y='0' z='0'/>"
      "<edge2 x='0' y='6' z='-6'/><material>m</material></rectangle></rectangles>";
  // By twice the distance between the mirrors, across them.
  const FloatPicture seen = rendered(scene("<eye x='0' y='0' z='0'/><lookat x='0' y='0' z='-1'/>", periscope)),
                     wanted = rendered(scene("<eye x='0' y='6' z='6'/><lookat x='0' y='6' z='5'/>", ""));
  int differing = 0, lit = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      differing += difference(seen.at(x, y), wanted.at(x, y)) > 1e-5;
      lit += wanted.at(x, y).red > 0.5F;
    }
  CHECK(lit > 30);
  CHECK(differing <= 2);  // samples at an edge
}

TEST_CASE("paths by mirrors, metals and glass do not depend on threads, samples at once, or cuts") {
  check_same_bits_of_balls(
      "<mattes><matte><name>floor</name><ka>0</ka><kd>0.7</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
      "<mirrors><mirror><name>m</name><cr texture='checks'/></mirror></mirrors><conductors><conductor><name>gold</name>"
      "<metal>gold</metal><bump texture='checks' height='0.02'/></conductor>"
      "<conductor><name>brushed</name><metal>silver</metal><roughness texture='checks'/></conductor></conductors>"
      "<dielectrics><dielectric><name>glass</name><attenuationcolor red='0.2' green='0.8' blue='0.5'/>"
      "<attenuationdistance>1</attenuationdistance></dielectric><dielectric><name>frost</name>"
      "<roughness texture='checks'/><ct texture='checks'/></dielectric><dielectric><name>pane</name>"
      "<thinwalled>true</thinwalled><roughness>0.2</roughness></dielectric></dielectrics>",
      {"m", "gold", "brushed", "glass", "frost", "pane"},
      "<color1 red='1' green='1' blue='1'/><color2 red='0.3' green='0.6' blue='0.2'/>",
      "<planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' "
      "z='0'/><material>floor</material></plane></planes>");
}

TEST_CASE("a narrow highlight does not coarsen the film's unit") {
  const auto usual = [](const std::string& roughness) {
    return build_scene(parsed_scene(scene_text(
                           8, 8, 1,
                           "<lights><pointlights><pointlight><location x='0' y='0' z='9'/></pointlight></pointlights>"
                           "</lights><materials>" +
                               conductor(white("cr") + roughness) +
                               "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius>"
                               "<material>m</material></sphere></spheres></objects>")),
                       {1, {}})
        ->radiance_range();
  };
  const RadianceRange smooth = usual(""), narrow = usual("<roughness>0.05</roughness>");
  CHECK(smooth.usual <= 4);
  CHECK(narrow.usual <= 4);
  CHECK(narrow.largest > 1000);
}

}  // namespace raytrace::test
