// What the program says about itself, and the words of a command line that ask for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.h"

namespace raytrace {

/// The answer to --help, --version or --list; none if none of them is asked.
std::optional<std::string> about_program(const Options& options);

/// What --list knows: "shapes", "materials", ...
std::vector<std::string> listing_names();

/// The command line with "help" and "help merge" as the options that they stand for. Throws UsageError where the first
/// word is no file, and is like a command that there is, or was meant for one that is an option here.
std::vector<const char*> with_command_words_read(int argc, const char* const* argv);

}  // namespace raytrace
