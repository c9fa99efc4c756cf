// What the command line asks for. The options themselves, with their help, stand in options.cpp, once: the parser,
// --help and the man page are all made of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messages.h"
#include "option_values.h"
#include "progress.h"
#include "raytrace/batch/render_job.h"

namespace raytrace {

class OptionParser;

/// What all renders of the run have in common, with patterns for names, and what else the command is to do.
struct Options : RenderJob {
  std::vector<std::string> scenes;  ///< "-": standard input
  std::vector<int> frames;          ///< in increasing order; empty: not asked for
  std::optional<PixelIndex> pixel;  ///< to be printed instead of a picture

  bool floor = false;      ///< ModelStage::floor
  std::string clay_names;  ///< as given; empty: not at all

  int verbose = 0;  ///< how often asked
  bool quiet = false;
  ProgressStyle progress = ProgressStyle::automatic;
  std::string log_file;  ///< empty: none
  bool shows_statistics = false;

  bool validate = false;
  bool print_scene = false;
  std::string list;  ///< empty, or what to list
  bool version = false;
  bool help = false;

  bool renders() const { return !validate && !print_scene && !pixel; }
  Verbosity verbosity() const;
};

/// Adds all options to a parser, which fills `options`.
void define_options(OptionParser& parser, Options& options);

/// Without the files of a render that is not asked for. Throws UsageError, which says what is wrong and, where a name
/// is not known, the nearest one.
Options parse_options(int argc, const char* const* argv);

}  // namespace raytrace
