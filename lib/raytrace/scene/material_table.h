// All materials of one type together: shaded for a packet in one call, whichever of them its lanes hit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/bsdfs/layer_normals.h"
#include "raytrace/film/film.h"
#include "raytrace/materials/medium.h"
#include "raytrace/materials/subsurface.h"
#include "raytrace/math/color.h"
#include "raytrace/math/frame.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"
#include "raytrace/scene/texture_table.h"

namespace raytrace {

/// The light that reaches a packet's surface points from one light: nothing where it is shadowed or from behind.
struct IncidentLight {
  Vec3<FloatN> wi;  ///< unit length, towards the light
  FloatN cosine;    ///< of wi and the normal; 0 where nothing arrives
  Rgb<FloatN> radiance;
};

/// Of a BSDF for two directions.
struct BsdfValue {
  Rgb<FloatN> f;  ///< in 1/steradian, without the cosine
  FloatN pdf;     ///< at which it draws the one that light comes from, per solid angle
};

/// What a point of a path asks of its material.
struct Scattering {
  BsdfSample<FloatN> sample;
  BsdfValue towards;  ///< the light that was drawn for it
};

/// What the lights of a scene send to a point at most, by magnitude.
struct LightBounds {
  Rgb<float> ambient{0, 0, 0};  ///< ambient light
  Rgb<float> usual{0, 0, 0};    ///< all others together, those that fall off at distance 1
  Rgb<float> largest{0, 0, 0};  ///< the same, those that fall off as near to them as must still fit
  /// Each channel by itself: the dimmest of them that has any of it, those that fall off as far away as the eye.
  Rgb<float> dimmest{infinite, infinite, infinite};

 private:
  static constexpr float infinite = std::numeric_limits<float>::infinity();
};

class MaterialTable {
 public:
  virtual ~MaterialTable() = default;

  /// Adds what those of them that are in use (1, else 0) send on under the lights. None reflects more than straight
  /// back along its normal.
  virtual void add_to(RadianceRange& range, const LightBounds& lights, const std::uint8_t* used) const = 0;

  // point: null where none of the lanes' materials has a texture. layers: null where none has layers with normals of
  // their own.

  /// The albedo of each lane's material, and the most that any of those in use has, by magnitude.
  virtual Rgb<FloatN> albedo(const LaneIndices& materials, const TexturePoint<FloatN>* point) const = 0;
  virtual Rgb<float> largest_albedo(const std::uint8_t* used) const = 0;

  /// The radiance that leaves of itself; of materials that do not shine none.
  virtual Rgb<FloatN> emitted(const LaneIndices& materials, const TexturePoint<FloatN>* point) const = 0;

  /// A direction that light comes from, drawn by each lane's material out of u, u1 and u2 in [0, 1), and what leaves
  /// of light from wi, in the lanes of `lit`. wo, wi, layers: in the local frame.
  virtual Scattering scatter(const LaneIndices& materials, const MaskN& front, const Refraction<FloatN>& media,
                             const Vec3<FloatN>& wo, const MaskN& lit, const Vec3<FloatN>& wi, const FloatN& u,
                             const FloatN& u1, const FloatN& u2, const LayerNormals<FloatN>* layers,
                             const TexturePoint<FloatN>* point) const = 0;

  /// What of f, as scatter() has it for light from wi above the surface, is gloss. `sharp`: of a mixture alone.
  virtual Rgb<FloatN> gloss(const LaneIndices& materials, const MaskN& front, const Refraction<FloatN>& media,
                            const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, Gloss which,
                            const LayerNormals<FloatN>* layers, const TexturePoint<FloatN>* point) const = 0;

  /// The share that is left of light that went so far behind surfaces.
  virtual Rgb<FloatN> transmittance(const LaneIndices& materials, const FloatN& distance,
                                    const TexturePoint<FloatN>* point) const = 0;

  /// The share of light that comes straight through panes, against wo in the local frame.
  virtual Rgb<FloatN> straight(const LaneIndices& materials, const Refraction<FloatN>& media, const Vec3<FloatN>& wo,
                               const TexturePoint<FloatN>* point) const = 0;

  /// What is below surfaces whose samples `enters`.
  virtual Subsurface<FloatN> subsurface(const LaneIndices& materials, const TexturePoint<FloatN>* point) const = 0;

