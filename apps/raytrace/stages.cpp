#include "stages.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <sstream>
#include <tuple>
#include <unordered_set>

#include "about.h"
#include "memory_limit.h"
#include "messages.h"
#include "outputs.h"
#include "picture_settings.h"
#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/scene_hash.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/output/complete_picture.h"
#include "raytrace/output/film_channels.h"
#include "raytrace/output/image_file.h"
#include "raytrace/text/quoted.h"
#include "signals.h"

namespace raytrace {

namespace {

std::string shown_name(const std::string& scene_file) { return scene_file == "-" ? "<stdin>" : scene_file; }

template <class ItemLists>
std::size_t count_items(const ItemLists& lists) {
  return std::apply([](const auto&... list) { return (list.size() + ...); }, lists);
}

std::string time_taken(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, " in %.3f s", seconds);
  return text;
}

std::string contents(const SceneDescription& description) {
  return counted(count_items(description.objects), "object") + ", " + counted(count_items(description.lights), "light");
}

void write_statistics(const Statistics& statistics, const std::string& file) {
  AtomicFile atomic(file);
  const std::string text = json(statistics);
  if (std::fwrite(text.data(), 1, text.size(), atomic.stream()) != text.size()) atomic.fail(errno);
  atomic.commit();
}

/// Those that an earlier render of the scene, another frame, had too are not told again.
void log_findings(const Diagnostics& diagnostics) {
  static std::string file;
  static std::unordered_set<std::string> told;
  if (file != diagnostics.file()) told.clear();
  file = diagnostics.file();
  std::stringstream lines;
  diagnostics.print(lines);
  std::string news, first_error;
  for (std::string line; std::getline(lines, line);) {
    if (!told.insert(line).second) continue;
    news += line + "\n";
    if (first_error.empty() && line.find(": error: ") != std::string::npos) first_error = line;
  }
  if (!news.empty()) log_lines(news);
  if (!first_error.empty()) log_program_failure(first_error);
}

}  // namespace

void check_formats(const Options& options) {
  for (const std::string& file : options.outputs) check_format(file, options.image_file_settings());
  if (options.full_float && std::none_of(options.outputs.begin(), options.outputs.end(), holds_float)) {
    throw UsageError("--float: none of the outputs can hold floats; .exr and .tif can");
  }
  if (options.transparent && std::none_of(options.outputs.begin(), options.outputs.end(), holds_alpha)) {
    throw UsageError("--transparent: none of the outputs can hold alpha; .exr, .png and .tif can");
  }
  if (options.exposure) refuse_useless_exposure(options.outputs, options.image_file_settings());
  if (!options.aovs.empty() && std::none_of(options.outputs.begin(), options.outputs.end(), holds_data)) {
    throw UsageError("--aov: none of the outputs can hold more than colour; .exr can");
  }
}

void check_checkpoint(const Options& options) {
  if (options.checkpoint.empty() || options.resume || !std::filesystem::exists(options.checkpoint)) return;
  throw UsageError("--checkpoint: there is a " + options.checkpoint +
                   " already; --resume goes on from it, or remove it");
}

void check_outputs(const Options& options) {
  if (!options.renders()) return;
  check_formats(options);
  check_checkpoint(options);
  const StopSignalsWait no_temporary_file_stays;
  for (const std::string& file : options.files()) {
    const AtomicFile made_and_removed(file);
  }
}

bool might_be_skipped(const Options& options) {
  return options.skip_existing && options.renders() &&
         (options.checkpoint.empty() || !std::filesystem::exists(options.checkpoint)) &&
         std::all_of(options.outputs.begin(), options.outputs.end(),
                     [](const std::string& file) { return std::filesystem::exists(file); });
}

