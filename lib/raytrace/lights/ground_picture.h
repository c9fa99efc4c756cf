// The environment that is darker, or brighter, below.
#pragma once

#include "raytrace/output/picture.h"

namespace raytrace {

/// White from above, and so much from below: even with height in between. As a picture of longitude and latitude
/// (environment_light.h).
Picture picture_of_ground(double ground);

}  // namespace raytrace
