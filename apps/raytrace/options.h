// What the command line asks for. The options themselves, with their help, stand in options.cpp, once: the parser,
// --help and the man page are all made of them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "messages.h"
#include "option_values.h"
#include "progress_lines.h"
#include "raytrace/display/display_server.h"
#include "raytrace/film/film.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

class OptionParser;

/// The value of Options::statistics for --stats without a file.
inline constexpr std::string_view statistics_as_text = "text";

struct Options {
  std::vector<std::string> scenes;  ///< "-": standard input
  std::vector<int> frames;          ///< in increasing order; empty: not asked for
  std::map<std::string, std::string> variables;
  std::vector<std::string> outputs;
  bool skip_existing = false;

  // Of one render; Jobs sets them, and puts its values into the names of files.
  std::string scene;
  int frame = 1;
  bool is_one_of_frames = false;  ///< the frame is one of --frames
  std::size_t job_index = 0, job_count = 1;

  std::optional<Resolution> resolution;  ///< none: the scene's
  std::optional<Region> crop;            ///< none: the whole picture
  double scale = 1;                      ///< of the resolution
  std::uint64_t seed = 0;
  std::optional<int> samples;                  ///< a pixel; none: the scene's
  std::optional<std::uint32_t> sample_offset;  ///< none: all samples of the picture, not a part of them
  std::optional<Tile> tile;                    ///< none: all of the picture, or of the crop
  std::optional<PixelPlace> pixel;             ///< to be printed instead of a picture

  std::string checkpoint;           ///< file; empty: none
  double checkpoint_interval = 60;  ///< seconds
  bool resume = false;
  std::optional<double> time_limit;  ///< seconds

  AovSet aovs;

  int threads = 0;  ///< after parse_options never 0
  int bit_depth = 8;
  std::string isa;  ///< empty: the best

  int verbose = 0;  ///< how often asked
  ProgressStyle progress = ProgressStyle::automatic;
  std::string log_file;    ///< empty: none
  std::string statistics;  ///< empty: none; statistics_as_text; or the JSON file to write
  std::optional<DisplayAddress> display_server;
  std::string list;  ///< empty, or the kind of thing to list

  bool full_float = false;
  bool transparent = false;
  std::optional<double> exposure;  ///< in stops; none: not asked for
  bool quiet = false;
  bool validate = false;
  bool print_scene = false;
  bool version = false;
  bool help = false;

  bool renders() const { return !validate && !print_scene && !pixel; }
  bool has_statistics_file() const { return !statistics.empty() && statistics != statistics_as_text; }
  std::vector<std::string> files() const;  ///< that a render writes
  Verbosity verbosity() const;
  ImageFileSettings image_file_settings() const {
    return {full_float, bit_depth, true, threads, transparent, exposure.value_or(0)};
  }
};

/// Adds all options to a parser, which fills `options`.
void define_options(OptionParser& parser, Options& options);

/// Throws UsageError, which tells what is wrong and, where a name is not known, the nearest one.
Options parse_options(int argc, const char* const* argv);

}  // namespace raytrace
