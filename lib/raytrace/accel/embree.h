// Embree 3.13 and 4.x behind one spelling. Nothing outside accel/ includes Embree.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <type_traits>

namespace raytrace::embree {

/// Embree handles that release themselves.
template <class Handle, void (*release)(Handle)>
struct Release {
  void operator()(Handle handle) const { release(handle); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<RTCDevice, rtcReleaseDevice>>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release<RTCScene, rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release<RTCGeometry, rtcReleaseGeometry>>;

/// Embree's packet types and calls by size; version 3 takes a context where version 4 takes arguments.
template <int size>
struct Packet;

#if RTC_VERSION_MAJOR >= 4
/// A user geometry's callback has to say in `valid` which lanes it hit.
inline constexpr bool callback_reports_hits = true;

class Query {
 public:
  explicit Query(bool coherent) {
    rtcInitRayQueryContext(&context_);
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    intersect_.context = occluded_.context = &context_;
  }
  RTCIntersectArguments* intersect() { return &intersect_; }
  RTCOccludedArguments* occluded() { return &occluded_; }

 private:
  RTCRayQueryContext context_;
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
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  RTCIntersectContext* context() { return &context_; }

 private:
  RTCIntersectContext context_;
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

RAYTRACE_EMBREE_PACKET(4)
RAYTRACE_EMBREE_PACKET(8)
RAYTRACE_EMBREE_PACKET(16)
#undef RAYTRACE_EMBREE_PACKET

}  // namespace raytrace::embree
