// Reads a whole file, or standard input, into memory.
#pragma once

#include <optional>
#include <string>

#include "raytrace/description/diagnostics.h"

namespace raytrace {

/// The bytes of the file ("-": standard input). No value, and an error without a line, if it is missing, a directory,
/// unreadable, or larger than 2 GiB (as /dev/zero is).
std::optional<std::string> read_text_file(const std::string& file, Diagnostics& diagnostics);

}  // namespace raytrace
