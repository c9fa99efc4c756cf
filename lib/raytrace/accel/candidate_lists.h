// How the lists of a direction buffer are made.
#pragma once

#include <optional>
#include <span>

#include "raytrace/accel/cube_projection.h"
#include "raytrace/accel/direction_buffer.h"

namespace raytrace {

/// For each cell of grids on the projection's faces, the objects that may be met through it. None where that would not
/// pay, as DirectionBuffer::make() says. The lists do not depend on the number of threads.
std::optional<DirectionBuffer::Lists> make_candidate_lists(const CubeProjection& projection,
                                                           std::span<const BoundedObject> objects, int threads);

}  // namespace raytrace
