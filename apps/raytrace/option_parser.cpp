#include "option_parser.h"

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

/// Everything that starts with a dash in the parser's own options.
Names option_names(const CLI::App& parser) {
  Names names;
  for (const CLI::Option* const option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

void refuse_unknown(const CLI::App& parser) {
  const Names unknown = parser.remaining();
  for (const std::string& argument : unknown) {
    if (argument.size() < 2 || argument.front() != '-') continue;
    const std::string name = argument.substr(0, argument.find('='));
    const bool is_long = name.size() > 2 && name[1] == '-';
    throw UsageError("there is no option " + in_quotes(name) + (is_long ? suggestion(name, option_names(parser)) : ""));
  }
}

}  // namespace

void prepare(CLI::App& parser) {
  parser.set_help_flag();  // ours is like any other option
  parser.allow_extras();   // refuse_unknown() tells what was meant
}

CLI::Option* add(CLI::App& parser, const std::string& names, const std::string& value_name, const std::string& help,
                 const std::function<void(const std::string&)>& take) {
  const std::string name = names.substr(names.rfind(',') + 1);
  const auto take_named = [take, name](const std::string& text) {
    try {
      take(text);
    } catch (const UsageError& error) {
      throw UsageError(name + ": " + error.what());
    }
  };
  return parser.add_option_function<std::string>(names, take_named, help)->type_name(value_name)->take_last();
}

void parse(CLI::App& parser, int argc, const char* const* argv) {
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    throw UsageError(explained(error.what()));
  }
  refuse_unknown(parser);
}

}  // namespace raytrace
