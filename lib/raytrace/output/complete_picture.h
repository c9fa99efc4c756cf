// Whether a picture need not be rendered again.
#pragma once

#include <string>

namespace raytrace {

/// The file exists and, if it is an EXR, can be read, has all its rows and is not marked as a part of a picture (int
/// attribute raytrace:partial, 1). Other formats hold no mark; what is there counts as complete.
bool is_complete_picture(const std::string& file);

}  // namespace raytrace
