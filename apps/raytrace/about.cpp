#include "about.h"

#include <tbb/version.h>

#include "listing.h"
#include "manual.h"
#include "option_parser.h"
#include "raytrace/render/renderer.h"

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
  std::string isas;
  for (const std::string& name : isa_names()) isas += (isas.empty() ? "" : ", ") + name;
  // An empty scene knows which Embree it is made with.
  const std::string embree_version = build_scene({}, {1, "", true})->statistics().embree_version;
  return software_name() + "\nEmbree " + embree_version + "\nOpenImageIO " OPENIMAGEIO_VERSION "\noneTBB " +
         TBB_runtime_version() + "\ninstruction sets: " + isas + " (best here: " + best_isa() + ")\n";
}

}  // namespace

std::string software_name() { return "raytrace " RAYTRACE_VERSION; }

std::optional<std::string> about_program(const Options& options) {
  if (options.help) return help();
  if (options.version) return version();
  if (!options.list.empty()) return listing(options.list);
  return std::nullopt;
}

}  // namespace raytrace
