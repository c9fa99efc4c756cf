// Normal maps among pictures that may be maps of heights as well.
#pragma once

#include <string>

namespace raytrace {

/// Whether its colours are those of normals, which point up on the whole: their blue is more than their red and their
/// green; of halves, that they are no greys. A picture that cannot be read counts as one.
bool holds_normals(const std::string& file);

}  // namespace raytrace
