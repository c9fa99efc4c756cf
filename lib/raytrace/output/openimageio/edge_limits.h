// How large and how small pictures of a format can be.
#pragma once

#include <string>

namespace raytrace {

/// In pixels, of each edge.
struct EdgeLimits {
  int least, most;
};

/// What OpenImageIO's writers take, and its readers give back, in all versions from 2.4 on. Not all of them say so
/// themselves: libjpeg ends the process, and a GIF gets the width modulo 65536. oiio_name: "jpeg", "targa".
EdgeLimits edge_limits(const std::string& oiio_name);

}  // namespace raytrace
