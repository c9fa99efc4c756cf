#include "raytrace/batch/render_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/fit_camera.h"
#include "raytrace/batch/frames.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/description/clay.h"
#include "raytrace/description/default_integrator.h"
#include "raytrace/description/light_groups.h"
#include "raytrace/text/message.h"
#include "raytrace/textures/udim.h"

namespace raytrace {

std::vector<std::string> RenderJob::files() const {
  std::vector<std::string> files = outputs;
  if (!statistics.empty()) files.push_back(statistics);
  if (!checkpoint.empty()) files.push_back(checkpoint);
  return files;
}

ImageFileSettings RenderJob::image_file_settings() const {
  ImageFileSettings settings;
  settings.full_float = full_float;
  settings.bit_depth = bit_depth;
  settings.threads = threads;
  settings.transparent = transparent;
  settings.ocio = view.ocio;
  settings.dither = view.dither;
  return settings;
}

namespace {

/// The scene's view plane with the job's resolution, scale, samples and view.
ViewPlane requested_view_plane(const ViewPlane& viewplane, const RenderJob& job) {
  const Resolution unscaled = job.resolution.value_or(Resolution{viewplane.hres, viewplane.vres});
  const double width = std::max(1.0, std::round(unscaled.width * job.scale));
  const double height = std::max(1.0, std::round(unscaled.height * job.scale));
  if (!is_allowed_size(width, height)) {
    throw SettingsError("a picture of " + formatted("%.0f x %.0f", width, height) +
                        " pixels is too large; the most is " + std::to_string(largest_edge) + " along an edge and " +
                        std::to_string(static_cast<long long>(most_pixels)) + " in all");
  }
  ViewPlane requested = viewplane;
  if (width != viewplane.hres || height != viewplane.vres)
    requested = with_resolution(viewplane, static_cast<int>(width), static_cast<int>(height));
  const ViewSettings view = job.view.over(view_settings(viewplane));
  requested.viewtransform = view.transform;
  requested.exposure = view.exposure;
  requested.autoexposure = view.auto_exposure;
  requested.whitebalance = view.white_balance;
  requested.samples = job.samples.value_or(viewplane.samples);
  if (std::int64_t{job.sample_offset.value_or(0)} + requested.samples > std::numeric_limits<int>::max())
    throw SettingsError("--sample-offset: a picture has at most 2147483647 samples per pixel");
  return requested;
}

/// A shift counts in the picture's larger side: where that changes, the shift keeps its length on the view plane.
void keep_shift(const ViewPlane& before, const ViewPlane& now, CameraParameters& any_camera) {
  const auto side = [](const ViewPlane& picture) { return picture.pixelsize * std::max(picture.hres, picture.vres); };
  std::visit(
      [&](auto& camera) {
        if constexpr (requires { camera.shift; }) {
          camera.shift.x *= side(before) / side(now);
          camera.shift.y *= side(before) / side(now);
        }
      },
      any_camera);
}

void choose_integrator(const std::string& name, SceneDescription& description) {
  bool found = false;
  for_each_type(Integrators{}, [&]<class Integrator>(std::type_identity<Integrator>) {
    if (name != Integrator::element) return;
    found = true;
    // The scene's own parameters stay, if they are this integrator's.
    const bool is_the_scenes =
        description.integrator && std::holds_alternative<typename Integrator::Parameters>(*description.integrator);
    if (!is_the_scenes) description.integrator = typename Integrator::Parameters{};
  });
  if (!found) throw SettingsError("there is no integrator " + in_quotes(name));
}

void clamp_indirect(double most, SceneDescription& description) {
  IntegratorParameters integrator = integrator_of(description);
  auto* const path = std::get_if<Path::Parameters>(&integrator);
  if (path == nullptr)
    throw SettingsError(
        "--clamp-indirect is of path tracing, and this picture is not path traced; --integrator path does it");
  if (path->clampindirect == most) return;  // a scene that leaves it open stays as it is
  path->clampindirect = most;
  description.integrator = integrator;
}

}  // namespace

void apply_job(const RenderJob& job, SceneDescription& description) {
  const ViewPlane scenes = description.viewplane;
  description.viewplane = requested_view_plane(scenes, job);
  keep_shift(scenes, description.viewplane, description.camera);
  for (CameraParameters& moment : description.moving_camera) keep_shift(scenes, description.viewplane, moment);
  if (!job.integrator.empty()) choose_integrator(job.integrator, description);
  if (job.clamp_indirect) clamp_indirect(*job.clamp_indirect, description);
  if (!job.clay) return;
  if (const OptionalMessage problem = make_clay(description, *job.clay)) throw SettingsError("--clay: " + *problem);
}

SampleRange sample_range(const ViewPlane& viewplane, const RenderJob& job) {
  const auto count = static_cast<std::uint32_t>(viewplane.samples);
  if (job.sample_offset) return {*job.sample_offset, count, false};
  return {0, count, count == 1};
}

Region crop_window(const ViewPlane& viewplane, const RenderJob& job) {
  if (!job.crop) return {0, 0, viewplane.hres, viewplane.vres};
  if (const auto error = crop_error(*job.crop, viewplane.hres, viewplane.vres))
    throw SettingsError("--crop: " + text_of(*job.crop) + ": " + *error);
  return *job.crop;
}

Region render_window(const Region& crop_window, const RenderJob& job) {
  if (!job.tile) return crop_window;
  const auto pixels = std::int64_t{crop_window.width()} * crop_window.height();
  if (job.tile->count > pixels)
    throw SettingsError("--tile: the picture has only " + std::to_string(pixels) + " pixels");
  return tile_of(crop_window, job.tile->index, job.tile->count);
}

namespace {

/// The files that the scene names are not to be written.
void refuse_to_overwrite(const SceneDescription& description, const RenderJob& job) {
  UsedFiles files;
  const auto add_meshes = [&](const ObjectLists& objects) {
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(objects)) {
      if (!mesh.parameters.file.path.empty()) files.add({"a mesh", mesh.parameters.file.path, false});
      if (mesh.data != nullptr)
        for (const std::string& file : mesh.data->files) files.add({"a file of a mesh", file, false});
    }
    for (const auto& cloud : std::get<ObjectItems<SphereCloud>>(objects))
      files.add({"a cloud of spheres", cloud.parameters.file.path, false});
    for (const auto& curve : std::get<ObjectItems<Curve>>(objects))
      if (!curve.parameters.file.path.empty()) files.add({"strands of a curve", curve.parameters.file.path, false});
    for (const auto& model : std::get<ObjectItems<Model>>(objects))
      files.add({"a model", model.parameters.file.path, false});
  };
  for (const auto& image : std::get<TextureItems<Image>>(description.textures))
    if (is_udim(image.parameters.file.path))
      for (const UdimTile& tile : find_udim_tiles(image.parameters.file.path))
        files.add({"a texture", tile.file, false});
    else
      files.add({"a texture", image.parameters.file.path, false});
  for (const auto& light : std::get<LightItems<EnvironmentLight>>(description.lights))
    if (!light.parameters.file.path.empty()) files.add({"an environment", light.parameters.file.path, false});
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light>) {
    for (const auto& light : std::get<LightItems<Light>>(description.lights))
      if constexpr (requires { light.photometry; })
        if (!light.parameters.iesfile.path.empty()) files.add({"an IES file", light.parameters.iesfile.path, false});
  });
  for (const IncludedFile& file : description.included) files.add({"an included scene", file.name, false});
  add_meshes(description.objects);
  for (const Group& group : description.groups) add_meshes(group.objects);
  for (const std::string& file : job.files()) files.add_or_refuse({"an output", file, true});
  for (const UsedFile& file : job.other_files) files.add_or_refuse(file);
}

}  // namespace

