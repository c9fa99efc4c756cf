// OpenPBR: light that comes through rough facets from behind, against what samples draw by themselves.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bsdfs/white_materials.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// Those that let light through, white and not.
std::vector<std::pair<std::string, OpenPbr::Parameters>> clear_materials(double roughness) {
  std::vector<std::pair<std::string, OpenPbr::Parameters>> result;
  for (const auto& [name, parameters] : white_materials(roughness))
    if (parameters.transmission_weight > 0) result.emplace_back(name, parameters);
  for (const bool thin : {false, true}) {
    OpenPbr::Parameters parameters = white(roughness);
    parameters.transmission_weight = 1;
    parameters.transmission_color = {0.3, 0.6, 0.9};
    parameters.specular_color = {0.5, 0.7, 0.4};
    parameters.specular_roughness_anisotropy = 0.6;
    parameters.geometry_thin_walled = thin;
    result.emplace_back(thin ? "brushed pane" : "brushed glass", parameters);
    parameters.transmission_weight = parameters.subsurface_weight = 0.5;
    result.emplace_back(thin ? "half a brushed pane with paper" : "half brushed glass with wax", parameters);
  }
  return result;
}

/// With normals of the base's and the coat's own, or not.
struct ClearBsdf {
  PbrBsdf bsdf;
  bool is_layered = false;

  LayerFrames<FloatN> frames(const Vec3<FloatN>& wo) const {
    return {{MaskN(true), spread(at_angle({0, 0, 1}, 15, 4)), spread(at_angle({0, 0, 1}, 20, 2)),
             spread(at_angle({0, 0, 1}, 10, 1))},
            wo};
  }
  BsdfSample<FloatN> sample(const Vec3<FloatN>& wo, const FloatN& u, const FloatN& u1, const FloatN& u2) const {
    const LayerFrames<FloatN> of_wo = frames(wo);
    return bsdf.sample(bsdf.lobes(wo, is_layered ? &of_wo : nullptr), u, u1, u2);
  }
  PbrBsdf::Value value(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi) const {
    const LayerFrames<FloatN> of_wo = frames(wo);
    return bsdf.value(bsdf.lobes(wo, is_layered ? &of_wo : nullptr), wi);
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi) const { return value(wo, wi).pdf; }
};

/// What comes through; other samples go straight up.
struct Behind {
  JudgedBsdf<ClearBsdf> judged;

  Vec3<FloatN> sample(const Vec3<FloatN>& wo, const Vec3<FloatN>& normal, const FloatN& u1, const FloatN& u2) const {
    const BsdfSample<FloatN> drawn =
        judged.bsdf.sample(wo, batch_of<FloatN>([&](std::size_t) { return judged.lobes.unit(); }), u1, u2);
    const MaskN through = (drawn.pdf > FloatN(0)) & !drawn.specular & !drawn.enters & (drawn.wi.z < FloatN(0));
    return select(through, drawn.wi, normal);
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, const Vec3<FloatN>& normal) const {
    return select(wi.z < FloatN(0), judged.pdf(wo, wi, normal), FloatN(0));
  }
};

/// The integral of something over the lower half of all directions.
template <class Function>
double integral_below(const Function& function) {
  constexpr int rows = 150, columns = 320;
  double sum = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; column += packet_lanes) {
      // Even in the solid angle.
      const double cosine = (row + 0.5) / rows, sine = std::sqrt(1 - cosine * cosine);
      const Vec3<FloatN> wi = vectors_of([&](std::size_t lane) {
        const double turn = (column + static_cast<int>(lane) + 0.5) * 2 * std::numbers::pi / columns;
        return Vec3d{sine * std::cos(turn), sine * std::sin(turn), -cosine};
      });
      const FloatN values = function(wi);
      for (std::size_t lane = 0; lane < lanes && column + static_cast<int>(lane) < columns; ++lane)
        sum += double{values.get(lane)} * 2 * std::numbers::pi / (rows * columns);
    }
  return sum;
}

}  // namespace

