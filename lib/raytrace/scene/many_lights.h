// Lights at points that fall off, where they are so many that to ask each takes longer than all else of a path: a few
// are drawn for each of its points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "raytrace/lights/photometric_share_kernel.h"
#include "raytrace/lights/point_source.h"
#include "raytrace/math/ray.h"
#include "raytrace/scene/light_tree.h"

namespace raytrace {

class ManyLights {
 public:
  /// From so many on, lights of a group are drawn.
  static constexpr std::size_t least = 8;
  /// So many of them for each point.
  static constexpr std::size_t draws = 2;
  /// Up to so many are asked each where the camera sees the point: that costs little there, and its light has no noise.
  static constexpr std::size_t most_asked = 16;

  /// Those without light are left out.
  void add(const PointSource<float>& source, const PhotometricShare& photometry, bool shadows);
  /// After the last of them.
  void build(LightSampling sampling);
  /// Whether all are dark; then nothing can be drawn.
  bool empty() const { return tree_.empty(); }

  /// Leads rays, whose origins are set, to lights, where they end. radiance: receives what arrives along them, over the
  /// probability of the draw; nothing in lanes that no light reaches. normal: at the origin, of unit length; of length
  /// 0: it is on no surface. u: in [0, 1), chooses the light. The result: whether things may hide it.
  MaskN sample(Ray<FloatN>& shadow_rays, const Vec3<FloatN>& normal, const FloatN& u, Rgb<FloatN>& radiance) const;

  /// What sample() is made of: those that are together in the tree, by their numbers, some of which are dark.
  struct Leaf {
    IntN first;
    std::size_t size;
    FloatN probability;  ///< 0 where no light reaches the point
    FloatN rest;         ///< what is left of u: in [0, 1), evenly
  };
  Leaf choose(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const FloatN& u) const;
  PointSource<FloatN> source(const IntN& light) const;
  /// Leads the ray to that light, and gives what arrives along it.
  Rgb<FloatN> sample(const IntN& light, const PointSource<FloatN>& source, Ray<FloatN>& shadow_ray) const;
  MaskN has_shadow(const IntN& light) const;

 private:
  /// So many are drawn together from the tree, and one of them by what it sends to the point.
  static constexpr std::size_t most_together = 8;

  /// What of each lane's light goes that way, where lights have photometry.
  FloatN photometric_share(const IntN& light, const Vec3<FloatN>& to_light) const;

  // Of each light; when it is built, by the tree's leaves.
  std::vector<PointSource<float>> sources_;
  std::vector<std::int32_t> photometry_of_;  ///< the number of its share; -1: the same into all directions
  std::vector<std::int32_t> has_shadow_;
  std::vector<LightEmission> emissions_;  ///< until it is built

  std::vector<PhotometricShare> photometry_;
  std::map<std::tuple<const Photometry*, float, float, float>, std::int32_t>
      photometry_numbers_;  ///< until it is built
  std::size_t leaf_size_ = 1;
  LightTree tree_;
};

}  // namespace raytrace
