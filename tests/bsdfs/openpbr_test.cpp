// OpenPBR's lobes over each other: that samples follow their density, and that nothing is lost.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bsdfs/white_materials.h"
#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("OpenPBR: what is reflected follows its pdf") {
  const Vec3d normal{0, 0, 1};
  for (const double roughness : {0.0, 0.5, 0.9})
    for (const auto& [name, parameters] : white_materials(roughness))
      for (const double angle : {0.0, 45.0, 75.0})
        for (const bool front : {true, false}) {
          const Above<PbrBsdf> above{{bsdf_of(parameters, front)}};
          const Outcome outcome = judge(above, at_angle(normal, angle, 2), normal, Cells(normal, 1), true);
          INFO(name << (front ? "" : " from its back") << ", roughness " << roughness << ", wo at " << angle);
          if (outcome.integral > 0) CHECK(outcome.deviation < 4.5);  // else all is smooth
          CHECK(outcome.worst_length < 1e-5);
        }
}

TEST_CASE("OpenPBR: rough glass chooses between its sides by the facet, so that no sample weighs much") {
  Random random(71);
  for (const double roughness : {0.1, 0.3, 0.6, 1.0})
    for (const bool front : {true, false})
      for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
        OpenPbr::Parameters parameters = white(roughness);
        parameters.transmission_weight = 1;
        const PbrBsdf bsdf = bsdf_of(parameters, front);
        double largest = 0;
        for (int i = 0; i < 4000; i += packet_lanes) {
          const auto numbers = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
          const FloatN u = numbers(), u1 = numbers(), u2 = numbers();
          const BsdfSample<FloatN> sample = bsdf.sample(spread(at_angle({0, 0, 1}, angle, 1)), u, u1, u2);
          for (std::size_t lane = 0; lane < lanes; ++lane)
            if (sample.pdf.get(lane) > 0) largest = std::max(largest, weight_of(sample, lane));
        }
        INFO("roughness " << roughness << (front ? "" : ", from its back") << ", wo at " << angle);
        CHECK(largest < (roughness < 1 ? 1.6 : 2.6));
      }
}

TEST_CASE("OpenPBR: what absorbs nothing sends all light on, from both sides") {
  for (const double roughness : {0.0, 0.035, 0.06, 0.1, 0.3, 0.6, 1.0})
    for (const auto& [name, parameters] : white_materials(roughness))
      for (const bool front : {true, false}) {
        double mean = 0;
        for (const double angle : {0.0, 30.0, 60.0, 80.0, 87.0}) {
          const double share = sent_on(bsdf_of(parameters, front), at_angle({0, 0, 1}, angle, 1));
          INFO(name << (front ? "" : " from its back") << ", roughness " << roughness << ", wo at " << angle);
          CHECK(share == Approx(1).epsilon(0.02));
          mean += share / 5;
        }
        INFO(name << (front ? "" : " from its back") << ", roughness " << roughness);
        CHECK(mean == Approx(1).epsilon(0.005));
      }
}

TEST_CASE("OpenPBR: what absorbs nothing sends all light on, of whatever index it is") {
  for (const double ior : {0.1, 0.2, 3.0, 5.0, 10.0})
    for (const bool coated : {false, true})
      for (const double transmission : {0.0, 1.0})
        for (const bool front : {true, false}) {
          OpenPbr::Parameters parameters = white(0.6);
          parameters.transmission_weight = transmission;
          (coated ? parameters.coat_ior : parameters.specular_ior) = ior;
          parameters.coat_weight = coated ? 1 : 0;
          parameters.coat_roughness = 0.6;
          for (const double angle : {0.0, 40.0, 75.0}) {
            INFO((coated ? "coat" : "base") << " of " << ior << (front ? "" : " from its back") << ", transmission "
                                            << transmission << ", wo at " << angle);
            CHECK(sent_on(bsdf_of(parameters, front), at_angle({0, 0, 1}, angle, 1)) == Approx(1).epsilon(0.02));
          }
        }
}