std::optional<SceneDescription> load_picture(const RenderJob& job, RenderObserver& observer, Phase& phase) {
  observer.on_stage(RenderStage::load);
  Diagnostics diagnostics(on_one_line(job.scene_name()));
  std::optional<SceneDescription> description;
  {
    const PhaseTimer timer(phase);
    if (is_model(job.scene)) {
      if (!job.variables.empty()) throw SettingsError("--define: " + job.scene + " is a model, which has no variables");
      const auto size =
          job.resolution ? std::optional(std::array{job.resolution->width, job.resolution->height}) : std::nullopt;
      const std::optional<int> frame = job.is_one_of_frames ? std::optional(job.frame) : std::nullopt;
      ModelStage stage = job.stage.value_or(ModelStage());
      stage.fit = job.fit;
      description = load_model(job.scene, stage, frame, size, diagnostics, job.threads, job.textures);
      if (description) refuse_to_overwrite(*description, job);
    } else {
      if (job.stage) throw SettingsError("a stage is for models: " + job.scene_name() + " has a camera and lights");
      const SceneSettings settings{
          .frame = job.frame, .variables = job.variables, .textures = job.textures, .still = job.still};
      description = load_scene(job.scene, diagnostics, job.threads, settings);
    }
    if (description && !is_model(job.scene)) {
      refuse_to_overwrite(*description, job);
      if (!load_meshes(*description, diagnostics, job.threads, job.textures)) description.reset();
      if (description) refuse_to_overwrite(*description, job);  // the textures that models name, too
    }
  }
  observer.on_diagnostics(diagnostics);
  if (!description) return std::nullopt;
  observer.on_message(MessageLevel::step,
                      job.scene_name() + ": " + contents_text(*description) + ", read" + time_taken(phase.seconds));
  apply_job(job, *description);
  if (job.fit && !is_model(job.scene)) fit_camera(*description, *description);
  return description;
}

