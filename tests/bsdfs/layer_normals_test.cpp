// OpenPBR's coats and bases with normals of their own, through what the tracer calls: that samples follow their
// density, that no light is made, and where it goes.
#include "raytrace/bsdfs/layer_normals.h"

#include "bsdfs/white_materials.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// In all lanes the same normals, in the surface's local frame.
struct LayeredBsdf {
  PbrBsdf bsdf;
  Vec3d base, coat;
  MaskN lanes{true};
  Vec3d diffuse = base;

  LayerFrames<FloatN> frames(const Vec3<FloatN>& wo) const {
    return {{lanes, spread(diffuse), spread(base), spread(coat)}, wo};
  }
  BsdfSample<FloatN> sample(const Vec3<FloatN>& wo, const FloatN& u, const FloatN& u1, const FloatN& u2) const {
    const LayerFrames<FloatN> of_wo = frames(wo);
    return bsdf.sample(bsdf.lobes(wo, &of_wo), u, u1, u2);
  }
  PbrBsdf::Value value(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi) const {
    const LayerFrames<FloatN> of_wo = frames(wo);
    return bsdf.value(bsdf.lobes(wo, &of_wo), wi);
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi) const { return value(wo, wi).pdf; }
};

Vec3d tilted(double degrees, double azimuth) { return at_angle({0, 0, 1}, degrees, azimuth); }

/// Normals of a base and of a coat.
const std::vector<std::pair<Vec3d, Vec3d>> layer_normals{{tilted(30, 2.2), tilted(0, 0)},
                                                         {tilted(55, 5), tilted(0, 0)},
                                                         {tilted(0, 0), tilted(20, 1)},
                                                         {tilted(25, 0.4), tilted(35, 3.4)}};

const Vec3d up{0, 0, 1};

OpenPbr::Parameters coat_alone(double roughness) {
  OpenPbr::Parameters parameters = white(0.3);
  parameters.base_weight = parameters.specular_weight = 0;
  parameters.coat_weight = 1;
  parameters.coat_roughness = roughness;
  return parameters;
}

}  // namespace

TEST_CASE("layers with normals of their own: what is reflected follows its pdf") {
  for (const double roughness : {0.45, 0.8})
    for (const auto& [name, parameters] : white_materials(roughness))
      for (const auto& [base, coat] : layer_normals) {
        const Above<LayeredBsdf> above{{{bsdf_of(parameters), base, coat, MaskN(true), at_angle(base, 15, 4)}}};
        const Outcome outcome = judge(above, at_angle(up, 50, 2), up, Cells(up, 1), true);
        INFO(name << ", roughness " << roughness << ", base " << base.x << " " << base.y << ", coat " << coat.x << " "
                  << coat.y);
        CHECK(outcome.deviation < 4.5);
        CHECK(outcome.worst_length < 1e-5);
        CHECK(outcome.integral < 1.01);
      }
}

TEST_CASE("layers with normals of their own send on no more light than they get, and little less") {
  for (const double roughness : {0.0, 0.2, 0.7})
    for (const auto& [name, parameters] : white_materials(roughness))
      for (const double angle : {30.0, 60.0, 80.0}) {
        INFO(name << ", roughness " << roughness << ", wo at " << angle);
        const Vec3d wo = at_angle(up, angle, 2);
        for (const auto& [base, coat] : layer_normals)
          for (const Vec3d& diffuse : {base, at_angle(base, 15, 4)})
            CHECK(sent_on(LayeredBsdf{bsdf_of(parameters), base, coat, MaskN(true), diffuse}, wo) < 1.02);
        if (angle > 50) continue;
        CHECK(sent_on(LayeredBsdf{bsdf_of(parameters), tilted(8, 1), tilted(8, 4)}, wo) > 0.93);
      }
}

