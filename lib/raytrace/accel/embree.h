// Embree 3.13 and 4.x behind one spelling. Nothing outside accel/ includes Embree.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstdint>
#include <memory>
#include <type_traits>

namespace raytrace {
struct RayIdentity;  // cutouts.h
}

namespace raytrace::embree {

/// Embree handles that release themselves.
template <class Handle, void (*release)(Handle)>
struct Release {
  void operator()(Handle handle) const { release(handle); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<RTCDevice, rtcReleaseDevice>>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release<RTCScene, rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release<RTCGeometry, rtcReleaseGeometry>>;

/// The nearest hits so far of a query's rays, by the rays' ids, kept by the callbacks (callbacks.h): what Embree itself
/// would keep depends on the order in which it visits objects of equal distance. Embree hands it to each callback.
struct NearestHits {
  static constexpr int most_rays = 32;
  static constexpr std::uint32_t none = RTC_INVALID_GEOMETRY_ID;

#if RTC_VERSION_MAJOR >= 4
  RTCRayQueryContext context;
#else
  RTCIntersectContext context;
#endif
  alignas(64) float distance[most_rays];          ///< where a ray ends: at its hit, or what it was given
  alignas(64) std::uint32_t geometry[most_rays];  ///< `none`: it has hit nothing
  alignas(64) std::uint32_t primitive[most_rays];
  alignas(64) std::uint32_t instance[most_rays];  ///< as InstanceTable numbers them; 0: none
  std::uint32_t current_instance = 0;             ///< whose scene the query is in
  const RayIdentity* cutouts = nullptr;           ///< null: rays pass nothing

  /// Ray `id` ends at `end`, and has hit nothing.
  void start(unsigned id, float end) {
    distance[id] = end;
    geometry[id] = none;
    primitive[id] = 0;
    instance[id] = 0;
  }
};

/// Embree's packet types and calls by size; version 3 takes a context where version 4 takes arguments. The rays of a
/// packet have ids that follow each other; for each, NearestHits must say where it ends.
template <int size>
struct Packet;

#if RTC_VERSION_MAJOR >= 4
/// A user geometry's callback has to say in `valid` which lanes it hit.
inline constexpr bool callback_reports_hits = true;

class Query {
 public:
  explicit Query(bool coherent) {
    rtcInitRayQueryContext(&nearest.context);
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    intersect_.context = occluded_.context = &nearest.context;
  }
  RTCIntersectArguments* intersect() { return &intersect_; }
  RTCOccludedArguments* occluded() { return &occluded_; }

  NearestHits nearest;

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

inline void intersect1(RTCScene scene, Query& query, RTCRayHit& ray) { rtcIntersect1(scene, &ray, query.intersect()); }
inline void occluded1(RTCScene scene, Query& query, RTCRay& ray) { rtcOccluded1(scene, &ray, query.occluded()); }

#define RAYTRACE_EMBREE_PACKET(size)                                                      \
  template <>                                                                             \
  struct Packet<size> {                                                                   \
    using RayHit = RTCRayHit##size;                                                       \
    using Ray = RTCRay##size;                                                             \
    static void intersect(const int* valid, RTCScene scene, Query& query, RayHit& rays) { \
      rtcIntersect##size(valid, scene, &rays, query.intersect());                         \
    }                                                                                     \
    static void occluded(const int* valid, RTCScene scene, Query& query, Ray& rays) {     \
      rtcOccluded##size(valid, scene, &rays, query.occluded());                           \
    }                                                                                     \
  };
#else
inline constexpr bool callback_reports_hits = false;

class Query {
 public:
  explicit Query(bool coherent) {
    rtcInitIntersectContext(&nearest.context);
    nearest.context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  RTCIntersectContext* context() { return &nearest.context; }

  NearestHits nearest;
};

inline void intersect1(RTCScene scene, Query& query, RTCRayHit& ray) { rtcIntersect1(scene, query.context(), &ray); }
inline void occluded1(RTCScene scene, Query& query, RTCRay& ray) { rtcOccluded1(scene, query.context(), &ray); }

#define RAYTRACE_EMBREE_PACKET(size)                                                      \
  template <>                                                                             \
  struct Packet<size> {                                                                   \
    using RayHit = RTCRayHit##size;                                                       \
    using Ray = RTCRay##size;                                                             \
    static void intersect(const int* valid, RTCScene scene, Query& query, RayHit& rays) { \
      rtcIntersect##size(valid, scene, query.context(), &rays);                           \
    }                                                                                     \
    static void occluded(const int* valid, RTCScene scene, Query& query, Ray& rays) {     \
      rtcOccluded##size(valid, scene, query.context(), &rays);                            \
    }                                                                                     \
  };
#endif

/// The same of any size, single rays included, for queries in the callbacks of others, with their context.
template <int size>
struct AnyPacket;

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#define RAYTRACE_EMBREE_ANY_PACKET(size, suffix, valid_argument)                                                    \
  template <>                                                                                                       \
  struct AnyPacket<size> {                                                                                          \
    using RayHit = RTCRayHit##suffix;                                                                               \
    using Ray = RTCRay##suffix;                                                                                     \
    static void intersect([[maybe_unused]] const int* valid, RTCScene scene, QueryContext* context, RayHit& rays) { \
      RTCIntersectArguments arguments;                                                                              \
      rtcInitIntersectArguments(&arguments);                                                                        \
      arguments.context = context;                                                                                  \
      rtcIntersect##size(valid_argument scene, &rays, &arguments);                                                  \
    }                                                                                                               \
    static void occluded([[maybe_unused]] const int* valid, RTCScene scene, QueryContext* context, Ray& rays) {     \
      RTCOccludedArguments arguments;                                                                               \
      rtcInitOccludedArguments(&arguments);                                                                         \
      arguments.context = context;                                                                                  \
      rtcOccluded##size(valid_argument scene, &rays, &arguments);                                                   \
    }                                                                                                               \
  };
#else
using QueryContext = RTCIntersectContext;
#define RAYTRACE_EMBREE_ANY_PACKET(size, suffix, valid_argument)                                                    \
  template <>                                                                                                       \
  struct AnyPacket<size> {                                                                                          \
    using RayHit = RTCRayHit##suffix;                                                                               \
    using Ray = RTCRay##suffix;                                                                                     \
    static void intersect([[maybe_unused]] const int* valid, RTCScene scene, QueryContext* context, RayHit& rays) { \
      rtcIntersect##size(valid_argument scene, context, &rays);                                                     \
    }                                                                                                               \
    static void occluded([[maybe_unused]] const int* valid, RTCScene scene, QueryContext* context, Ray& rays) {     \
      rtcOccluded##size(valid_argument scene, context, &rays);                                                      \
    }                                                                                                               \
  };
#endif
#define RAYTRACE_EMBREE_VALID valid,
RAYTRACE_EMBREE_ANY_PACKET(1, , )
RAYTRACE_EMBREE_ANY_PACKET(4, 4, RAYTRACE_EMBREE_VALID)
RAYTRACE_EMBREE_ANY_PACKET(8, 8, RAYTRACE_EMBREE_VALID)
RAYTRACE_EMBREE_ANY_PACKET(16, 16, RAYTRACE_EMBREE_VALID)
#undef RAYTRACE_EMBREE_ANY_PACKET
#undef RAYTRACE_EMBREE_VALID

RAYTRACE_EMBREE_PACKET(4)
RAYTRACE_EMBREE_PACKET(8)
RAYTRACE_EMBREE_PACKET(16)
#undef RAYTRACE_EMBREE_PACKET

}  // namespace raytrace::embree
