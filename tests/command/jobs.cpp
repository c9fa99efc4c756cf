// The renders that a command line asks for.
#include "messages.h"
#include "options.h"
#include "process.h"
#include "run_all.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

RenderBatch jobs(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "raytrace");
  const Options options = parse_options(static_cast<int>(arguments.size()), arguments.data());
  return RenderBatch(options.scenes, options.frames, options);
}

std::string refusal(const std::vector<const char*>& arguments) {
  try {
    jobs(arguments);
  } catch (const SettingsError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a run of one render") {
  const RenderBatch one = jobs({"s.xml", "-o", "take#1.exr"});
  REQUIRE(one.size() == 1);
  CHECK(one[0].scene == "s.xml");
  CHECK(one[0].frame == 1);
  CHECK(one[0].outputs == std::vector<std::string>{"take#1.exr"});
  CHECK(one.name(0) == "s.xml");
  // One frame needs no token.
  CHECK(jobs({"s.xml", "-o", "a.exr", "--frames", "7"})[0].outputs[0] == "a.exr");
}

TEST_CASE("each frame of each scene") {
  const RenderBatch all = jobs({"a.##.xml", "b.xml", "-o", "{scene}.####.exr", "-o", "p/{scene}.%d.png", "--frames",
                                "3-5:2", "-s7", "--stats={scene}.#.json"});
  REQUIRE(all.size() == 4);
  CHECK(all[0].scene == "a.03.xml");
  CHECK(all[1].scene == "a.05.xml");
  CHECK(all[1].frame == 5);
  CHECK(all[1].outputs == std::vector<std::string>{"a.05.0005.exr", "p/a.05.5.png"});
  CHECK(all[2].scene == "b.xml");
  CHECK(all[3].outputs == std::vector<std::string>{"b.0005.exr", "p/b.5.png"});
  CHECK(all[3].statistics == "b.5.json");
  CHECK(all[3].samples == 7);
  CHECK(all.name(3) == "b.xml, frame 5");
}

TEST_CASE("renders that would write the same file are refused with a name to use") {
  CHECK(refusal({"s.xml", "-o", "a.exr", "--frames", "1-2"}) ==
        "--output: more than one render would write a.exr; use a name such as a.####.exr");
  CHECK(refusal({"s.xml", "-o", "a.#.exr", "--frames", "1-2", "--stats=s.json"}) ==
        "--stats: more than one render would write s.json; use a name such as s.####.json");
  CHECK(refusal({"s.xml", "t.xml", "-o", "a.exr"}) ==
        "--output: more than one render would write a.exr; use a name such as a.{scene}.exr");
  CHECK(refusal({"s.xml", "t.xml", "-o", "a.exr", "--frames=1,2"}) ==
        "--output: more than one render would write a.exr; use a name such as a.{scene}.####.exr");
  CHECK(refusal({"x/s.xml", "y/s.xml", "-o", "{scene}.exr"}) ==
        "--output: more than one render would write s.exr; give scenes and outputs names that differ");
  CHECK(refusal({"s.xml", "-o", "a.#.exr", "-o", "a.%d.exr", "--frames=1"}) ==
        "--output: more than one render would write a.1.exr; give scenes and outputs names that differ");
  CHECK(refusal({"s.xml", "t.xml", "-o", "{scene}.exr", "--stats"}) == "");
  CHECK(refusal({"s.xml", "-o", "a.{tile}.exr"}).find("--tile 0/4") != std::string::npos);
}

TEST_CASE("standard input is read once") {
  CHECK(refusal({"-", "-", "-o", "{scene}.exr"}) ==
        "standard input can be read once; give a file for the second scene");
  CHECK(refusal({"-", "-o", "#.exr", "--frames=1,2"}) ==
        "standard input can be read once; give a file for several frames");
  CHECK(jobs({"-", "s.xml", "-o", "{scene}.exr"})[0].outputs[0] == "stdin.exr");
}

TEST_CASE("one scene is printed, any number validated") {
  CHECK(refusal({"s.xml", "t.xml", "--print-scene"}) == "--print-scene prints one scene; give one");
  CHECK(refusal({"s.xml", "--print-scene", "--frames=3-4"}) ==
        "--print-scene prints one scene; give one, and one frame, e.g. --frames 3");
  CHECK(jobs({"s.xml", "t.xml", "--validate", "--frames=1-3"}).size() == 6);
}

TEST_CASE("a render that fails does not stop the others, a signal does") {
  set_verbosity(Verbosity::errors);
  const RenderBatch all = jobs({"s.xml", "-o", "#.exr", "--frames=1-5"});
  std::vector<int> seen;
  const auto run = [&](int failing, int code) {
    seen.clear();
    return run_all(all, [&, failing, code](const RenderJob& job, std::size_t) {
      seen.push_back(job.frame);
      return job.frame % failing == 0 ? code : exit_code::done;
    });
  };
  const std::vector<int> everyone = {1, 2, 3, 4, 5};
  CHECK(run(9, exit_code::failed) == exit_code::done);
  CHECK(run(2, exit_code::failed) == exit_code::failed);
  CHECK(seen == everyone);
  CHECK(run(2, exit_code::out_of_memory) == exit_code::out_of_memory);
  CHECK(seen == everyone);
  CHECK(run(3, exit_code::stopped + 15) == exit_code::stopped + 15);
  CHECK(seen == std::vector<int>{1, 2, 3});

  seen.clear();
  CHECK(run_all(all, [&](const RenderJob& job, std::size_t) -> int {
          seen.push_back(job.frame);
          if (job.frame == 2) throw UsageError("x");
          if (job.frame == 4) throw std::runtime_error("y");
          return exit_code::done;
        }) == exit_code::failed);
  CHECK(seen == everyone);
  set_verbosity(Verbosity::warnings);
}

}  // namespace raytrace::test