TEST_CASE("layers with normals of their own: f and pdf of a sample are those of value()") {
  Random random(8);
  double worst = 0;
  int compared = 0;
  for (const auto& material : white_materials(0.4))
    for (const auto& [base, coat] : layer_normals) {
      const LayeredBsdf bsdf{bsdf_of(material.second), base, coat, MaskN(true), at_angle(base, 15, 4)};
      for (int i = 0; i < 100; ++i) {
        const Vec3<FloatN> wo = spread(at_angle(up, 80 * random.unit(), 6 * random.unit()));
        const auto number = [&] { return FloatN(static_cast<float>(random.unit())); };
        const FloatN u = number(), u1 = number(), u2 = number();
        const auto sample = bsdf.sample(wo, u, u1, u2);
        if (!(sample.wi.z.get(0) > 0) || any(sample.specular) || !(sample.pdf.get(0) > 0)) continue;
        ++compared;
        const auto [f, pdf] = bsdf.value(wo, sample.wi);
        worst = std::max({worst, std::abs(double{f.green.get(0)} / double{sample.f.green.get(0)} - 1),
                          std::abs(double{pdf.get(0)} / double{sample.pdf.get(0)} - 1)});
      }
    }
  CHECK(compared > 2000);
  CHECK(worst < 1e-5);
}

TEST_CASE("a smooth coat reflects about its own normal, a smooth base about its own, each what it does alone") {
  OpenPbr::Parameters parameters = white(0);
  parameters.base_metalness = parameters.coat_weight = 1;
  parameters.coat_darkening = 0;
  const Vec3d wo = at_angle(up, 20, 1), base = tilted(12, 4), coat = tilted(9, 2);
  const LayeredBsdf bsdf{bsdf_of(parameters), base, coat};
  const double cosine = dot(coat, wo);
  OpenPbr::Parameters alone = coat_alone(0);
  // What it sends on in all, of one direction: f |wi.z|.
  const auto sent = [&](const auto& sample) { return double{sample.f.green.get(0)} * double{sample.wi.z.get(0)}; };
  const auto of_coat = bsdf.sample(spread(wo), FloatN(0), FloatN(0.5F), FloatN(0.5F)),
             of_base = bsdf.sample(spread(wo), FloatN(0.99F), FloatN(0.5F), FloatN(0.5F)),
             of_coat_alone = bsdf_of(alone).sample(spread(at_angle(up, std::acos(cosine) * 180 / std::numbers::pi, 0)),
                                                   FloatN(0), FloatN(0.5F), FloatN(0.5F));
  CHECK(length(lane_of(of_coat.wi, 0) - mirror_of(wo, coat)) < 1e-5);
  CHECK(length(lane_of(of_base.wi, 0) - mirror_of(wo, base)) < 1e-5);
  // A layer that leans away from the light gets all of it, as much as about its own normal.
  const double reflected = sent(of_coat_alone);
  CHECK(sent(of_coat) < reflected * 1.0001);
  CHECK(sent(of_coat) > reflected * 0.9);
  CHECK(sent(of_base) < 1 - reflected + 1e-4);
  CHECK(sent(of_base) > (1 - reflected) * 0.9);
}

TEST_CASE("light comes through a base about its own normal, all of it") {
  OpenPbr::Parameters parameters = white(0);
  parameters.transmission_weight = 1;
  const Vec3d wo = at_angle(up, 20, 1), base = tilted(15, 4);
  const LayeredBsdf bsdf{bsdf_of(parameters), base, up};
  const BsdfSample<FloatN> sample = bsdf.sample(spread(wo), FloatN(0.99F), FloatN(0.5F), FloatN(0.5F));
  const Vec3d wi = lane_of(sample.wi, 0);
  CHECK(wi.z < 0);
  CHECK(length(cross(base, wi) * 1.5 + cross(base, wo)) < 1e-5);  // Snell
  CHECK(weight_of(sample, 0) == Approx(1).epsilon(1e-4));
}