  /// The radiance that leaves along wo, of unit length. materials: of each lane, for every lane one that exists. frame:
  /// about the normal; null where no material's reflection differs along the surface.
  virtual Rgb<FloatN> shade(const LaneIndices& materials, const MaskN& front, const Refraction<FloatN>& media,
                            const Vec3<FloatN>& wo, const Vec3<FloatN>& normal, const Frame<FloatN>* frame,
                            const Rgb<float>& ambient_radiance, std::span<const IncidentLight> lights,
                            const LayerNormals<FloatN>* layers, const TexturePoint<FloatN>* point) const = 0;
};

/// A material with textures.
template <class Material>
struct TexturedMaterial {
  std::int32_t index;
  typename Material::template Values<float> values;
  std::vector<TextureFactor> factors;  ///< of the values
};

template <class Material>
class MaterialTableOf final : public MaterialTable {
 public:
  using MaterialKernel = Kernel<Material>;
  using TexturedMaterials = std::vector<TexturedMaterial<Material>>;

  /// bsdfs: those of materials with textures are the most that they can be. textured: by their indices; textures:
  /// theirs.
  explicit MaterialTableOf(std::vector<typename MaterialKernel::template Bsdf<float>> bsdfs,
                           TexturedMaterials textured = {}, const TextureTable* textures = nullptr)
      : bsdfs_(std::move(bsdfs)), textured_(std::move(textured)), textures_(textures) {}

  Rgb<FloatN> shade(const LaneIndices& materials, const MaskN& front, const Refraction<FloatN>& media,
                    const Vec3<FloatN>& wo, const Vec3<FloatN>& normal, const Frame<FloatN>* frame,
                    const Rgb<float>& ambient_radiance, std::span<const IncidentLight> lights,
                    const LayerNormals<FloatN>* layers, const TexturePoint<FloatN>* point) const override {
    const auto bsdfs = gathered(materials, front, point, media);
    Rgb<FloatN> result = bsdfs.ambient_radiance(Rgb<FloatN>(ambient_radiance));
    if constexpr (requires { BsdfN::in_local_frame; }) {
      if (BsdfN::in_local_frame || frame != nullptr) {
        const Frame<FloatN> local = frame != nullptr ? *frame : Frame<FloatN>(normal);
        const Vec3<FloatN> local_wo = local.to_local(wo);
        if (lights.empty()) return result;
        if constexpr (BsdfN::in_local_frame) {
          const auto with_lobes = [&](const auto& lobes) {
            for (const IncidentLight& light : lights)
              result += bsdfs.value(lobes, local.to_local(light.wi)).f * (light.radiance * light.cosine);
            return result;
          };
          if constexpr (has_layers)
            if (layers != nullptr) [[unlikely]] {
              const LayerFrames<FloatN> frames(layers->to_local(local), local_wo);
              return with_lobes(bsdfs.lobes(local_wo, &frames));
            }
          return with_lobes(bsdfs.lobes(local_wo));
        } else {
          for (const IncidentLight& light : lights)
            result += bsdfs.evaluate(local_wo, local.to_local(light.wi), local_normal<FloatN>()) *
                      (light.radiance * light.cosine);
          return result;
        }
      }
    }
    for (const IncidentLight& light : lights)
      // The cosine first: where it is 0, a product beyond the range of floats would make it NaN.
      result += bsdfs.evaluate(wo, light.wi, normal) * (light.radiance * light.cosine);
    return result;
  }

  Rgb<FloatN> emitted(const LaneIndices& materials, const TexturePoint<FloatN>* point) const override {
    if constexpr (shines) {
      auto bsdfs = gather_records<MaterialKernel::template Bsdf, FloatN>(bsdfs_.data(), materials);
      if (point != nullptr) set_textured(bsdfs, materials, *point);
      return bsdfs.emitted();
    } else {
      return Rgb<FloatN>(Rgb<float>(0, 0, 0));
    }
  }

