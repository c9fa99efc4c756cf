// The image files of a picture, and what is checked of them before the render.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "raytrace/batch/render_job.h"
#include "raytrace/batch/render_observer.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/output/denoised_picture.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// Throws OutputError or SettingsError for what would fail at the end of the render: a format, a file or folder that
/// cannot be written, a checkpoint that is there and not to be resumed from. (Temporary files are made and removed.)
void check_outputs(const RenderJob& job);

/// The part of it that opens no file.
void check_output_settings(const RenderJob& job);

/// Throws SettingsError if options for the view are given and matter to none of the files.
void refuse_useless_view(const std::vector<std::string>& files, const ImageFileSettings& settings,
                         const ViewOptions& view);

/// Throws SettingsError for files of a piece that cannot be put together, where that needs the whole picture: light
/// paths of other tiles reach this one; or the picture is to be exposed by itself, or denoised.
void refuse_useless_tile(const RenderJob& job, const ViewPlane& viewplane, bool light_paths_of_others);

/// Whether any is for display.
bool any_for_display(const std::vector<std::string>& files, const ImageFileSettings& settings);

/// Sets the exposure and the view transform. found: the exposure that the picture itself asks for, where it is wanted.
void set_view(ImageFileSettings& settings, const ViewSettings& view, double found);

/// Whether all outputs are there and may be left as they are (RenderJob::skip_existing). A checkpoint that is still
/// there says that they are not complete, whatever their formats can.
bool may_be_skipped(const RenderJob& job);

/// Whether all outputs are whole, and of this picture, as far as their formats say.
bool outputs_are_complete(const RenderJob& job, const SceneDescription& description);

/// What is to be said of values that the file could not hold, a line each.
std::vector<std::string> warnings_of(const Repairs& repairs, const std::string& file);

/// Writes the outputs of a job. One that fails is reported, and the others go on.
class OutputFiles {
 public:
  /// files: those of job.outputs to write. settings: the job's, with the picture's view. sums: the sum_channels() that
  /// EXR files keep, too; empty if none. denoised: has the film's colours in their place; null: they stay.
  OutputFiles(const RenderJob& job, const std::vector<std::string>& files, const ImageFileSettings& settings,
              const PictureExtent& extent, const ImageMetadata& metadata, std::vector<Channel> sums,
              const DenoisedPicture* denoised, RenderObserver& observer);

  /// film: whole rows of the extent's region, the next below those written before. False if no file is left.
  bool write(const Film& film);

  /// After the last row: gives the files their names, which it returns.
  std::vector<std::string> commit();

 private:
  struct File {
    std::string name;
    std::unique_ptr<ImageFile> image;
  };
  template <class Action>
  bool succeeds(const Action& action) const;

  const RenderJob& job_;
  RenderObserver& observer_;
  const DenoisedPicture* denoised_;
  std::vector<Channel> sums_, channels_;  ///< channels_: all of them
  std::vector<File> files_;               ///< those without a fault
};

}  // namespace raytrace
