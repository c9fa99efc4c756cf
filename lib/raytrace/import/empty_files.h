// Files of meshes, clouds and strands in which nothing is: of a series of them, some frame's may be so.
#pragma once

#include <string_view>

#include "raytrace/xml/diagnostics.h"

namespace raytrace {

// The error of a reader whose file says that it has nothing.
inline constexpr const char* no_faces = "has no faces";
inline constexpr const char* no_points = "has no points";
inline constexpr const char* no_strands = "has no strands";

/// Whether a reader found nothing else wrong than that. Faces and points that cannot be rendered are another matter.
inline bool says_empty(const Diagnostics& found) {
  if (found.error_count() != 1 || found.kept().empty()) return false;
  const std::string_view last = found.kept().back().message;
  return last == no_faces || last == no_points || last == no_strands;
}

}  // namespace raytrace
