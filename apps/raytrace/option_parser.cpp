#include "option_parser.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// The names of a CLI11 option, short ones first, with their dashes.
Names names_of(const CLI::Option& option) {
  Names names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// `take`, with the option's name before what it refuses.
/// is_option: whether a text is the name of one.
OptionParser::Take named(const OptionParser::Take& take, const std::string& names,
                         const std::function<bool(std::string_view)>& is_option) {
  return [take, is_option, name = names.substr(names.rfind(',') + 1)](const std::string& text) {
    if (is_option(text)) throw UsageError(name + " needs a value, and " + text + " is an option");
    try {
      take(text);
    } catch (const SettingsError& error) {
      throw UsageError(name + ": " + error.what());
    }
  };
}

struct Synonyms {
  std::string_view option;
  std::string_view words;  ///< between spaces, in lower case, without hyphens
};

constexpr Synonyms synonyms[] = {
    {"--spp",
     " samples sample samplesperpixel sampleperpixel pixelsamples nsamples numsamples samplecount aa aasamples "
     "antialias antialiasing quality "},
    {"--resolution",
     " size width height res hres vres imagesize image dimensions dimension picturesize outputsize filmsize filmwidth "
     "filmheight resolutionx resolutiony w x y "},
    {"--output",
     " out outfile outputfile outputimage outputpath imagefile imagename filename picture save write writeto "
     "renderoutput outputname "},
    {"--frames", " frame framerange range framelist startframe endframe start end anim animation f "},
    {"--threads",
     " cpus cpu cores jobs nthreads numthreads threadcount threadlimit workers nproc processors parallel j "},
    {"--crop", " region window cropwindow croprectangle cropregion roi border rect renderregion subregion "},
    {"--tile", " tiles part slice chunk bucket "},
    {"--define", " var variable variables set setvar param parameter parameters override declare def "},
    {"--isa", " simd arch instructionset vector avx avx2 avx512 sse "},
    {"--aov", " aovs channels channel passes pass layers layer renderelements "},
    {"--time-limit", " timeout maxtime time rendertime maxrendertime stoptime limit "},
    {"--error-limit",
     " noise noiselimit noisethreshold noiselevel maxerror maxnoise targeterror errorthreshold error threshold "
     "adaptive "
     "adaptivethreshold "},
    {"--denoise", " denoiser denoising oidn optix noisefree removenoise "},
    {"--resume", " continue restart recover "},
    {"--checkpoint", " snapshot autosave savestate checkpointfile "},
    {"--skip-existing", " skip nooverwrite keepexisting skiprendered "},
    {"--log-file", " log logfile logto "},
    {"--stats", " statistics statsfile profile timing timings "},
    {"--validate", " check dryrun lint noop parseonly test syntax n "},
    {"--print-scene", " print dump dumpscene toxml echo flatten "},
    {"--quiet", " silent noverbose quietly "},
    {"--verbose", " debug verbosity loglevel info "},
    {"--display-server", " display viewer preview tev show displaydriver interactive "},
    {"--bit-depth", " bits depth bpp bitdepth bitsperchannel "},
    {"--float", " full float32 fullfloat fp32 singleprecision half "},
    {"--transparent", " alpha nobackground background transparentbackground filmtransparent nosky "},
    {"--exposure", " ev gain brightness expose stops exposurevalue exposurecompensation noautoexposure fixedexposure "},
    {"--clamp-indirect",
     " clamp clamping clampradiance indirectclamp indirectclamping sampleclampindirect maxradiance maxcomponentvalue "
     "clampvalue maxsubpixelintensity fireflies firefly fireflyremoval despeckle "},
    {"--clay",
     " claymode clayrender clayoverride clayshading overridematerial overridematerials materialoverride "
     "overrideshader globalmaterial whitemodel whitemode greymode graymode untextured notextures nomaterials "
     "defaultmaterial "},
    {"--view-transform", " tonemap tonemapping tonemapper toneoperator viewtransform agx filmic colormanagement look "},
    {"--auto-exposure", " autoexpose autobrightness autogain "},
    {"--white-balance", " whitebalance wb kelvin colortemperature colourtemperature temperature whitepoint "},
    {"--ocio", " ocioconfig opencolorio colorconfig "},
    {"--scale", " percent percentage resize resolutionscale fraction "},
    {"--sample-offset", " offset firstsample startsample samplestart sampleoffset samplerange skipsamples "},
    {"--seed", " randomseed rngseed random "},
    {"--pixel", " debugpixel inspect xy "},
    {"--list", " shapes materials lights plugins formats types listtypes "},
    {"--version", " ver v "},
    {"--help", " usage man h ? "},
};

struct Letters {
  std::string_view start;
  std::string_view option;
};

constexpr Letters povray[] = {{"wt", "--threads"}, {"w", "--resolution"},    {"h", "--resolution"}, {"o", "--output"},
                              {"f", "--output"},   {"am", "--spp"},          {"a", "--spp"},        {"r", "--spp"},
                              {"sr", "--crop"},    {"er", "--crop"},         {"sc", "--crop"},      {"ec", "--crop"},
                              {"kf", "--frames"},  {"sf", "--frames"},       {"ef", "--frames"},    {"c", "--resume"},
                              {"v", "--verbose"},  {"d", "--display-server"}};

std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '-' || c == '_' || c == '.' || c == '+') continue;
    result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

}  // namespace

