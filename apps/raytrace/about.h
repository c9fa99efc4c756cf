// What the program tells about itself.
#pragma once

#include <optional>
#include <string>

#include "options.h"

namespace raytrace {

/// "raytrace 1.2.3"
std::string software_name();

/// The answer to --help, --version or --list; none if neither is asked.
std::optional<std::string> about_program(const Options& options);

}  // namespace raytrace
