// The command: options -> for each frame of each scene: load -> build -> render -> write.
#include <algorithm>
#include <filesystem>

#include "about.h"
#include "exit_code.h"
#include "jobs.h"
#include "merge_command.h"
#include "messages.h"
#include "options.h"
#include "picture_render.h"
#include "picture_settings.h"
#include "process_setup.h"
#include "raytrace/output/complete_picture.h"
#include "run_checks.h"
#include "signals.h"
#include "stages.h"
#include "thread_limit.h"

namespace raytrace {

namespace {

/// A checkpoint that is still there tells that they are not, whatever their formats can.
bool outputs_are_complete(const Options& options) {
  return (options.checkpoint.empty() || !std::filesystem::exists(options.checkpoint)) &&
         std::all_of(options.outputs.begin(), options.outputs.end(), is_complete_picture);
}

int run(const Options& options, Progress& progress) {
  progress.begin(options.job_index, options.job_count);
  if (options.skip_existing && options.renders() && outputs_are_complete(options)) {
    tell_note(joined(options.outputs, ", ") + ": there already, skipped");
    progress.finish();
    return exit_code::done;
  }
  const auto start = PictureRender::Clock::now();
  {
    const StopSignalsWait no_temporary_file_stays;
    check_outputs(options);
  }
  Statistics statistics;
  std::optional<SceneDescription> description = load(options, statistics);
  if (!description) return exit_code::failed;
  description->viewplane = asked_viewplane(description->viewplane, options);
  const Region whole = asked_whole(description->viewplane, options);
  const Region region = asked_region(whole, options);
  if (options.print_scene || options.validate) {
    if (options.print_scene) print(print_scene(*description));
    if (!options.print_scene && !options.quiet) print(summary(*description) + "\n");
    return exit_code::done;
  }

  const std::unique_ptr<const Scene> scene = build(*description, options, statistics);
  if (options.pixel) {
    print_pixel(*scene, *description, region, options);
    return exit_code::done;
  }
  describe(*description, region, options, statistics);
  const Signals signals;
  const Ending ending =
      PictureRender(*scene, *description, options, whole, region, signals, start, progress, statistics).run();
  if (ending == Ending::stopped) {
    return options.checkpoint.empty() ? exit_code::stopped + signals.stop_signal() : exit_code::resumable;
  }
  report(statistics, options);
  return ending == Ending::written ? exit_code::done : exit_code::failed;
}

}  // namespace

}  // namespace raytrace

int main(int argc, char** argv) {
  using namespace raytrace;
  const auto program = [&] {
    if (is_merge_command(argc, argv)) return merge_command(argc, argv);
    Options options = parse_options(argc, argv);
    set_verbosity(options.verbosity());
    if (!options.log_file.empty()) log_to(options.log_file);
    tell_program_in(options.progress);
    if (const auto answer = about_program(options)) {
      print(*answer);
      return exit_code::done;
    }
    options.threads = threads_with_room(options.threads);
    Progress progress(options.progress);
    const Jobs jobs(options);
    const RunChecks checks(jobs);
    return run_all(jobs,
                   [&](const Options& job) { return checks.forbid(job) ? exit_code::failed : run(job, progress); });
  };
  return run_in_prepared_process([&] { return guarded(program); });
}
