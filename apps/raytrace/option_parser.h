// Command line options that say what would have been right. CLI11 parses them, and is included in option_parser.cpp
// alone, since its headers take longer to compile than all the rest of the program.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "option_values.h"

namespace raytrace {

/// An option as help, man pages and completions show it.
struct OptionEntry {
  std::string group;       ///< "Output"
  Names names;             ///< "-o", "--output"; empty for what stands without an option's name
  std::string value_name;  ///< "FILE"; empty for a switch
  std::string help;
  Names values{};                  ///< those that the value is one of; empty: any text
  bool value_is_optional = false;  ///< it follows a "=": --stats[=FILE.json]

  /// "-o, --output FILE"
  std::string term() const;
};

class OptionParser {
 public:
  using Take = std::function<void(const std::string& value)>;

  OptionParser();
  ~OptionParser();
  OptionParser(const OptionParser&) = delete;
  OptionParser& operator=(const OptionParser&) = delete;

  // names: "-o,--output". The variables must live until parse() has returned.

  /// The options that follow belong to it.
  void group(const std::string& name) { group_ = name; }

  /// Arguments without an option's name.
  void add_arguments(const std::string& value_name, const std::string& help, std::vector<std::string>& values);

  /// An option with a value; the last one counts, so that a wrapper script's can be overridden. A UsageError that
  /// `take` throws is thrown again with the option's name before it. values: those that it takes, for messages and
  /// completions; empty: any text.
  void add(const std::string& names, const std::string& value_name, const std::string& help, const Take& take,
           const Names& values = {});

  /// The same for a variable, which becomes parse(the value).
  template <class Variable, class Parse>
  void add(const std::string& names, const std::string& value_name, const std::string& help, Variable& variable,
           const Parse& parse, const Names& values = {}) {
    add(names, value_name, help, [&variable, parse](const std::string& text) { variable = parse(text); }, values);
  }

  /// One that may be repeated, and keeps all its values.
  void add_repeatable(const std::string& names, const std::string& value_name, const std::string& help,
                      const Take& take);

  /// One that can do without a value, which is then `without`: no argument after it is taken for the value.
  void add_with_optional_value(const std::string& names, const std::string& value_name, const std::string& help,
                               std::string& value, const std::string& without);

  /// Options without a value. The count is how often it was given.
  void add_switch(const std::string& names, bool& flag, const std::string& help);
  void add_switch(const std::string& names, int& count, const std::string& help);

  /// Throws UsageError, which says what is wrong and, where an option is not known, the nearest one.
  void parse(int argc, const char* const* argv);

  const std::vector<OptionEntry>& entries() const { return entries_; }

  /// After parse(): the last names of those options of a group that were given.
  Names given(const std::string& group) const;

 private:
  struct Parser;
  void refuse_other_style(int argc, const char* const* argv) const;
  void refuse_unknown() const;
  std::string hint(const std::string& name) const;
  const OptionEntry* entry(std::string_view name) const;
  std::string explained(const std::string& message) const;
  void note(const Names& names, const std::string& value_name, const std::string& help, const Names& values = {},
            bool value_is_optional = false);

  std::unique_ptr<Parser> parser_;
  std::string group_;
  std::vector<OptionEntry> entries_;
  std::vector<std::string>* arguments_ = nullptr;
};

/// "--spp" for "--samples", "-samples" or "samples", however it is divided into words ("--num_threads",
/// "--numThreads"); empty if it is not known.
std::string_view option_of_other_renderers(std::string_view name);

/// "--resolution" for "+W640", as POV-Ray has it.
std::string_view option_of_povray(std::string_view argument);

}  // namespace raytrace
