// The command: raytrace SCENE.xml... -o FILE, and raytrace merge.
#include <vector>

#include "about.h"
#include "merge_command.h"
#include "messages.h"
#include "options.h"
#include "process.h"
#include "render_command.h"
#include "run_all.h"

int main(int argc, char** argv) {
  using namespace raytrace;
  const auto program = [&] {
    const std::vector<const char*> arguments = with_command_words_read(argc, argv);
    const int count = static_cast<int>(arguments.size());
    if (is_merge_command(count, arguments.data())) return merge_command(count, arguments.data());
    const Options options = parse_options(count, arguments.data());
    set_verbosity(options.verbosity());
    log_program_in(options.progress);
    if (const auto answer = about_program(options)) {
      print(*answer);
      return exit_code::done;
    }
    return render_command(options);
  };
  run_in_prepared_process([&] { return run_reporting_errors(program); });
}
