// Radiances beyond the bound that the film's unit is made from. No integrator exceeds its own, so films with finer
// units stand for them.
#include <algorithm>
#include <cmath>
#include <functional>

#include "raytrace/batch/checkpoint.h"
#include "raytrace/math/limbs.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// Of a film whose unit is 2^finer times smaller than the scene's.
FilmSettings finer_settings(const Scene& scene, const SceneDescription& description, int finer) {
  FilmSettings settings = film_settings(scene, description, {1, 5, whole(description), {}});
  settings.unit_exponent -= finer;
  return settings;
}

using Channel128 = std::function<Int128(const Film&, int, int)>;

Int128 red(const Film& film, int x, int y) { return from_limbs({film.sum(x, y).red, film.high(x, y).red}); }
Int128 blue(const Film& film, int x, int y) { return from_limbs({film.sum(x, y).blue, film.high(x, y).blue}); }

bool same_sums(const Film& a, const Film& b) {
  const Region& region = a.region();
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x)
      if (a.sum(x, y) != b.sum(x, y) || a.high(x, y) != b.high(x, y)) return false;
  return true;
}

/// Nothing but the background: red 0.1, blue 0.4.
SceneDescription empty_scene(int width, int height, int samples) {
  return parsed_scene(scene_text(width, height, samples, ""));
}

}  // namespace

TEST_CASE("a radiance far beyond the bound counts its exact units") {
  const SceneDescription description = empty_scene(9, 5, 3);
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {1, isa});
    for (const int finer : {0, 7, 8, 9, 10, 20, 30, 38}) {
      Film film(finer_settings(*scene, description, finer));
      const RenderReport report = render(*scene, film, 3, 1);
      INFO(isa << ", a unit finer by 2^" << finer);
      CHECK(report.invalid_samples.count == 0);
      CHECK(film.has_high() == (finer > 18));
      const double inverse_unit = std::ldexp(1.0, -film.settings().unit_exponent);
      int wrong = 0;
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) {
          wrong += red(film, x, y) != 3 * static_cast<Int128>(std::nearbyint(0.1F * inverse_unit));
          wrong += blue(film, x, y) != 3 * static_cast<Int128>(std::nearbyint(0.4F * inverse_unit));
          wrong += film.sum(x, y).samples != 3 || film.pixel(x, y).blue != 0.4F;
        }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("a radiance beyond 2^83 units is reported, and counted as black") {
  const SceneDescription description = empty_scene(9, 5, 3);
  const auto scene = build_scene(description, {1, {}});
  for (const int finer : {39, 40}) {  // 0.4 is 1.6 * 2^43 of the scene's units
    Film film(finer_settings(*scene, description, finer));
    const RenderReport report = render(*scene, film, 3, 1);
    INFO("a unit finer by 2^" << finer);
    CHECK(report.invalid_samples.count == (finer == 39 ? 0 : 9 * 5 * 3));
    CHECK((blue(film, 8, 4) != 0) == (finer == 39));
    CHECK((red(film, 8, 4) != 0) == (finer == 39));
    CHECK(film.sum(8, 4).samples == 3);
  }
}

TEST_CASE("many samples near the largest that are added at once do not leave a block's sums") {
  constexpr int samples = 20'000;  // of 1.6 * 2^49 units each
  const SceneDescription description = empty_scene(2, 1, samples);
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {1, isa});
    const FilmSettings settings = finer_settings(*scene, description, 6);
    Film sums(settings), means(settings, FilmContent::means);
    render(*scene, sums, samples, 1);
    render(*scene, means, samples, 1);
    INFO(isa);
    const double term = 0.4F * std::ldexp(1.0, -settings.unit_exponent);
    CHECK((blue(sums, 1, 0) == samples * static_cast<Int128>(term)));
    CHECK(identical(sums.pixel(1, 0), means.pixel(1, 0)));
    CHECK(std::abs(means.pixel(1, 0).blue - 0.4F) <= 0x1p-25F);
  }
}

TEST_CASE("large terms have the same sums however a render is cut") {
  const SceneDescription description = parsed_scene(busy_scene(61, 47, 40));
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {3, isa});
    const int finer = GENERATE(12, 24);  // some beyond 2^51 units; nearly all, and many sums beyond 64 bits
    const FilmSettings settings = finer_settings(*scene, description, finer);
    Film once(settings);
    render(*scene, once, 40, 1);
    INFO(isa << ", a unit finer by 2^" << finer);
    CHECK(once.has_high() == (finer == 24));

    Film passes(settings);
    for (const std::uint32_t target : {1U, 3U, 8U, 24U, 40U}) render(*scene, passes, target, 3);
    CHECK(same_sums(passes, once));

    Film pieces(settings);
    for (const SampleRange range : {SampleRange{0, 5}, SampleRange{5, 16}, SampleRange{21, 19}}) {
      FilmSettings part = settings;
      part.samples = range;
      Film piece(part);
      render(*scene, piece, range.count, 3);
      for (int y = 0; y < 47; ++y)
        for (int x = 0; x < 61; ++x) pieces.add(x, y, piece.sum(x, y), piece.high(x, y));
    }
    CHECK(same_sums(pieces, once));

    Film means(settings, FilmContent::means);
    render(*scene, means, 40, 3);
    const std::vector<Pixel> wanted = once.pixels(), got = means.pixels();
    CHECK(std::equal(wanted.begin(), wanted.end(), got.begin(),
                     [](const auto& a, const auto& b) { return identical(a, b); }));
  }
}

TEST_CASE("a checkpoint keeps both limbs, and a render goes on from it, below 0 and without background, too") {
  const bool negative = GENERATE(false, true), transparent = GENERATE(false, true);
  SceneDescription description = parsed_scene(busy_scene(40, 30, 8));
  if (negative) {
    std::get<LightItems<AmbientLight>>(description.lights).front().parameters.scaleradiance = -1000;
    description.viewplane.background.red = -1000;
  }
  const auto scene = build_scene(description, {1, {}});
  for (const int finer : {0, 24}) {
    FilmSettings settings = finer_settings(*scene, description, finer);
    settings.transparent = transparent;
    Film film(settings), whole_film(settings);
    render(*scene, film, 4, 1);
    render(*scene, whole_film, 8, 1);
    CHECK(whole_film.has_high() == (finer != 0));
    PieceIdentity identity;
    identity.provenance = provenance_of(*scene, description);
    identity.film = film.settings();
    identity.whole = whole(description);
    const TemporaryFolder folder;
    ImageMetadata metadata;
    metadata.software = identity.provenance.software;
    metadata.seed = identity.film.seed;
    write_checkpoint(folder.file("c.exr"), film, identity, metadata);
    Film got(film.settings());
    read_checkpoint(folder.file("c.exr"), identity, got);
    CHECK(same_sums(got, film));
    render(*scene, got, 8, 1);
    CHECK(same_sums(got, whole_film));
  }
}

}  // namespace raytrace::test
