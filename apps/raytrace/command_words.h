// The first word of a command line, where it is no scene: raytrace merge, raytrace help.
#pragma once

#include <string>
#include <vector>

namespace raytrace {

/// The command line with "help" and "help merge" as the options that they stand for. Throws UsageError where the first
/// word is no file, and is like a command that there is, or was meant for one that is an option here.
std::vector<const char*> with_command_words_read(int argc, const char* const* argv);

}  // namespace raytrace
