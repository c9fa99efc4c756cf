// The scene's geometry in Embree: packets of rays in, nearest hits out.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "raytrace/accel/callbacks.h"
#include "raytrace/accel/direction_buffer.h"
#include "raytrace/accel/embree.h"
#include "raytrace/accel/few_objects.h"
#include "raytrace/accel/instance_callbacks.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// How the rays of one call relate: it decides how they are traced, not what they hit.
enum class Coherence {
  coherent,    ///< neighbours take the same way (camera rays, shadow rays to one light): a packet query
  incoherent,  ///< they scatter (bounces): one query a ray, up to 4 times faster there (docs/design.md); in scenes of
               ///< few objects, a packet with all of them (accel/few_objects.h)
};

/// Owns Embree's device and scene of a geometry table's objects. Embree's BVH is built when it is first asked for, by
/// the threads that ask: direction buffers may answer all rays. What builds it throws RenderError with Embree's
/// message, std::bad_alloc where memory runs out.
class Accelerator {
 public:
  /// For up to `threads` threads; isa is Embree's name of the best instruction set that it may use. fogs: 1 for each
  /// material that is one, else 0; may be empty. The table must outlive it. Throws as building does.
  Accelerator(const GeometryTable& table, int threads, const char* isa, std::span<const std::uint8_t> fogs);
  ~Accelerator();

  /// A direction buffer around each of the origins, where there is one and it would pay. With `threads` threads.
  std::vector<std::optional<DirectionBuffer>> direction_buffers(std::span<const std::optional<BufferOrigin>> origins,
                                                                int threads) const;

  /// Nearest hits in the lanes of `active`, which then are where the rays end; of those at equal distances, the first
  /// by geometry and primitive. Rays that Embree cannot take (a component that is NaN, infinite or beyond 1.8e18, or a
  /// direction of length 0) hit nothing. origin_buffer: from the point that all rays start at, their directions being
  /// of unit length; null if there is none. The same answer, sooner. Where near is negative, shapes with bounds are hit
  /// from the origin on.
  /// identity: null where no ray passes a surface and nothing moves; else there are no buffers.
  Hits intersect(Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                 const DirectionBuffer* origin_buffer = nullptr, const RayIdentity* identity = nullptr) const;

  /// The lanes of `active` in which anything lies between near and far. end_buffer: from where all rays go, which is
  /// the point origin + direction, where they end, the same for all but for the rounding of their directions; or
  /// infinitely far, with the same direction for all. Null if there is no such place. The same answer, sooner.
  MaskN occluded(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence,
                 const DirectionBuffer* end_buffer = nullptr, const RayIdentity* identity = nullptr) const;

  /// The surfaces that were hit, where the rays end, with their normals on the side that the rays come from; lanes
  /// without a hit hold anything.
  SurfaceInteraction<FloatN> surface(const Ray<FloatN>& rays, const Hits& hits) const;

  /// What Embree holds by now.
  std::uint64_t bvh_bytes() const;

  /// "3.13.5"
  std::string embree_version() const;

  /// The two parts of a query, for tests and benchmarks that put their own to Embree: the shapes without end, and the
  /// scene that holds all others, whose rays need embree::Query. `active`: lanes that Embree can take.
  Hits intersect_unbounded(Ray<FloatN>& rays, const MaskN& active, const RayIdentity* identity = nullptr) const;
  MaskN occluded_unbounded(const Ray<FloatN>& rays, const MaskN& active, const RayIdentity* identity = nullptr) const;
  /// For them as well: from now on rays that scatter go to Embree, however few objects there are.
  void use_embree_alone() { few_objects_.clear(); }
  RTCScene embree_scene() const {
    if (!is_built_.load(std::memory_order_acquire)) build();
    return scene_.get();
  }

  /// Whether more than one object is a fog, so that boundaries may lie in each other.
  bool has_several_fogs() const { return has_several_fogs_; }

 private:
  struct Report;
  /// What the tables could tell, without a branch on the shape's type, which would take what fetch_record() gains.
  struct RecordsInMemory {
    const std::byte* first = nullptr;
    std::size_t record_size = 0;
  };

  embree::Scene new_scene() const;
  /// A scene of a table's own objects, without instances. shapes: receives their callbacks.
  embree::Scene make_scene(const GeometryTable& table, InstanceCallbacks::Shapes& shapes) const;
  void add_instances();
  /// Whether there are any that move, or that stand still.
  bool has_instances(bool that_move) const;
  void add_fogs(std::span<const std::uint8_t> fogs);
  void build() const;
  /// Asks for the memory of an object's record, without waiting for it.
  RAYTRACE_INLINE void fetch_record(const DirectionBuffer::Object& object) const {
    const RecordsInMemory& records = records_in_memory_[object.shape_type];
    __builtin_prefetch(records.first + object.primitive * records.record_size);
  }
  /// The rays of lanes that hit instances, before the instances' transforms.
  Ray<FloatN> in_instances(const Ray<FloatN>& rays, const Hits& hits) const;
  /// And the way back, of what was hit.
  void to_world(const Hits& hits, SurfaceInteraction<FloatN>& surface) const;
  /// Whether rays that scatter are tested with all objects, which are few, and not put to Embree.
  bool tests_all(Coherence coherence, const RayIdentity* identity) const {
    return !few_objects_.empty() && coherence == Coherence::incoherent && identity == nullptr;
  }
  // Those of candidates return the lanes that are left to Embree. distance: of the hits so far, or where the rays end;
  // rays.far: as far as they are followed.
  void intersect_bvh(const Ray<FloatN>& rays, const MaskN& active, Coherence coherence, const RayIdentity* identity,
                     FloatN& distance, Hits& hits) const;
  MaskN intersect_candidates(const DirectionBuffer& buffer, Ray<FloatN>& rays, const MaskN& active, FloatN& distance,
                             Hits& hits) const;
  MaskN occluded_by_candidates(const DirectionBuffer& buffer, const Ray<FloatN>& rays, const MaskN& active,
                               const MaskN& in_reach, MaskN& occluded) const;

  std::unique_ptr<Report> report_;  ///< before device_, which still reports while it ends
  const GeometryTable& table_;
  std::array<RecordsInMemory, Shapes::size> records_in_memory_;  ///< of each table
  FewObjects few_objects_;
  embree::Device device_;
  std::vector<embree::Scene> group_scenes_;
  InstanceCallbacks instance_callbacks_;
  std::array<InstanceGeometry, 2> instance_geometries_;  ///< what stands still, what moves
  embree::Scene scene_;
  /// Of those geometries that have fogs, for rays that look for their boundaries; null if there is none.
  embree::Scene fog_scene_;
  bool has_several_fogs_ = false;
  mutable std::atomic<bool> is_built_{false};
};

}  // namespace raytrace
