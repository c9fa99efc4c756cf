#include "raytrace/output/openimageio/edge_limits.h"

#include <limits>
#include <map>

namespace raytrace {

EdgeLimits edge_limits(const std::string& oiio_name) {
  constexpr int unlimited = std::numeric_limits<int>::max();
  constexpr int sixteen_bits = 65535;
  static const std::map<std::string, EdgeLimits> limits = {
      {"bmp", {1, sixteen_bits}},                        // OpenImageIO's own limit from 2.5 on, as for pnm
      {"gif", {1, sixteen_bits}}, {"heif", {1, 32768}},  // beyond it libheif reads nothing
      {"ico", {1, 256}},          {"iff", {1, 8192}},
      {"jpeg", {1, 65500}},       {"jpeg2000", {32, unlimited}},  // five times halved, it still has a pixel
      {"pnm", {1, sixteen_bits}}, {"rla", {1, sixteen_bits}},
      {"sgi", {1, sixteen_bits}}, {"targa", {1, sixteen_bits}},
      {"webp", {1, 16383}},
  };
  const auto found = limits.find(oiio_name);
  return found == limits.end() ? EdgeLimits{1, unlimited} : found->second;
}

}  // namespace raytrace
