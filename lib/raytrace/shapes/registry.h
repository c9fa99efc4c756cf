// All shapes. A new shape: its own pair of files, one include and one name here, and one
// include in kernels.h. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/math/type_list.h"
#include "raytrace/shapes/annulus.h"
#include "raytrace/shapes/box.h"
#include "raytrace/shapes/cone.h"
#include "raytrace/shapes/curve.h"
#include "raytrace/shapes/cylinder.h"
#include "raytrace/shapes/disk.h"
#include "raytrace/shapes/instance.h"
#include "raytrace/shapes/mesh.h"
#include "raytrace/shapes/model.h"
#include "raytrace/shapes/plane.h"
#include "raytrace/shapes/rectangle.h"
#include "raytrace/shapes/sphere.h"
#include "raytrace/shapes/sphere_cloud.h"
#include "raytrace/shapes/torus.h"
#include "raytrace/shapes/triangle.h"

namespace raytrace {

using Shapes = TypeList<Plane, Sphere, Triangle, Cylinder, Torus, Disk, Rectangle, Box, Cone, Annulus>;

/// All that <objects> holds: the shapes; meshes, which are many triangles or quads each; clouds of many spheres; curves
/// of many strands; instances of groups; models, until load_meshes() has made meshes and lights of them.
using Objects =
    Appended<Appended<Appended<Appended<Appended<Shapes, Mesh>::type, SphereCloud>::type, Curve>::type, Instance>::type,
             Model>::type;

}  // namespace raytrace
