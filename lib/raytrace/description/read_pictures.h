// Pictures of files, several at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

#include "raytrace/output/picture.h"

namespace raytrace {

/// What became of a picture.
struct PictureResult {
  std::optional<Picture> picture;
  std::exception_ptr error;

  /// The picture, or null if none was asked for. Throws what went wrong.
  const Picture* get() const {
    if (error) std::rethrow_exception(error);
    return picture ? &*picture : nullptr;
  }
};

/// Reads pictures on up to `threads` threads (0: all processors), at any time as many as have room in `memory` bytes,
/// or one. open(i): the i-th one's reader; null: it is not wanted. use(i, result): gets it. Both are called in the
/// order of i, on the caller's thread; what open() throws is the picture's error.
void read_pictures(std::size_t count, int threads, std::uint64_t memory,
                   const std::function<std::unique_ptr<PictureReader>(std::size_t i)>& open,
                   const std::function<void(std::size_t i, const PictureResult& result)>& use);

}  // namespace raytrace
