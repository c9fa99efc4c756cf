// Points drawn on patches: as often as their density says, which integrates to 1, near and far.
//
// Wide code is compiled for each instruction set apart, so the test has its own.
#include "raytrace/scene/patch_sampling.cpp"  // NOLINT(bugprone-suspicious-include)

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "raytrace/scene/patch_geometry.cpp"  // NOLINT(bugprone-suspicious-include)
#include "raytrace/scene/patch_shares.cpp"    // NOLINT(bugprone-suspicious-include)
#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

struct FlatPatch {
  const char* name;
  PatchShape shape;
  Vec3d origin, a, b, from;
  bool near;  ///< whether it is drawn by solid angle
};

const FlatPatch flat_patches[] = {
    {"a triangle", PatchShape::triangle, {-0.5, 0, 0}, {0.5, 0.1, 0.6}, {1, 0.2, -0.2}, {0.1, -0.3, 0.1}, true},
    {"its back", PatchShape::triangle, {-0.5, 0, 0}, {1, 0.2, -0.2}, {0.5, 0.1, 0.6}, {0.1, 0.7, 0.1}, true},
    {"a rectangle", PatchShape::parallelogram, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.6, 0.3}, true},
    {"near a corner", PatchShape::parallelogram, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.02, 0.02, 0.05}, true},
    {"from the side", PatchShape::parallelogram, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.5, 0.5, 0.03}, true},
    {"a strip", PatchShape::parallelogram, {0, 0, 0}, {10, 0, 0}, {0, 0.1, 0}, {3, 0.05, 0.1}, true},
    {"skewed, far out", PatchShape::parallelogram, {90, 200, 50}, {1, 0, 0}, {0.4, 1, 0}, {90.4, 200.7, 50.5}, true},
    {"almost in it", PatchShape::parallelogram, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0.002}, false},
    {"far away", PatchShape::parallelogram, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.7, 30}, false}};

}  // namespace

TEST_CASE("points of flat patches are drawn with their density, which integrates to 1") {
  constexpr int cells = 16, parts = 64, samples = 200000;
  // Of two textures: the patches' is the second.
  PatchShares shares(8);
  std::mt19937 texels(3);
  for (int texture = 0; texture < 2; ++texture) {
    std::vector<float> radiances(64);
    for (float& radiance : radiances) radiance = texels() % 4 == 0 ? 1.0F : 0.02F;
    shares.add(radiances);
  }
  shares.add({});
  const PatchTextures textures{shares, IntN(1)}, even{shares, IntN(2)};
  const std::array<const PatchTextures*, 3> all_textures{nullptr, &textures, &even};
  const PatchTextures* const textures_or_none = all_textures.at(GENERATE(0U, 1U, 2U));
  const bool is_textured = textures_or_none == &textures;
  INFO((textures_or_none == nullptr ? "without textures"
        : is_textured               ? "with an uneven texture"
                                    : "beside one that has"));
  for (const FlatPatch& flat : flat_patches) {
    INFO(flat.name);
    const PatchRecord<FloatN> patch{spread(flat.origin), spread(flat.a), spread(flat.b),
                                    FloatN(PatchCode::of(flat.shape, 5, false))};
    const Vec3<FloatN> from = spread(flat.from);
    const Vec3d across = cross(flat.a, flat.b), normal = normalize(across);
    const bool is_triangle = flat.shape == PatchShape::triangle;
    if (!is_textured) CHECK(all(FlatView(patch, from, textures_or_none).near) == flat.near);

    std::vector<double> expected(cells * cells), observed(cells * cells);
    double integral = 0;
    constexpr int steps = cells * parts;
    for (int row = 0; row < steps; ++row)
      for (int first = 0; first < steps; first += packet_lanes) {
        const double v = (row + 0.5) / steps;
        const auto u_of = [&](std::size_t lane) { return (first + static_cast<double>(lane) + 0.5) / steps; };
        const Vec3<FloatN> points =
            vectors_of([&](std::size_t lane) { return flat.origin + flat.a * u_of(lane) + flat.b * v; });
        const FloatN pdf = patch_pdf(patch, from, points, spread(normal), textures_or_none);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          if (is_triangle && u_of(lane) + v > 1) continue;
          const Vec3d way = flat.origin + flat.a * u_of(lane) + flat.b * v - flat.from;
          const double distance = length(way), area = length(across) / steps / steps;
          const double share = double{pdf.get(lane)} * area * std::abs(dot(way, normal)) / std::pow(distance, 3);
          const int cell = row / parts * cells + (first + static_cast<int>(lane)) / parts;
          expected[static_cast<std::size_t>(cell)] += share * samples;
          integral += share;
        }
      }
    CHECK(integral == Approx(1).epsilon(2e-3));

    std::mt19937 random(5);
    const auto numbers = [&] {
      return batch_of<FloatN>([&](std::size_t) { return static_cast<double>(random() >> 8U) * 0x1p-24; });
    };
    double worst_place = 0;
    bool all_within = true;
    std::uint64_t other_pdf = 0;
    for (int i = 0; i < samples; i += packet_lanes) {
      const FloatN u1 = numbers(), u2 = numbers();
      const PatchSample sample = sample_patch(patch, from, u1, u2, textures_or_none);
      const FloatN pdf = patch_pdf(patch, from, sample.p, sample.normal, textures_or_none);
      other_pdf += count_lanes(!(abs(pdf - sample.pdf) <= sample.pdf * FloatN(is_textured ? 1e-6F : 0.0F)));
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const double u = double{sample.u.get(lane)}, v = double{sample.v.get(lane)};
        all_within = all_within && u >= 0 && v >= 0 && u <= 1 && v <= 1 && (!is_triangle || u + v < 1.000001);
        const Vec3d place = flat.origin + flat.a * u + flat.b * v;
        worst_place = std::max(worst_place, length(lane_of(sample.p, lane) - place));
        const auto cell = [](double x) {
          return static_cast<std::size_t>(std::min(static_cast<int>(x * cells), cells - 1));
        };
        ++observed[cell(v) * static_cast<std::size_t>(cells) + cell(u)];
      }
    }
    CHECK(all_within);
    // At the edges of cells, rounding takes a point to its neighbour.
    CHECK(other_pdf <= (is_textured ? std::uint64_t{samples} / 1000 : 0));
    CHECK(worst_place < 1e-4);
    CHECK(chi_square_deviation(observed, expected) < 4);
  }
}

