// Whether a sanitizer is in this build that makes it much slower and brings an allocator of its own.
#pragma once

#if defined(__has_feature)
#define RAYTRACE_HAS_FEATURE(name) __has_feature(name)
#else
#define RAYTRACE_HAS_FEATURE(name) 0
#endif

namespace raytrace::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || RAYTRACE_HAS_FEATURE(address_sanitizer) || \
    RAYTRACE_HAS_FEATURE(thread_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace raytrace::test
