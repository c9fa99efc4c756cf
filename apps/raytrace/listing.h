// What a scene and a picture can be made of: --list.
#pragma once

#include <string>
#include <vector>

namespace raytrace {

/// "shapes", "materials", ...
std::vector<std::string> listing_kinds();

/// The names of all things of a kind, one a line, as scene files and options spell them.
std::string listing(const std::string& kind);

}  // namespace raytrace
