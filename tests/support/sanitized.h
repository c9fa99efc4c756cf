// Whether the build has a sanitizer: tests that draw or trace much do less there.
#pragma once

#if defined(__has_feature)
#define RAYTRACE_HAS_FEATURE(name) __has_feature(name)
#else
#define RAYTRACE_HAS_FEATURE(name) 0
#endif

namespace raytrace::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || RAYTRACE_HAS_FEATURE(address_sanitizer) || \
    RAYTRACE_HAS_FEATURE(thread_sanitizer)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace raytrace::test
