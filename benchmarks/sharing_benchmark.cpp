// Do threads that render one picture disturb each other by writing to the same cache lines (false sharing)?
//
// The same tiles are rendered by the same number of threads twice: together, into one film from one scene, and apart,
// each thread with a film and a scene of its own, where there is nothing to share. Equal times say that nothing shared
// is written in the loop. That the method can see it, additions to one line of the film show, which share on purpose.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <barrier>
#include <cstdio>
#include <ctime>
#include <functional>
#include <thread>

#include "raytrace/render/renderer.h"
#include "scenes.h"

namespace {

using namespace raytrace;
using namespace raytrace::benchmark;

constexpr int resolution = 1024;
/// The smallest that the renderer gives to threads, since they have the longest borders.
constexpr int tile_edge = 8;
/// A pass takes as many samples as make one packet of a block, so that every packet writes to the film.
constexpr std::uint32_t pass_samples = 4;
constexpr std::uint32_t passes = 4;

/// Of the whole process, all threads, since `start`. Unlike the wall clock's it leaves out other programs' work; a
/// thread that waits for a cache line is at work.
double processor_seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Runs work(i) in thread i, all at the same time; the processor seconds that they take.
double time_threads(int threads, const std::function<void(int)>& work) {
  std::barrier ready(threads + 1);
  std::vector<std::jthread> workers;
  for (int i = 0; i < threads; ++i)
    workers.emplace_back([&, i] {
      ready.arrive_and_wait();
      work(i);
    });
  const std::clock_t start = std::clock();
  ready.arrive_and_wait();
  workers.clear();
  return processor_seconds_since(start);
}

/// One for all threads, or one for each.
class Pictures {
 public:
  Pictures(int count, int threads, const std::string& isa) : description_(random_spheres(1000, resolution, 1)) {
    for (int i = 0; i < count; ++i) scenes_.push_back(build_scene(description_, {threads, isa}));
  }

  /// Thread i of n renders every n-th tile of each row, so that each tile's neighbours are others'.
  double time_tiles(int threads) const {
    std::vector<Film> films = begun_films(threads);
    return time_threads(threads, [&](int i) {
      const auto mine = static_cast<std::size_t>(i) % scenes_.size();
      for (std::uint32_t pass = 1; pass <= passes; ++pass)
        for (int top = 0; top < resolution; top += tile_edge)
          for (int left = i * tile_edge; left < resolution; left += threads * tile_edge)
            choose_variant(scenes_[mine]->isa())
                .render(*scenes_[mine], {left, top, std::min(left + tile_edge, resolution), top + tile_edge},
                        (1 + pass) * pass_samples, films[mine], nullptr);
    });
  }

  /// The same as a program has it done, with what is written once a tile.
  double time_render(int threads) const {
    std::vector<Film> films = begun_films(threads);
    const std::clock_t start = std::clock();
    for (std::uint32_t pass = 1; pass <= passes; ++pass)
      render(*scenes_[0], films[0], (1 + pass) * pass_samples, threads);
    return processor_seconds_since(start);
  }

 private:
  /// With the first samples, so that the system has given them all their memory.
  std::vector<Film> begun_films(int threads) const {
    RenderSettings settings{threads, 0, {0, 0, resolution, resolution}};
    settings.samples = SampleRange{0, (1 + passes) * pass_samples};
    std::vector<Film> films;
    for (const auto& scene : scenes_) {
      films.emplace_back(film_settings(*scene, description_, settings));
      render(*scene, films.back(), pass_samples, threads);
    }
    return films;
  }

  SceneDescription description_;
  std::vector<std::unique_ptr<const Scene>> scenes_;
};

/// Each thread adds to a pixel of its own, so many pixels from the next thread's; atomically, so that each
/// addition needs the line.
double time_additions(int threads, int distance) {
  constexpr int additions = 50'000'000;
  FilmSettings settings;
  settings.extent = {resolution, 1, {0, 0, resolution, 1}};
  Film film(settings);
  return time_threads(threads, [&](int i) {
    const std::atomic_ref sum(film.sum(i * distance, 0).red);
    for (int n = 0; n < additions; ++n) sum.fetch_add(n, std::memory_order_relaxed);
  });
}

struct Comparison {
  const char* name;
  std::function<double()> together, apart;
};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  int threads = 2, runs = 15;
  std::string isa = best_isa();
  CLI::App parser("Times threads that render one film against threads that render a film each.");
  parser.add_option("-t,--threads", threads)->check(CLI::Range(2, 64))->capture_default_str();
  parser.add_option("--runs", runs, "Runs of which the median counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parser.add_option("--isa", isa, "Instruction set")->check(CLI::IsMember(isa_names()))->capture_default_str();
  CLI11_PARSE(parser, argc, argv);

  const Pictures one(1, threads, isa), one_each(threads, threads, isa);
  constexpr int apart = 16;  // pixels of 32 bytes: lines that no processor fetches in pairs
  const Comparison comparisons[] = {
      {"tiles by turns", [&] { return one.time_tiles(threads); }, [&] { return one_each.time_tiles(threads); }},
      {"render()", [&] { return one.time_render(threads); }, [&] { return one_each.time_tiles(threads); }},
      {"sharing on purpose", [&] { return time_additions(threads, 1); },
       [&] { return time_additions(threads, apart); }},
  };
  std::printf("%s, %d threads; processor seconds, medians of %d runs in turns\n", isa.c_str(), threads, runs);
  std::printf("%-20s %10s %10s %8s   %s\n", "", "together", "apart", "ratio", "least to most");
  for (const Comparison& comparison : comparisons) {
    std::vector<double> together, alone, ratios;
    for (int run = 0; run < runs; ++run) {
      // The other one first in every other run.
      if (run % 2 == 0) together.push_back(comparison.together());
      alone.push_back(comparison.apart());
      if (run % 2 != 0) together.push_back(comparison.together());
      ratios.push_back(together.back() / alone.back());
    }
    const auto [least, most] = std::ranges::minmax(ratios);
    std::printf("%-20s %10.4f %10.4f %8.3f   %.3f to %.3f\n", comparison.name, median(together), median(alone),
                median(ratios), least, most);
    std::fflush(stdout);
  }
}