namespace {

/// What an opaque one without fuzz sends on, by the directions that each of its lobes is drawn by.
double sent_on_by_lobes(const PbrBsdf& bsdf, const Vec3d& wo) {
  constexpr int count = 4096;
  const auto lobes = bsdf.lobes(spread(wo));
  const double coat = lobes.coat_choice.get(0), all = coat + double{lobes.facet_choice.get(0)};
  double sum = 0;
  for (const auto& [from, to] : {std::pair(0.0, coat), std::pair(coat, all), std::pair(all, 1.0)}) {
    if (to - from < 1e-6) continue;
    const FloatN u(static_cast<float>((from + to) / 2));
    for (int i = 0; i < count; i += packet_lanes) {
      const auto numbers = [&](double step) {
        return batch_of<FloatN>([&](std::size_t lane) { return std::fmod((i + double(lane) + 0.5) * step, 1); });
      };
      const FloatN u1 = numbers(0.75487766624669276), u2 = numbers(0.56984029099805327);
      const BsdfSample<FloatN> sample = bsdf.sample(lobes, u, u1, u2);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (sample.pdf.get(lane) > 0) sum += weight_of(sample, lane) * (to - from) / count;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("OpenPBR: what absorbs nothing sends all light on about the angle of total reflection") {
  for (const std::string kind : {"base", "coat", "film"})
    for (const double ior : {0.4, 0.7, 0.9, 0.97})
      for (const double roughness : {0.04, 0.1, 0.3, 0.6, 1.0}) {
        OpenPbr::Parameters parameters = white(roughness);
        parameters.coat_weight = kind == "coat" ? 1 : 0;
        parameters.thin_film_weight = kind == "film" ? 1 : 0;
        parameters.coat_roughness = roughness;
        (kind == "coat" ? parameters.coat_ior : parameters.specular_ior) = ior;
        const PbrBsdf bsdf = bsdf_of(parameters);
        const double critical = std::sqrt(1 - ior * ior);
        for (const double step : {-1.0, -0.3, -0.1, 0.0, 0.1, 0.3, 1.0}) {
          const double cosine = std::clamp(critical + step * roughness * roughness, 0.03, 0.999);
          INFO(kind << " of " << ior << ", roughness " << roughness << ", wo at a cosine of " << cosine);
          CHECK(sent_on_by_lobes(bsdf, {std::sqrt(1 - cosine * cosine), 0, cosine}) == Approx(1).epsilon(0.005));
        }
      }
}

TEST_CASE("OpenPBR: rough diffuse reflection beside light that goes in loses nothing") {
  for (const double weight : {0.5, 1.0})
    for (const std::string kind : {"walks", "no walks", "thin"})
      for (const bool front : {true, false}) {
        OpenPbr::Parameters parameters = white(1);
        parameters.specular_ior = 1;
        parameters.base_diffuse_roughness = 1;
        parameters.subsurface_weight = weight;
        parameters.subsurface_color = {1, 1, 1};
        parameters.walks = kind == "no walks" ? 0 : 1;
        parameters.geometry_thin_walled = kind == "thin";
        for (const double angle : {10.0, 70.0}) {
          INFO("weight " << weight << ", " << kind << (front ? "" : " from its back") << ", wo at " << angle);
          CHECK(sent_on(bsdf_of(parameters, front), at_angle({0, 0, 1}, angle, 1)) == Approx(1).epsilon(3e-3));
        }
      }
}

TEST_CASE("OpenPBR: what is diffuse beside light that goes in is as rough as without") {
  OpenPbr::Parameters parameters = white(1);
  parameters.specular_ior = 1;
  parameters.base_color = {0.3, 0.6, 0.9};
  parameters.base_diffuse_roughness = 1;
  const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 50, 1)), wi = spread(at_angle({0, 0, 1}, 30, 2));
  const auto f = [&](double weight) {
    parameters.subsurface_weight = weight;
    return bsdf_of(parameters).evaluate(wo, wi, local_normal<FloatN>());
  };
  const Rgb<FloatN> all = f(0), part = f(0.75);
  CHECK(part.red.get(0) == Approx(all.red.get(0) / 4).epsilon(1e-5));
  CHECK(part.blue.get(0) == Approx(all.blue.get(0) / 4).epsilon(1e-5));
}

namespace {

OpenPbr::Parameters brushed_metal(double roughness) {
  OpenPbr::Parameters parameters = white(roughness);
  parameters.base_metalness = 1;
  parameters.specular_roughness_anisotropy = 0.6;
  return parameters;
}

}  // namespace

TEST_CASE("OpenPBR: stretched lobes follow their pdf, and white ones send all light on") {
  const Vec3d normal{0, 0, 1};
  for (const double roughness : {0.45, 0.6})
    for (const double angle : {0.0, 45.0, 75.0})
      for (const double turn : {0.0, 0.7, 1.6}) {
        const Above<PbrBsdf> above{{bsdf_of(brushed_metal(roughness))}};
        const Vec3d wo = at_angle(normal, angle, turn);
        INFO("roughness " << roughness << ", wo at " << angle << ", turned by " << turn);
        CHECK(judge(above, wo, normal, Cells(normal, 1), true).deviation < 4.5);
        CHECK(sent_on(above.judged.bsdf, wo) == Approx(1).epsilon(0.015));
      }
}

TEST_CASE("OpenPBR: grooves along y spread light along x") {
  const PbrBsdf bsdf = bsdf_of(brushed_metal(0.3));
  const auto f = [&](const Vec3d& wi) {
    return double{bsdf.evaluate(local_normal<FloatN>(), spread(normalize(wi)), local_normal<FloatN>()).red.get(0)};
  };
  CHECK(f({0.3, 0, 1}) > 4 * f({0, 0.3, 1}));
}

TEST_CASE("OpenPBR: f and pdf of a sample are those of evaluate() and pdf()") {
  Random random(8);
  double worst = 0;
  for (const auto& material : white_materials(0.4)) {
    const PbrBsdf bsdf = bsdf_of(material.second);
    for (int i = 0; i < 100; ++i) {
      const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit()));
      const auto number = [&] { return FloatN(static_cast<float>(random.unit())); };
      const FloatN u = number(), u1 = number(), u2 = number();
      const auto sample = bsdf.sample(wo, u, u1, u2);
      if (!(sample.wi.z.get(0) > 0) || any(sample.specular) || !(sample.pdf.get(0) > 0)) continue;
      const double f = bsdf.evaluate(wo, sample.wi, local_normal<FloatN>()).green.get(0),
                   pdf = bsdf.pdf(wo, sample.wi).get(0);
      worst = std::max(
          {worst, std::abs(f / double{sample.f.green.get(0)} - 1), std::abs(pdf / double{sample.pdf.get(0)} - 1)});
    }
  }
  CHECK(worst < 1e-5);
}