TEST_CASE("OpenPBR: f and pdf of what comes through are those of its direction") {
  Random random(12);
  for (const double roughness : {0.2, 0.45, 0.8})
    for (const auto& [name, parameters] : clear_materials(roughness))
      for (const bool front : {true, false})
        for (const bool layered : {false, true}) {
          const ClearBsdf clear{bsdf_of(parameters, front), layered};
          double worst = 0;
          int through = 0;
          for (int i = 0; i < 200; ++i) {
            const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit()));
            const auto number = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
            const FloatN u = number(), u1 = number(), u2 = number();
            BsdfSample<FloatN> sample = clear.sample(wo, u, u1, u2);
            sample.f.blue = select(sample.enters, FloatN(0), sample.f.blue);
            const PbrBsdf::Value value = clear.value(wo, sample.wi);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
              if (!(sample.wi.z.get(lane) < -0.02F) || !(sample.f.blue.get(lane) > 0)) continue;
              ++through;
              const auto differ = [&](const FloatN& a, const FloatN& b) {
                return std::abs(double{a.get(lane)} / double{b.get(lane)} - 1);
              };
              worst = std::max({worst, differ(value.pdf, sample.pdf), differ(value.f.red, sample.f.red),
                                differ(value.f.blue, sample.f.blue)});
            }
          }
          INFO(name << (front ? "" : " from its back") << ", roughness " << roughness << (layered ? ", layered" : ""));
          CHECK(worst < 0.02);
          CHECK(through > 50);
        }
}

TEST_CASE("OpenPBR: what comes through follows its pdf") {
  const Vec3d normal{0, 0, 1}, below{0, 0, -1};
  for (const double roughness : {0.65, 0.9})
    for (auto [name, parameters] : clear_materials(roughness))
      for (const double angle : {10.0, 60.0})
        for (const bool front : {true, false})
          for (const bool layered : {false, true}) {
            // Below a coat of nearly the same index light is hardly bent, and lobes are narrower than cells.
            if (parameters.coat_weight > 0) parameters.specular_ior = 2.6;
            const Behind behind{{{bsdf_of(parameters, front), layered}}};
            const Outcome outcome = judge(behind, at_angle(normal, angle, 2), normal, Cells(below, 1), true);
            INFO(name << (front ? "" : " from its back") << ", roughness " << roughness << ", wo at " << angle
                      << (layered ? ", layered" : ""));
            CHECK(outcome.deviation < 4.5);
            CHECK(outcome.integral > 0.01);
          }
}

TEST_CASE("OpenPBR: even light from behind is sent on as samples send it") {
  for (const auto& [name, parameters] : clear_materials(0.6))
    for (const bool front : {true, false})
      for (const double angle : {20.0, 60.0}) {
        const PbrBsdf bsdf = bsdf_of(parameters, front);
        const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, angle, 1));
        const auto lobes = bsdf.lobes(wo);
        const double by_f =
            integral_below([&](const Vec3<FloatN>& wi) { return bsdf.value(lobes, wi).f.green * -wi.z; });
        Random random(5);
        double by_samples = 0;
        constexpr int count = 40000;
        for (int i = 0; i < count; i += packet_lanes) {
          const auto number = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
          const FloatN u = number(), u1 = number(), u2 = number();
          BsdfSample<FloatN> sample = bsdf.sample(lobes, u, u1, u2);
          sample.pdf = select(sample.enters | (sample.wi.z > FloatN(0)), FloatN(0), sample.pdf);
          for (std::size_t lane = 0; lane < lanes; ++lane)
            if (sample.pdf.get(lane) > 0) by_samples += weight_of(sample, lane) / double{sample.eta2.get(lane)} / count;
        }
        INFO(name << (front ? "" : " from its back") << ", wo at " << angle);
        CHECK(by_f == Approx(by_samples).epsilon(0.03));
      }
}

