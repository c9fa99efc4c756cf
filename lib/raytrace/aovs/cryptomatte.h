// Cryptomatte: mattes by the names of things, with soft edges (Friedman and Jones, "Fully Automatic ID Mattes with
// Support for Motion Blur and Transparency"; specification 1.2 at https://github.com/Psyop/Cryptomatte).
//
// A pixel holds pairs of an id and the share of the pixel that the things of that id cover, the largest first. An id
// is a hash of the name, so that it stays the same from frame to frame and from scene to scene.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace::cryptomatte {

/// Pairs that a picture stores of each pixel.
inline constexpr std::size_t pairs = 6;

/// MurmurHash3_x86_32 of Austin Appleby, with seed 0.
std::uint32_t murmur_hash3(std::string_view text);

/// The id of a name: its hash, but for one bit where that would be no normal number as the bits of a float.
std::uint32_t id_of(std::string_view name);

/// "layer00.R" (id), ".G" (share), ".B" (the next id), ".A" (its share), "layer01.R"...
std::vector<Channel> channels(std::string_view layer);

/// cryptomatte/<key>/name, hash, conversion and manifest.
std::vector<ImageAttribute> attributes(std::string_view layer, const std::vector<std::string>& names);

}  // namespace raytrace::cryptomatte
