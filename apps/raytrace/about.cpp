#include "about.h"

#include <tbb/version.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "manual.h"
#include "option_parser.h"
#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/cameras/registry.h"
#include "raytrace/import/mesh_codecs.h"
#include "raytrace/integrators/registry.h"
#include "raytrace/lights/registry.h"
#include "raytrace/materials/registry.h"
#include "raytrace/render/renderer.h"
#include "raytrace/shapes/registry.h"
#include "raytrace/text/message.h"
#include "raytrace/textures/registry.h"

namespace raytrace {

namespace {

std::string help() {
  OptionParser parser;
  Options options;
  define_options(parser, options);
  return help_text(render_manual, parser.entries());
}

/// The version, the libraries' and the instruction sets, one a line.
std::string version() {
  // An empty scene knows which Embree it is made with.
  const std::string embree_version = build_scene({}, {1, "", true})->statistics().embree_version;
  std::string codecs;
  for (const std::string& codec : mesh_codecs()) codecs += '\n' + codec;
  return software_name() + "\nEmbree " + embree_version + "\nOpenImageIO " OPENIMAGEIO_VERSION "\noneTBB " +
         TBB_runtime_version() + codecs + "\ninstruction sets: " + joined(isa_names(), ", ") +
         " (best here: " + best_isa() + ")\n";
}

std::vector<std::pair<std::string, Names>> listings() {
  return {{"shapes", names_in(Objects())},
          {"textures", names_in(Textures())},
          {"materials", names_in(Materials())},
          {"lights", names_in(Lights())},
          {"cameras", names_in(Cameras())},
          {"integrators", names_in(Integrators())},
          {"aovs", aov_names()}};
}

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

std::vector<std::string> listing_names() {
  std::vector<std::string> names;
  for (const auto& [name, members] : listings()) names.push_back(name);
  return names;
}

std::optional<std::string> about_program(const Options& options) {
  if (options.help) return help();
  if (options.version) return version();
  for (const auto& [name, members] : listings())
    if (name == options.list) return joined(members, "\n") + "\n";
  return std::nullopt;
}

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
