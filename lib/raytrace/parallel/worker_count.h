// How many threads a loop may ask oneTBB for.
#pragma once

#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>

namespace raytrace {

/// `wanted`, or all that there can be if that is less or `wanted` is 0: asking for more (Embree sets that limit, too)
/// would have oneTBB warn on the standard error output.
inline int worker_count(int wanted) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(wanted > 0 ? std::min(static_cast<std::size_t>(wanted), most) : most);
}

}  // namespace raytrace
