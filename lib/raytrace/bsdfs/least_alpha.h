// From which roughness on a surface is rough.
#pragma once

namespace raytrace {

/// The slopes' root mean square, alpha, of the smoothest surface with facets; what is smoother reflects as a mirror.
inline constexpr float least_alpha = 1e-3F;

}  // namespace raytrace
