// Progress, and renders that are stopped.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

const Pixel untouched;

/// How many pixels are done; each must be as in the whole picture, the others untouched.
int whole_pixels(const FloatPicture& film, const FloatPicture& all) {
  int done = 0;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    if (identical(film.pixels()[i], untouched)) continue;
    if (!identical(film.pixels()[i], all.pixels()[i])) FAIL("pixel " << i << " is neither done nor untouched");
    ++done;
  }
  return done;
}

/// Sets the flag when the render beside it has computed for a while: on a busy machine it may not even have begun after
/// the same time.
void stop_after_some_rays(std::atomic<bool>& stop) {
  const std::clock_t end = std::clock() + CLOCKS_PER_SEC / 20;  // of all threads
  while (std::clock() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  stop = true;
}

}  // namespace

TEST_CASE("progress grows with each call, one call at a time, and ends at 1") {
  const SceneDescription description = parsed_scene(busy_scene(200, 130, 1));
  for (const int threads : {1, 4}) {
    const auto scene = build_scene(description, {threads, {}});
    std::vector<double> told;
    std::atomic<int> inside{0};
    bool overlapped = false;
    RayCounts rays;
    render(*scene, description, {threads, 0, {3, 7, 200, 130}}, rays, [&](const RenderProgress& progress) {
      overlapped = overlapped || ++inside > 1;
      told.push_back(progress.fraction);
      --inside;
    });
    CHECK(!overlapped);
    REQUIRE(told.size() > 10);
    CHECK(told.front() > 0);
    for (std::size_t i = 1; i < told.size(); ++i) CHECK(told[i] > told[i - 1]);
    CHECK(told.back() == 1.0);
  }
}

TEST_CASE("a render that is stopped ends early, with pixels that are done or untouched") {
  const SceneDescription description = parsed_scene(busy_scene(256, 192, 1));
  const FloatPicture all = rendered(description);
  for (const int threads : {1, 3}) {
    const auto scene = build_scene(description, {threads, {}});
    for (const int calls : {1, 5}) {
      std::atomic<bool> stop{false};
      int told = 0;
      RayCounts rays;
      const FloatPicture film = render(
          *scene, description, {threads, 0, whole(description)}, rays,
          [&](const RenderProgress&) { stop = ++told >= calls; }, &stop);
      const int done = whole_pixels(film, all);
      INFO(threads << " threads, stopped at call " << calls << ", done " << done);
      CHECK(done > 0);
      CHECK(done < 256 * 192 / 2);
      CHECK(rays.camera >= static_cast<std::uint64_t>(done));
      CHECK(told < calls + threads);  // no thread begins another tile
    }
  }
}