TEST_CASE("Oren and Nayar's diffuse reflection is reciprocal, and of roughness 0 Lambertian") {
  Random random(6);
  double worst = 0;
  for (const float roughness : {0.0F, 0.4F, 1.0F}) {
    const OrenNayar<FloatN> diffuse{Rgb<FloatN>(Rgb<float>(0.2F, 0.7F, 1)), FloatN(roughness)};
    for (int i = 0; i < 500; ++i) {
      const Vec3<FloatN> a = spread(at_angle({0, 0, 1}, 88 * random.unit(), 6 * random.unit())),
                         b = spread(at_angle({0, 0, 1}, 88 * random.unit(), 6 * random.unit()));
      const double forth = diffuse.f(a, b).green.get(0), back = diffuse.f(b, a).green.get(0);
      worst = std::max(worst, std::abs(forth / back - 1));
      if (roughness == 0) worst = std::max(worst, std::abs(forth * std::numbers::pi / 0.7 - 1));
    }
  }
  CHECK(worst < 1e-4);
}

TEST_CASE("OpenPBR: a metal and a glass are those of <conductor> and <dielectric>") {
  OpenPbr::Parameters metal;
  metal.base_color = {0.9, 0.6, 0.3};
  metal.specular_color = {0.8, 0.9, 1};
  metal.base_metalness = 1;
  metal.specular_roughness = 0.5;
  Conductor::Parameters conductor;
  conductor.cr = metal.base_color;
  conductor.edgecolor = metal.specular_color;
  conductor.roughness = 0.5;
  const auto same_metal = spread_bsdf<Kernel<Conductor>::Bsdf>(Kernel<Conductor>::bsdf(conductor));
  OpenPbr::Parameters glass;
  glass.transmission_weight = 1;
  glass.specular_roughness = 0.5;
  Dielectric::Parameters dielectric;
  dielectric.roughness = 0.5;
  auto same_glass = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(dielectric));
  same_glass.set_side(MaskN(true), FloatN(1));
  Random random(6);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 85 * random.unit(), 6 * random.unit())),
                       wi = spread(at_angle({0, 0, 1}, 85 * random.unit(), 6 * random.unit()));
    const auto compare = [&](const auto& a, const auto& b) {
      const Rgb<FloatN> fa = a.evaluate(wo, wi, local_normal<FloatN>()),
                        fb = b.evaluate(wo, wi, local_normal<FloatN>());
      for (const auto channel : {&Rgb<FloatN>::red, &Rgb<FloatN>::green, &Rgb<FloatN>::blue})
        worst = std::max(worst, std::abs(double{(fa.*channel).get(0)} / double{(fb.*channel).get(0)} - 1));
    };
    compare(bsdf_of(metal), same_metal);
    compare(bsdf_of(glass), same_glass);
  }
  CHECK(worst < 1e-4);
}

