// Surfaces whose layers have normals of their own, as a smooth coat over a base with relief, or a diffuse base under a
// gloss that is bent.
//
// Each layer reflects about its own normal, in its own frame. Whoever shades the surface counts the light that comes to
// it about the surface's normal, which is that of the shape and belongs to no layer: so a layer's f is multiplied by
// the ratio of the two cosines; of one that is diffuse, also by how its relief hides light from itself. No layer gets
// light from below the surface or from below its own normal: what sample() draws there is lost, its pdf is 0, and no
// layer sends on more than it would alone.
#pragma once

#include "raytrace/bsdfs/ggx.h"
#include "raytrace/math/frame.h"

namespace raytrace {

/// The share of the light that reaches a surface whose relief is not there for rays: it ends softly where the true
/// surface turns away, in place of at a hard edge. Chiang, Li and Burley, "Taming the Shadow Terminator", SIGGRAPH
/// Talks 2019. Cosines of the light about the true normal and the relief's, and of both normals.
template <class T>
RAYTRACE_INLINE T relief_shadow(const T& cosine, const T& relief_cosine, const T& normals_cosine) {
  const T g = min(max(cosine, T(0)) / max(relief_cosine * normals_cosine, T(1e-6F)), T(1));
  return ((T(1) - g) * g + T(1)) * g;
}

/// T: a batch.
template <class T>
struct LayerNormals {
  Mask<T> lanes;  ///< in which layers have normals of their own; in the others all have the surface's
  /// Of unit length. What is diffuse of the base has its relief as it is; what mirrors is bent so far that it mirrors
  /// nothing from inside.
  Vec3<T> diffuse, base, coat;

  /// In the frame about the surface's normal.
  LayerNormals to_local(const Frame<T>& frame) const {
    return {lanes, frame.to_local(diffuse), frame.to_local(base), frame.to_local(coat)};
  }
};

/// A layer about its own normal, for light that leaves in one direction. All are in the surface's local frame but what
/// is `own`, which is in the layer's: there its normal is z, and x is as near to the surface's as can be.
template <class T>
class LayerFrame {
 public:
  LayerFrame(const Mask<T>& lanes, const Vec3<T>& normal, const Vec3<T>& wo) : lanes_(lanes), frame_(normal) {
    const Vec3<T> x = Vec3<T>{T(1), T(0), T(0)} - normal * normal.x;
    const T size = length(x);
    const Mask<T> has_x = size > T(1e-3F);
    frame_.x = select(has_x, x * (T(1) / size), frame_.x);
    frame_.y = select(has_x, cross(normal, frame_.x), frame_.y);
    own_wo_ = above_surface(to_own(wo), local_normal<T>());
  }

  const Vec3<T>& own_wo() const { return own_wo_; }
  Vec3<T> to_own(const Vec3<T>& w) const { return select(lanes_, frame_.to_local(w), w); }
  Vec3<T> from_own(const Vec3<T>& own) const { return select(lanes_, frame_.to_world(own), own); }

  /// What light from wi is to the layer, over what it is to the surface.
  T share(const Vec3<T>& wi, const Vec3<T>& own_wi) const {
    const T ratio = own_wi.z / max(wi.z, T(1e-6F));
    return select(lanes_, select((wi.z > T(1e-6F)) & (own_wi.z > T(1e-6F)), ratio, T(0)), T(1));
  }
  /// What relief leaves of light from wi to a diffuse layer.
  T softness(const Vec3<T>& wi, const Vec3<T>& own_wi) const {
    return select(lanes_, relief_shadow(wi.z, own_wi.z, frame_.z.z), T(1));
  }
  /// Turns f about the layer's normal into f about the surface's, and takes away the pdf where no light comes from.
  template <class F>
  void count_about_surface(const Vec3<T>& wi, const Vec3<T>& own_wi, F& f, T& pdf) const {
    const T part = share(wi, own_wi);
    f = f * part;
    pdf = select(part > T(0), pdf, T(0));
  }
  /// The ratio of the cosines alone, of light that comes through both from below.
  T share_from_below(const Vec3<T>& wi, const Vec3<T>& own_wi) const {
    return select(lanes_, own_wi.z / min(wi.z, T(-1e-6F)), T(1));
  }

 private:
  Mask<T> lanes_;
  Frame<T> frame_;
  Vec3<T> own_wo_;
};

template <class T>
struct LayerFrames {
  LayerFrame<T> diffuse, base, coat;

  /// normals, wo: in the surface's local frame.
  LayerFrames(const LayerNormals<T>& normals, const Vec3<T>& wo)
      : diffuse(normals.lanes, normals.diffuse, wo),
        base(normals.lanes, normals.base, wo),
        coat(normals.lanes, normals.coat, wo) {}
};

}  // namespace raytrace
