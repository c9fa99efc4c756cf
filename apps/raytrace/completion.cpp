#include "completion.h"

#include <string_view>

#include "raytrace/batch/message_text.h"

namespace raytrace {

namespace {

using Entries = std::vector<OptionEntry>;

constexpr const char* made_by = "for raytrace; made by the build from the program's own options\n";

bool takes_value(const OptionEntry& option) { return !option.value_name.empty(); }
bool takes_file(const OptionEntry& option) { return option.value_name.starts_with("FILE"); }
bool takes_list(const OptionEntry& option) { return option.value_name == "LIST"; }

/// The first clause of an option's help.
std::string summary(const OptionEntry& option) {
  const std::string clause = option.help.substr(0, option.help.find_first_of(";:("));
  return clause.substr(0, clause.find_last_not_of(' ') + 1);
}

/// In single quotes, in which `escape` is what stands for one.
std::string quoted(std::string_view text, std::string_view escape) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += escape;
    else
      result += c;
  }
  return result + "'";
}

std::string in_shell_quotes(std::string_view text) { return quoted(text, R"('\'')"); }

// bash

std::string bash_function(const std::string& name, const Entries& options) {
  std::string files, texts, choices, names;
  for (const OptionEntry& option : options) {
    if (option.names.empty()) continue;
    names += (names.empty() ? "" : " ") + option.names.back();
    if (!takes_value(option)) continue;
    // An optional value follows a "=" alone.
    std::string pattern;
    for (const std::string& spelling : option.names)
      pattern += (pattern.empty() ? "" : "|") + spelling + (option.value_is_optional ? "=" : "|" + spelling + "=");
    if (!option.values.empty())
      choices += "    " + pattern + ") _raytrace_words '" + joined(option.values, " ") + "' ;;\n";
    else if (takes_file(option))
      files += (files.empty() ? "" : "|") + pattern;
    else
      texts += (texts.empty() ? "" : "|") + pattern;
  }
  return name + "() {\n  case $option in\n" + choices + "    " + files + ") _raytrace_files ;;\n    " + texts +
         ") ;;\n    *)\n      if [[ $current == -* ]]; then\n        _raytrace_words '" + names +
         "'\n      else\n        _raytrace_files\n      fi ;;\n  esac\n}\n\n";
}

// zsh

/// With a backslash before what means something to _arguments.
std::string zsh_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("[]:\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// An argument of _arguments for each of the option's names.
std::string zsh_option(const OptionEntry& option) {
  std::string specifications;
  for (const std::string& name : option.names) {
    std::string text = "*" + name;
    if (takes_value(option)) text += option.value_is_optional ? "=-" : name.starts_with("--") ? "=" : "+";
    text += "[" + zsh_text(summary(option)) + "]";
    if (takes_value(option)) {
      text += (option.value_is_optional ? "::" : ":") + zsh_text(option.value_name) + ":";
      const std::string values = joined(option.values, " ");
      if (takes_list(option))
        text += "_values -s , " + option.value_name + " " + values;
      else if (!values.empty())
        text += "(" + values + ")";
      else if (takes_file(option))
        text += "_files";
    }
    specifications += " \\\n    " + in_shell_quotes(text);
  }
  return specifications;
}

std::string zsh_function(const std::string& name, const Entries& options, const std::string& arguments) {
  std::string text = name + "() {\n  _arguments -s -S";
  for (const OptionEntry& option : options) text += zsh_option(option);
  return text + " \\\n    " + arguments + "\n}\n\n";
}

// fish

std::string fish_lines(const Entries& options, const std::string& condition) {
  std::string lines;
  for (const OptionEntry& option : options) {
    if (option.names.empty()) continue;
    lines += "complete -c raytrace -n '" + condition + "'";
    for (const std::string& name : option.names)
      lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (takes_value(option) && !option.value_is_optional) lines += takes_file(option) ? " -r -F" : " -x";
    if (!option.values.empty()) lines += " -a '" + joined(option.values, " ") + "'";
    lines += " -d " + quoted(summary(option), R"(\')") + "\n";
  }
  return lines;
}

}  // namespace

std::string bash_completion(const Entries& render, const Entries& merge) {
  return std::string("# Completion in bash ") + made_by + R"(
# After the last comma of a list, too.
_raytrace_words() {
  local before=
  [[ $current == *,* ]] && before=${current%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${current#"$before"}")
}

_raytrace_files() {
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
}

)" + bash_function("_raytrace_render", render) +
         bash_function("_raytrace_merge", merge) + R"(_raytrace() {
  local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}
  # To readline, the = of --option=value is a word of its own.
  if [[ $current == = ]]; then
    current= option+='='
  elif [[ $option == = ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}=
  fi
  COMPREPLY=()
  if ((COMP_CWORD > 1)) && [[ ${COMP_WORDS[1]} == merge ]]; then
    _raytrace_merge
    return
  fi
  _raytrace_render
  if ((COMP_CWORD == 1)) && [[ $current != -* ]]; then
    local words
    mapfile -t words < <(compgen -W 'merge help' -- "$current")
    COMPREPLY+=("${words[@]}")
  fi
}

complete -F _raytrace raytrace
)";
}

std::string zsh_completion(const Entries& render, const Entries& merge) {
  return std::string("#compdef raytrace\n# Completion in zsh ") + made_by + R"zsh(
_raytrace_first() {
  _alternative 'commands:command:(merge help)' 'scenes:scene:_files -g "*.xml(-.)"'
}

)zsh" + zsh_function("_raytrace_render", render, R"zsh('1: :_raytrace_first' '*:scene:_files -g "*.xml(-.)"')zsh") +
         zsh_function("_raytrace_merge", merge, "'*:piece:_files'") +
         R"(_raytrace() {
  if ((CURRENT > 2)) && [[ $words[2] == merge ]]; then
    shift words
    ((CURRENT--))
    _raytrace_merge
  else
    _raytrace_render
  fi
}

_raytrace "$@"
)";
}

std::string fish_completion(const Entries& render, const Entries& merge) {
  const std::string is_merge = "__fish_seen_subcommand_from merge";
  return std::string("# Completion in fish ") + made_by +
         "complete -c raytrace -n __fish_use_subcommand -a merge -d 'Put pieces of a picture together'\n" +
         "complete -c raytrace -n __fish_use_subcommand -a help -d 'Print the options'\n" +
         fish_lines(render, "not " + is_merge) + fish_lines(merge, is_merge);
}

}  // namespace raytrace
