// The image files of a run. One that cannot be written is told, and the others go on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "raytrace/cameras/camera_matrices.h"
#include "raytrace/output/image_file.h"
#include "statistics.h"

namespace raytrace {

class Outputs {
 public:
  Outputs(const Options& options, const PictureExtent& extent, const CameraMatrices& camera)
      : options_(options), extent_(extent), camera_(camera) {}

  /// band: whole rows of the extent's region, the next below those written before. The files are begun with the first.
  /// False if none is left.
  bool write(const Film& band, Statistics& statistics);

  /// After the last band: gives the files their names. False if any could not be written.
  bool commit(Statistics& statistics);

 private:
  struct File {
    std::string name;
    std::unique_ptr<ImageFile> image;
  };

  void begin(const Film& first_band, const Statistics& statistics);

  const Options& options_;
  PictureExtent extent_;
  CameraMatrices camera_;
  std::vector<File> files_;  ///< those without a fault
  bool begun_ = false;
};

}  // namespace raytrace
