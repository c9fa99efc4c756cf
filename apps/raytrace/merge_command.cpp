#include "merge_command.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "manual.h"
#include "messages.h"
#include "option_parser.h"
#include "process.h"
#include "raytrace/batch/output_files.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/render/renderer.h"
#include "raytrace/text/message.h"
#include "signals.h"
#include "view_arguments.h"

namespace raytrace {

namespace {

bool is_list(const std::string& piece) { return piece.starts_with('@'); }

/// The lines of a list of pieces, without what editors and other systems add: a byte order mark, spaces and carriage
/// returns at the ends, empty lines.
std::vector<std::string> lines_of(const std::string& list, const std::string& argument) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf", spaces = " \t\r";
  std::error_code unknown;
  const auto type = std::filesystem::status(list, unknown).type();
  if (type == std::filesystem::file_type::not_found)
    throw UsageError("there is no list of pieces " + list + "; a piece of that name is ./" + argument);
  // A pipe might never say anything.
  if (type != std::filesystem::file_type::regular)
    throw UsageError("the list of pieces " + list + " is no regular file");
  std::ifstream stream(list, std::ios::binary);
  if (!stream) throw UsageError("cannot read the list of pieces " + list);
  std::vector<std::string> lines;
  bool first = true;
  for (std::string line; std::getline(stream, line); first = false) {
    if (first && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    line.erase(line.find_last_not_of(spaces) + 1);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// "@FILE" stands for the names in the file, one a line: there may be more than a command line holds.
std::vector<std::string> with_lists_read(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    if (!is_list(name)) {
      all.push_back(name);
      continue;
    }
    for (std::string& line : lines_of(name.substr(1), name)) all.push_back(std::move(line));
  }
  return all;
}

/// names: as they were given, with the lists, which merge_pieces() does not know.
void refuse_clashes(const std::vector<std::string>& names, const MergeSettings& settings) {
  UsedFiles files;
  for (const std::string& name : names)
    if (is_list(name)) files.add_or_refuse({"the list", name.substr(1), false});
  for (const std::string& piece : settings.pieces) files.add_or_refuse({"the piece", piece, false});
  for (const std::string& output : settings.outputs) files.add_or_refuse({"--output", output, true});
}

MergeOptions parsed(int argc, const char* const* argv) {
  constexpr const char* no_pieces = "no pieces given; for example: raytrace merge tile.*.exr -o whole.exr";
  if (argc == 1) throw UsageError(no_pieces, short_help(merge_manual));
  MergeOptions options;
  OptionParser parser;
  define_merge_options(parser, options);
  parser.parse(argc, argv);
  if (options.quiet && options.verbose) throw UsageError("--quiet excludes --verbose");
  if (options.help) return options;
  const std::vector<std::string> names = options.settings.pieces;
  options.settings.pieces = with_lists_read(names);
  const MergeSettings& settings = options.settings;
  if (settings.pieces.empty()) throw UsageError(no_pieces);
  if (settings.outputs.empty())
    throw UsageError("no output given; for example: raytrace merge tile.*.exr -o whole.exr");
  refuse_two_views(settings.view);
  ImageFileSettings image_settings;
  image_settings.ocio = settings.view.ocio;
  refuse_useless_view(settings.outputs, image_settings, settings.view);
  refuse_clashes(names, settings);
  return options;
}

void log_report(const MergeReport& report) {
  for (const std::string& file : report.outputs) {
    log_step("wrote " + file + ": " + counted(report.pieces, "piece") + ", " +
             counted(static_cast<std::uint64_t>(report.samples), "sample") + " per pixel");
  }
  for (const std::string& warning : report.warnings) log_warning(warning);
  if (report.missing_parts) log_warning("the picture is not complete: some pixels, or samples of them, are missing");
}

}  // namespace

void define_merge_options(OptionParser& parser, MergeOptions& options) {
  constexpr int largest = std::numeric_limits<int>::max();
  constexpr int most_threads = 1024;
  MergeSettings& settings = options.settings;
  parser.group("Input");
  parser.add_arguments("PIECES...",
                       "EXR files that raytrace wrote with --tile, --crop or --sample-offset: parts of one picture; "
                       "@FILE stands for the names in FILE, one a line",
                       settings.pieces);
  parser.add_switch("--partial", settings.partial,
                    "Pieces may be missing or unfinished: a pixel gets the samples that there are, or else a checked "
                    "background with alpha 0");
  parser.add("-s,--spp", "N", "Refuse pieces that have other than N samples per pixel together (as many as there are)",
             settings.samples, integer_between(1, largest));
  parser.group("Output");
  parser.add_repeatable("-o,--output", "FILE", "Write the picture to FILE; repeatable",
                        [&](const std::string& text) { settings.outputs.push_back(text); });
  parser.add_switch("--denoise", settings.denoise,
                    "Take the noise out of the picture; so it is if the pieces were rendered with --denoise");
  parser.add("--bit-depth", "8|16", "Bits per channel in PNG, TIFF and other sRGB-encoded files (8)",
             settings.bit_depth, bit_depth, {"8", "16"});
  define_view_options(parser, settings.view);
  parser.group("Work");
  parser.add("-t,--threads", "N", "Use N threads (all processors)", settings.threads, integer_between(1, most_threads));
  parser.group("Messages");
  parser.add_switch("-q,--quiet", options.quiet, "Errors only");
  parser.add_switch("-v,--verbose", options.verbose, "Report what is done");
  parser.add_switch("-h,--help", options.help, "Print this");
}

bool is_merge_command(int argc, const char* const* argv) { return argc > 1 && std::string_view(argv[1]) == "merge"; }

int merge_command(int argc, const char* const* argv) {
  MergeOptions options = parsed(argc - 1, argv + 1);  // "merge" is the program's name here
  if (options.help) {
    OptionParser parser;
    MergeOptions unused;
    define_merge_options(parser, unused);
    print(help_text(merge_manual, parser.entries()));
    return exit_code::done;
  }
  set_verbosity(options.quiet ? Verbosity::errors : options.verbose ? Verbosity::steps : Verbosity::warnings);
  const int wanted_threads = thread_count(options.settings.threads);
  options.settings.threads = threads_with_room(wanted_threads);
  log_missing_threads(wanted_threads, options.settings.threads);
  obey_group_memory_limit(options.settings.threads);
  const Signals signals;
  try {
    const MergeReport report = merge_pieces(options.settings, [] { return signal_control().is_stopped(); });
    if (report.stopped) {
      log_note("stopped by " + stop_signal_name() + ": nothing written");
      return exit_code::stopped + stop_signal();
    }
    log_report(report);
  } catch (const MergeError& error) {
    std::istringstream problems(error.what());
    for (std::string problem; std::getline(problems, problem);) log_error(problem);
    return exit_code::failed;
  }
  return exit_code::done;
}

}  // namespace raytrace