TEST_CASE("OpenPBR: at a wavelength, clear bases have the index that they have there, after their weight") {
  OpenPbr::Parameters parameters;
  parameters.transmission_weight = 1;
  parameters.specular_roughness = 0;
  for (const double weight : {1.0, 0.5, 0.0})
    for (const bool front : {true, false}) {
      parameters.specular_weight = weight;
      const auto kept = spread_bsdf<Kernel<OpenPbr>::Bsdf>(Kernel<OpenPbr>::bsdf(parameters));
      auto bsdf = kept;
      Refraction<FloatN> media;
      media.disperses = true;
      media.factor = FloatN(1.1F);
      bsdf.set_side(MaskN(front), media);
      const float index = 1 + (kept.eta.get(0) - 1) * 1.1F;
      CHECK(std::abs(bsdf.eta.get(0) - (front ? index : 1 / index)) < 1e-6F);
    }
}

TEST_CASE("OpenPBR: a coat takes its color from what is below it, and darkens it") {
  OpenPbr::Parameters parameters;
  parameters.base_color = {0.5, 0.5, 0.5};
  parameters.specular_weight = 0;
  parameters.coat_weight = 1;
  parameters.coat_color = {0.2, 0.6, 1};
  parameters.coat_darkening = 0;
  const Vec3<FloatN> straight = local_normal<FloatN>();
  const auto f = [&](const OpenPbr::Parameters& p) { return bsdf_of(p).evaluate(straight, straight, straight); };
  const double through = 1 - std::pow(0.6 / 2.6, 2);  // the coat's own reflection is in one direction
  const Rgb<FloatN> colored = f(parameters);
  CHECK(double{colored.red.get(0)} == Approx(0.2 * through * 0.5 / std::numbers::pi).epsilon(2e-3));
  CHECK(double{colored.green.get(0)} == Approx(0.6 * through * 0.5 / std::numbers::pi).epsilon(2e-3));
  parameters.coat_darkening = 1;
  const double dark = f(parameters).green.get(0) / colored.green.get(0);
  CHECK(dark > 0.5);
  CHECK(dark < 0.75);
}

}  // namespace raytrace::test
