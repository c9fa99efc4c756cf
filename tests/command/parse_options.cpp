// What the parser makes of command lines, and what it says about those that make no sense.
#include <algorithm>

#include "about.h"
#include "option_parser.h"
#include "options.h"
#include "raytrace/render/renderer.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

Options parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "raytrace");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

/// The parsed options of a complete command line and these arguments.
Options with(const std::vector<const char*>& more) {
  std::vector<const char*> arguments = {"scene.xml", "-o", "a.exr"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return parse(arguments);
}

/// The message of the refusal contains the text.
#define CHECK_REFUSED(expression, text)             \
  do {                                              \
    std::string message;                            \
    try {                                           \
      expression;                                   \
    } catch (const UsageError& error) {             \
      message = error.what();                       \
    }                                               \
    INFO("message: " << message);                   \
    CHECK(message.find(text) != std::string::npos); \
  } while (false)

}  // namespace

TEST_CASE("defaults") {
  const Options options = parse({"scene.xml", "-o", "a.exr"});
  CHECK(options.scenes == std::vector<std::string>{"scene.xml"});
  CHECK(options.frames.empty());
  CHECK(options.variables.empty());
  CHECK_FALSE(options.skip_existing);
  CHECK(options.outputs == std::vector<std::string>{"a.exr"});
  CHECK_FALSE(options.full_float);
  CHECK(options.bit_depth == 8);
  CHECK_FALSE(options.resolution.has_value());
  CHECK(options.scale == 1);
  CHECK_FALSE(options.crop.has_value());
  CHECK_FALSE(options.samples.has_value());
  CHECK(options.seed == 0);
  CHECK(options.threads == thread_count(0));
  CHECK(options.isa.empty());
  CHECK(options.verbosity() == Verbosity::warnings);
  CHECK(options.progress == ProgressStyle::automatic);
  CHECK(options.log_file.empty());
  CHECK(options.statistics.empty());
  CHECK_FALSE(options.validate);
  CHECK_FALSE(options.print_scene);
}

