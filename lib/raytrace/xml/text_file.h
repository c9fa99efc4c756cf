// Reads a whole file, or standard input, into memory.
#pragma once

#include <optional>
#include <string>

#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/text_buffer.h"

namespace raytrace {

/// The bytes of the file ("-": standard input). No value, and an error without a line, if it is missing, a directory,
/// unreadable, or larger than 2 GiB (as /dev/zero is). threads: so many at most read a large one; 0: all that the
/// machine has.
std::optional<TextBuffer> read_text_file(const std::string& file, int threads, Diagnostics& diagnostics);

}  // namespace raytrace
