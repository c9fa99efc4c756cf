// Which of many lights a point is lit by: a tree of their bounds, followed by chance.
//
// Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018; pbrt-v4,
// section 12.6.3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytrace/integrators/path.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// Where a light is, where to it shines, and how much.
struct LightEmission {
  Bounds box = empty_bounds;
  Vec3f axis{0, 0, 1};  ///< unit length: the normals of its surface lie in a cone about it, and it shines to the
                        ///< front of each
  float cosine = 1;     ///< of half the cone's angle
  float power = 0;
};

class LightTree {
 public:
  LightTree() = default;
  LightTree(const std::vector<LightEmission>& lights, LightSampling sampling);

  bool empty() const { return trails_.empty(); }

  struct Choice {
    IntN light;
    FloatN probability;  ///< 0 where no light reaches the point
  };
  /// Drawn out of u in [0, 1), for a point with a normal of unit length; of length 0: one that is on no surface.
  Choice sample(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, FloatN u) const;
  /// The probability of that choice.
  FloatN probability(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const IntN& light) const;

  std::size_t bytes() const { return nodes_.size() * sizeof(Node<float>) + trails_.size() * sizeof(trails_[0]); }

 private:
  /// Children lie beside each other.
  template <class T>
  struct Node {
    Vec3<T> lower, upper;
    T directions;  ///< the bits of a cone around those of all its lights
    T power;
    T child;  ///< the bits of an integer: of its first child; of a leaf, ~ of its light
  };

  /// order: the lights below the node.
  void build(const std::vector<LightEmission>& lights, std::span<std::uint32_t> order, std::size_t node,
             std::uint32_t trail, int depth);
  IntN children_of(const IntN& node) const;
  /// How often the first of two children is chosen. Clears `reached` in lanes that neither of them lights.
  FloatN first_share(const IntN& children, const Vec3<FloatN>& p, const Vec3<FloatN>& normal, MaskN& reached) const;
  FloatN importance(const Node<FloatN>& node, const Vec3<FloatN>& p, const Vec3<FloatN>& normal) const;

  LightSampling sampling_ = LightSampling::tree;
  float inverse_power_ = 0;  ///< of all lights
  std::vector<Node<float>> nodes_;
  std::vector<std::int32_t> trails_;  ///< of each light: bit d is the child at depth d
};

}  // namespace raytrace
