// How the lists of a direction buffer are made.
#pragma once

#include <optional>
#include <span>

#include "raytrace/accel/direction_buffer.h"
#include "raytrace/accel/perspective.h"

namespace raytrace {

/// For each cell of grids on the perspective's faces, the objects that may be met through it. None where that would not
/// pay, as DirectionBuffer::make() says. The lists do not depend on the number of threads.
std::optional<DirectionBuffer::Lists> make_candidate_lists(const Perspective& perspective,
                                                           std::span<const PlacedObject> objects, int threads);

}  // namespace raytrace
