// All materials of one type together: shaded for a packet in one call, whichever of them its lanes hit.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The light that reaches a packet's surface points from one light: nothing where it is shadowed or from behind.
struct IncidentLight {
  Vec3<FloatN> wi;  ///< unit length, towards the light
  FloatN cosine;    ///< of wi and the normal; 0 where nothing arrives
  Rgb<FloatN> radiance;
};

class MaterialTable {
 public:
  virtual ~MaterialTable() = default;

  /// The most that any of them sends anywhere under lights of together that radiance: none reflects more than straight
  /// back along its normal.
  virtual Rgb<float> largest_radiance(const Rgb<float>& ambient_radiance, const Rgb<float>& light_radiance) const = 0;

  /// The albedo of each lane's material, and the most that any of them has.
  virtual Rgb<FloatN> albedo(const LaneIndices& materials) const = 0;
  virtual Rgb<float> largest_albedo() const = 0;

  /// The radiance that leaves along wo, of unit length. materials: of each lane, for every lane one that exists.
  virtual Rgb<FloatN> shade(const LaneIndices& materials, const Vec3<FloatN>& wo, const Vec3<FloatN>& normal,
                            const Rgb<float>& ambient_radiance, std::span<const IncidentLight> lights) const = 0;
};

template <class MaterialKernel>
class MaterialTableOf final : public MaterialTable {
 public:
  explicit MaterialTableOf(std::vector<typename MaterialKernel::template Bsdf<float>> bsdfs)
      : bsdfs_(std::move(bsdfs)) {}

  Rgb<FloatN> shade(const LaneIndices& materials, const Vec3<FloatN>& wo, const Vec3<FloatN>& normal,
                    const Rgb<float>& ambient_radiance, std::span<const IncidentLight> lights) const override {
    const auto bsdfs = gather_records<MaterialKernel::template Bsdf, FloatN>(bsdfs_.data(), materials);
    Rgb<FloatN> result = bsdfs.ambient_radiance(Rgb<FloatN>(ambient_radiance));
    for (const IncidentLight& light : lights)
      // The cosine first: where it is 0, a product beyond the range of floats would make it NaN.
      result += bsdfs.evaluate(wo, light.wi, normal) * (light.radiance * light.cosine);
    return result;
  }

  Rgb<float> largest_radiance(const Rgb<float>& ambient_radiance, const Rgb<float>& light_radiance) const override {
    const Vec3<FloatN> normal(Vec3<float>{0, 0, 1});
    Rgb<float> largest(0, 0, 0);
    for (std::size_t i = 0; i < bsdfs_.size(); ++i) {
      const LaneIndices material(static_cast<std::int32_t>(i));
      const auto bsdfs = gather_records<MaterialKernel::template Bsdf, FloatN>(bsdfs_.data(), material);
      const Rgb<FloatN> radiance = bsdfs.ambient_radiance(Rgb<FloatN>(ambient_radiance)) +
                                   bsdfs.evaluate(normal, normal, normal) * Rgb<FloatN>(light_radiance);
      largest = max(largest, {radiance.red.get(0), radiance.green.get(0), radiance.blue.get(0)});
    }
    return largest;
  }

  Rgb<FloatN> albedo(const LaneIndices& materials) const override {
    return gather_records<MaterialKernel::template Bsdf, FloatN>(bsdfs_.data(), materials).albedo();
  }

  Rgb<float> largest_albedo() const override {
    Rgb<float> largest(0, 0, 0);
    for (const auto& bsdf : bsdfs_) largest = max(largest, bsdf.albedo());
    return largest;
  }

 private:
  std::vector<typename MaterialKernel::template Bsdf<float>> bsdfs_;
};

}  // namespace raytrace