TEST_CASE("every option reaches its setting, in each of its spellings") {
  CHECK(parse({"--output", "a.exr", "-ob.png", "--output=c.tif", "-"}).outputs ==
        std::vector<std::string>{"a.exr", "b.png", "c.tif"});
  CHECK(parse({"--output", "a.exr", "-", "b.xml"}).scenes == std::vector<std::string>{"-", "b.xml"});
  CHECK(parse({"a.xml", "-o", "a.exr", "b.xml"}).scenes == std::vector<std::string>{"a.xml", "b.xml"});
  CHECK(with({"--frames", "-2-0:2"}).frames == std::vector<int>{-2, 0});
  CHECK(with({"--frames=7"}).frames == std::vector<int>{7});
  CHECK(with({"-D", "a=1", "-Db=x=y", "--define=c=", "-D", "a=[2,3]"}).variables ==
        std::map<std::string, std::string>{{"a", "[2,3]"}, {"b", "x=y"}, {"c", ""}});
  CHECK(with({"--skip-existing"}).skip_existing);
  CHECK(with({"--float"}).full_float);
  CHECK(with({"--bit-depth", "16"}).bit_depth == 16);
  for (const std::vector<const char*>& spelling :
       {std::vector{"-r", "20x30"}, std::vector{"-r20x30"}, std::vector{"--resolution=20x30"}}) {
    const Options options = with(spelling);
    REQUIRE(options.resolution.has_value());
    CHECK(options.resolution->width == 20);
    CHECK(options.resolution->height == 30);
  }
  CHECK(with({"--scale", "0.25"}).scale == 0.25);
  CHECK_FALSE(with({}).view.exposure.has_value());
  CHECK(with({"--exposure", "-1.5"}).view.exposure == -1.5);
  CHECK(with({"--exposure=-1.5"}).view.exposure == -1.5);
  CHECK(with({"--exposure", "-.5"}).view.exposure == -0.5);
  CHECK(with({"--exposure", "+2"}).view.exposure == 2);
  CHECK(with({"--exposure", "0"}).view.exposure == 0);
  CHECK_FALSE(with({}).clamp_indirect.has_value());
  CHECK(with({"--clamp-indirect", "10"}).clamp_indirect == 10);
  CHECK(with({"--clamp-indirect=0"}).clamp_indirect == 0);
  CHECK_FALSE(with({}).clay.has_value());
  CHECK(with({"--clay"}).clay == std::vector<std::string>{});
  CHECK(with({"--clay=glass,gold paint"}).clay == std::vector<std::string>{"glass", "gold paint"});
  CHECK_FALSE(with({}).view.transform.has_value());
  CHECK(with({"--view-transform", "agx"}).view.transform == ViewTransform::agx);
  CHECK(with({"--view-transform=khronos-neutral"}).view.transform == ViewTransform::khronos_neutral);
  CHECK(with({"--view-transform=srgb"}).view.transform == ViewTransform::srgb);
  CHECK_FALSE(with({}).view.auto_exposure);
  CHECK(with({"--auto-exposure"}).view.auto_exposure);
  CHECK(with({"--ocio", "a.ocio", "--ocio-display", "d", "--ocio-view", "v", "--ocio-colorspace", "c"}).view.ocio ==
        OcioSettings{"a.ocio", "d", "v", "c"});
  CHECK(with({"--transparent"}).transparent);
  CHECK_FALSE(with({}).transparent);
  CHECK(with({"--crop", "1,2,3,4"}).crop == Region{1, 2, 3, 4});
  CHECK(with({"--crop", "-1,0,5,5"}).crop == Region{-1, 0, 5, 5});
  CHECK(with({"-s", "7"}).samples == 7);
  CHECK(with({"--spp=2147483647"}).samples == 2147483647);
  CHECK(with({"--seed", "18446744073709551615"}).seed == 18446744073709551615U);
  CHECK(with({"-t", "3"}).threads == 3);
  CHECK(with({"--threads", "1024"}).threads == 1024);
  CHECK(with({"--isa", isa_names().front().c_str()}).isa == isa_names().front());
  CHECK(with({"-q"}).verbosity() == Verbosity::errors);
  CHECK(with({"--quiet"}).verbosity() == Verbosity::errors);
  CHECK(with({"-v"}).verbosity() == Verbosity::steps);
  CHECK(with({"-vv"}).verbosity() == Verbosity::details);
  CHECK(with({"--verbose", "--verbose", "-v"}).verbosity() == Verbosity::details);
  CHECK(with({"--progress=auto"}).progress == ProgressStyle::automatic);
  CHECK(with({"--progress=bar"}).progress == ProgressStyle::bar);
  CHECK(with({"--progress", "plain"}).progress == ProgressStyle::plain);
  CHECK(with({"--progress", "none"}).progress == ProgressStyle::none);
  CHECK(with({"--progress=openjd"}).progress == ProgressStyle::openjd);
  CHECK(with({"--progress=alf"}).progress == ProgressStyle::alf);
  CHECK(with({"--progress=json"}).progress == ProgressStyle::json);
  CHECK(with({"--log-file", "run.log"}).log_file == "run.log");
  CHECK(parse({"scene.xml", "--validate"}).validate);
  CHECK(parse({"scene.xml", "--print-scene"}).print_scene);
  CHECK(parse({"--list", "shapes"}).list == "shapes");
  CHECK(parse({"--version"}).version);
  CHECK(parse({"--help"}).help);
  CHECK(parse({"-h"}).help);
}

TEST_CASE("the option --stats takes a file only after an equals sign") {
  CHECK(with({"--stats"}).shows_statistics);
  CHECK(with({"--stats"}).statistics.empty());
  CHECK_FALSE(with({"--stats=file.json"}).shows_statistics);
  CHECK(with({"--stats=file.json"}).statistics == "file.json");
  CHECK_REFUSED(parse({"-o", "a.exr", "scene.xml", "--stats", "a.json"}), "--stats=a.json");
  CHECK_REFUSED(parse({"-o", "a.exr", "scene.xml", "--stats", "json"}), "'json'; --stats takes a file after \"=\"");
  const Options options = parse({"-o", "a.exr", "--stats", "scene.xml"});
  CHECK(options.shows_statistics);
  CHECK(options.scenes == std::vector<std::string>{"scene.xml"});
}

