// AOVs of whole pictures: the same bits however a picture is cut, and what must hold between them.
#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/output/image_band.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

RenderSettings all_aovs(const Region& region) {
  RenderSettings settings;
  settings.threads = 1;
  settings.region = region;
  settings.aovs = aov_set(aov_names());
  return settings;
}

Film rendered_aovs(const Scene& scene, const SceneDescription& description, const RenderSettings& settings) {
  RayCounts rays;
  return render(scene, description, settings, rays);
}

/// All planes of AOVs of a region.
ImageBand aovs_of(const Film& film, const Region& rows) {
  ImageBand band{rows, {}};
  fill_aovs(band, 0, film);
  return band;
}

std::uint32_t bits_at(const ImageBand& band, std::size_t plane, int x, int y) {
  const auto at = static_cast<std::size_t>(y - band.region.y0) * static_cast<std::size_t>(band.region.width()) +
                  static_cast<std::size_t>(x - band.region.x0);
  return std::visit([at](const auto& values) { return std::bit_cast<std::uint32_t>(values[at]); }, band.planes[plane]);
}

/// The values of `part`'s pixels that are not those of the whole.
int differing(const ImageBand& part, const ImageBand& whole) {
  int count = 0;
  for (std::size_t plane = 0; plane < part.planes.size(); ++plane)
    for (int y = part.region.y0; y < part.region.y1; ++y)
      for (int x = part.region.x0; x < part.region.x1; ++x)
        count += bits_at(part, plane, x, y) != bits_at(whole, plane, x, y);
  return count;
}

/// The place of a channel among all AOVs' planes.
std::size_t plane_of(const std::string& name) {
  const std::vector<Channel> channels = aov_channels(aov_set(aov_names()));
  std::size_t plane = 0;
  while (channels.at(plane).name != name) ++plane;
  return plane;
}

float value_at(const ImageBand& band, const std::string& channel, int x, int y) {
  return std::bit_cast<float>(bits_at(band, plane_of(channel), x, y));
}

}  // namespace

TEST_CASE("AOVs are the same from any number of threads, in any crop, with any instruction set's blocks") {
  const SceneDescription description = parsed_scene(busy_scene(101, 77, 5));
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {4, isa});
    const Region everything = whole(description);
    const ImageBand wanted = aovs_of(rendered_aovs(*scene, description, all_aovs(everything)), everything);
    RenderSettings settings = all_aovs(everything);
    settings.threads = 4;
    CHECK(differing(aovs_of(rendered_aovs(*scene, description, settings), everything), wanted) == 0);
    std::mt19937 bits(5);
    const auto below = [&](int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); };
    for (int i = 0; i < 10; ++i) {
      Region crop;
      crop.x0 = below(101);
      crop.y0 = below(77);
      crop.x1 = i % 5 == 0 ? crop.x0 + 1 : crop.x0 + 1 + below(101 - crop.x0);
      crop.y1 = i % 7 == 0 ? crop.y0 + 1 : crop.y0 + 1 + below(77 - crop.y0);
      INFO(isa << ": " << crop.x0 << "," << crop.y0 << "," << crop.x1 << "," << crop.y1);
      CHECK(differing(aovs_of(rendered_aovs(*scene, description, all_aovs(crop)), crop), wanted) == 0);
    }
  }
}

TEST_CASE("AOVs are the same from any split of the samples, in passes or in pieces") {
  const SceneDescription description = parsed_scene(busy_scene(61, 43, 23));
  const auto scene = build_scene(description, {1, {}});
  const Region everything = whole(description);
  const ImageBand wanted = aovs_of(rendered_aovs(*scene, description, all_aovs(everything)), everything);

  Film passes(film_settings(*scene, description, all_aovs(everything)));
  for (const std::uint32_t samples : {1U, 4U, 17U, 23U}) render(*scene, passes, samples, 1);
  CHECK(differing(aovs_of(passes, everything), wanted) == 0);

  Film merged(film_settings(*scene, description, all_aovs(everything)));
  for (const auto& [first, count] : {std::pair{16U, 7U}, {0U, 3U}, {3U, 13U}}) {
    RenderSettings settings = all_aovs(everything);
    settings.samples = SampleRange{first, count, false};
    const Film piece = rendered_aovs(*scene, description, settings);
    const std::vector<Channel> channels = sum_channels(piece);
    ImageBand band{everything, {}};
    append_sums(band, channels, piece);
    CHECK(add_sums(band, channels, {first, count}, merged));
  }
  CHECK(differing(aovs_of(merged, everything), wanted) == 0);
}

