// Completion of command lines in shells, made of the parser's own options, as the manual is.
#pragma once

#include <string>
#include <vector>

#include "option_parser.h"

namespace raytrace {

/// What bash, zsh and fish read when a person types raytrace and the tab key. render, merge: the options of raytrace
/// and of raytrace merge.
std::string bash_completion(const std::vector<OptionEntry>& render, const std::vector<OptionEntry>& merge);
std::string zsh_completion(const std::vector<OptionEntry>& render, const std::vector<OptionEntry>& merge);
std::string fish_completion(const std::vector<OptionEntry>& render, const std::vector<OptionEntry>& merge);

}  // namespace raytrace
