// How a surface answers light.
//
// A material type provides, besides its Parameters and fields():
//   template <class T> struct Brdfs { ... };         its BRDFs, members of type T only
//   static Brdfs<float> brdfs(const Parameters&);
//   template <class T> static Rgb<T> ambient(const Brdfs<T>&, const Rgb<T>& radiance);
//   template <class T> static Rgb<T> albedo(const Brdfs<T>&);
//   template <class T> static Rgb<T> reflect(const Brdfs<T>&, const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>&
//   normal);
// albedo is the share of light from all sides that it scatters evenly to all sides, without highlights.
// reflect is the sum of its BRDFs' f: without the cosine, all vectors unit length and away from the surface.
//
// Here they become MaterialTables: all materials of one type together, shaded for a packet in one call, whichever of
// them its lanes hit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The light that reaches a packet's surface points from one light: nothing where it is shadowed or from behind.
struct ArrivingLight {
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
  virtual Rgb<FloatN> albedo(const LaneIndices& places) const = 0;
  virtual Rgb<float> largest_albedo() const = 0;

  /// The radiance that leaves against `direction`: that of the rays which see it, of unit length. `places`: each lane's
  /// material, for every lane one that exists.
  virtual Rgb<FloatN> shade(const LaneIndices& places, const Vec3<FloatN>& direction, const Vec3<FloatN>& normal,
                            const Rgb<float>& ambient_radiance, std::span<const ArrivingLight> lights) const = 0;
};

template <class Material>
class MaterialTableOf final : public MaterialTable {
 public:
  explicit MaterialTableOf(std::vector<typename Material::template Brdfs<float>> brdfs) : brdfs_(std::move(brdfs)) {}

  Rgb<FloatN> shade(const LaneIndices& places, const Vec3<FloatN>& direction, const Vec3<FloatN>& normal,
                    const Rgb<float>& ambient_radiance, std::span<const ArrivingLight> lights) const override {
    const auto brdfs = gather_records<Material::template Brdfs, FloatN>(brdfs_.data(), places);
    Rgb<FloatN> result = Material::template ambient<FloatN>(brdfs, Rgb<FloatN>(ambient_radiance));
    const Vec3<FloatN> wo = -direction;
    for (const ArrivingLight& light : lights)
      // The cosine first: where it is 0, a product beyond the range of floats would make it NaN.
      result += Material::template reflect<FloatN>(brdfs, wo, light.wi, normal) * (light.radiance * light.cosine);
    return result;
  }

  Rgb<float> largest_radiance(const Rgb<float>& ambient_radiance, const Rgb<float>& light_radiance) const override {
    const Vec3<FloatN> normal(Vec3<float>{0, 0, 1});
    Rgb<float> largest(0, 0, 0);
    for (std::size_t i = 0; i < brdfs_.size(); ++i) {
      const LaneIndices place(static_cast<std::int32_t>(i));
      const auto brdfs = gather_records<Material::template Brdfs, FloatN>(brdfs_.data(), place);
      const Rgb<FloatN> radiance =
          Material::template ambient<FloatN>(brdfs, Rgb<FloatN>(ambient_radiance)) +
          Material::template reflect<FloatN>(brdfs, normal, normal, normal) * Rgb<FloatN>(light_radiance);
      largest = max(largest, {radiance.red.get(0), radiance.green.get(0), radiance.blue.get(0)});
    }
    return largest;
  }

  Rgb<FloatN> albedo(const LaneIndices& places) const override {
    return Material::template albedo<FloatN>(gather_records<Material::template Brdfs, FloatN>(brdfs_.data(), places));
  }

  Rgb<float> largest_albedo() const override {
    Rgb<float> largest(0, 0, 0);
    for (const auto& brdfs : brdfs_) largest = max(largest, Material::template albedo<float>(brdfs));
    return largest;
  }

 private:
  std::vector<typename Material::template Brdfs<float>> brdfs_;
};

}  // namespace raytrace
