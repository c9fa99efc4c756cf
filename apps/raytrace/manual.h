// The manual of the command, made of the parser's own options: --help and the man page cannot differ.
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

}  // namespace raytrace
