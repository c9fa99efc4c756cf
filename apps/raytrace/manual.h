// The manual of the command, made of the parser's own options: --help and the man page cannot differ.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace raytrace {

/// For a terminal: no line above 80 columns.
std::string help_text(const CLI::App& parser);

/// For man(1), in the man macros of troff. `software` and `date` stand in the page's margins.
std::string man_page(const CLI::App& parser, const std::string& software);

}  // namespace raytrace