struct OptionParser::Parser {
  CLI::App app;
};

std::string OptionEntry::term() const {
  if (names.empty()) return value_name;
  std::string term = joined(names, ", ");
  if (value_is_optional) return term + "[=" + value_name + "]";
  return value_name.empty() ? term : term + " " + value_name;
}

OptionParser::OptionParser() : parser_(std::make_unique<Parser>()) {
  parser_->app.set_help_flag();  // ours is like any other option
  parser_->app.allow_extras();   // refuse_unknown() says what was meant
}

OptionParser::~OptionParser() = default;

void OptionParser::add_arguments(const std::string& value_name, const std::string& help,
                                 std::vector<std::string>& values) {
  parser_->app.add_option("arguments", values)->type_name(value_name);
  arguments_ = &values;
  note({}, value_name, help);
}

void OptionParser::add(const std::string& names, const std::string& value_name, const std::string& help,
                       const Take& take, const Names& values) {
  const CLI::Option* const option =
      parser_->app
          .add_option_function<std::string>(
              names, named(take, names, [this](std::string_view text) { return entry(text) != nullptr; }))
          ->type_name(value_name)
          ->take_last();
  note(names_of(*option), value_name, help, values);
}

void OptionParser::add_repeatable(const std::string& names, const std::string& value_name, const std::string& help,
                                  const Take& take) {
  const auto take_all = [take = named(take, names, [this](std::string_view text) { return entry(text) != nullptr; })](
                            const std::vector<std::string>& values) {
    for (const std::string& value : values) take(value);
  };
  const CLI::Option* const option = parser_->app.add_option_function<std::vector<std::string>>(names, take_all)
                                        ->type_name(value_name)
                                        ->allow_extra_args(false);
  note(names_of(*option), value_name, help);
}

void OptionParser::add_with_optional_value(const std::string& names, const std::string& value_name,
                                           const std::string& help, std::string& value, const std::string& without) {
  // CLI11's flag with a value: it takes no argument after it.
  const CLI::Option* const option = parser_->app.add_flag(names + "{" + without + "}", value);
  note(names_of(*option), value_name, help, {}, true);
}

void OptionParser::add_switch(const std::string& names, bool& flag, const std::string& help) {
  note(names_of(*parser_->app.add_flag(names, flag)->disable_flag_override()), {}, help);
}

void OptionParser::add_switch(const std::string& names, int& count, const std::string& help) {
  note(names_of(*parser_->app.add_flag(names, count)->disable_flag_override()), {}, help);
}

void OptionParser::note(const Names& names, const std::string& value_name, const std::string& help, const Names& values,
                        bool value_is_optional) {
  entries_.push_back({group_, names, value_name, help, values, value_is_optional});
}

void OptionParser::parse(int argc, const char* const* argv) {
  refuse_other_style(argc, argv);
  try {
    parser_->app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    throw UsageError(explained(error.what()));
  }
  refuse_unknown();
}

Names OptionParser::given(const std::string& group) const {
  Names names;
  for (const OptionEntry& entry : entries_)
    if (entry.group == group && parser_->app.count(entry.names.back()) > 0) names.push_back(entry.names.back());
  return names;
}

