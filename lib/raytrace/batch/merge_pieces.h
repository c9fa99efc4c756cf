// One picture out of pieces that were rendered apart: tiles, crops and ranges of samples, in any order.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "raytrace/output/image_file.h"

namespace raytrace {

struct MergeSettings {
  std::vector<std::string> pieces;   ///< EXR files of this program
  std::vector<std::string> outputs;  ///< colour in the pieces' type: ImageFileSettings::full_float is theirs
  std::optional<int> samples;        ///< per pixel that the picture must get; none: as many as the pieces have
  bool partial = false;  ///< what is missing has fewer samples, or is filled with checks of alpha 0; with nothing in a
                         ///< transparent picture
  int bit_depth = 8;
  bool denoise = false;  ///< the picture; it is as well if all pieces say that it is to be
  ViewOptions view;      ///< in place of the pieces' own; some output must be for display
  int threads = 0;
};

struct MergeReport {
  std::size_t pieces = 0;
  int samples = 0;             ///< per pixel
  bool missing_parts = false;  ///< only with MergeSettings::partial
  bool stopped = false;        ///< nothing was written
  std::vector<std::string> outputs;
  std::vector<std::string> warnings;  ///< of values that outputs could not hold
};

/// Pieces that do not fit together; what() holds all the problems, a line each, each naming its file.
class MergeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Checks that the pieces are of one scene, with the same settings, version and instruction set, and cover the
/// picture once, without a gap; then writes it, bit for bit as one render of the whole would have. A band of rows is in
/// memory at a time, and a piece is open only while it is read. Ends early, and leaves all files as they were, once
/// `stop` says so, which is asked before each piece and band. Throws MergeError, InputError or OutputError;
/// SettingsError if an output is one of the pieces, or another output.
MergeReport merge_pieces(const MergeSettings& settings, const std::function<bool()>& stop = {});

}  // namespace raytrace