  Scattering scatter(const LaneIndices& materials, const MaskN& front, const Refraction<FloatN>& media,
                     const Vec3<FloatN>& wo, const MaskN& lit, const Vec3<FloatN>& wi, const FloatN& u,
                     const FloatN& u1, const FloatN& u2, const LayerNormals<FloatN>* layers,
                     const TexturePoint<FloatN>* point) const override {
    const auto bsdfs = gathered(materials, front, point, media);
    const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
    if constexpr (has_lobes) {
      const auto result_of = [&](const auto& lobes) {
        Scattering result{bsdfs.sample(lobes, u, u1, u2), {black, FloatN(0)}};
        if (none(lit)) return result;
        const auto value = bsdfs.value(lobes, wi);
        result.towards = {value.f, value.pdf};
        return result;
      };
      if constexpr (has_layers)
        if (layers != nullptr) [[unlikely]] {
          const LayerFrames<FloatN> frames(*layers, wo);
          return result_of(bsdfs.lobes(wo, &frames));
        }
      return result_of(bsdfs.lobes(wo));
    } else {
      Scattering result{bsdfs.sample(wo, u, u1, u2), {black, FloatN(0)}};
      if (any(lit)) result.towards = {bsdfs.evaluate(wo, wi, local_normal<FloatN>()), bsdfs.pdf(wo, wi)};
      return result;
    }
  }

  Rgb<FloatN> gloss(const LaneIndices& materials, const MaskN& front, const Refraction<FloatN>& media,
                    const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, Gloss which, const LayerNormals<FloatN>* layers,
                    const TexturePoint<FloatN>* point) const override {
    const Rgb<FloatN> black(Rgb<float>(0, 0, 0));
    if constexpr (has_layers) {
      const auto bsdfs = gathered(materials, front, point, media);
      if (layers == nullptr) return bsdfs.gloss(bsdfs.lobes(wo), wi, which);
      const LayerFrames<FloatN> frames(*layers, wo);
      return bsdfs.gloss(bsdfs.lobes(wo, &frames), wi, which);
    } else if constexpr (requires(BsdfN bsdf) { bsdf.gloss(wo, wi); }) {
      return which == Gloss::any ? gathered(materials, front, point, media).gloss(wo, wi) : black;
    } else if constexpr (requires { BsdfN::is_glossy; }) {
      return which == Gloss::any ? gathered(materials, front, point, media).evaluate(wo, wi, local_normal<FloatN>())
                                 : black;
    } else {
      return black;
    }
  }

  Rgb<FloatN> transmittance(const LaneIndices& materials, const FloatN& distance,
                            const TexturePoint<FloatN>* point) const override {
    if constexpr (requires(BsdfN bsdf, FloatN d) { bsdf.transmittance(d); })
      return gathered(materials, MaskN(false), point).transmittance(distance);
    else
      return Rgb<FloatN>(Rgb<float>(1, 1, 1));
  }

  Rgb<FloatN> straight(const LaneIndices& materials, const Refraction<FloatN>& media, const Vec3<FloatN>& wo,
                       const TexturePoint<FloatN>* point) const override {
    if constexpr (requires(BsdfN bsdf) { bsdf.straight(wo); })
      return gathered(materials, MaskN(true), point, media).straight(wo);
    else
      return Rgb<FloatN>(Rgb<float>(0, 0, 0));
  }

  Subsurface<FloatN> subsurface(const LaneIndices& materials, const TexturePoint<FloatN>* point) const override {
    if constexpr (requires(BsdfN bsdf) { bsdf.subsurface_inside(); })
      return gathered(materials, MaskN(true), point).subsurface_inside();
    else
      return {};
  }

  void add_to(RadianceRange& range, const LightBounds& lights, const std::uint8_t* used) const override {
    const Vec3<FloatN> normal(Vec3<float>{0, 0, 1});
    const auto lane = [](const Rgb<FloatN>& c) { return Rgb<float>(c.red.get(0), c.green.get(0), c.blue.get(0)); };
    for (std::size_t i = 0; i < bsdfs_.size(); ++i) {
      if (used[i] == 0) continue;
      const auto bsdf = magnitudes(bsdfs_[i]);
      const auto bsdfs = gather_records<MaterialKernel::template Bsdf, FloatN>(&bsdf, LaneIndices(0));
      const Rgb<FloatN> ambient = bsdfs.ambient_radiance(Rgb<FloatN>(lights.ambient));
      const Rgb<FloatN> f = bsdfs.evaluate(normal, normal, normal);
      Rgb<FloatN> usual = f;
      if constexpr (requires { bsdfs.usual_f(); }) usual = bsdfs.usual_f();
      range.add_usual(lane(ambient + usual * Rgb<FloatN>(lights.usual)));
      range.add_largest(lane(ambient + f * Rgb<FloatN>(lights.largest)));
      range.add_source(lane(ambient));
      range.add_source(lane(usual * Rgb<FloatN>(lights.dimmest)));
      if constexpr (shines) {
        const Rgb<float> emitted = lane(bsdfs.emitted());
        range.add_usual(emitted);
        range.add_largest(emitted);
        range.add_source(emitted);
      }
    }
  }

