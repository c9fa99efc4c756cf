#include "raytrace/scene/patch_pieces.h"

#include <algorithm>

namespace raytrace {

namespace {

/// In a grid along a and b. Of a triangle's cells, each has one half in it, and all but the last of a row the other,
/// which is turned round.
struct Cell {
  int a, b;
  bool turned;
};

Cell cell_of(PatchShape shape, int cuts, int number) {
  if (shape != PatchShape::triangle) return {number % cuts, number / cuts, false};
  int b = 0;
  for (int row = 2 * cuts - 1; number >= row; row -= 2, ++b) number -= row;
  return {number / 2, b, number % 2 == 1};
}

}  // namespace

LightPatch piece_of(const LightPatch& whole, int cuts, int number) {
  const Cell cell = cell_of(whole.shape, cuts, number);
  const Vec3d a = whole.a * (1.0 / cuts), b = whole.b * (1.0 / cuts);
  if (!cell.turned) return {whole.shape, whole.origin + a * cell.a + b * cell.b, a, b};
  return {whole.shape, whole.origin + a * (cell.a + 1) + b * (cell.b + 1), -a, -b};
}

Vec2<float> in_whole(PatchShape shape, int cuts, int number, const Vec2<float>& in_piece) {
  const Cell cell = cell_of(shape, cuts, number);
  const auto along = [&](int begin, float place) {
    return (static_cast<float>(begin) + (cell.turned ? 1 - place : place)) / static_cast<float>(cuts);
  };
  return {along(cell.a, in_piece.x), along(cell.b, in_piece.y)};
}

int piece_at(PatchShape shape, int cuts, const Vec2<float>& place) {
  const auto cell_at = [](float x, int cells) {
    return static_cast<int>(std::clamp(x, 0.0F, static_cast<float>(cells) - 0.5F));
  };
  const int b = cell_at(place.y, cuts);
  if (shape != PatchShape::triangle) return b * cuts + cell_at(place.x, cuts);
  const int a = cell_at(place.x, cuts - b);
  const bool turned = place.x - static_cast<float>(a) + place.y - static_cast<float>(b) > 1 && a + 1 < cuts - b;
  return b * (2 * cuts - b) + 2 * a + (turned ? 1 : 0);
}

}  // namespace raytrace
