// BSDFs' samples against their densities, and what they send on.
#pragma once

#include <algorithm>
#include <vector>

#include "bsdfs/directions.h"
#include "raytrace/materials/kernels.h"
#include "raytrace/math/gather.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

inline constexpr int samples = 60000;
inline constexpr std::size_t rings = 16, sectors = 12;

/// The sphere in rings about an axis, bounded by equal steps of cosine^power, each cut into sectors; what lies more
/// than a right angle from the axis is one cell, the last. The lobe cosine^(power - 1) has as much in each ring.
class Cells {
 public:
  Cells(const Vec3d& axis, double power) : frame_(axis), power_(power) {}

  static constexpr std::size_t count = rings * sectors + 1;

  std::size_t cell_of(const Vec3d& direction) const {
    const double cosine = dot(direction, frame_.w);
    if (cosine <= 0) return count - 1;
    const auto ring = static_cast<std::size_t>(std::pow(std::min(cosine, 1.0), power_) * rings);
    const auto sector = static_cast<std::size_t>(frame_.azimuth_of(direction) / (2 * std::numbers::pi) * sectors);
    return std::min(ring, rings - 1) * sectors + std::min(sector, sectors - 1);
  }

  /// The integral of a density over each cell but the last, by the midpoint rule in the variables cosine^power and
  /// azimuth.
  template <class Density>
  std::vector<double> integrals(Density density) const {
    constexpr std::size_t steps = 12;
    std::vector<double> result(count);
    for (std::size_t ring = 0; ring < rings; ++ring)
      for (std::size_t sector = 0; sector < sectors; ++sector)
        for (std::size_t i = 0; i < steps; ++i) {
          const double cosine =
              std::pow((static_cast<double>(ring) + (static_cast<double>(i) + 0.5) / steps) / rings, 1 / power_);
          const double solid_angle =
              2 * std::numbers::pi / (power_ * std::pow(cosine, power_ - 1)) / double{rings * steps * sectors * steps};
          for (std::size_t first = 0; first < steps; first += lanes) {
            const FloatN values = density(vectors_of([&](std::size_t lane) {
              const double azimuth =
                  (static_cast<double>(sector) + (static_cast<double>(first + lane) + 0.5) / steps) / sectors;
              return frame_.direction(cosine, azimuth * 2 * std::numbers::pi);
            }));
            for (std::size_t lane = 0; lane < lanes && first + lane < steps; ++lane)
              result[ring * sectors + sector] += static_cast<double>(values.get(lane)) * solid_angle;
          }
        }
    return result;
  }

 private:
  Frame frame_;
  double power_;
};

struct Outcome {
  double integral;      ///< of the pdf over the sphere
  double deviation;     ///< of the samples from the pdf, in standard deviations
  double worst_length;  ///< largest | |wi| - 1 |
  double lowest;        ///< smallest dot(normal, wi)
  int impossible = 0;   ///< samples whose pdf is 0
};

/// may_miss: some samples are of no use, and the pdf's integral is that of the others.
template <class Brdf>
Outcome judge(const Brdf& brdf, const Vec3d& wo, const Vec3d& normal, const Cells& cells, bool may_miss = false) {
  const Vec3<FloatN> wide_wo = spread(wo), wide_normal = spread(normal);
  const auto pdf = [&](const Vec3<FloatN>& wi) { return brdf.pdf(wide_wo, wi, wide_normal); };
  std::vector<double> expected = cells.integrals(pdf);
  Outcome outcome{0, 0, 0, 1};
  for (double& value : expected) {
    outcome.integral += value;
    value *= samples;
  }
  if (may_miss) expected.back() = samples * std::max(0.0, 1 - outcome.integral);
  std::vector<double> observed(Cells::count);
  Random random(12345);
  for (int i = 0; i < samples; i += packet_lanes) {
    const FloatN u1 = batch_of<FloatN>([&](std::size_t) { return random.unit(); });
    const FloatN u2 = batch_of<FloatN>([&](std::size_t) { return random.unit(); });
    const Vec3<FloatN> wi = brdf.sample(wide_wo, wide_normal, u1, u2);
    const FloatN density = pdf(wi);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3d direction = lane_of(wi, lane);
      ++observed[cells.cell_of(direction)];
      outcome.worst_length = std::max(outcome.worst_length, std::abs(length(direction) - 1));
      outcome.lowest = std::min(outcome.lowest, dot(direction, normal));
      outcome.impossible += !(density.get(lane) > 0);
    }
  }
  outcome.deviation = chi_square_deviation(observed, expected);
  return outcome;
}

/// A material's Bsdf, for judge(): which lobe a sample is of comes from random numbers of its own.
template <class Bsdf>
struct JudgedBsdf {
  Bsdf bsdf;
  mutable Random lobes{777};

  Vec3<FloatN> sample(const Vec3<FloatN>& wo, const Vec3<FloatN>&, const FloatN& u1, const FloatN& u2) const {
    return bsdf.sample(wo, batch_of<FloatN>([&](std::size_t) { return lobes.unit(); }), u1, u2).wi;
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, const Vec3<FloatN>&) const { return bsdf.pdf(wo, wi); }
};

/// The same of every lane.
template <template <class> class Bsdf>
Bsdf<FloatN> spread_bsdf(const Bsdf<float>& bsdf) {
  return gather_records<Bsdf, FloatN>(&bsdf, LaneIndices(0));
}

}  // namespace raytrace::test
