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

std::string counted(std::uint64_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string in_seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, " in %.3f s", seconds);
  return text;
}

std::string contents(const SceneDescription& description) {
  return counted(count_items(description.objects), "object") + ", " + counted(count_items(description.lights), "light");
}

ImageMetadata metadata_of(const SceneDescription& description, const Statistics& statistics) {
  ImageMetadata metadata;
  metadata.software = statistics.software;
  metadata.scene_file = statistics.scene_file;
  metadata.samples = statistics.samples;
  metadata.seed = statistics.seed;
  metadata.threads = statistics.threads;
  metadata.render_seconds = statistics.seconds.render;
  metadata.camera = camera_matrices(description);
  return metadata;
}

void tell_repairs(const std::string& file, const Repairs& repairs) {
  if (repairs.clamped > 0) {
    tell_warning(file + ": " + counted(repairs.clamped, "value") +
                 " beyond what the format holds became its largest; in EXR, --float keeps them");
  }
  if (repairs.not_finite > 0) {
    tell_warning(file + ": " + counted(repairs.not_finite, "value") + " not finite; NaN became 0");
  }
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
    description = load_scene(options.scene, diagnostics);
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

Film render(const Scene& scene, const SceneDescription& description, const Region& region, const Options& options,
            const std::atomic<bool>& stop, Statistics& statistics) {
  statistics.software = software_name();
  statistics.scene_file = shown_name(options.scene);
  statistics.width = description.viewplane.hres;
  statistics.height = description.viewplane.vres;
  statistics.region = region;
  statistics.samples = description.viewplane.samples;
  statistics.seed = options.seed;
  statistics.threads = options.threads;

  Progress progress(options.quiet ? ProgressStyle::none : options.progress);
  const PhaseTimer timer(statistics.seconds.render);
  Film film = render(
      scene, description, {options.threads, options.seed, region}, statistics.rays,
      [&](double fraction) { progress.update(fraction); }, &stop);
  if (!stop) progress.finish();
  return film;
}

bool write(const Film& film, const SceneDescription& description, const Options& options, Statistics& statistics) {
  tell_step("rendered " + counted(statistics.total_rays(), "ray") + " on " +
            counted(static_cast<std::uint64_t>(options.threads), "thread") + in_seconds(statistics.seconds.render));
  const ImageMetadata metadata = metadata_of(description, statistics);
  for (const std::string& file : options.outputs) {
    const PhaseTimer timer(statistics.seconds.write);
    try {
      const Repairs repairs = write_image(file, film, metadata, options.image_file_settings());
      statistics.outputs.push_back(file);
      tell_repairs(file, repairs);
      tell_step("wrote " + file);
    } catch (const OutputError& error) {
      tell_error(error.what());
    }
  }
  return statistics.outputs.size() == options.outputs.size();
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
