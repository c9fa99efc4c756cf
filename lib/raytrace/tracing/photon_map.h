// Photons on surfaces, found again by their places (Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/film/photons.h"
#include "raytrace/math/color.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// Light that has come to a point.
struct Photon {
  Vec3f p;
  Vec3f normal;         ///< of the true surface, on the side that the light came to; unit length
  Vec3f wi;             ///< towards where it came from; unit length
  Rgb<float> flux;      ///< its share of that of all light paths of the pass
  std::int32_t group;   ///< of lights
  bool is_met;          ///< paths from the camera may come to its light: it is a lamp's, or the sky's
  std::int32_t points;  ///< that focused it
};

class PhotonMap final : public Photons {
 public:
  /// radius: within which photons are looked up, greater than 0. The map does not depend on `threads`. Throws
  /// std::bad_alloc.
  PhotonMap(const std::vector<Photon>& photons, float radius, int threads);

  /// A light in place of all photons around a point.
  struct Light {
    MaskN lanes;  ///< where there are any
    Vec3<FloatN> wi;
    Rgb<FloatN> flux_density;  ///< over the surface, whatever the light's direction
    IntN group;
    MaskN is_met;
  };
  /// Estimates the light at points p of surfaces of those normals, from photons that came by `most_points` or fewer:
  /// draws one of them in proportion to its flux and to a kernel that falls off with the distance, and gives it the
  /// light of all. So the expectation is that of all together, for the price of one BSDF. u: in [0, 1).
  Light choose(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const MaskN& lanes, const FloatN& u,
               int most_points) const;

 private:
  /// What decides whether a photon counts, in arrays: a packet of photons is tested at once.
  struct Places {
    std::vector<float> x, y, z, normal_x, normal_y, normal_z;
    std::vector<float> power;  ///< the largest channel of the flux, by magnitude
    std::vector<std::int32_t> points;
  };
  struct Choice;
  /// Of those around a point.
  void choose_around(const Vec3f& p, const Vec3f& normal, int most_points, Choice& choice) const;
  /// Of photons [first, last).
  void choose_from(std::uint32_t first, std::uint32_t last, const Vec3f& p, const Vec3f& normal, int most_points,
                   Choice& choice) const;
  std::uint32_t bucket_of(std::int32_t x, std::int32_t y, std::int32_t z) const;

  float radius_, cells_per_unit_;
  std::uint32_t bucket_mask_ = 0;
  std::vector<std::uint32_t> starts_;  ///< of each bucket's photons, and where the last one's end
  Places places_;
  std::vector<Photon> photons_;  ///< by bucket, those of a bucket in the order of their paths
};

/// The radius within which a photon in the middle has `neighbours` others: half of the photons, of 64 that stand for
/// all, have more. 0 if there are not so many.
float radius_for(const std::vector<Photon>& photons, std::size_t neighbours, int threads);

}  // namespace raytrace
