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

#if RTC_VERSION_MAJOR >= 4
/// A user geometry's callback has to say in `valid` which lanes it hit.
inline constexpr bool callback_reports_hits = true;
#else
inline constexpr bool callback_reports_hits = false;
#endif

/// What Embree is asked for, and the nearest hits so far of its rays by their ids. The callbacks keep those
/// (callbacks.h): what Embree itself would keep depends on the order in which it visits objects of equal distance.
struct Query {
  static constexpr int most_rays = 32;
  static constexpr std::uint32_t none = RTC_INVALID_GEOMETRY_ID;

#if RTC_VERSION_MAJOR >= 4
  RTCRayQueryContext context;  ///< first of all members: Embree hands it to each callback
  RTCRayQueryFlags flags;
#else
  RTCIntersectContext context;  ///< first of all members: Embree hands it to each callback
#endif
  alignas(64) float distance[most_rays];          ///< where a ray ends: at its hit, or what it was given
  alignas(64) std::uint32_t geometry[most_rays];  ///< `none`: it has hit nothing
  alignas(64) std::uint32_t primitive[most_rays];
  alignas(64) std::uint32_t instance[most_rays];  ///< as InstanceTable numbers them; 0: none
  std::uint32_t current_instance = 0;             ///< whose scene the query is in
  std::int32_t current_material = -1;             ///< that it has in place of its objects'; -1: none
  const RayIdentity* cutouts = nullptr;           ///< null: rays pass nothing

  explicit Query(bool coherent) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
#else
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
  }

  /// The query in one of whose callbacks we are.
  template <class Arguments>
  static Query& of(const Arguments* arguments) {
    return *reinterpret_cast<Query*>(arguments->context);
  }

  /// Ray `id` ends at `end`, and has hit nothing.
  void start(unsigned id, float end) {
    distance[id] = end;
    geometry[id] = none;
    primitive[id] = 0;
    instance[id] = 0;
  }
};

/// Embree's types and calls for packets of one size; version 3 takes a context where version 4 takes arguments.
template <class RayHitType, class RayType, auto rtc_intersect, auto rtc_occluded>
class PacketOf {
 public:
  using RayHit = RayHitType;
  using Ray = RayType;

  static void intersect(const int* valid, RTCScene scene, Query& query, RayHit& rays) {
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = query.flags;
    arguments.context = &query.context;
    call(rtc_intersect, valid, scene, &rays, &arguments);
#else
    call(rtc_intersect, valid, scene, &query.context, &rays);
#endif
  }

  static void occluded(const int* valid, RTCScene scene, Query& query, Ray& rays) {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = query.flags;
    arguments.context = &query.context;
    call(rtc_occluded, valid, scene, &rays, &arguments);
#else
    call(rtc_occluded, valid, scene, &query.context, &rays);
#endif
  }

 private:
  template <class Function, class... Arguments>
  static void call(Function* function, [[maybe_unused]] const int* valid, Arguments... arguments) {
    if constexpr (std::is_invocable_v<Function*, Arguments...>)
      function(arguments...);
    else
      function(valid, arguments...);
  }
};

/// By size, which may be 1. The rays of a packet have ids that follow each other; for each, Query must say where it
/// ends. A single ray is always valid.
template <int size>
struct Packet;
template <>
struct Packet<1> : PacketOf<RTCRayHit, RTCRay, &rtcIntersect1, &rtcOccluded1> {};
template <>
struct Packet<4> : PacketOf<RTCRayHit4, RTCRay4, &rtcIntersect4, &rtcOccluded4> {};
template <>
struct Packet<8> : PacketOf<RTCRayHit8, RTCRay8, &rtcIntersect8, &rtcOccluded8> {};
template <>
struct Packet<16> : PacketOf<RTCRayHit16, RTCRay16, &rtcIntersect16, &rtcOccluded16> {};

}  // namespace raytrace::embree
