#include "stages.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <tuple>

#include "about.h"
#include "messages.h"
#include "progress.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

namespace {

std::string shown_name(const std::string& scene_file) { return scene_file == "-" ? "<stdin>" : scene_file; }

template <class ItemLists>
std::size_t count_items(const ItemLists& lists) {
  return std::apply([](const auto&... list) { return (list.size() + ...); }, lists);
}

std::string in_seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, " in %.3f s", seconds);
  return text;
}

std::string contents(const SceneDescription& description) {
  return counted(count_items(description.objects), "object") + ", " + counted(count_items(description.lights), "light");
}

/// Rows of a band: the most whose film is not larger than a GiB, and a multiple of every packet's height.
int band_rows(const Region& region) {
  constexpr int unit = 32;
  constexpr std::size_t most_bytes = std::size_t{1} << 30U;
  const std::size_t unit_bytes = unit * sizeof(Pixel) * static_cast<std::size_t>(region.width());
  return unit * static_cast<int>(std::max<std::size_t>(1, most_bytes / unit_bytes));
}

void write_statistics(const Statistics& statistics, const std::string& file) {
  AtomicFile atomic(file);
  std::ofstream stream(atomic.temporary_name());
  stream << json(statistics);
  stream.close();
  if (!stream) throw OutputError("cannot write " + file);
  atomic.commit();
}

}  // namespace

void check_outputs(const Options& options) {
  if (options.validate || options.print_scene) return;
  for (const std::string& file : options.outputs) check_writable(file, options.image_file_settings());
  if (options.full_float && std::none_of(options.outputs.begin(), options.outputs.end(), holds_float)) {
    throw UsageError("--float: none of the outputs can hold floats; .exr and .tif can");
  }
  if (!options.statistics.empty() && options.statistics != statistics_as_text) {
    const AtomicFile made_and_removed(options.statistics);
  }
}

std::optional<SceneDescription> load(const Options& options, Statistics& statistics) {
  Diagnostics diagnostics(shown_name(options.scene));
  std::optional<SceneDescription> description;
  {
    const PhaseTimer timer(statistics.seconds.load);
    description = load_scene(options.scene, diagnostics, options.threads);
  }
  if (diagnostics.has_errors() || tells(Verbosity::warnings)) diagnostics.print(std::cerr);
  if (description) {
    tell_step(shown_name(options.scene) + ": " + contents(*description) + ", read" +
              in_seconds(statistics.seconds.load));
  }
  return description;
}

std::unique_ptr<const Scene> build(const SceneDescription& description, const Options& options,
                                   Statistics& statistics) {
  std::unique_ptr<const Scene> scene;
  {
    const PhaseTimer timer(statistics.seconds.build);
    scene = build_scene(description, {options.threads, options.isa});
  }
  statistics.scene = scene->statistics();
  tell_step("built for " + statistics.scene.isa + " with Embree " + statistics.scene.embree_version +
            in_seconds(statistics.seconds.build));
  return scene;
}

void render(const Scene& scene, const SceneDescription& description, const Region& region, const Options& options,
            const std::atomic<bool>& stop, Outputs& outputs, Statistics& statistics) {
  statistics.software = software_name();
  statistics.scene_file = shown_name(options.scene);
  statistics.width = description.viewplane.hres;
  statistics.height = description.viewplane.vres;
  statistics.region = region;
  statistics.samples = description.viewplane.samples;
  statistics.seed = options.seed;
  statistics.threads = options.threads;

  Progress progress(options.quiet ? ProgressStyle::none : options.progress);
  for (Region band = region; band.y0 < region.y1; band.y0 = band.y1) {
    band.y1 = std::min(band.y0 + band_rows(region), region.y1);
    const auto update = [&](double fraction) {
      progress.update((band.y0 - region.y0 + fraction * band.height()) / region.height());
    };
    PhaseTimer timer(statistics.seconds.render);
    RayCounts rays;
    const Film film = raytrace::render(scene, description, {options.threads, options.seed, band}, rays, update, &stop);
    timer.stop();
    if (stop) return;
    statistics.rays += rays;
    if (band.y1 == region.y1) progress.finish();
    if (!outputs.write(film, statistics)) return;
  }
  tell_step("rendered " + counted(statistics.total_rays(), "ray") + " on " +
            counted(static_cast<std::uint64_t>(options.threads), "thread") + in_seconds(statistics.seconds.render));
}

void report(Statistics& statistics, const Options& options) {
  statistics.peak_memory_bytes = peak_memory_bytes();
  const bool as_text = options.statistics == statistics_as_text;
  if (as_text || tells(Verbosity::details)) std::cerr << text(statistics);
  if (!options.statistics.empty() && !as_text) write_statistics(statistics, options.statistics);
}

std::string summary(const SceneDescription& description) {
  return shown_name(description.file) + ": ok (" + contents(description) + ")";
}

}  // namespace raytrace
