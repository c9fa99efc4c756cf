// Whether one text is somewhere in another.
#pragma once

#include <string_view>

namespace raytrace::test {

inline bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace raytrace::test
