// Triangles and parallelograms that are cut into equal pieces, cuts * cuts of them, each of the whole's kind.
#pragma once

#include "raytrace/math/vec2.h"
#include "raytrace/shapes/light_patch.h"

namespace raytrace {

LightPatch piece_of(const LightPatch& whole, int cuts, int number);

/// How far along the whole's a and b a point is that is so far along those of the piece.
Vec2<float> in_whole(PatchShape shape, int cuts, int number, const Vec2<float>& in_piece);

/// The number of the piece that has the point of the whole so many pieces along a and b.
int piece_at(PatchShape shape, int cuts, const Vec2<float>& place);

}  // namespace raytrace
