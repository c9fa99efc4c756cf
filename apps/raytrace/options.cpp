#include "options.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "about.h"
#include "manual.h"
#include "option_parser.h"
#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/check_job.h"
#include "raytrace/batch/frames.h"
#include "raytrace/description/variables.h"
#include "raytrace/integrators/registry.h"
#include "raytrace/render/renderer.h"
#include "raytrace/text/message.h"
#include "raytrace/text/utf8.h"
#include "view_arguments.h"

namespace raytrace {

namespace {

std::string instruction_set(const std::string& text) {
  one_of(text, isa_names());
  if (!isa_supported(text)) {
    throw UsageError("this processor has no " + text + "; its best is " + best_isa());
  }
  return text;
}

Names progress_names() { return {"auto", "bar", "plain", "openjd", "alf", "json", "none"}; }

ProgressStyle progress_style(const std::string& text) {
  const Names names = progress_names();
  const ProgressStyle styles[] = {ProgressStyle::automatic, ProgressStyle::bar, ProgressStyle::plain,
                                  ProgressStyle::openjd,    ProgressStyle::alf, ProgressStyle::json,
                                  ProgressStyle::none};
  return styles[std::find(names.begin(), names.end(), one_of(text, names)) - names.begin()];
}

/// "name=value"
void define(const std::string& text, std::map<std::string, std::string>& variables) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (equals == std::string::npos || !is_variable_name(name)) {
    throw UsageError(in_quotes(text) + " sets no variable; use NAME=VALUE, e.g. -D radius=2 for $radius");
  }
  if (name == frame_variable) throw UsageError("$frame is the frame's number; use --frames");
  const std::string value = text.substr(equals + 1);
  const bool has_control = std::any_of(value.begin(), value.end(), [](char c) { return c >= 0 && c < ' '; });
  if (has_control || find_invalid_utf8(value, 1) != std::string_view::npos) {
    throw UsageError("the value of " + name + " is no text in UTF-8 without control characters");
  }
  variables[name] = value;
}

/// What --stats is without a file.
constexpr const char* statistics_as_text = "text";

/// What --clay is without names: no material has this one.
constexpr const char* all_of_clay = "*";

constexpr const char* models_group = "Models";

constexpr const char* no_scene = "no scene given; for example: raytrace scene.xml -o picture.exr";

/// given: those of the options for models.
void refuse_for_scenes(const Options& options, const Names& given) {
  for (const std::string& scene : options.scenes)
    if (!given.empty() && !is_model(scene))
      throw UsageError(joined(given, ", ") + (given.size() == 1 ? " is" : " are") +
                       " for models: " + on_one_line(scene == "-" ? "<stdin>" : scene) + " has a camera and lights");
}

void refuse_incomplete(const Options& options) {
  if (options.scenes.empty()) throw UsageError(no_scene);
  for (const std::string& scene : options.scenes) {
    if (scene.empty()) throw UsageError("the scene's file name is empty");
    if (scene == "merge" && !std::filesystem::exists(scene))
      throw UsageError("the command comes first: raytrace merge, and then its options");
    if (options.statistics == statistics_as_text && scene.ends_with(".json"))
      throw UsageError("--stats takes a file after \"=\": --stats=" + scene);
    const bool is_word = scene != "-" && scene.find('.') == std::string::npos && !std::filesystem::exists(scene);
    if (options.statistics == statistics_as_text && options.scenes.size() > 1 && is_word)
      throw UsageError("there is no scene " + in_quotes(scene) +
                       "; --stats takes a file after \"=\": --stats=FILE.json");
    if (options.clay && options.clay->empty() && options.scenes.size() > 1 && is_word)
      throw UsageError("there is no scene " + in_quotes(scene) + "; --clay takes names after \"=\": --clay=" + scene);
  }
  if (options.outputs.empty() && options.renders()) {
    const std::string& last = options.scenes.back();
    const bool is_picture = options.scenes.size() > 1 && (last.ends_with(".exr") || last.ends_with(".png") ||
                                                          last.ends_with(".jpg") || last.ends_with(".tif"));
    throw UsageError("no output given; for example: raytrace " + options.scenes.front() + " -o " +
                     (is_picture ? last : "picture.exr"));
  }
  require_good_job(options);
  if (options.print_scene && (options.scenes.size() > 1 || options.frames.size() > 1)) {
    throw UsageError(
        "--print-scene prints one scene; give one" +
        (options.frames.size() > 1 ? ", and one frame, e.g. --frames " + std::to_string(options.frames.front()) : ""));
  }
  for (auto output = options.outputs.begin(); output != options.outputs.end(); ++output) {
    if (output->empty()) throw UsageError("--output: the file name is empty");
    if (std::find(options.outputs.begin(), output, *output) != output) {
      throw UsageError("--output: " + *output + " is given twice");
    }
  }
}

}  // namespace

