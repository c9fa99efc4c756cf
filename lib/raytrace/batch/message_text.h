// Parts of messages.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raytrace {

/// "1 object", "2 objects"
inline std::string counted(std::uint64_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

inline std::string joined(const std::vector<std::string>& texts, const char* separator) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
  return all;
}

}  // namespace raytrace
