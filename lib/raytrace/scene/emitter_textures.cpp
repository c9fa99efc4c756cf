// What textures make of the surfaces that light is drawn from.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "raytrace/scene/emitter_table.h"
#include "raytrace/scene/flat_view.h"
#include "raytrace/scene/patch_pieces.h"

namespace raytrace {

std::vector<float> EmitterTable::radiances_of(const LightPatch& patch, const Affine& world_from_patch, bool is_second,
                                              const Range& range, std::int32_t primitive, const Making& making) {
  const LightPatch face{patch.shape, world_from_patch.point(patch.origin), world_from_patch.vector(patch.a),
                        world_from_patch.vector(patch.b)};
  const std::int32_t cells = making.cells * making.cells, all = making.cuts * making.cuts * cells;
  const double radius = std::max(length(face.a), length(face.b)) / (making.cuts * making.cells);
  SurfaceInteraction<FloatN> surface{};
  surface.ng = surface.ns = surface.wo =
      Vec3<FloatN>(Vec3f(normalize(world_from_patch.normal(cross(patch.a, patch.b)))));
  surface.front = MaskN(true);
  Hits hits;
  hits.instance = UintN(range.instance);
  hits.geometry = UintN(range.geometry);
  hits.primitive = IntN(primitive);
  hits.time = FloatN(0.5F);  // where things move, they are halfway
  std::vector<float> result;
  for (std::int32_t first = 0; first < all; first += packet_lanes) {
    const std::int32_t lanes = std::min<std::int32_t>(packet_lanes, all - first);
    alignas(64) std::array<float, packet_lanes> x{}, y{}, u{}, v{}, radiances{};
    const auto middle = [&](const IntN& cell) {
      return (to_float(cell) + FloatN(0.5F)) * FloatN(1 / static_cast<float>(making.cells));
    };
    const IntN cell = (IntN(first) + lane_numbers<IntN>()) & IntN(cells - 1), row = cell & IntN(making.cells - 1);
    const Vec2<FloatN> in_piece =
        flat_point(MaskN(face.shape == PatchShape::triangle),
                   middle((cell - row) >> std::countr_zero(static_cast<unsigned>(making.cells))), middle(row));
    for (std::int32_t lane = 0; lane < lanes; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      const Vec2<float> place =
          in_whole(face.shape, making.cuts, (first + lane) / cells, {in_piece.x.get(i), in_piece.y.get(i)});
      const Vec2<float> uv = range.turned(place, is_second);
      x[i] = place.x;
      y[i] = place.y;
      u[i] = uv.x;
      v[i] = uv.y;
    }
    hits.hit = first_lanes<FloatN>(lanes);
    hits.u = FloatN::load_aligned(u.data());
    hits.v = FloatN::load_aligned(v.data());
    hits.find_first();
    surface.p = Vec3<FloatN>(Vec3f(face.origin)) + Vec3<FloatN>(Vec3f(face.a)) * FloatN::load_aligned(x.data()) +
                Vec3<FloatN>(Vec3f(face.b)) * FloatN::load_aligned(y.data());
    making.radiance_at(hits, surface, FloatN(static_cast<float>(radius))).store_aligned(radiances.data());
    result.insert(result.end(), radiances.begin(), radiances.begin() + lanes);
  }
  return result;
}

void EmitterTable::weigh(Faces& faces, const Range& range, std::int32_t primitive, const MaterialEmission& material,
                         const Making& making) {
  // What look-ups miss may shine all the same: nothing is left out.
  constexpr float least_of_mean = 0.1F, least_of_most = 1e-4F;
  constexpr float uneven = 2;  // the brightest cell to the dimmest: less is not worth the longer way in the tree
  std::vector<float> cells, wholes;
  bool is_even = true;
  for (std::size_t i = 0; i < faces.patches.size(); ++i) {
    std::vector<float> face =
        radiances_of(faces.patches[i], faces.world_from_patches, range.is_mesh && i > 0, range, primitive, making);
    for (float& radiance : face) radiance = std::isfinite(radiance) ? radiance : material.radiance;
    double sum = 0;
    for (const float radiance : face) sum += double{radiance};
    const auto mean = static_cast<float>(sum / static_cast<double>(face.size()));
    const float least = std::max(mean * least_of_mean, material.radiance * least_of_most);
    for (float& radiance : face) radiance = std::max(radiance, least);
    const auto [dimmest, brightest] = std::minmax_element(face.begin(), face.end());
    is_even = is_even && *brightest <= uneven * *dimmest;
    // Textures that its emission has none of leave a material as it is.
    const bool is_whole = std::abs(mean - material.radiance) <= material.radiance * 1e-4F;
    wholes.push_back(is_whole ? material.radiance : std::max(mean, least));
    cells.insert(cells.end(), face.begin(), face.end());
  }
  if (is_even) {
    faces.radiances = std::move(wholes);
    return;
  }
  std::vector<LightPatch> patches;
  for (const LightPatch& face : faces.patches)
    for (std::int32_t i = 0; i < making.cuts * making.cuts; ++i) patches.push_back(piece_of(face, making.cuts, i));
  std::vector<float> pieces;
  const std::ptrdiff_t each = making.cells * making.cells;
  for (auto cell = cells.begin(); cell != cells.end(); cell += each)
    pieces.push_back(static_cast<float>(std::accumulate(cell, cell + each, 0.0) / static_cast<double>(each)));
  faces = {std::move(patches), std::move(pieces), making.cuts, std::move(cells), faces.world_from_patches};
}

}  // namespace raytrace
