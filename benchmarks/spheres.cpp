// The first benchmark: random spheres over a plane under one shadowing point light, against the bare loop.
//
// Render and bare loop take turns, so that a machine whose speed drifts does not favour one; medians are printed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

#include "ceiling.h"

namespace {

using namespace raytrace;

SceneDescription random_spheres(int count, int resolution, int samples) {
  SceneDescription scene;
  scene.file = "random spheres";
  scene.viewplane.hres = scene.viewplane.vres = resolution;
  scene.viewplane.pixelsize = 1024.0 / resolution;
  scene.viewplane.samples = samples;
  scene.camera = PinholeCamera::Parameters{{0, 8, 30}, {0, 0, 0}, {0, 1, 0}, 1500};
  std::get<LightItems<AmbientLight>>(scene.lights).push_back({});
  PointLight::Parameters light;
  light.location = {20, 40, 30};
  light.scaleradiance = 3;
  std::get<LightItems<PointLight>>(scene.lights).push_back({light});

  std::mt19937 generator(1);
  const auto random = [&generator] { return static_cast<double>(generator()) / 4294967296.0; };
  constexpr std::uint32_t materials = 8;
  for (std::uint32_t i = 0; i < materials; ++i) {
    std::get<MaterialItems<Matte>>(scene.materials).push_back({{0.2, 0.7, {random(), random(), random()}}, {}});
    std::get<MaterialItems<Phong>>(scene.materials)
        .push_back({{0.2, 0.5, 0.3, {random(), random(), random()}, {1, 1, 1}, 40}, {}});
  }
  // The spheres fill the same share of the space, however many there are.
  const double size = 4 / std::cbrt(count);
  for (int i = 0; i < count; ++i) {
    ObjectItem<Sphere> item;
    item.parameters.center = {16 * random() - 8, 10 * random() - 3, 16 * random() - 8};
    item.parameters.radius = size * (0.3 + 0.7 * random());
    item.material = {static_cast<std::uint32_t>(generator() % 2), static_cast<std::uint32_t>(generator() % materials)};
    std::get<ObjectItems<Sphere>>(scene.objects).push_back(item);
  }
  ObjectItem<Plane> plane;
  plane.parameters = {{0, -4, 0}, {0, 1, 0}};
  std::get<ObjectItems<Plane>>(scene.objects).push_back(plane);
  return scene;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options(
      "Renders random spheres over a plane and times the same rays in a bare loop of Embree packet queries.");
  std::vector<int> counts{1000, 100000};
  int resolution = 1024, samples = 16, threads = 0, runs = 5;
  std::string isa = best_isa();
  std::string spheres = "callback";
  options.add_option("--spheres", counts, "Numbers of spheres")->capture_default_str();
  options.add_option("--resolution", resolution, "Pixels an edge")->capture_default_str();
  options.add_option("--samples", samples, "Samples a pixel")->capture_default_str();
  options.add_option("-t,--threads", threads, "Threads; 0: all processors")->capture_default_str();
  options.add_option("--runs", runs, "Runs of which the median counts")->capture_default_str();
  options.add_option("--isa", isa, "Instruction set")->check(CLI::IsMember(isa_names()))->capture_default_str();
  options
      .add_option("--sphere", spheres,
                  "Who intersects spheres in the bare loop: our callback, or Embree's built-in sphere")
      ->check(CLI::IsMember({"callback", "embree"}))
      ->capture_default_str();
  CLI11_PARSE(options, argc, argv);

  threads = thread_count(threads);
  std::printf("%s, %d thread%s, %d x %d, %d samples, spheres of the bare loop by %s; medians of %d runs\n", isa.c_str(),
              threads, threads == 1 ? "" : "s", resolution, resolution, samples, spheres.c_str(), runs);
  std::printf("%9s %10s %10s %10s %14s %14s\n", "spheres", "render s", "bare s", "ratio", "render Mray/s",
              "bare Mray/s");
  for (const int count : counts) {
    const SceneDescription description = random_spheres(count, resolution, samples);
    const auto scene = build_scene(description, {threads, isa});
    const auto ceiling = benchmark::make_ceiling(
        description, isa,
        spheres == "embree" ? benchmark::SphereGeometry::embree : benchmark::SphereGeometry::callback);
    std::vector<double> render_seconds, bare_seconds, ratios;
    RayCounts rays;
    for (int run = 0; run < runs; ++run) {
      const auto start = std::chrono::steady_clock::now();
      render(*scene, description, {threads, 0, {0, 0, resolution, resolution}}, rays);
      render_seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      bare_seconds.push_back(ceiling->trace(threads).seconds / threads);
      ratios.push_back(render_seconds.back() / bare_seconds.back());
    }
    const double million_rays = static_cast<double>(rays.camera + rays.shadow) * 1e-6;
    std::printf("%9d %10.4f %10.4f %10.3f %14.1f %14.1f\n", count, median(render_seconds), median(bare_seconds),
                median(ratios), million_rays / median(render_seconds), million_rays / median(bare_seconds));
  }
}
