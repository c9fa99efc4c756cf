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
  Vec3f axis{0, 0, 1};  ///< unit length, of a cone; which one, LightTree::Reach says
  float cosine = 1;     ///< of half the cone's angle
  float power = 0;
};

/// All that both have, or the other one where one has an empty box.
LightEmission join(const LightEmission& a, const LightEmission& b);

class LightTree {
 public:
  /// What the lights' cones are.
  enum class Reach {
    hemispheres,  ///< that of a surface's normals: it shines to the front of each, the less the flatter
    cone,         ///< of where the light shines, the same into all directions
  };

  LightTree() = default;
  /// leaf_size: so many lights at most are chosen together.
  LightTree(const std::vector<LightEmission>& lights, LightSampling sampling, Reach reach = Reach::hemispheres,
            std::size_t leaf_size = 1);

  bool empty() const { return trails_.empty(); }

  /// The lights of all leaves, where a leaf has several: leaf_size of each, filled up with `none`.
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  const std::vector<std::uint32_t>& leaves() const { return leaves_; }

  struct Choice {
    IntN light;          ///< or its leaf, where that has several
    FloatN probability;  ///< 0 where no light reaches the point
    FloatN rest;         ///< what is left of u: in [0, 1), evenly
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
    T child;  ///< the bits of an integer: of its first child; of a leaf, ~ of its light or its own number
  };

  /// order: the lights below the node.
  void build(const std::vector<LightEmission>& lights, std::span<std::uint32_t> order, std::size_t node,
             std::uint32_t trail, int depth);
  /// Two children that lie beside each other: how often the first is chosen, and what they have as `child`.
  struct Pair {
    FloatN first_share;
    IntN first_child, second_child;
  };
  /// children: the number of the first. Clears `reached` in lanes that neither of them lights.
  Pair pair(const IntN& children, const Vec3<FloatN>& p, const Vec3<FloatN>& normal, MaskN& reached) const;
  std::int32_t leaf_of(std::span<const std::uint32_t> lights);
  FloatN importance(const Node<FloatN>& node, const Vec3<FloatN>& p, const Vec3<FloatN>& normal) const;

  LightSampling sampling_ = LightSampling::tree;
  Reach reach_ = Reach::hemispheres;
  float inverse_power_ = 0;  ///< of all lights
  std::size_t leaf_size_ = 1;
  std::vector<std::uint32_t> leaves_;
  std::vector<Node<float>> nodes_;
  std::vector<std::int32_t> trails_;  ///< of each light: bit d is the child at depth d
};

}  // namespace raytrace
