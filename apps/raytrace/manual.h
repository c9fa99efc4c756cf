// What is made of the parser's own options, so that they cannot differ: --help, the man pages, and what shells
// complete.
#pragma once

#include <string>
#include <vector>

#include "option_parser.h"

namespace raytrace {

/// What a manual says besides the options.
struct Manual;
extern const Manual render_manual;  ///< of raytrace
extern const Manual merge_manual;   ///< of raytrace merge

/// For a terminal: no line above 80 columns.
std::string help_text(const Manual& manual, const std::vector<OptionEntry>& options);

/// For whoever types the command's name alone: how it is called, and the examples, a line each.
std::vector<std::string> short_help(const Manual& manual);

/// For man(1), in the man macros of troff. `software` stands in the page's margins.
std::string man_page(const Manual& manual, const std::vector<OptionEntry>& options, const std::string& software);

/// What bash, zsh and fish read when a person types raytrace and the tab key. render, merge: the options of raytrace
/// and of raytrace merge.
std::string bash_completion(const std::vector<OptionEntry>& render, const std::vector<OptionEntry>& merge);
std::string zsh_completion(const std::vector<OptionEntry>& render, const std::vector<OptionEntry>& merge);
std::string fish_completion(const std::vector<OptionEntry>& render, const std::vector<OptionEntry>& merge);

}  // namespace raytrace