bool outputs_are_complete(const SceneDescription& description, const Region& whole, const Region& region,
                          const Options& options) {
  PieceIdentity identity;
  identity.provenance.scene = scene_hash(description, options.threads);
  identity.film.seed = options.seed;
  identity.film.transparent = options.transparent;
  identity.film.extent = {description.viewplane.hres, description.viewplane.vres, region};
  identity.film.samples = sample_range(description.viewplane, options);
  identity.whole = whole;
  WantedPicture wanted;
  wanted.extent = identity.film.extent;
  wanted.channels = color_channels(options.full_float);
  for (Channel& channel : aov_channels(options.aovs)) wanted.channels.push_back(std::move(channel));
  if (options.sample_offset)
    for (Channel& channel : sum_channels()) wanted.channels.push_back(std::move(channel));
  wanted.bit_depth = options.bit_depth;
  wanted.exposure = options.exposure.value_or(0);
  wanted.attributes = picture_attributes(identity, options.time_limit.has_value());
  return std::all_of(options.outputs.begin(), options.outputs.end(),
                     [&](const std::string& file) { return is_complete_picture(file, wanted); });
}

void check_output_sizes(const Options& options, const Region& region) {
  for (const std::string& file : options.outputs) check_size(file, region, options.image_file_settings());
}

std::optional<SceneDescription> load(const Options& options, Statistics& statistics) {
  obey_group_memory_limit(options.threads);
  Diagnostics diagnostics(on_one_line(shown_name(options.scene)));
  std::optional<SceneDescription> description;
  {
    const PhaseTimer timer(statistics.phases.load);
    description = load_scene(options.scene, diagnostics, options.threads, {options.frame, options.variables});
  }
  if (diagnostics.has_errors() || tells(Verbosity::warnings)) log_findings(diagnostics);
  if (description) {
    log_step(shown_name(options.scene) + ": " + contents(*description) + ", read" +
             time_taken(statistics.phases.load.seconds));
  }
  return description;
}

std::unique_ptr<const Scene> build(const SceneDescription& description, const Options& options,
                                   Statistics& statistics) {
  constexpr std::uint64_t embree_device = std::uint64_t{128} << 20U;
  obey_group_memory_limit(options.threads, embree_device);
  std::unique_ptr<const Scene> scene;
  {
    const PhaseTimer timer(statistics.phases.build);
    scene = build_scene(description, {options.threads, options.isa, true});
  }
  obey_group_memory_limit(options.threads);
  statistics.scene = scene->statistics();
  log_step("built for " + statistics.scene.isa + " with Embree " + statistics.scene.embree_version +
           time_taken(statistics.phases.build.seconds));
  return scene;
}

void describe(const SceneDescription& description, const Region& region, const Options& options,
              Statistics& statistics) {
  statistics.software = software_name();
  statistics.scene_file = shown_name(options.scene);
  statistics.width = description.viewplane.hres;
  statistics.height = description.viewplane.vres;
  statistics.region = region;
  statistics.samples = description.viewplane.samples;
  statistics.seed = options.seed;
  statistics.threads = options.threads;
}

void print_pixel(const Scene& scene, const SceneDescription& description, const Region& pixel, const Options& options) {
  const auto values = [&](const Film& film) {
    const Pixel mean = film.pixel(pixel.x0, pixel.y0);
    std::string text;
    for (const float value : {mean.red, mean.green, mean.blue, mean.alpha}) text += " " + number_text(double{value});
    return text + "\n";
  };
  RenderSettings settings{1, options.seed, pixel, sample_range(description.viewplane, options)};
  settings.transparent = options.transparent;
  const SampleRange samples = *settings.samples;
  for (std::uint32_t i = 0; i < samples.count; ++i) {
    settings.samples = SampleRange{samples.first + i, 1, samples.centered};
    Film film(film_settings(scene, description, settings));
    const RenderReport report = render(scene, film, 1, 1);
    print("sample " + std::to_string(samples.first + i) + ":" +
          (report.invalid_samples.count > 0 ? " not finite\n" : values(film)));
  }
  settings.samples = samples;
  Film film(film_settings(scene, description, settings));
  render(scene, film, samples.count, 1);
  print("mean:" + values(film));
}

void report(Statistics& statistics, const Options& options) {
  statistics.peak_memory_bytes = peak_memory_bytes();
  if (options.statistics == statistics_as_text || tells(Verbosity::details)) log_lines(text(statistics));
  if (options.has_statistics_file()) write_statistics(statistics, options.statistics);
}

std::string summary(const SceneDescription& description) {
  return on_one_line(shown_name(description.file)) + ": ok (" + contents(description) + ")";
}

}  // namespace raytrace