TEST_CASE("the option --display-server takes a host and a port") {
  const auto parsed = [](const char* text) {
    const auto address = with({"--display-server", text}).display_server;
    REQUIRE(address.has_value());
    return address->host + " " + address->port;
  };
  CHECK_FALSE(with({}).display_server.has_value());
  CHECK(parsed("render-pc:4000") == "render-pc 4000");
  CHECK(parsed("10.0.0.7") == "10.0.0.7 14158");
  CHECK(parsed("[::1]:65535") == "::1 65535");
  CHECK(parsed("[fe80::1]") == "fe80::1 14158");
  for (const char* const text : {"", ":", ":14158", "host:", "host:0", "host:65536", "host:tev", "::1", "[::1",
                                 "[::1]4", "[]:1", "a:b:1", "ho]st:1"})
    CHECK_REFUSED(with({"--display-server", text}), "use HOST:PORT, e.g. localhost:14158");
}

TEST_CASE("the last of several settings counts") {
  CHECK(with({"-s", "7", "--spp=8"}).samples == 8);
  CHECK(with({"-r", "1x1", "-r", "2x2"}).resolution->width == 2);
}

TEST_CASE("quiet silences the progress that nobody asked for") {
  CHECK(with({"-q"}).progress == ProgressStyle::none);
  CHECK(with({"-q", "--progress=openjd"}).progress == ProgressStyle::openjd);
}

TEST_CASE("incomplete command lines are refused with what to type") {
  CHECK_REFUSED(parse({}), "raytrace scene.xml -o picture.exr");
  try {
    parse({});
  } catch (const UsageError& error) {
    const std::vector<std::string>& lines = error.more_lines();
    CHECK(std::find(lines.begin(), lines.end(), "Usage: raytrace SCENE.xml... -o FILE [options]") != lines.end());
    CHECK(std::find(lines.begin(), lines.end(), "Examples:") != lines.end());
  }
  CHECK_REFUSED(parse({"-q"}), "no scene given");
  CHECK_REFUSED(parse({"--list"}), "--list needs a value: one of shapes, textures, materials, ");
  CHECK_REFUSED(parse({"--progress"}), "--progress needs a value: one of auto, bar, ");
  CHECK_REFUSED(parse({"my.xml"}), "raytrace my.xml -o picture.exr");
  CHECK_REFUSED(parse({"my.xml", "my.png"}), "raytrace my.xml -o my.png");
  CHECK_REFUSED(parse({"my.xml", "--checkpoint", "-o", "a.exr"}), "--checkpoint needs a value, and -o is an option");
  CHECK_REFUSED(parse({"a.glb", "-o", "a.exr", "--view", "srgb"}), "; did you mean --view-transform srgb?");
  CHECK_REFUSED(parse({"my.xml", "-o"}), "--output needs a value: FILE");
  CHECK_REFUSED(parse({"my.xml", "-o", "a.exr", "-t"}), "--threads needs a value: N");
  CHECK_REFUSED(parse({"", "-o", "a.exr"}), "the scene's file name is empty");
  CHECK_REFUSED(with({"-o", "a.exr"}), "a.exr is given twice");
  CHECK_REFUSED(with({"-o", ""}), "the file name is empty");
}

TEST_CASE("an unknown option is refused with the nearest known one") {
  CHECK_REFUSED(with({"--thread", "4"}), "'--thread'; did you mean '--threads'?");
  CHECK_REFUSED(with({"--resolutoin=8x8"}), "'--resolutoin'; did you mean '--resolution'?");
  CHECK_REFUSED(with({"--stat"}), "did you mean '--stats'?");
  CHECK_REFUSED(with({"-x"}), "there is no option '-x'");
  CHECK_REFUSED(parse({"--frobnicate"}), "there is no option '--frobnicate'");
}

