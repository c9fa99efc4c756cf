// Parts of messages.
#pragma once

#include <cstdint>
#include <cstdio>
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

/// " in 1.250 s"
inline std::string time_taken(double seconds) {
  char text[64];
  std::snprintf(text, sizeof text, " in %.3f s", seconds);
  return text;
}

}  // namespace raytrace
