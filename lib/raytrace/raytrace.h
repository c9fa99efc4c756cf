// The library in one include: read a scene or make one, build it, render it, write the picture, merge pieces of one.
// docs/library.md shows a whole program.
#pragma once

#include "raytrace/batch/checkpoint.h"
#include "raytrace/batch/merge_pieces.h"
#include "raytrace/description/check_scene.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/output/image_file.h"
#include "raytrace/render/renderer.h"