TEST_CASE("the words of other renderers are refused with the option that they stand for") {
  const auto check = [](const char* word, const std::string& option) {
    CHECK_REFUSED(with({word}), "there is no option '" + std::string(word) + "'; did you mean '" + option + "'?");
  };
  for (const char* const word : {"--samples", "--sample", "--samples-per-pixel", "--aa", "-samples", "-spp", "+A0.3"})
    check(word, "--spp");
  for (const char* const word :
       {"--width", "--HEIGHT", "--size", "--res", "--image-size", "-res", "-width", "+W640", "+H480"})
    check(word, "--resolution");
  for (const char* const word : {"--out", "--outfile", "--output_file", "--outputFile", "-output", "+Oa.png"})
    check(word, "--output");
  for (const char* const word : {"--num_threads", "--jobs", "--cpus", "-threads", "+WT4"}) check(word, "--threads");
  for (const char* const word : {"--frame", "--frame-range", "--start", "+KFF10"}) check(word, "--frames");
  check("--region", "--crop");
  check("--set", "--define");
  check("--dry-run", "--validate");
  check("--no-overwrite", "--skip-existing");
  check("--continue", "--resume");
  check("-help", "--help");
  check("--resol", "--resolution");
  CHECK_REFUSED(with({"--samples=16"}), "'--samples'; did you mean '--spp'? (-s, --spp N)");
  CHECK_REFUSED(with({"-j4"}), "'-j'; did you mean '--threads'?");
  CHECK_REFUSED(with({"+Q9"}), "there is no option '+Q9'");
  // Values that are written together with short options are none of these words.
  CHECK(with({"-oout", "-s16"}).outputs.back() == "out");
  CHECK(with({"-o", "-out"}).outputs.size() == 2);
  CHECK(with({"+Scene.xml", "--", "-samples"}).scenes ==
        std::vector<std::string>{"scene.xml", "+Scene.xml", "-samples"});
}

TEST_CASE("every word of other renderers leads to an option that there is") {
  OptionParser parser;
  Options options;
  define_options(parser, options);
  Names known;
  for (const OptionEntry& entry : parser.entries()) known.insert(known.end(), entry.names.begin(), entry.names.end());
  for (const char* const word :
       {"samples",     "width",   "outfile", "frame",    "jobs",     "roi",         "chunk",    "var",
        "simd",        "passes",  "timeout", "continue", "autosave", "nooverwrite", "log",      "timing",
        "check",       "dump",    "silent",  "debug",    "viewer",   "bpp",         "fp32",     "percent",
        "firstsample", "rngseed", "inspect", "plugins",  "ver",      "usage",       "fireflies"}) {
    INFO(word);
    CHECK(std::count(known.begin(), known.end(), option_of_other_renderers(word)) == 1);
  }
}

TEST_CASE("the first word may be a command, or like one") {
  const auto read = [](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "raytrace");
    std::string words;
    for (const char* const word : with_command_words_read(static_cast<int>(arguments.size()), arguments.data()))
      words += std::string(words.empty() ? "" : " ") + word;
    return words;
  };
  CHECK(read({}) == "raytrace");
  CHECK(read({"help"}) == "raytrace --help");
  CHECK(read({"help", "merge"}) == "raytrace merge --help");
  CHECK(read({"merge", "help"}) == "raytrace merge --help");
  CHECK(read({"help", "--spp"}) == "raytrace --help");
  for (const char* const line : {"scene", "mrege.xml", "./mrege", "merge", "-q"})
    CHECK(read({line}) == "raytrace " + std::string(line));
  CHECK_REFUSED(read({"help", "me"}), "there is no help about 'me'");
  CHECK_REFUSED(read({"mrege", "a", "b"}), "no command 'mrege'; did you mean 'raytrace merge'?");
  CHECK_REFUSED(read({"Merge"}), "did you mean 'raytrace merge'?");
  CHECK_REFUSED(read({"halp"}), "did you mean 'raytrace help'?");
  CHECK_REFUSED(read({"render", "a.xml"}), "no command 'render'; use raytrace scene.xml -o picture.exr");
}