TEST_CASE("a render stops inside a pixel, however many samples that has") {
  // One tile, of more samples than a day could trace.
  const SceneDescription description = parsed_scene(busy_scene(32, 32, 2'000'000'000));
  const auto scene = build_scene(description, {1, {}});
  std::atomic<bool> stop{false};
  Film film(film_settings(*scene, description, {1, 0, whole(description), {}}));
  std::thread stopper(stop_after_some_rays, std::ref(stop));
  render(*scene, film, 2'000'000'000, 1, {}, &stop);
  stopper.join();
  CHECK(film.fewest_samples() < 2'000'000'000);
}

TEST_CASE("a render that is paused again and again ends in the same sums") {
  const SceneDescription description = parsed_scene(busy_scene(61, 47, 40));
  for (const int threads : {1, 3}) {
    const auto scene = build_scene(description, {threads, {}});
    const RenderSettings settings{threads, 5, whole(description), {}};
    Film once(film_settings(*scene, description, settings)), paused(once.settings());
    render(*scene, once, 40, threads);
    int pauses = 0;
    while (paused.fewest_samples() < 40) {
      std::atomic<bool> stop{false};
      const std::uint32_t target = std::min(40U, paused.fewest_samples() + 7);
      // Further on each time, since tiles that are done count again; the other threads are in the middle of theirs.
      int calls = 0;
      render(*scene, paused, target, threads, [&](const RenderProgress&) { stop = calls++ >= pauses; }, &stop);
      ++pauses;
    }
    CHECK(pauses > 10);
    CHECK(std::equal(once.sums().begin(), once.sums().end(), paused.sums().begin(), paused.sums().end()));
  }
}

TEST_CASE("a film of means has those of the sums") {
  for (const int samples : {1, 2, 5, 8, 16, 40}) {
    const SceneDescription description = parsed_scene(busy_scene(61, 47, samples));
    for (const int threads : {1, 3}) {
      const auto scene = build_scene(description, {threads, {}});
      const FilmSettings settings = film_settings(*scene, description, {threads, 5, whole(description), {}});
      const auto count = static_cast<std::uint32_t>(samples);
      Film sums(settings), means(settings, FilmContent::means);
      const RenderReport of_sums = render(*scene, sums, count, threads),
                         of_means = render(*scene, means, count, threads);
      CHECK(of_means.rays.camera == of_sums.rays.camera);
      CHECK(of_means.rays.shadow == of_sums.rays.shadow);
      const std::vector<Pixel> wanted = sums.pixels(), got = means.pixels();
      int wrong = 0;
      for (std::size_t i = 0; i < wanted.size(); ++i) wrong += !identical(wanted[i], got[i]);
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("a render that was stopped goes on with packets of any shape") {
  const SceneDescription description = parsed_scene(busy_scene(61, 47, 96));
  const auto scene = build_scene(description, {1, {}});
  Film once(film_settings(*scene, description, {1, 5, whole(description), {}}));
  render(*scene, once, 96, 1);
  // Groups of 32, 16, 8, 4 and 1 of a pixel's samples, each stopped in the middle of a tile.
  Film often(once.settings());
  const Region region = often.region();
  std::uint32_t target = 0;
  int uneven = 0;
  for (const std::uint32_t step : {32U, 16U, 8U, 4U, 1U, 16U, 1U, 8U, 2U, 8U}) {
    target += step;
    std::atomic<bool> stop{true};  // after a block
    for (int i = 0; i < 5; ++i) choose_variant(scene->isa()).render(*scene, region, target, often, &stop);
    uneven += often.sum(region.x0, region.y0).samples != often.sum(region.x1 - 1, region.y1 - 1).samples;
  }
  CHECK(target == 96);
  CHECK(uneven == 10);
  render(*scene, often, 96, 1);
  CHECK(std::equal(once.sums().begin(), once.sums().end(), often.sums().begin(), often.sums().end()));
}

TEST_CASE("a film of means shows what there is of a tile that was stopped") {
  const SceneDescription description = parsed_scene(busy_scene(8, 8, 2'000'000'000));
  const auto scene = build_scene(description, {1, {}});
  std::atomic<bool> stop{false};
  Film film(film_settings(*scene, description, {1, 0, whole(description), {}}), FilmContent::means);
  std::thread stopper(stop_after_some_rays, std::ref(stop));
  render(*scene, film, 2'000'000'000, 1, {}, &stop);
  stopper.join();
  const std::vector<Pixel> pixels = film.pixels();
  CHECK(!identical(pixels.front(), untouched));
  CHECK(identical(pixels.back(), untouched));
}

TEST_CASE("sums of parts of the samples add up to those of all") {
  const SceneDescription description = parsed_scene(busy_scene(50, 30, 21));
  const auto scene = build_scene(description, {1, {}});
  const auto part = [&](std::uint32_t first, std::uint32_t count) {
    Film film(film_settings(*scene, description, {1, 5, whole(description), SampleRange{first, count, false}}));
    render(*scene, film, count, 1);
    return film;
  };
  const Film all = part(0, 21);
  const Film first = part(0, 1), second = part(1, 6), third = part(7, 14);
  int wrong = 0;
  for (std::size_t i = 0; i < all.sums().size(); ++i) {
    PixelSum sum = third.sums()[i];
    sum += first.sums()[i];
    sum += second.sums()[i];
    wrong += !(sum == all.sums()[i]);
  }
  CHECK(wrong == 0);
}

TEST_CASE("samples do not depend on the packets in which they are traced") {
  // Objects so small that packets come apart: few, which are met in the directions where they are, or so many for so
  // few pixels that Embree traces all rays.
  const int objects = GENERATE(200, 3000);
  std::minstd_rand random(7);
  const auto number = [&](double low, double high) {
    return std::to_string(low + (high - low) * static_cast<double>(random()) / std::minstd_rand::max());
  };
  std::string cylinders, spheres, tori;
  for (int i = 0; i < objects; ++i) {
    const std::string x = number(-20, 20), z = number(-20, 20), bottom = number(-16, 0), top = number(0, 16);
    cylinders += "<cylinder><bottom x='" + x + "' y='" + bottom + "' z='" + z + "'/><top x='" + x + "' y='" + top +
                 "' z='" + z + "'/><radius>0.1</radius><material>white</material></cylinder>";
    spheres += "<sphere><center x='" + number(-20, 20) + "' y='" + number(-16, 16) + "' z='" + number(-20, 0) +
               "'/><radius>" + number(0.1, 0.6) + "</radius><material>white</material></sphere>";
    tori += "<torus><center x='" + number(-20, 20) + "' y='" + number(-16, 16) + "' z='" + number(-20, 20) +
            "'/><sweptradius>" + number(0.3, 2) + "</sweptradius><tuberadius>" + number(0.1, 0.3) +
            "</tuberadius><axis x='" + number(-1, 1) + "' y='" + number(-1, 1) +
            "' z='1'/><material>white</material></torus>";
  }
  // More than are shaded at once, which some rays see and others do not.
  std::string lights;
  for (int i = 0; i < 20; ++i)
    lights += "<directionallight><direction x='" + number(-1, 1) + "' y='" + number(-1, 1) +
              "' z='0.1'/><scaleradiance>0.1</scaleradiance></directionallight>";
  const SceneDescription description = parsed_scene(
      "<raytracer><viewplane><hres>64</hres><vres>48</vres><samples>32</samples></viewplane>"
      "<camera><eye x='0' y='0' z='40'/><lookat x='0' y='0' z='0'/><viewdistance>60</viewdistance></camera>"
      "<lights><pointlights><pointlight><location x='9' y='20' z='30'/></pointlight></pointlights><directionallights>" +
      lights +
      "</directionallights></lights><materials><mattes><matte><name>white</name><ka>0</ka><kd>1</kd><cd red='1' "
      "green='1' "
      "blue='1'/></matte></mattes>"
      "</materials><objects><cylinders>" +
      cylinders + "</cylinders><spheres>" + spheres + "</spheres><toruses>" + tori +
      "</toruses></objects></raytracer>");
  const auto scene = build_scene(description, {1, {}});
  const auto in_steps = [&](const std::vector<std::uint32_t>& targets) {
    Film film(film_settings(*scene, description, {1, 5, whole(description), {}}));
    for (const std::uint32_t target : targets) render(*scene, film, target, 1);
    return film;
  };
  const Film once = in_steps({32});
  for (const auto& targets :
       {std::vector<std::uint32_t>{8, 16, 24, 32}, {4, 8, 12, 16, 20, 24, 28, 32}, {1, 2, 3, 32}}) {
    const Film steps = in_steps(targets);
    int wrong = 0;
    for (std::size_t i = 0; i < once.sums().size(); ++i) wrong += !(steps.sums()[i] == once.sums()[i]);
    INFO("in " << targets.size() << " steps");
    CHECK(wrong == 0);
  }
}

TEST_CASE("a render that is stopped before it begins does nothing") {
  const SceneDescription description = parsed_scene(busy_scene(64, 64, 1));
  const auto scene = build_scene(description, {2, {}});
  const std::atomic<bool> stop{true};
  RayCounts rays{7, 7};
  const FloatPicture film = render(*scene, description, {2, 0, whole(description)}, rays, {}, &stop);
  CHECK(whole_pixels(film, rendered(description)) == 0);
  CHECK(rays.camera == 0);
  CHECK(rays.shadow == 0);
}

}  // namespace raytrace::test
