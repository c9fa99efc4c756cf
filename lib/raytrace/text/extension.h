// The ends of files' names.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace raytrace {

/// Whether a file's name ends so, in small letters or capitals. extension: in small ones, with its dot.
inline bool has_extension(std::string_view file, std::string_view extension) {
  return file.size() >= extension.size() &&
         std::equal(extension.begin(), extension.end(), file.end() - static_cast<std::ptrdiff_t>(extension.size()),
                    [](char wanted, char c) { return wanted == std::tolower(static_cast<unsigned char>(c)); });
}

}  // namespace raytrace
