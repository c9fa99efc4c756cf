// Whole renders of random scenes, each against bare loops of Embree packet queries for the same rays.
//
// Render and bare loops take turns, so that a machine whose speed drifts does not favour one; medians are printed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>

#include "ceiling.h"
#include "raytrace/film/film.h"
#include "raytrace/render/renderer.h"
#include "scenes.h"

namespace {

using namespace raytrace;
using namespace raytrace::benchmark;

/// In BareLoop's order.
const std::vector<std::string> bare_loop_names{"parts", "embree", "embree-spheres"};

struct Options {
  std::vector<std::string> scenes{"spheres:1000", "spheres:100000", "mix:5000"};
  std::vector<int> threads{1, 0};
  int resolution = 1024, samples = 16, runs = 5;
  std::string isa = best_isa();
  std::vector<std::string> bare{"embree", "parts"};
};

/// The count of a scene's name, "kind:count"; 0 if it is no such name.
int count_of(const std::string& scene) {
  int count = 0;
  const char* end = scene.data() + scene.size();
  for (const std::string_view kind : {"spheres:", "mix:"})
    if (scene.starts_with(kind) && std::from_chars(scene.data() + kind.size(), end, count).ptr != end) count = 0;
  return count;
}

SceneDescription make_scene(const std::string& name, const Options& options) {
  const auto make = name.starts_with("mix:") ? random_mix : random_spheres;
  return make(count_of(name), options.resolution, options.samples);
}

std::string check_scene(const std::string& name) {
  return count_of(name) > 0 ? "" : "no scene " + name + ": it is spheres:COUNT or mix:COUNT";
}

Options parse(int argc, char** argv) {
  Options options;
  CLI::App parser("Renders random scenes and times the same rays in a bare loop of Embree packet queries.");
  parser
      .add_option("--scene", options.scenes,
                  "spheres:COUNT over a plane, or mix:COUNT of planes, spheres, triangles, cylinders and toruses")
      ->check(check_scene)
      ->capture_default_str();
  parser.add_option("-t,--threads", options.threads, "Threads; 0: all processors")->capture_default_str();
  parser.add_option("--resolution", options.resolution, "Pixels an edge")->capture_default_str();
  parser.add_option("--samples", options.samples, "Samples a pixel")->capture_default_str();
  parser.add_option("--runs", options.runs, "Runs of which the median counts")->capture_default_str();
  parser.add_option("--isa", options.isa, "Instruction set")->check(CLI::IsMember(isa_names()))->capture_default_str();
  parser
      .add_option("--bare", options.bare,
                  "What bare loops ask: one scene of Embree's; the renderer's own parts, with planes beside Embree's "
                  "scene; or one scene with Embree's built-in sphere, where spheres are alone with planes")
      ->check(CLI::IsMember(bare_loop_names))
      ->capture_default_str();
  try {
    parser.parse(argc, argv);
    for (const std::string& scene : options.scenes)
      if (std::ranges::count(options.bare, "embree-spheres") != 0 && !scene.starts_with("spheres:"))
        throw CLI::ValidationError("--bare", "Embree's built-in sphere cannot stand in for the shapes of " + scene);
  } catch (const CLI::ParseError& error) {
    std::exit(parser.exit(error));
  }
  for (int& threads : options.threads) threads = thread_count(threads);
  const auto repeated = std::unique(options.threads.begin(), options.threads.end());  // 1 and all, with one processor
  options.threads.erase(repeated, options.threads.end());
  return options;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Medians over the runs.
struct BareTiming {
  double seconds;
  double ratio;  ///< the render's time over this one, of the same run
};

struct Timing {
  double render_seconds;
  std::vector<BareTiming> bare;  ///< in the order of Options::bare
  double million_rays;
};

Timing time_scene(const SceneDescription& description, int threads, const Options& options) {
  const auto scene = build_scene(description, {threads, options.isa});
  std::vector<std::unique_ptr<Ceiling>> ceilings;
  for (const std::string& name : options.bare) {
    const auto bare = std::ranges::find(bare_loop_names, name) - bare_loop_names.begin();
    ceilings.push_back(make_ceiling(description, options.isa, static_cast<BareLoop>(bare)));
  }
  std::vector<double> render_seconds;
  std::vector<std::vector<double>> bare_seconds(ceilings.size()), ratios(ceilings.size());
  const RenderSettings settings{threads, 0, {0, 0, options.resolution, options.resolution}};
  RayCounts rays;
  for (int run = 0; run < options.runs; ++run) {
    // As the program renders a picture in one go: its film, too, is fresh from the system each time.
    const auto start = std::chrono::steady_clock::now();
    Film film(film_settings(*scene, description, settings), FilmContent::half_means);
    rays = render(*scene, film, film.settings().samples.count, threads).rays;
    render_seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    for (std::size_t i = 0; i < ceilings.size(); ++i) {
      bare_seconds[i].push_back(ceilings[i]->trace(threads).seconds / threads);
      ratios[i].push_back(render_seconds.back() / bare_seconds[i].back());
    }
  }
  Timing timing{median(render_seconds), {}, static_cast<double>(rays.camera + rays.shadow) * 1e-6};
  for (std::size_t i = 0; i < ceilings.size(); ++i) timing.bare.push_back({median(bare_seconds[i]), median(ratios[i])});
  return timing;
}

void print_heads(const Options& options) {
  std::printf("%s, %d x %d, %d samples; medians of %d runs\n", options.isa.c_str(), options.resolution,
              options.resolution, options.samples, options.runs);
  std::printf("%-16s %7s %10s", "scene", "threads", "render s");
  for (const std::string& name : options.bare) std::printf(" %16s %7s", (name + " s").c_str(), "ratio");
  std::printf(" %8s\n", "Mray/s");
}

void print_row(const std::string& scene, int threads, const Timing& timing) {
  std::printf("%-16s %7d %10.4f", scene.c_str(), threads, timing.render_seconds);
  for (const BareTiming& bare : timing.bare) std::printf(" %16.4f %7.3f", bare.seconds, bare.ratio);
  std::printf(" %8.1f\n", timing.million_rays / timing.render_seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  print_heads(options);
  for (const std::string& name : options.scenes) {
    const SceneDescription description = make_scene(name, options);
    for (const int threads : options.threads) print_row(name, threads, time_scene(description, threads, options));
  }
}
