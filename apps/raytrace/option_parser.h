// CLI11 as this program uses it: options that say what would have been right.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "option_values.h"

namespace raytrace {

/// Before any option is added.
void prepare(CLI::App& parser);

/// An option with a value; the last one counts, so that a wrapper script's can be overridden.
CLI::Option* add(CLI::App& parser, const std::string& names, const std::string& value_name, const std::string& help,
                 const std::function<void(const std::string&)>& take);

/// An option without a value.
template <class Flag>
CLI::Option* add_switch(CLI::App& parser, const std::string& names, Flag& flag, const std::string& help) {
  return parser.add_flag(names, flag, help)->disable_flag_override();
}

/// Throws UsageError, which tells what is wrong and, where an option is not known, the nearest one.
void parse(CLI::App& parser, int argc, const char* const* argv);

}  // namespace raytrace