TEST_CASE("a rough coat is brightest where its own normal lies between wo and wi, whatever the base's") {
  const Vec3d wo = at_angle(up, 30, 1);
  for (const auto& [base, coat] :
       {std::pair{tilted(30, 2.2), up}, std::pair{tilted(55, 5), up}, std::pair{up, tilted(15, 2)}}) {
    const LayeredBsdf bsdf{bsdf_of(coat_alone(0.25)), base, coat};
    const auto f = [&](const Vec3d& wi) { return double{bsdf.value(spread(wo), spread(wi)).f.green.get(0)}; };
    const Vec3d mirrored = mirror_of(wo, coat);
    INFO("coat " << coat.x << " " << coat.y);
    for (const double azimuth : {0.0, 1.6, 3.1, 4.7}) CHECK(f(mirrored) > 2 * f(at_angle(mirrored, 20, azimuth)));
    // About its own normal the same as any other coat, but for its share of the surface's light.
    const double cosine = dot(wo, coat);
    const Vec3<FloatN> own_wo = spread(at_angle(up, std::acos(cosine) * 180 / std::numbers::pi, 0)),
                       own_wi = spread(mirror_of(lane_of(own_wo, 0), up));
    const double alone = bsdf.bsdf.value(bsdf.bsdf.lobes(own_wo), own_wi).f.green.get(0);
    const double light = f(mirrored) * mirrored.z / (alone * cosine);
    CHECK(light < 1.001);
    CHECK(light > 0.75);
  }
}

TEST_CASE("a base gets what a coat's Fresnel reflection about its own normal leaves of light towards wo") {
  OpenPbr::Parameters parameters;
  parameters.base_color = {0.5, 0.5, 0.5};
  parameters.specular_weight = 0;
  parameters.coat_weight = 1;
  parameters.coat_darkening = 0;
  const Vec3d wo = at_angle(up, 40, 0.5), wi = at_angle(up, 25, 3);
  for (const double degrees : {0.0, 35.0}) {
    const Vec3d coat = tilted(degrees, 0.5 + std::numbers::pi);  // away from wo
    const LayeredBsdf bsdf{bsdf_of(parameters), up, coat};
    const double reflected =
        fresnel_reflection(FloatN(static_cast<float>(dot(wo, coat))), FloatN(1.6F)).reflectance.get(0);
    CHECK(double{bsdf.value(spread(wo), spread(wi)).f.green.get(0)} ==
          Approx((1 - reflected) * 0.5 / std::numbers::pi).epsilon(2e-3));
  }
}

TEST_CASE("lanes without normals of their own have the same bits beside those that have them") {
  const std::vector<float> every_other = [] {
    std::vector<float> result;
    for (std::size_t lane = 0; lane < lanes; ++lane) result.push_back(lane % 2 == 0 ? 1.0F : 0.0F);
    return result;
  }();
  const MaskN some = batch_of<FloatN>([&](std::size_t lane) { return double{every_other[lane]}; }) > FloatN(0.5F);
  Random random(5);
  int differ = 0, differ_not = 0;
  for (const auto& material : white_materials(0.4)) {
    const LayeredBsdf bsdf{bsdf_of(material.second), tilted(30, 1), tilted(20, 3), some};
    for (int i = 0; i < 50; ++i) {
      const Vec3<FloatN> wo = spread(at_angle(up, 85 * random.unit(), 6 * random.unit())),
                         wi = spread(at_angle(up, 85 * random.unit(), 6 * random.unit()));
      const auto number = [&] { return FloatN(static_cast<float>(random.unit())); };
      const FloatN u = number(), u1 = number(), u2 = number();
      const auto a = bsdf.sample(wo, u, u1, u2), b = bsdf.bsdf.sample(wo, u, u1, u2);
      const auto towards = bsdf.value(wo, wi), plain = bsdf.bsdf.value(bsdf.bsdf.lobes(wo), wi);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto same = [&](const FloatN& x, const FloatN& y) { return x.get(lane) == y.get(lane); };
        const bool all = same(a.wi.x, b.wi.x) && same(a.wi.y, b.wi.y) && same(a.wi.z, b.wi.z) && same(a.pdf, b.pdf) &&
                         same(a.f.green, b.f.green) && same(towards.f.green, plain.f.green) &&
                         same(towards.pdf, plain.pdf);
        if (every_other[lane] == 0)
          differ += all ? 0 : 1;
        else
          differ_not += all ? 1 : 0;
      }
    }
  }
  CHECK(differ == 0);
  CHECK(differ_not == 0);
}

}  // namespace raytrace::test