Verbosity Options::verbosity() const {
  if (quiet) return Verbosity::errors;
  if (verbose == 0) return Verbosity::warnings;
  return verbose == 1 ? Verbosity::steps : Verbosity::details;
}

void define_options(OptionParser& parser, Options& options) {
  constexpr int largest = std::numeric_limits<int>::max();
  constexpr int most_threads = 1024;
  parser.group("Input");
  parser.add_arguments("SCENE.xml",
                       "Scene files; - reads one from standard input. Or models (.glb, .gltf, .obj, .ply, .stl, .fbx, "
                       ".dae, .vdb...), which "
                       "get a camera and lights",
                       options.scenes);
  parser.add(
      "--frames", "FRAMES",
      "Render these frames, e.g. 1-10:2,15; #### or %04d in the names of scenes, outputs and statistics is the number, "
      "{#} a #",
      options.frames, frame_numbers);
  parser.add_repeatable("-D,--define", "NAME=VALUE", "Set the variable $NAME of the scene; repeatable",
                        [&](const std::string& text) { define(text, options.variables); });
  parser.add("--missing-texture", "error|warn",
             "What a texture is whose file cannot be read: an error, or a warning and magenta (error)",
             options.textures.missing, missing_texture, {"error", "warn"});
  parser.add(
      "--texture-memory", "SIZE",
      "Keep so many bytes of textures in memory, e.g. 2G or 500M, the others in files in $TMPDIR or /var/tmp (half "
      "of what is free)",
      options.textures.memory, byte_count);

  const auto stage = [&]() -> ModelStage& {
    if (!options.stage) options.stage.emplace();
    return *options.stage;
  };
  parser.group(models_group);
  parser.add("--view", "front|back|side|top|iso|A,E",
             "Look from there: A degrees from the model's front to its right, E degrees above (30,15)",
             [stage](const std::string& text) {
               const auto [azimuth, elevation] = model_view(text);
               stage().view = {azimuth, elevation};
             });
  parser.add("--camera", "NAME", "Look by this camera of the file (its first, if it has any and there is no --view)",
             [stage](const std::string& text) {
               if (text.empty()) throw UsageError("the name is empty");
               stage().camera = text;
             });
  parser.add(
      "--animation", "NAME",
      "Animate by this one of the file (its first, if there are --frames), by its name or its number from 0, or by all",
      [stage](const std::string& text) { stage().animation = label(text); });
  parser.add("--fps", "F", "Frame 1 is the animation's beginning, and F frames are a second of it (24)",
             [stage](const std::string& text) { stage().frames_per_second = frames_per_second(text); });
  parser.add("--variant", "NAME", "Take this variant of the file's materials, by its name or its number from 0",
             [stage](const std::string& text) { stage().variant = label(text); });
  parser.add("--up", "y|z", "Which way is up in the file (y); z in most of CAD",
             [stage](const std::string& text) { stage().z_is_up = one_of(text, {"y", "z"}) == "z"; });
  parser.add("--turntable", "N", "Render a full turn in N frames, or those of --frames",
             [stage](const std::string& text) { stage().turntable = integer(text, 1, 100'000); });
  parser.add_switch("--floor", options.floor, "Stand the model on an endless grey floor");
  parser.add("--environment", "FILE|sky|none",
             "Light by a picture of all that is around (.exr, .hdr), by a sky with its sun, or by nothing but the "
             "model's own lights and what of it shines",
             [stage](const std::string& text) {
               if (text.empty()) throw UsageError("the file name is empty");
               stage().environment = text;
             });
  parser.add("--sun", "A,E", "Light by a sun there, as --view has angles; in the sky of --environment, if it has one",
             [stage](const std::string& text) { stage().sun = sun_angles(text); });

  parser.group("Output");
  parser.add_repeatable(
      "-o,--output", "FILE",
      "Write the picture to FILE, in the format of its extension (.exr, .png, .tif, .jpg, .hdr...); "
      "repeatable, for several files from one render. {scene} in the name is that of the scene, {tile} the "
      "tile's number",
      [&](const std::string& text) { options.outputs.push_back(text); });
  parser.add_switch("--skip-existing", options.skip_existing,
                    "Render no frame whose outputs all exist and are complete");
  parser.add_switch("--float", options.full_float, "32 bit floats in EXR (else 16 bit) and in TIFF (else sRGB)");
  parser.add_switch("--transparent", options.transparent,
                    "Leave the background out of the colour; alpha is coverage: premultiplied in EXR, straight RGBA in "
                    "PNG and TIFF");
  parser.add_switch("--denoise", options.denoise,
                    "Take the noise out of the picture by Open Image Denoise; EXR files keep the noisy one, too. Of "
                    "tiles and parts of the samples, `raytrace merge` does");
  define_view_options(parser, options.view);
  parser.add("--aov", "LIST",
             "What EXR files hold besides the colour, separated by commas: " + joined(aov_names(), ", ") +
                 "; light_NAME, what the lights of a group bring; passes, from diffuse_direct to background; or all, "
                 "but passes",
             options.aovs, aovs, aov_choices());
  parser.add("--bit-depth", "8|16", "Bits per channel in PNG, TIFF and other sRGB-encoded files (8)", options.bit_depth,
             bit_depth, {"8", "16"});

  parser.group("Picture");
  parser.add("-r,--resolution", "WxH", "Size in pixels instead of the scene's; what was in view stays in view",
             options.resolution, resolution);
  parser.add_switch("--fit", options.fit,
                    "Move the camera so that all objects are just in view; it keeps its direction and angle of view");
  parser.add("--scale", "F", "Multiply the resolution by F (1)", options.scale, scale);
  parser.add(
      "--crop", "x0,y0,x1,y1",
      "Only these pixels: origin at the top left, x1 and y1 exclusive; they may reach beyond the picture; an EXR says "
      "where in the whole picture they are",
      options.crop, crop);
  parser.add(
      "--tile", "I/N",
      "Only part I (from 0) of N of the picture or crop, for as many machines: together they cover it; `raytrace "
      "merge` "
      "puts them together",
      options.tile, tile);
  parser.add("-s,--spp", "N", "Samples per pixel instead of the scene's; 1 goes through the pixel's centre",
             options.samples, integer_between(1, largest));
  parser.add("--sample-offset", "K",
             "These --spp samples are the picture's from number K on; the EXR keeps their sums for `raytrace merge`",
             options.sample_offset, integer_between(0, largest));
  parser.add("--pixel", "x,y", "Print the samples of one pixel, from the top left, instead of rendering a picture",
             options.pixel, pixel_index);
  parser.add("--integrator", "NAME",
             "How light is computed, instead of the scene's way: " + joined(names_in(Integrators{}), ", "),
             options.integrator, one_of(names_in(Integrators{})), names_in(Integrators{}));
  parser.add("--clamp-indirect", "X",
             "Let no path bring more than X, in each channel, from beyond its first surface, e.g. 10: it takes away "
             "bright dots, and some light; 0: any, whatever the scene says",
             options.clamp_indirect, radiance);
  parser.add_with_optional_value(
      "--clay", "NAMES",
      "Make all that is opaque matte grey clay, to look at forms: without textures, gloss and relief. What shines, "
      "glass, fogs and cut-outs stay; and so do materials of these names, with commas between them",
      options.clay_names, all_of_clay);
  parser.add("--seed", "N|frame",
             "Another, equally good, pattern of samples (0); frame: that of the frame's number, so that the noise of a "
             "film moves",
             [&](const std::string& text) {
               options.seed_is_frame = text == "frame";
               if (!options.seed_is_frame) options.seed = natural_number(text);
             });

  parser.group("Work");
  parser.add("-t,--threads", "N", "Use N threads (all processors); the picture does not depend on it", options.threads,
             integer_between(1, most_threads));
  parser.add("--isa", "NAME", "Instruction set: " + joined(isa_names(), ", ") + " (the best that the processor has)",
             options.isa, instruction_set, isa_names());

  parser.add(
      "--time-limit", "TIME",
      "Stop adding samples when TIME (90s, 10m, 1h30m) has passed since the start; the picture has as many as fit, at "
      "least 4",
      options.time_limit, duration);

  parser.add("--error-limit", "E",
             "Stop adding samples when the picture's estimated error is E (2%) or less; --spp is the most",
             options.error_limit, error_limit);

  parser.group("Safety");
  parser.add("--checkpoint", "FILE", "Keep what is rendered in FILE, once a minute and when stopped by a signal",
             [&](const std::string& text) { options.checkpoint = text; });
  parser.add("--checkpoint-interval", "TIME", "Time between two checkpoints (60s)", options.checkpoint_interval,
             duration);
  parser.add_switch("--resume", options.resume, "Go on from the checkpoint, if there is one");

  parser.group("Messages");
  parser.add_switch("-q,--quiet", options.quiet,
                    "Errors only: no warnings, and no progress but what --progress asks for");
  parser.add_switch("-v,--verbose", options.verbose, "Report what is done; twice: all that --stats reports, too");
  parser.add("--progress", "STYLE",
             "How far the render is: auto, bar and plain on standard error (auto: a bar on a terminal, plain lines "
             "elsewhere); "
             "openjd, alf and json on standard output, for Open Job Description, Tractor and other programs; or none",
             options.progress, progress_style, progress_names());
  parser.add("--log-file", "FILE", "Add the messages to FILE, too, each with its time", [&](const std::string& text) {
    if (text.empty()) throw UsageError("the file name is empty");
    options.log_file = text;
  });
  parser.add_with_optional_value("--stats", "FILE.json",
                                 "Times, rays, memory: as text on standard error, or as JSON in a file",
                                 options.statistics, statistics_as_text);

  parser.add(
      "--display-server", "HOST:PORT",
      "Show the picture as it grows in the image viewer tev (port 14158); one that fails does not stop the render",
      options.display_server, display_address);

  parser.group("Look first");
  parser.add_switch("--validate", options.validate, "Check the scene and render nothing");
  parser.add_switch("--print-scene", options.print_scene,
                    "Print the scene with every value spelled out, as it would be rendered, and render nothing");
  parser.add("--list", "KIND", "Print the " + joined(listing_names(), ", ") + " that there are", options.list,
             one_of(listing_names()), listing_names());
  parser.add_switch("--version", options.version, "Print the version, the libraries' and the instruction sets");
  parser.add_switch("-h,--help", options.help, "Print this");
}

Options parse_options(int argc, const char* const* argv) {
  if (argc == 1) throw UsageError(no_scene, short_help(render_manual));
  Options options;
  OptionParser parser;
  define_options(parser, options);
  parser.parse(argc, argv);
  options.threads = thread_count(options.threads);
  if (options.floor) {
    if (!options.stage) options.stage.emplace();
    options.stage->floor = true;
  }
  if (options.stage && options.stage->turntable > 0 && options.frames.empty())
    options.frames = frame_numbers("1-" + std::to_string(options.stage->turntable));
  if (options.clay_names == all_of_clay)
    options.clay.emplace();
  else if (!options.clay_names.empty())
    options.clay = material_names(options.clay_names);
  // Not by CLI11's excludes(): from version 2.4 on, a counting flag counts as given when it is not.
  if (options.quiet && options.verbose > 0) throw UsageError("--quiet excludes --verbose");
  refuse_two_views(options.view);
  if (options.quiet && options.progress == ProgressStyle::automatic) options.progress = ProgressStyle::none;
  if (!options.help && !options.version && options.list.empty()) {
    refuse_for_scenes(options, parser.given(models_group));
    refuse_incomplete(options);
  }
  options.still = options.print_scene;
  options.shows_statistics = options.statistics == statistics_as_text;
  if (options.shows_statistics || !options.renders()) options.statistics.clear();
  if (!options.renders()) {
    options.outputs.clear();
    options.checkpoint.clear();
  }
  return options;
}

}  // namespace raytrace
