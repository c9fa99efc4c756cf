// The command: options -> for each frame of each scene: load -> build -> render -> write.
#include <optional>
#include <utility>
#include <vector>

#include "about.h"
#include "command_words.h"
#include "exit_code.h"
#include "jobs.h"
#include "merge_command.h"
#include "messages.h"
#include "options.h"
#include "picture_render.h"
#include "picture_settings.h"
#include "process_setup.h"
#include "run_checks.h"
#include "signals.h"
#include "stages.h"
#include "thread_limit.h"

namespace raytrace {

namespace {

int run(const Options& options, Progress& progress) {
  progress.begin(options.job_index, options.job_count);
  const auto start = PictureRender::Clock::now();
  std::optional<StopEndsProgram> no_rays_yet;  // whoever asked for a checkpoint begins again, and loses nothing
  if (options.renders() && !options.checkpoint.empty()) no_rays_yet.emplace(exit_code::resumable);
  const bool might_skip = might_be_skipped(options);  // if the files are of this picture, which the scene tells
  if (!might_skip) check_outputs(options);
  Statistics statistics;
  std::optional<SceneDescription> description = load(options, statistics);
  if (!description) return exit_code::failed;
  description->viewplane = asked_viewplane(description->viewplane, options);
  const Region whole = crop_window(description->viewplane, options);
  const Region region = render_window(whole, options);
  if (options.print_scene || options.validate) {
    if (options.print_scene) print(print_scene(*description));
    if (!options.print_scene && !options.quiet) print(summary(*description) + "\n");
    return exit_code::done;
  }
  if (might_skip) {
    if (outputs_are_complete(*description, whole, region, options)) {
      log_note(joined(options.outputs, ", ") + ": there already, skipped");
      progress.skip();
      return exit_code::done;
    }
    check_outputs(options);
  }
  if (options.renders()) check_output_sizes(options, region);

  const std::unique_ptr<const Scene> scene = build(*description, options, statistics);
  if (options.pixel) {
    print_pixel(*scene, *description, region, options);
    return exit_code::done;
  }
  describe(*description, region, options, statistics);
  const Signals signals;
  const RenderOutcome ending =
      PictureRender(*scene, *description, options, whole, region, signals, start, progress, statistics).run();
  if (ending == RenderOutcome::stopped) {
    return options.checkpoint.empty() ? exit_code::stopped + signals.stop_signal() : exit_code::resumable;
  }
  report(statistics, options);
  return ending == RenderOutcome::written ? exit_code::done : exit_code::failed;
}

}  // namespace

}  // namespace raytrace

int main(int argc, char** argv) {
  using namespace raytrace;
  const auto program = [&] {
    const std::vector<const char*> arguments = with_command_words_read(argc, argv);
    const int count = static_cast<int>(arguments.size());
    if (is_merge_command(count, arguments.data())) return merge_command(count, arguments.data());
    Options options = parse_options(count, arguments.data());
    set_verbosity(options.verbosity());
    log_program_in(options.progress);
    if (const auto answer = about_program(options)) {
      print(*answer);
      return exit_code::done;
    }
    const int wanted_threads = std::exchange(options.threads, threads_with_room(options.threads));
    const Jobs jobs(options);  // before the log file is opened, which might be the scene
    if (!options.log_file.empty()) log_to(options.log_file);
    log_missing_threads(wanted_threads, options.threads);
    Progress progress(options.progress);
    const RunChecks checks(jobs);
    return run_all(jobs,
                   [&](const Options& job) { return checks.forbid(job) ? exit_code::failed : run(job, progress); });
  };
  return run_in_prepared_process([&] { return run_reporting_errors(program); });
}
