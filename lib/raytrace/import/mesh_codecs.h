// The libraries that decode compressed mesh files, which a build may lack.
#pragma once

#include <string>
#include <vector>

namespace raytrace {

/// Those that are there, with their versions, such as "Draco 1.5.5".
std::vector<std::string> mesh_codecs();

}  // namespace raytrace
