#include "command_words.h"

#include <filesystem>
#include <string_view>

#include "option_values.h"
#include "raytrace/text/quoted.h"

namespace raytrace {

namespace {

struct OptionForWord {
  std::string_view word;
  const char* instead;
};

constexpr OptionForWord option_words[] = {{"render", "raytrace scene.xml -o picture.exr"},
                                          {"validate", "raytrace scene.xml --validate"},
                                          {"check", "raytrace scene.xml --validate"},
                                          {"print", "raytrace scene.xml --print-scene"},
                                          {"list", "raytrace --list shapes"},
                                          {"version", "raytrace --version"},
                                          {"resume", "raytrace scene.xml -o picture.exr --checkpoint FILE --resume"}};

void refuse_wrong_word(const std::string& word) {
  if (word.empty() || word.find_first_of("./-") != std::string::npos || std::filesystem::exists(word)) return;
  const std::string start = "there is no scene and no command " + in_quotes(word) + "; ";
  for (const OptionForWord& option : option_words)
    if (word == option.word) throw UsageError(start + "use " + option.instead);
  const std::string meant = nearest(word, {"merge", "help"});
  if (!meant.empty()) throw UsageError(start + "did you mean 'raytrace " + meant + "'?");
}

}  // namespace

std::vector<const char*> with_command_words_read(int argc, const char* const* argv) {
  std::vector<const char*> arguments(argv, argv + argc);
  if (argc < 2) return arguments;
  const std::string_view first(argv[1]), second(argc > 2 ? argv[2] : "");
  if (first == "help" && argc <= 3) {
    if (second == "merge") return {argv[0], argv[2], "--help"};
    if (second.empty() || second.starts_with('-') || second == "help") return {argv[0], "--help"};
    throw UsageError("there is no help about " + in_quotes(second) +
                     "; there is raytrace help and raytrace help merge");
  }
  if (first == "merge" && second == "help" && argc == 3) return {argv[0], argv[1], "--help"};
  if (first != "merge") refuse_wrong_word(std::string(first));
  return arguments;
}

}  // namespace raytrace
