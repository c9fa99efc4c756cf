// All AOVs. A new AOV: its own file, one include and one name here. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/aovs/albedo.h"
#include "raytrace/aovs/crypto_material.h"
#include "raytrace/aovs/crypto_object.h"
#include "raytrace/aovs/depth.h"
#include "raytrace/aovs/material_id.h"
#include "raytrace/aovs/normal.h"
#include "raytrace/aovs/object_id.h"
#include "raytrace/aovs/position.h"
#include "raytrace/aovs/sample_count.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Aovs = TypeList<Depth, Position, Normal, Albedo, ObjectId, MaterialId, CryptoObject, CryptoMaterial, SampleCount>;

}  // namespace raytrace
