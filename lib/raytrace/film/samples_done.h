// How far a film has come.
#pragma once

#include <cstdint>
#include <string>

#include "raytrace/film/film.h"

namespace raytrace {

/// Of all pixels' numbers of samples.
struct SamplesDone {
  std::uint32_t least = 0, most = 0;
};

/// Of a film of means, whose pixels get all of their samples at once: 0, and all if any pixel has them.
SamplesDone samples_done(const Film& film);

/// "12 of 64 samples per pixel", or "8 to 12 of 64 samples per pixel"
std::string samples_done_text(const Film& film);

}  // namespace raytrace