TEST_CASE("annuli that are stretched to a line are no patches, since floats lose their width") {
  const auto is_patch = [](double inner, double width) {
    const Affine map{{1, 0, 0}, {0, width, 0}, {0, 0, 1}, {0, 0, 0}};
    return transformed({PatchShape::band, {}, {0, 0, 1}, {0.9, inner, 0}}, map, 0).has_value();
  };
  CHECK(is_patch(0.5, 1e-3));
  CHECK_FALSE(is_patch(0.5, 1e-5));
  CHECK(is_patch(0, 1e-5));
}

TEST_CASE("points of ellipses, with holes or without, are drawn evenly in area, with that density") {
  constexpr std::size_t rings = 8, sectors = 16;
  constexpr int samples = 100000;
  const Vec3d origin{2, 1, -3}, from{2.2, 0, -2.5};
  const Affine map{{0.8, 0.1, 0}, {0, -0.3, 0.1}, {0.3, 0.2, 1}, origin};
  const double outer = 0.5, inner = GENERATE(0.0, 0.3);
  const LightPatch ellipse = transformed({PatchShape::band, {}, {0, 0, 1}, {outer, inner, 0}}, map, 0).value();
  const double area = std::numbers::pi * (outer * outer - inner * inner) * length(cross(map.x, map.y));
  CHECK(area_of(ellipse) == Approx(area));
  const PatchRecord<FloatN> patch{spread(ellipse.origin), spread(ellipse.a), spread(ellipse.b),
                                  FloatN(PatchCode::of(ellipse.shape, 5, false))};
  std::vector<double> observed(rings * sectors);
  const std::vector<double> expected(rings * sectors, double{samples} / (rings * sectors));
  double worst_density = 0;
  bool all_within = true, same_pdf = true, front = true;
  std::mt19937 random(5);
  const auto numbers = [&] {
    return batch_of<FloatN>([&](std::size_t) { return static_cast<double>(random() >> 8U) * 0x1p-24; });
  };
  const Bounds box = box_of(ellipse);
  const Affine back = map.inverse();
  for (int i = 0; i < samples; i += packet_lanes) {
    const FloatN u1 = numbers(), u2 = numbers();
    const PatchSample sample = sample_patch(patch, spread(from), u1, u2);
    same_pdf = same_pdf && all(patch_pdf(patch, spread(from), sample.p, sample.normal) == sample.pdf);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3d p = lane_of(sample.p, lane), on_disk = back.point(p), normal = lane_of(sample.normal, lane);
      const Vec3d way = p - from;
      const double per_area = double{sample.pdf.get(lane)} * std::abs(dot(way, normal)) / std::pow(length(way), 3);
      worst_density = std::max(worst_density, std::abs(per_area * area - 1));
      front = front && dot(normal, map.z) > 0 && std::abs(dot(normal, normalize(map.x))) < 1e-5;
      const double place = (on_disk.x * on_disk.x + on_disk.y * on_disk.y - inner * inner) /
                           (outer * outer - inner * inner),
                   turn = std::atan2(on_disk.y, on_disk.x) / (2 * std::numbers::pi) + 0.5;
      all_within = all_within && place > -1e-5 && place < 1 + 1e-5 && std::abs(on_disk.z) < 1e-5;
      const auto has = [](float lower, double x, float upper) {
        return x > double{lower} - 1e-5 && x < double{upper} + 1e-5;
      };
      all_within = all_within && has(box.lower.x, p.x, box.upper.x) && has(box.lower.y, p.y, box.upper.y) &&
                   has(box.lower.z, p.z, box.upper.z);
      const auto cell = [](double x, std::size_t cells) {
        return static_cast<std::size_t>(std::clamp(x * static_cast<double>(cells), 0.0, double(cells) - 0.5));
      };
      ++observed[cell(place, rings) * sectors + cell(turn, sectors)];
    }
  }
  CHECK(all_within);
  CHECK(same_pdf);
  CHECK(front);
  CHECK(worst_density < 1e-4);
  CHECK(chi_square_deviation(observed, expected) < 4);
}

}  // namespace raytrace::test
