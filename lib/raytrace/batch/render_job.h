// A picture to render, and a batch of them: each frame of each scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/batch/model_scene.h"
#include "raytrace/batch/render_observer.h"
#include "raytrace/batch/render_statistics.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/display/display_server.h"
#include "raytrace/film/film.h"
#include "raytrace/film/tiles.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

struct Resolution {
  int width = 0, height = 0;
};

/// What a render reads, the picture that it makes, and the files that it writes.
struct RenderJob {
  std::string scene;                ///< its file; "-": standard input; or a model's (model_scene.h)
  std::optional<ModelStage> stage;  ///< of a model; none: the usual
  int frame = 1;
  bool is_one_of_frames = false;  ///< the picture says which frame it is
  std::map<std::string, std::string> variables;
  TextureSettings textures{};
  bool still = false;  ///< nothing moves while the shutter is open

  std::optional<Resolution> resolution;        ///< none: the scene's
  bool fit = false;                            ///< moves the camera so that all is just in view (fit_camera.h)
  double scale = 1;                            ///< of the resolution
  std::optional<Region> crop;                  ///< none: the whole picture
  std::optional<Tile> tile;                    ///< none: all of the picture, or of the crop
  std::optional<int> samples;                  ///< per pixel; none: the scene's
  std::optional<std::uint32_t> sample_offset;  ///< none: all samples of the picture, not a part of them
  std::uint64_t seed = 0;
  bool seed_is_frame = false;            ///< RenderBatch sets the seed: each frame has noise of its own
  std::string integrator;                ///< its element, such as "normals"; empty: the scene's
  std::optional<double> clamp_indirect;  ///< Path::Parameters::clampindirect; none: the scene's
  /// All that is opaque is of clay (description/clay.h), but for materials of these names; none: the scene's materials.
  std::optional<std::vector<std::string>> clay;
  AovSet aovs;
  bool transparent = false;
  bool denoise = false;  ///< a tile, or a part of the samples: says so to the merge (batch/denoise.h)

  std::vector<std::string> outputs;  ///< image files, in the formats of their extensions
  bool skip_existing = false;        ///< render nothing if all outputs are there, and complete
  bool full_float = false;
  int bit_depth = 8;
  ViewOptions view;        ///< of files for display
  std::string statistics;  ///< JSON file; empty: none

  std::string checkpoint;            ///< file; empty: none
  double checkpoint_interval = 60;   ///< seconds
  bool resume = false;               ///< from the checkpoint, if there is one
  std::optional<double> time_limit;  ///< seconds from the beginning, the scene's loading included
  /// Samples are added until RenderStatistics::estimated_error is at most this, or there are all of them.
  std::optional<double> error_limit;
  std::optional<DisplayAddress> display_server;

  std::vector<UsedFile> other_files;  ///< that the run uses, too, such as its log

  int threads = 0;  ///< 0: all processors
  std::string isa;  ///< empty: the best

  /// As messages show it: "<stdin>" for "-".
  std::string scene_name() const { return scene == "-" ? "<stdin>" : scene; }
  /// All that the render writes.
  std::vector<std::string> files() const;
  /// But for the picture's exposure and view transform, which its scene may say.
  ImageFileSettings image_file_settings() const;
};

/// Gives the scene the job's resolution, scale, samples, view, integrator and clay. Throws SettingsError if the picture
/// gets too large, there is no such integrator, or what is asked of it is another's.
void apply_job(const RenderJob& job, SceneDescription& description);

/// Which of each pixel's samples: a sample offset makes them a part of the picture's.
SampleRange sample_range(const ViewPlane& viewplane, const RenderJob& job);

/// Its pixels, all of them.
inline Region whole_picture(const ViewPlane& viewplane) { return {0, 0, viewplane.hres, viewplane.vres}; }

/// What is cut into tiles: the crop, or the whole picture. Throws SettingsError if the crop reaches too far beyond the
/// picture.
Region crop_window(const ViewPlane& viewplane, const RenderJob& job);

/// The tile of it, or all. Throws SettingsError if there are more tiles than pixels.
Region render_window(const Region& crop_window, const RenderJob& job);

/// The job's scene with the view plane that the job wants. None if it has errors, which the observer knows.
std::optional<SceneDescription> load_picture(const RenderJob& job, RenderObserver& observer, Phase& phase);

/// With the names of the light groups that the job wants. Throws SettingsError for one that the scene does not have.
AovSet aovs_in(const RenderJob& job, const SceneDescription& description);

/// "3 objects, 2 lights"
std::string contents_text(const SceneDescription& description);

class RenderBatch {
 public:
  /// frames: in increasing order; none: each scene is rendered once, and its name is no pattern. each: what all renders
  /// have in common; the names of its files, and of the scenes, may be patterns (frames.h). Throws SettingsError if a
  /// file that is written would be another file of the run, or if standard input would be read twice. Opens no file.
  RenderBatch(std::vector<std::string> scenes, std::vector<int> frames, RenderJob each);

  /// All frames of the first scene, then those of the next.
  std::size_t size() const { return scenes_.size() * frame_count(); }
  RenderJob operator[](std::size_t i) const;

  /// "scene.xml, frame 7"
  std::string name(std::size_t i) const;

  /// The names of some, in their order, those of a scene's frames together: "scene.xml, frames 1-7,9"
  std::vector<std::string> names(const std::vector<std::size_t>& some) const;

 private:
  std::size_t frame_count() const { return frames_.empty() ? 1 : frames_.size(); }
  std::optional<int> frame(std::size_t i) const;
  std::string scene(std::size_t i) const;
  void refuse_clashes() const;

  std::vector<std::string> scenes_;
  std::vector<int> frames_;
  RenderJob each_;
};

}  // namespace raytrace
