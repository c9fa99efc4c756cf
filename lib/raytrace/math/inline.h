// For the small functions of the innermost loop, which the compiler's own estimate would leave as calls through memory
// once the function that uses them is large.
#pragma once

#define RAYTRACE_INLINE inline RAYTRACE_INLINE_LAMBDA

/// Behind a lambda's parameters.
#define RAYTRACE_INLINE_LAMBDA __attribute__((always_inline))