std::string contents_text(const SceneDescription& description) {
  const auto count = [](const auto& lists) {
    return std::apply([](const auto&... list) { return (list.size() + ...); }, lists);
  };
  return counted(count(description.objects), "object") + ", " + counted(count(description.lights), "light");
}

RenderBatch::RenderBatch(std::vector<std::string> scenes, std::vector<int> frames, RenderJob each)
    : scenes_(std::move(scenes)), frames_(std::move(frames)), each_(std::move(each)) {
  if (!frames_.empty()) {
    for (auto* const names : {&scenes_, &each_.outputs})
      for (std::string& name : *names) name = with_folders_kept(name);
    for (auto* const name : {&each_.statistics, &each_.checkpoint}) *name = with_folders_kept(*name);
  }
  const auto from_standard_input = std::count(scenes_.begin(), scenes_.end(), "-");
  if (from_standard_input > 1 || (from_standard_input == 1 && frame_count() > 1)) {
    throw SettingsError("standard input can be read once; give a file for " +
                        std::string(frame_count() > 1 ? "several frames" : "the second scene"));
  }
  refuse_clashes();
}

void RenderBatch::refuse_clashes() const {
  UsedFiles files;
  for (const UsedFile& file : each_.other_files) files.add_or_refuse(file);
  const auto add_written = [&](const std::string& option, const std::string& pattern, const std::string& name) {
    const UsedFile file{option, name, true};
    const UsedFile* const other = name.empty() ? nullptr : files.add(file);
    if (other == nullptr) return;
    if (other->role != option || other->file != name) throw ClashError(file, *other);
    if (option == "--output")
      static_cast<void>(image_format(name, each_.image_file_settings()));  // no format: that first
    const std::string tokens = with_tokens(pattern, frame_count() > 1, scenes_.size() > 1);
    throw SettingsError(
        option + ": more than one render would write " + name + "; " +
        (tokens == pattern ? "give scenes and outputs names that differ" : "use a name such as " + tokens));
  };
  std::string last_scene;
  for (std::size_t i = 0; i < size(); ++i) {
    const RenderJob job = (*this)[i];
    if (job.scene != last_scene) files.add_or_refuse({"the scene", job.scene == "-" ? "/dev/stdin" : job.scene, false});
    last_scene = job.scene;
    for (std::size_t k = 0; k < job.outputs.size(); ++k) add_written("--output", each_.outputs[k], job.outputs[k]);
    add_written("--stats", each_.statistics, job.statistics);
    add_written("--checkpoint", each_.checkpoint, job.checkpoint);
  }
}

std::optional<int> RenderBatch::frame(std::size_t i) const {
  if (frames_.empty()) return std::nullopt;
  return frames_[i % frame_count()];
}

std::string RenderBatch::scene(std::size_t i) const { return scene_file_name(scenes_[i / frame_count()], frame(i)); }

RenderJob RenderBatch::operator[](std::size_t i) const {
  RenderJob job = each_;
  job.scene = scene(i);
  job.is_one_of_frames = frame(i).has_value();
  job.frame = frame(i).value_or(job.frame);
  if (job.seed_is_frame) job.seed = static_cast<std::uint32_t>(job.frame);
  const NameValues values{frame(i), job.tile ? std::optional(job.tile->index) : std::nullopt, job.scene};
  for (std::string& output : job.outputs) output = file_name(output, values);
  job.statistics = file_name(job.statistics, values);
  job.checkpoint = file_name(job.checkpoint, values);
  return job;
}

std::string RenderBatch::name(std::size_t i) const {
  const std::optional<int> number = frame(i);
  return scene(i) + (number ? ", frame " + std::to_string(*number) : "");
}

std::vector<std::string> RenderBatch::names(const std::vector<std::size_t>& some) const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < some.size();) {
    const std::size_t scene_number = some[k] / frame_count();
    std::vector<int> numbers;
    const std::size_t first = some[k];
    for (; k < some.size() && some[k] / frame_count() == scene_number; ++k)
      numbers.push_back(frame(some[k]).value_or(0));
    names.push_back(numbers.size() == 1 ? name(first) : scenes_[scene_number] + ", frames " + frames_text(numbers));
  }
  return names;
}

AovSet aovs_in(const RenderJob& job, const SceneDescription& description) {
  try {
    return with_light_groups(job.aovs, light_group_names(description));
  } catch (const std::invalid_argument& problem) {
    throw SettingsError(std::string("--aov: ") + problem.what());
  }
}

}  // namespace raytrace