  Rgb<FloatN> albedo(const LaneIndices& materials, const TexturePoint<FloatN>* point) const override {
    auto bsdfs = gather_records<MaterialKernel::template Bsdf, FloatN>(bsdfs_.data(), materials);
    if (point != nullptr) set_textured(bsdfs, materials, *point);
    return bsdfs.albedo();
  }

  Rgb<float> largest_albedo(const std::uint8_t* used) const override {
    Rgb<float> largest(0, 0, 0);
    for (std::size_t i = 0; i < bsdfs_.size(); ++i)
      if (used[i] != 0) largest = max(largest, abs(bsdfs_[i].albedo()));
    return largest;
  }

 private:
  using Bsdf = typename MaterialKernel::template Bsdf<float>;
  using BsdfN = typename MaterialKernel::template Bsdf<FloatN>;
  /// Whether its BSDFs have them.
  static constexpr bool has_lobes = requires(BsdfN bsdf, Vec3<FloatN> wo) { bsdf.lobes(wo); };
  static constexpr bool has_layers =
      requires(BsdfN bsdf, Vec3<FloatN> wo, const LayerFrames<FloatN>* frames) { bsdf.lobes(wo, frames); };
  static constexpr bool shines = requires(BsdfN bsdf) { bsdf.emitted(); };

  /// The lanes' own, with their textures, for light that leaves on the side that `front` says.
  BsdfN gathered(const LaneIndices& materials, const MaskN& front, const TexturePoint<FloatN>* point,
                 const Refraction<FloatN>& media = {}) const {
    BsdfN bsdfs = gather_records<MaterialKernel::template Bsdf, FloatN>(bsdfs_.data(), materials);
    if (point != nullptr) set_textured(bsdfs, materials, *point);
    if constexpr (requires { bsdfs.set_side(front, media); }) bsdfs.set_side(front, media);
    return bsdfs;
  }

  /// Colours may be negative, and cancel each other in one direction but not in all.
  static Bsdf magnitudes(const Bsdf& bsdf) {
    auto numbers = std::bit_cast<std::array<float, sizeof(Bsdf) / sizeof(float)>>(bsdf);
    for (float& number : numbers) number = std::abs(number);
    return std::bit_cast<Bsdf>(numbers);
  }

  /// Sets the BSDFs of lanes whose materials have textures, material by material.
  [[gnu::noinline]] void set_textured(typename MaterialKernel::template Bsdf<FloatN>& bsdfs,
                                      const LaneIndices& materials, const TexturePoint<FloatN>& point) const {
    using Values = typename Material::template Values<FloatN>;
    for_each_value(materials.lanes(), MaskN(true), [&](std::int32_t index, const MaskN& here) {
      const auto found = std::lower_bound(textured_.begin(), textured_.end(), index,
                                          [](const auto& material, std::int32_t i) { return material.index < i; });
      if (found == textured_.end() || found->index != index) return;
      auto values = gather_records<Material::template Values, FloatN>(&found->values, LaneIndices(0));
      static_assert(sizeof(Values) % sizeof(FloatN) == 0);
      textures_->multiply(reinterpret_cast<FloatN*>(&values), found->factors, point);
      const auto own = MaterialKernel::template bsdf_of<FloatN>(values);
      const auto* const from = reinterpret_cast<const FloatN*>(&own);
      auto* const to = reinterpret_cast<FloatN*>(&bsdfs);
      for (std::size_t i = 0; i < sizeof own / sizeof(FloatN); ++i) to[i] = select(here, from[i], to[i]);
    });
  }

  std::vector<Bsdf> bsdfs_;
  TexturedMaterials textured_;
  const TextureTable* textures_;
};

}  // namespace raytrace
