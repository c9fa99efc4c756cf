// Pictures without their background: what is left is the same to the last bit, and alpha says how much it is.
#include <algorithm>
#include <cmath>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

Film film_of(const Scene& scene, const SceneDescription& description, bool transparent,
             FilmContent content = FilmContent::sums) {
  RenderSettings settings{1, 0, whole(description)};
  settings.transparent = transparent;
  Film film(film_settings(scene, description, settings), content);
  render(scene, film, film.settings().samples.count, 1);
  return film;
}

}  // namespace

TEST_CASE("over its background, a transparent picture is the opaque one: in sums exactly") {
  const int samples = GENERATE(1, 3, 16, 64);  // packets of all shapes
  const SceneDescription description = parsed_scene(busy_scene(61, 47, samples));
  const Rgb<float> background(description.viewplane.background);
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {1, isa});
    const Film opaque = film_of(*scene, description, false), transparent = film_of(*scene, description, true);
    REQUIRE(opaque.unit() == transparent.unit());
    const auto units = [&](float radiance) { return std::llrint(double{radiance} / opaque.unit()); };
    int wrong = 0, in_part = 0;
    double worst = 0;
    for (std::size_t i = 0; i < opaque.sums().size(); ++i) {
      PixelSum sum = transparent.sums()[i];
      const std::int64_t missed = std::int64_t{sum.samples} - sum.hits;
      in_part += missed > 0 && sum.hits > 0;
      sum.red += missed * units(background.red);
      sum.green += missed * units(background.green);
      sum.blue += missed * units(background.blue);
      wrong += sum != opaque.sums()[i];

      const Pixel over = transparent.pixels()[i], wanted = opaque.pixels()[i];
      wrong += wanted.alpha != 1 || over.alpha != static_cast<float>(sum.hits) / static_cast<float>(sum.samples);
      worst = std::max({worst, std::abs(double{over.red + (1 - over.alpha) * background.red} - double{wanted.red}),
                        std::abs(double{over.blue + (1 - over.alpha) * background.blue} - double{wanted.blue})});
    }
    INFO(isa << ", " << samples << " samples");
    CHECK(wrong == 0);
    CHECK(worst < 1e-6);
    CHECK(in_part > (samples > 1 ? 10 : -1));
  }
}

TEST_CASE("films of means have the colour and the alpha of those of sums") {
  const bool transparent = GENERATE(false, true);
  const SceneDescription description = parsed_scene(busy_scene(40, 30, GENERATE(1, 5, 16)));
  const auto scene = build_scene(description, {1, {}});
  const FloatPicture sums = film_of(*scene, description, transparent);
  CHECK(identical(FloatPicture(film_of(*scene, description, transparent, FilmContent::means)), sums));
  const FloatPicture halves = film_of(*scene, description, transparent, FilmContent::half_means);
  double worst = 0;
  for (std::size_t i = 0; i < sums.pixels().size(); ++i)
    worst = std::max(worst, difference(halves.pixels()[i], sums.pixels()[i]));
  CHECK(worst < 2e-3);
}

}  // namespace raytrace::test
