// The image files of a picture. One that cannot be written is told, and the others go on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "raytrace/output/image_file.h"
#include "statistics.h"

namespace raytrace {

/// Throws UsageError if --exposure matters to none of the files.
void refuse_useless_exposure(const std::vector<std::string>& files, const ImageFileSettings& settings);

class Outputs {
 public:
  /// files: those of options.outputs to write. sums: the sum_channels() that EXR files keep, too; empty if none.
  Outputs(const Options& options, const std::vector<std::string>& files, const PictureExtent& extent,
          const ImageMetadata& metadata, std::vector<Channel> sums);

  /// film: whole rows of the extent's region, the next below those written before. False if no file is left that could
  /// be written.
  bool write(const Film& film, Statistics& statistics);

  /// After the last row: gives the files their names. False if any could not be written.
  bool commit(Statistics& statistics);

 private:
  struct File {
    std::string name;
    std::unique_ptr<ImageFile> image;
  };

  const Options& options_;
  std::size_t wanted_files_;
  std::vector<Channel> sums_, channels_;  ///< channels_: all of them
  std::vector<File> files_;               ///< those without a fault
};

}  // namespace raytrace
