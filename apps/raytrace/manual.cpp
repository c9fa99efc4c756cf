#include "manual.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "process.h"
#include "raytrace/text/message.h"

namespace raytrace {

struct Entry {
  std::string term;
  std::string text;
};

struct Section {
  std::string title;
  std::vector<Entry> entries;
};

struct Manual {
  std::string command;   ///< "raytrace"
  std::string purpose;   ///< after "command: "
  std::string synopsis;  ///< the form of the command line
  Section examples;
  Section exit_codes;
};

const Manual render_manual = {
    "raytrace",
    "render a scene file to image files",
    "raytrace SCENE.xml... -o FILE [options]",
    {"Examples",
     {{"raytrace scenes/seed.xml -o seed.exr -o seed.png", "Both files from one render."},
      {"raytrace scene.xml -o draft.png --scale 0.25 -s 1 --stats", "A quick look, and what it took."},
      {"raytrace scene.xml --frames 1-48 -D size=2 -o picture.####.exr", "An animation."},
      {"raytrace scene.xml -o final.exr --checkpoint final.state --resume",
       "Goes on where an earlier run of the same command was stopped."},
      {"raytrace scene.xml -o tile.2.exr --tile 2/8", "The third of eight parts."},
      {"raytrace merge tile.*.exr -o whole.exr", "Puts the parts together: see raytrace merge --help."}}},
    {"Exit codes",
     {{std::to_string(exit_code::done), "Done."},
      {std::to_string(exit_code::failed), "The scene has errors, the render failed, or a file could not be written."},
      {std::to_string(exit_code::usage), "Invalid command line."},
      {std::to_string(exit_code::out_of_memory), "Out of memory."},
      {std::to_string(exit_code::resumable),
       "Stopped by SIGINT, SIGTERM, SIGHUP, SIGXCPU or SIGUSR2 with the checkpoint and the picture so far written: "
       "--resume goes on."},
      {"130, 143",
       "Stopped by SIGINT or SIGTERM without a checkpoint, as 128 + n by any of these signals, of number n; the "
       "picture "
       "so far is written, but not over a complete one."}}}};

const Manual merge_manual = {
    "raytrace merge",
    "put pieces of a picture together",
    "raytrace merge PIECES... -o FILE [options]",
    {"Examples",
     {{"raytrace merge tile.*.exr -o whole.exr", "Tiles, crops, ranges of samples, or all of these, in any order."},
      {"raytrace merge part.*.exr -o whole.exr -o whole.png -s 64", "Refuses to end with less than 64 samples."}}},
    {"Exit codes",
     {{std::to_string(exit_code::done), "Done."},
      {std::to_string(exit_code::failed),
       "The pieces do not fit together, or do not cover the picture; a file could not be read or written."},
      {std::to_string(exit_code::usage), "Invalid command line."},
      {std::to_string(exit_code::out_of_memory), "Out of memory."}}}};

namespace {

std::vector<Section> option_sections(const std::vector<OptionEntry>& options) {
  std::vector<Section> sections;
  for (const OptionEntry& option : options) {
    if (sections.empty() || sections.back().title != option.group) sections.push_back({option.group, {}});
    sections.back().entries.push_back({option.term(), option.help});
  }
  return sections;
}

std::size_t longest_term(const std::vector<Section>& sections) {
  std::size_t longest = 0;
  for (const Section& section : sections) {
    for (const Entry& entry : section.entries) longest = std::max(longest, entry.term.size());
  }
  return longest;
}

/// The text in lines of at most `width`, all but the first one indented.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result;
  while (text.size() > width) {
    const std::size_t space = text.rfind(' ', width);
    const std::size_t end = space == std::string_view::npos ? std::min(text.find(' '), text.size()) : space;
    result += text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    result += '\n' + std::string(indent, ' ');
  }
  return result + std::string(text);
}

/// A backslash and a leading dot or quote mean something to troff, and a bare "-" is a hyphen, which cannot be copied
/// to a shell.
std::string troff(std::string_view text) {
  std::string result;
  if (text.starts_with('.') || text.starts_with('\'')) result = "\\&";
  for (const char c : text) {
    if (c == '-') {
      result += "\\-";
    } else if (c == '\\') {
      result += "\\e";
    } else {
      result += c;
    }
  }
  return result;
}

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

std::string troff_section(const Section& section) {
  std::string page = ".SH " + in_capitals(section.title) + "\n";
  for (const Entry& entry : section.entries) {
    page += ".TP\n\\fB" + troff(entry.term) + "\\fR\n" + troff(entry.text) + "\n";
  }
  return page;
}

std::string examples_text(const Section& examples) {
  std::string text = "\n" + examples.title + ":\n";
  for (const Entry& example : examples.entries) text += "  " + example.term + "\n      " + example.text + "\n";
  return text;
}

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

std::vector<std::string> short_help(const Manual& manual) {
  std::vector<std::string> lines = {"", "Usage: " + manual.synopsis};
  std::istringstream examples(examples_text(manual.examples));
  for (std::string line; std::getline(examples, line);) lines.push_back(line);
  lines.emplace_back();
  return lines;
}

std::string help_text(const Manual& manual, const std::vector<OptionEntry>& options) {
  constexpr std::size_t columns = 80;
  std::string help = manual.command + ": " + manual.purpose + "\n\nUsage: " + manual.synopsis + "\n";
  const std::vector<Section> sections = option_sections(options);
  const auto append = [&](const Section& section, std::size_t indent) {
    help += "\n" + section.title + ":\n";
    for (const Entry& entry : section.entries)
      help += "  " + entry.term + std::string(indent - 2 - entry.term.size(), ' ') +
              wrapped(entry.text, columns - indent, indent) + "\n";
  };
  for (const Section& section : sections) append(section, longest_term(sections) + 4);
  help += examples_text(manual.examples);
  append(manual.exit_codes, longest_term({manual.exit_codes}) + 4);
  return help;
}

std::string man_page(const Manual& manual, const std::vector<OptionEntry>& options, const std::string& software) {
  std::string name = manual.command;  // a page is one word
  std::replace(name.begin(), name.end(), ' ', '-');
  std::string page = ".TH " + troff(in_capitals(name)) + " 1 \"\" \"" + troff(software) + "\"\n";
  page += ".SH NAME\n" + troff(name) + " \\- " + troff(manual.purpose) + "\n";
  page += ".SH SYNOPSIS\n\\fB" + troff(manual.synopsis) + "\\fR\n";
  for (const Section& section : option_sections(options)) page += troff_section(section);
  page += troff_section(manual.examples) + troff_section(manual.exit_codes);
  return page;
}

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