TEST_CASE("the picture is the same with AOVs and without") {
  const SceneDescription description = parsed_scene(busy_scene(64, 48, 7));
  const auto scene = build_scene(description, {1, {}});
  RenderSettings settings = all_aovs(whole(description));
  const Film with = rendered_aovs(*scene, description, settings);
  settings.aovs = {};
  const Film without = rendered_aovs(*scene, description, settings);
  CHECK(without.aovs() == nullptr);
  CHECK(identical(with, without));
}

TEST_CASE("each AOV alone has the values it has among all") {
  const SceneDescription description = parsed_scene(busy_scene(40, 30, 4));
  const auto scene = build_scene(description, {1, {}});
  const Region everything = whole(description);
  const ImageBand all = aovs_of(rendered_aovs(*scene, description, all_aovs(everything)), everything);
  for (const std::string& name : aov_names()) {
    RenderSettings settings = all_aovs(everything);
    settings.aovs = aov_set({name});
    const ImageBand alone = aovs_of(rendered_aovs(*scene, description, settings), everything);
    const std::vector<Channel> channels = aov_channels(settings.aovs);
    REQUIRE(alone.planes.size() == channels.size());
    int wrong = 0;
    for (std::size_t i = 0; i < channels.size(); ++i)
      for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) wrong += bits_at(alone, i, x, y) != bits_at(all, plane_of(channels[i].name), x, y);
    INFO(name);
    CHECK(wrong == 0);
  }
}

TEST_CASE("mattes coverage what is hit; normals and albedos are of the same part") {
  const SceneDescription description = parsed_scene(busy_scene(24, 18, 64));
  const auto scene = build_scene(description, {1, {}});
  const Region everything = whole(description);
  const Film film = rendered_aovs(*scene, description, all_aovs(everything));
  const ImageBand aovs = aovs_of(film, everything);
  int crowded = 0, wrong = 0, empty = 0;
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 24; ++x) {
      std::uint32_t objects = 0, materials = 0;
      for (const IdCount& one : film.aovs()->ranked(x, y, 0)) objects += one.count;
      for (const IdCount& one : film.aovs()->ranked(x, y, 1)) materials += one.count;
      wrong += objects != film.sum(x, y).hits || materials != film.sum(x, y).hits;
      crowded += film.aovs()->ranked(x, y, 0).size() > 6;
      const float nx = value_at(aovs, "N.X", x, y), ny = value_at(aovs, "N.Y", x, y), nz = value_at(aovs, "N.Z", x, y);
      wrong += std::sqrt(nx * nx + ny * ny + nz * nz) > static_cast<float>(film.sum(x, y).hits) / 64 + 1e-5F;
      wrong += bits_at(aovs, plane_of("samples"), x, y) != 64;
      if (objects > 0) continue;
      ++empty;
      wrong += value_at(aovs, "Z", x, y) != 1e30F || bits_at(aovs, plane_of("id.object"), x, y) != 0;
      wrong += value_at(aovs, "P.X", x, y) != 0 || value_at(aovs, "albedo.R", x, y) != 0 || nx != 0;
      wrong += bits_at(aovs, plane_of("crypto_object00.R"), x, y) != 0;
    }
  CHECK(wrong == 0);
  CHECK(crowded > 10);  // more ids than a file holds
  CHECK(empty > 0);
}

}  // namespace raytrace::test