TEST_CASE("OpenPBR: light comes through facets as well on the way back, by the squares of the indices") {
  Random random(3);
  for (const bool thin : {false, true}) {
    OpenPbr::Parameters parameters = white(0.5);
    parameters.transmission_weight = 1;
    parameters.geometry_thin_walled = thin;
    const PbrBsdf there = bsdf_of(parameters, true), back = bsdf_of(parameters, false);
    double worst = 0;
    int compared = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3<FloatN> above = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit())),
                         below = spread(at_angle({0, 0, -1}, 80 * random.unit(), 6 * random.unit()));
      const auto lobes = there.lobes(above), lobes_back = back.lobes(-below);
      // Without energy compensation, which is of one direction.
      const auto share = [&](const auto& l) { return double{(thin ? l.white_share : l.dielectric_share).get(0)}; };
      const double f = double{there.value(lobes, below).f.green.get(0)} * share(lobes),
                   f_back = double{back.value(lobes_back, -above).f.green.get(0)} * share(lobes_back);
      if (f < 1e-4 && f_back < 1e-4) continue;
      ++compared;
      worst = std::max(worst, std::abs(f * (thin ? 1 : 2.25) / f_back - 1));
    }
    INFO((thin ? "thin" : "solid"));
    CHECK(worst < 1e-3);
    CHECK(compared > 100);
  }
}

TEST_CASE("OpenPBR: light comes through a glass as through a <dielectric>") {
  Random random(6);
  for (const bool thin : {false, true})
    for (const bool front : {true, false}) {
      OpenPbr::Parameters glass = white(0.5);
      glass.transmission_weight = 1;
      glass.geometry_thin_walled = thin;
      Dielectric::Parameters dielectric;
      dielectric.roughness = 0.5;
      dielectric.thinwalled = thin;
      auto same = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(dielectric));
      same.set_side(MaskN(front), FloatN(1));
      const PbrBsdf bsdf = bsdf_of(glass, front);
      double worst = 0;
      for (int i = 0; i < 300; ++i) {
        const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 85 * random.unit(), 6 * random.unit())),
                           wi = spread(at_angle({0, 0, -1}, 85 * random.unit(), 6 * random.unit()));
        const double f = bsdf.evaluate(wo, wi, local_normal<FloatN>()).green.get(0),
                     wanted = same.evaluate(wo, wi, local_normal<FloatN>()).green.get(0);
        if (f > 0 || wanted > 0) worst = std::max(worst, std::abs(f / wanted - 1));
      }
      INFO((thin ? "thin" : "solid") << (front ? "" : " from its back"));
      CHECK(worst < 1e-3);
    }
}

TEST_CASE("OpenPBR: nothing comes from behind what is opaque or smooth") {
  OpenPbr::Parameters opaque = white(0.5), smooth = white(0);
  smooth.transmission_weight = 1;
  for (const OpenPbr::Parameters& parameters : {opaque, smooth}) {
    const PbrBsdf bsdf = bsdf_of(parameters);
    const auto lobes = bsdf.lobes(local_normal<FloatN>());
    const auto value = bsdf.value(lobes, spread({0, 0, -1}));
    CHECK(all(value.f.green == FloatN(0)));
    CHECK(all(value.pdf == FloatN(0)));
  }
}

TEST_CASE("OpenPBR: it says of itself that it is rough and clear where its facets are") {
  const auto none = [](std::string_view) { return false; };
  OpenPbr::Parameters parameters = white(0.3);
  CHECK(!OpenPbr::scatters_through(parameters, none));
  parameters.transmission_weight = 0.5;
  CHECK(OpenPbr::scatters_through(parameters, none));
  parameters.base_metalness = 1;
  CHECK(!OpenPbr::scatters_through(parameters, none));
  parameters.base_metalness = 0;
  for (const double roughness : {0.0, 0.02, 0.03, 0.033, 0.05, 0.5})
    for (const double anisotropy : {0.0, 0.9})
      for (const double coat : {0.0, 0.7}) {
        parameters.specular_roughness = roughness;
        parameters.specular_roughness_anisotropy = anisotropy;
        parameters.coat_weight = coat;
        parameters.coat_roughness = 0.3;
        const PbrBsdf bsdf = bsdf_of(parameters);
        const auto ggx = StretchedGgx<FloatN>::of(bsdf.roughness, bsdf.anisotropy);
        INFO("roughness " << roughness << ", anisotropy " << anisotropy << ", coat " << coat);
        CHECK(OpenPbr::scatters_through(parameters, none) == all(ggx.is_rough()));
      }
}

}  // namespace raytrace::test
