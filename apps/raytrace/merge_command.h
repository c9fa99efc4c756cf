// raytrace merge PIECES... -o FILE
#pragma once

#include "raytrace/batch/merge_pieces.h"

namespace raytrace {

class OptionParser;

struct MergeOptions {
  MergeSettings settings;
  bool quiet = false;
  bool verbose = false;
  bool help = false;
};

/// Adds all options to a parser, which fills `options`.
void define_merge_options(OptionParser& parser, MergeOptions& options);

/// Whether a command line is one of `raytrace merge`.
bool is_merge_command(int argc, const char* const* argv);

/// Runs it; the program's exit code. Throws UsageError, and what merge_pieces() throws but for MergeError.
int merge_command(int argc, const char* const* argv);

}  // namespace raytrace
