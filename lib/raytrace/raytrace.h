// The library in one include: read a scene or make one, build it, render it, write the picture; batches of pictures
// with checkpoints and a time limit; pieces of a picture, and merging them. docs/library.md shows a whole program.
#pragma once

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/checkpoint.h"
#include "raytrace/batch/frames.h"
#include "raytrace/batch/merge_pieces.h"
#include "raytrace/batch/render_picture.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/description/check_scene.h"
#include "raytrace/description/load_images.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/output/image_file.h"
#include "raytrace/render/renderer.h"
