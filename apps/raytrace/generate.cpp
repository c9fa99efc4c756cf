// Prints what is made of the program's options; run by the build.
//   raytrace_generate raytrace.1 | raytrace-merge.1 | bash | zsh | fish
#include <iostream>
#include <string_view>

#include "manual.h"
#include "merge_command.h"
#include "options.h"
#include "raytrace/batch/provenance.h"

int main(int argc, char** argv) {
  using namespace raytrace;
  OptionParser render, merge;
  Options options;
  MergeOptions merge_options;
  define_options(render, options);
  define_merge_options(merge, merge_options);
  const std::string_view what = argc == 2 ? argv[1] : "";
  if (what == "raytrace.1")
    std::cout << man_page(render_manual, render.entries(), software_name());
  else if (what == "raytrace-merge.1")
    std::cout << man_page(merge_manual, merge.entries(), software_name());
  else if (what == "bash")
    std::cout << bash_completion(render.entries(), merge.entries());
  else if (what == "zsh")
    std::cout << zsh_completion(render.entries(), merge.entries());
  else if (what == "fish")
    std::cout << fish_completion(render.entries(), merge.entries());
  else
    return 2;
  return std::cout.flush() ? 0 : 1;
}
