// The command: options -> load -> build -> render -> write.
#include <iostream>
#include <new>

#include "about.h"
#include "exit_code.h"
#include "messages.h"
#include "options.h"
#include "picture_settings.h"
#include "signals.h"
#include "stages.h"

namespace raytrace {

namespace {

int print(const std::string& text) {
  std::cout << text << std::flush;
  if (std::cout) return exit_code::done;
  tell_error("cannot write to standard output");
  return exit_code::failed;
}

int run(const Options& options) {
  if (const auto answer = about_program(options)) return print(*answer);

  check_outputs(options);
  Statistics statistics;
  std::optional<SceneDescription> description = load(options, statistics);
  if (!description) return exit_code::failed;
  description->viewplane = asked_viewplane(description->viewplane, options);
  const Region region = asked_region(description->viewplane, options);
  if (options.print_scene) return print(print_scene(*description));
  if (options.validate) return options.quiet ? exit_code::done : print(summary(*description) + "\n");

  const std::unique_ptr<const Scene> scene = build(*description, options, statistics);
  const StopOnSignal stop;
  const ViewPlane& viewplane = description->viewplane;
  Outputs outputs(options, {viewplane.hres, viewplane.vres, region}, camera_matrices(*description));
  render(*scene, *description, region, options, stop.flag(), outputs, statistics);
  if (stop.signal() != 0) return exit_code::stopped + stop.signal();

  const bool written = outputs.commit(statistics);
  report(statistics, options);
  return written ? exit_code::done : exit_code::failed;
}

}  // namespace

}  // namespace raytrace

int main(int argc, char** argv) {
  using namespace raytrace;
  try {
    const Options options = parse_options(argc, argv);
    set_verbosity(options.verbosity());
    return run(options);
  } catch (const UsageError& error) {
    tell_error(std::string(error.what()) + "\nTry 'raytrace --help'.");
    return exit_code::usage;
  } catch (const std::bad_alloc&) {
    tell_error("out of memory");
    return exit_code::out_of_memory;
  } catch (const std::exception& error) {
    tell_error(error.what());
    return exit_code::failed;
  }
}
