#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "raytrace/description/check_fogs.h"
#include "raytrace/description/include.h"
#include "raytrace/description/load_images.h"
#include "raytrace/description/motion.h"
#include "raytrace/description/scene_reader.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {

/// The text, but objects that have no keys, is read again at other moments, if something of the scene may move while
/// its shutter is open, or before it is.
SceneDescription with_motion(ReadScene read, std::string_view text, Diagnostics& diagnostics, int threads,
                             const SceneSettings& settings) {
  if (!read.has_keys || diagnostics.has_errors()) return std::move(read.scene);
  if (settings.still && !is_open_for_an_instant(read.scene)) {
    warn_of_motion(read.scene, diagnostics);
    return std::move(read.scene);
  }
  const auto at = [&](double after_frame, Diagnostics& of_moment) {
    SceneSettings at_moment = settings;
    at_moment.after_frame = after_frame;
    return read_scene(TextBuffer(text), read.scene.file, of_moment, threads, at_moment, &read.keyed).scene;
  };
  add_motion(read.scene, at, diagnostics);
  check_moving_densities(read.scene, diagnostics);
  return std::move(read.scene);
}

/// load_meshes() comes when there is nothing else wrong; a name that is, one wants to know at once.
void report_missing_meshes(const SceneDescription& scene, Diagnostics& diagnostics) {
  const auto look = [&](const FileName& file) {
    std::error_code error;
    if (file.path.empty() || std::filesystem::status(file.path, error).type() != std::filesystem::file_type::not_found)
      return;
    diagnostics.error(location_of(file),
                      on_one_line(file.path) + ": cannot read it: " + std::generic_category().message(ENOENT));
  };
  const auto look_in = [&](const ObjectLists& objects) {
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(objects)) look(mesh.parameters.file);
    for (const auto& model : std::get<ObjectItems<Model>>(objects)) look(model.parameters.file);
    for (const auto& cloud : std::get<ObjectItems<SphereCloud>>(objects)) look(cloud.parameters.file);
    for (const auto& curve : std::get<ObjectItems<Curve>>(objects)) look(curve.parameters.file);
  };
  look_in(scene.objects);
  for (const Group& group : scene.groups) look_in(group.objects);
}

}  // namespace

std::optional<SceneDescription> parse_scene(std::string_view text, Diagnostics& diagnostics, int threads,
                                            const SceneSettings& settings) {
  SceneDescription scene = with_motion(read_scene(TextBuffer(text), {}, diagnostics, threads, settings), text,
                                       diagnostics, threads, settings);
  if (diagnostics.has_errors()) return std::nullopt;
  return scene;
}

std::optional<SceneDescription> load_scene(const std::string& file, Diagnostics& diagnostics, int threads,
                                           const SceneSettings& settings) {
  std::optional<TextBuffer> text = read_text_file(file, threads, diagnostics);
  if (!text) return std::nullopt;
  // Standard input is read but once, and the first reading takes the text.
  const bool may_move = text->text().find("<shutter") != std::string_view::npos ||
                        text->text().find(Include::element) != std::string_view::npos;
  const std::string again(may_move ? text->text() : std::string_view());
  ReadScene read = read_scene(std::move(*text), file, diagnostics, threads, settings);
  read.scene.file = file;
  SceneDescription scene = with_motion(std::move(read), again, diagnostics, threads, settings);
  // Beside other errors, too, so that one run reports what is wrong with the files.
  load_images(scene, diagnostics, threads, settings.textures);
  if (!diagnostics.has_errors()) return scene;
  report_missing_meshes(scene, diagnostics);
  return std::nullopt;
}

}  // namespace raytrace
