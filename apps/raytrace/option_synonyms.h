// What other renderers call the options of this one.
#pragma once

#include <string_view>

namespace raytrace {

/// "--spp" for "--samples", "-samples" or "samples", however it is divided into words ("--num_threads",
/// "--numThreads"); empty if it is not known.
std::string_view option_of_other_renderers(std::string_view name);

/// "--resolution" for "+W640", as POV-Ray has it.
std::string_view option_of_povray(std::string_view argument);

}  // namespace raytrace