TEST_CASE("what is no value of an option is refused with what would be one") {
  CHECK_REFUSED(with({"--resolution", "800by600"}),
                "--resolution: '800by600' is not a resolution; use WIDTHxHEIGHT, e.g. 1920x1080");
  for (const char* const text : {"0x10", "10x-1", "10x", "x10", "10x10x10", "1e3x10", "10 x 10", ""})
    CHECK_REFUSED(with({"-r", text}), "use WIDTHxHEIGHT");
  for (const char* const text : {"0", "-1", "nan", "inf", "2x", "", " 1", "1e999"})
    CHECK_REFUSED(with({"--scale", text}), "is not a scale");
  for (const char* const text : {"0", "-3", "1.5", "many", "2147483648", ""})
    CHECK_REFUSED(with({"-s", text}), "--spp: '" + std::string(text) + "' is not a whole number from 1 to 2147483647");
  for (const char* const text : {"0", "-2", "1025"})
    CHECK_REFUSED(with({"-t", text}), "is not a whole number from 1 to 1024");
  for (const char* const text : {"-1", "18446744073709551616", "0x10", "1.0"})
    CHECK_REFUSED(with({"--seed", text}), "is not a whole number from 0 to 2^64 - 1, nor 'frame'");
  for (const char* const text : {"1,2,3", "1,2,3,4,5", "a,b,c,d", "0.5,0,1,1", "1 2 3 4", "", "1,2,3,"})
    CHECK_REFUSED(with({"--crop", text}), "use x0,y0,x1,y1");
  for (const char* const text : {"5,5,5,6", "5,5,6,5", "9,0,1,1"})
    CHECK_REFUSED(with({"--crop", text}), "holds no pixel");
  for (const char* const text : {"radius", "=2", "1a=2", "a b=2", "$a=2", ""})
    CHECK_REFUSED(with({"-D", text}), "use NAME=VALUE, e.g. -D radius=2");
  CHECK_REFUSED(with({"-D", "frame=2"}), "$frame is the frame's number; use --frames");
  CHECK_REFUSED(with({"-D", "a=\xff"}), "the value of a is no text in UTF-8");
  CHECK_REFUSED(with({"-D", "a=\n"}), "without control characters");
  CHECK_REFUSED(with({"--frames", "1..5"}), "--frames: '1..5' is no list of frames");
  CHECK_REFUSED(with({"--bit-depth", "12"}), "neither 8 nor 16");
  for (const char* const text : {"", "bright", "1x", "nan", "inf", "-inf", "64.5", "-65", "+", "+-1", "--1", "1,5"})
    CHECK_REFUSED(with({"--exposure", text}), "is not an exposure");
  for (const char* const text : {"", "-1", "nan", "inf", "1e18", "10x", "any"})
    CHECK_REFUSED(with({"--clamp-indirect", text}), "is no radiance; use a number such as 10");
  CHECK_REFUSED(with({"--clay=a,,b"}), "'a,,b' has a name that is empty");
  CHECK_REFUSED(with({"--view-transform", "agxx"}), "did you mean 'agx'?");
  CHECK_REFUSED(with({"--view-transform", "khronos"}), "is not one of srgb, agx, khronos-neutral");
  CHECK_REFUSED(with({"--ocio", ""}), "the name is empty");
  CHECK_REFUSED(with({"--ocio", "a.ocio", "--view-transform", "agx"}), "takes the place of a view transform");
  CHECK_REFUSED(with({"--ocio-view", "v"}), "say which with --ocio");
  CHECK_REFUSED(with({"--ocio-display", "v"}), "say which with --ocio");
  CHECK_REFUSED(with({"--ocio-colorspace", "v"}), "say which with --ocio");
  CHECK_REFUSED(with({"--log-file="}), "--log-file");
  CHECK_REFUSED(with({"--progress", "plan"}), "did you mean 'plain'?");
  CHECK_REFUSED(with({"--isa", (isa_names().front() + "x").c_str()}), "did you mean '" + isa_names().front() + "'?");
  CHECK_REFUSED(parse({"--list", "shape"}), "did you mean 'shapes'?");
  CHECK_REFUSED(with({"--float=yes"}), "--float takes no value");
  CHECK_REFUSED(with({"-q", "-v"}), "excludes");
}

TEST_CASE("options for models are refused for scenes, by their names and at once") {
  CHECK_REFUSED(parse({"a.xml", "--turntable", "4", "-o", "x.exr"}), "--turntable is for models: a.xml has a camera");
  CHECK_REFUSED(parse({"a.xml", "--floor", "-o", "x.exr"}), "--floor is for models: a.xml has");
  CHECK_REFUSED(parse({"a.glb", "-", "--sun", "1,2", "--floor", "-o", "x.exr"}),
                "--floor, --sun are for models: <stdin> has");
  CHECK(parse({"a.glb", "b.obj", "--floor", "-o", "x.exr"}).stage->floor);
}

}  // namespace raytrace::test
