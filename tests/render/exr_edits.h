// Edits of the EXR files that a test damages.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "raytrace/batch/checkpoint.h"
#include "support/exr_bytes.h"
#include "support/sample_pieces.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

using Edit = std::function<void(ExrBytes&)>;

inline ExrBytes exr_of(const std::string& file) { return *ExrBytes::parsed(bytes_of(file)); }

/// What resuming says of a checkpoint of this piece.
inline std::string resume_refusal(const std::string& file, const SamplePiece& piece) {
  const PieceIdentity identity = identity_of(piece);
  Film film(identity.film);
  try {
    read_checkpoint(file, identity, film);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline void set_window(ExrBytes& exr, const char* name, const std::vector<std::int32_t>& edges) {
  exr.set(name, "box2i", little_endian(edges));
}

inline void edit_channels(ExrBytes& exr, const std::function<void(std::vector<ExrChannel>&)>& edit) {
  std::vector<ExrChannel> channels = channels_of(exr["channels"].value);
  edit(channels);
  exr["channels"].value = channels_value(channels);
}

inline ExrChannel& channel(std::vector<ExrChannel>& channels, const std::string& name) {
  for (ExrChannel& one : channels)
    if (one.name == name) return one;
  throw std::runtime_error("no channel " + name);
}

}  // namespace raytrace::test
