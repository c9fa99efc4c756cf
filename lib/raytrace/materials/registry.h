// All materials. A new material: its own pair of files, one include and one name here, and one
// include in kernels.h. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/materials/conductor.h"
#include "raytrace/materials/dielectric.h"
#include "raytrace/materials/emissive.h"
#include "raytrace/materials/fog.h"
#include "raytrace/materials/hair.h"
#include "raytrace/materials/matte.h"
#include "raytrace/materials/mirror.h"
#include "raytrace/materials/openpbr.h"
#include "raytrace/materials/phong.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Materials = TypeList<Matte, Phong, Emissive, Mirror, Conductor, Dielectric, OpenPbr, Fog, Hair>;

}  // namespace raytrace