/// "-samples" would be read as "-s amples".
void OptionParser::refuse_other_style(int argc, const char* const* argv) const {
  constexpr std::size_t least_length = 3;  // of such a word
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument(argv[i]);
    if (argument == "--") return;
    const OptionEntry* const before = entry(argv[i - 1]);
    const bool is_value = before != nullptr && !before->value_name.empty() && !before->value_is_optional;
    if (is_value || argument.size() <= least_length || argument[0] != '-' || argument[1] == '-') continue;
    const std::string name(argument.substr(0, argument.find('=')));
    const std::string own_name = "-" + name;
    const std::string found = entry(own_name) != nullptr ? "; did you mean " + in_quotes(own_name) + "?" : hint(name);
    if (!found.empty()) throw UsageError("there is no option " + in_quotes(name) + found);
  }
}

void OptionParser::refuse_unknown() const {
  for (const std::string& argument : parser_->app.remaining()) {
    if (argument.size() < 2 || argument.front() != '-' || argument == "--") continue;
    const bool is_long = argument[1] == '-';
    const std::string name = is_long ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
    Names long_names;
    for (const OptionEntry& entry : entries_)
      for (const std::string& known : entry.names)
        if (known.starts_with("--")) long_names.push_back(known);
    std::string found = hint(name);
    for (const std::string& known : long_names)
      if (found.empty() && name.size() > 4 && known.starts_with(name))
        found = "; did you mean " + in_quotes(known) + "?";
    if (found.empty() && is_long) found = suggestion(name, long_names);
    throw UsageError("there is no option " + in_quotes(name) + found);
  }
  if (arguments_ == nullptr) return;
  for (const std::string& argument : *arguments_) {
    const bool is_option = argument.size() > 1 && argument[0] == '+' && argument[1] >= 'A' && argument[1] <= 'Z';
    if (!is_option || argument.ends_with(".xml") || std::filesystem::exists(argument)) continue;
    const std::string_view meant = option_of_povray(argument);
    throw UsageError("there is no option " + in_quotes(argument) +
                     (entry(meant) != nullptr ? "; did you mean " + in_quotes(meant) + "?" : ""));
  }
}

/// "; did you mean '--spp'?" for what other renderers call an option; empty if none does.
std::string OptionParser::hint(const std::string& name) const {
  const OptionEntry* const meant = entry(option_of_other_renderers(name));
  if (meant == nullptr) return {};
  const bool has_value = !meant->value_name.empty() && !meant->value_is_optional;
  return "; did you mean " + in_quotes(meant->names.back()) + "?" + (has_value ? " (" + meant->term() + ")" : "");
}

/// Null if there is no option of that name.
const OptionEntry* OptionParser::entry(std::string_view name) const {
  for (const OptionEntry& entry : entries_)
    if (std::find(entry.names.begin(), entry.names.end(), name) != entry.names.end()) return &entry;
  return nullptr;
}

/// CLI11's message in other words, where they are clearer.
std::string OptionParser::explained(const std::string& message) const {
  static constexpr std::string_view missing_value = ": 1 required ";                           // --spp ... N missing
  static constexpr std::string_view needless_value = " was given a disallowed flag override";  // float ...
  if (const std::size_t found = message.find(missing_value); found != std::string::npos) {
    const std::string name = message.substr(0, found);
    const OptionEntry* const option = entry(name);
    const std::string value = option == nullptr        ? ""
                              : option->values.empty() ? option->value_name
                                                       : "one of " + joined(option->values, ", ");
    return name + " needs a value: " + value;
  }
  if (message.ends_with(needless_value)) {
    return "--" + message.substr(0, message.size() - needless_value.size()) + " takes no value";
  }
  return message;
}

std::string_view option_of_other_renderers(std::string_view name) {
  const std::string word = " " + plain(name) + " ";
  if (word.size() == 2) return {};
  for (const Synonyms& entry : synonyms)
    if (entry.words.find(word) != std::string_view::npos) return entry.option;
  return {};
}

std::string_view option_of_povray(std::string_view argument) {
  const std::string letters = plain(argument);
  for (const Letters& entry : povray)
    if (letters.starts_with(entry.start)) return entry.option;
  return {};
}

}  // namespace raytrace
