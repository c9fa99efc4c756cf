#include "option_parser.h"

#include <CLI/CLI.hpp>
#include <string_view>

#include "raytrace/description/quoted.h"

namespace raytrace {

namespace {

/// CLI11's message in other words, where they are clearer.
std::string explained(const std::string& message) {
  static constexpr std::string_view missing_value = ": 1 required ";                           // --spp ... N missing
  static constexpr std::string_view needless_value = " was given a disallowed flag override";  // float ...
  if (const std::size_t found = message.find(missing_value); found != std::string::npos) {
    const std::string rest = message.substr(found + missing_value.size());
    return message.substr(0, found) + " needs a value: " + rest.substr(0, rest.find(' '));
  }
  if (message.ends_with(needless_value)) {
    return "--" + message.substr(0, message.size() - needless_value.size()) + " takes no value";
  }
  return message;
}

/// The names of a CLI11 option, short ones first, with their dashes.
Names names_of(const CLI::Option& option) {
  Names names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// `take`, with the option's name before what it refuses.
OptionParser::Take named(const OptionParser::Take& take, const std::string& names) {
  return [take, name = names.substr(names.rfind(',') + 1)](const std::string& text) {
    try {
      take(text);
    } catch (const UsageError& error) {
      throw UsageError(name + ": " + error.what());
    }
  };
}

}  // namespace

struct OptionParser::Parser {
  CLI::App app;
};

std::string OptionEntry::term() const {
  if (names.empty()) return value_name;
  std::string term = joined(names, ", ");
  if (value_is_optional) return term + "[=" + value_name + "]";
  return value_name.empty() ? term : term + " " + value_name;
}

OptionParser::OptionParser() : parser_(std::make_unique<Parser>()) {
  parser_->app.set_help_flag();  // ours is like any other option
  parser_->app.allow_extras();   // refuse_unknown() says what was meant
}

OptionParser::~OptionParser() = default;

void OptionParser::add_arguments(const std::string& value_name, const std::string& help,
                                 std::vector<std::string>& values) {
  parser_->app.add_option("arguments", values)->type_name(value_name);
  note({}, value_name, help);
}

void OptionParser::add(const std::string& names, const std::string& value_name, const std::string& help,
                       const Take& take) {
  const CLI::Option* const option =
      parser_->app.add_option_function<std::string>(names, named(take, names))->type_name(value_name)->take_last();
  note(names_of(*option), value_name, help);
}

void OptionParser::add_repeatable(const std::string& names, const std::string& value_name, const std::string& help,
                                  const Take& take) {
  const auto take_all = [take = named(take, names)](const std::vector<std::string>& values) {
    for (const std::string& value : values) take(value);
  };
  const CLI::Option* const option = parser_->app.add_option_function<std::vector<std::string>>(names, take_all)
                                        ->type_name(value_name)
                                        ->allow_extra_args(false);
  note(names_of(*option), value_name, help);
}

void OptionParser::add_with_optional_value(const std::string& names, const std::string& value_name,
                                           const std::string& help, std::string& value, const std::string& without) {
  // CLI11's flag with a value: it takes no argument after it.
  const CLI::Option* const option = parser_->app.add_flag(names + "{" + without + "}", value);
  note(names_of(*option), value_name, help, true);
}

void OptionParser::add_switch(const std::string& names, bool& flag, const std::string& help) {
  note(names_of(*parser_->app.add_flag(names, flag)->disable_flag_override()), {}, help);
}

void OptionParser::add_switch(const std::string& names, int& count, const std::string& help) {
  note(names_of(*parser_->app.add_flag(names, count)->disable_flag_override()), {}, help);
}

void OptionParser::note(const Names& names, const std::string& value_name, const std::string& help,
                        bool value_is_optional) {
  entries_.push_back({group_, names, value_name, help, value_is_optional});
}

void OptionParser::parse(int argc, const char* const* argv) {
  try {
    parser_->app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    throw UsageError(explained(error.what()));
  }
  refuse_unknown();
}

void OptionParser::refuse_unknown() const {
  Names long_names;
  for (const OptionEntry& entry : entries_)
    for (const std::string& name : entry.names)
      if (name.starts_with("--")) long_names.push_back(name);
  for (const std::string& argument : parser_->app.remaining()) {
    if (argument.size() < 2 || argument.front() != '-') continue;
    const std::string name = argument.substr(0, argument.find('='));
    const bool is_long = name.size() > 2 && name[1] == '-';
    throw UsageError("there is no option " + in_quotes(name) + (is_long ? suggestion(name, long_names) : ""));
  }
}

}  // namespace raytrace
