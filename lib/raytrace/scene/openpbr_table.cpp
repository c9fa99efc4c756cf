// Apart from the others: it takes as long to compile as all of them.
#include "raytrace/materials/openpbr_kernel.h"
#include "raytrace/scene/material_table.h"

namespace raytrace {

template class MaterialTableOf<OpenPbr>;

}  // namespace raytrace
