#include "raytrace/batch/provenance.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/film/samples_done.h"
#include "raytrace/math/blackbody.h"
#include "raytrace/output/pixel_format.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

constexpr const char* creator_name = "Software";
constexpr const char* embree_name = "raytrace:embree";
constexpr const char* isa_name = "raytrace:isa";
constexpr const char* scene_name = "raytrace:sceneHash";
constexpr const char* seed_name = "raytrace:seed";
constexpr const char* first_sample_name = "raytrace:firstSample";
constexpr const char* samples_name = "raytrace:samples";
constexpr const char* centered_name = "raytrace:centered";
constexpr const char* unit_name = "raytrace:unitExponent";
constexpr const char* aovs_name = "raytrace:aovs";  // only where there are any
constexpr const char* aov_units_name = "raytrace:aovUnits";
constexpr const char* whole_name = "raytrace:whole";
constexpr const char* region_name = "raytrace:region";
constexpr const char* tile_name = "raytrace:tile";  // only of a tile
constexpr const char* partial_name = "raytrace:partial";
constexpr const char* least_samples_name = "raytrace:leastSamples";  // only where it is partial
constexpr const char* most_samples_name = "raytrace:mostSamples";
constexpr const char* transparent_name = "raytrace:transparent";  // only where it is
constexpr const char* light_paths_name = "raytrace:lightPaths";   // only where there are any
constexpr const char* frame_name = "raytrace:frame";              // only where one was asked for
constexpr const char* variables_name = "raytrace:variables";      // only where there are any

template <class Value>
Value needed(const ExrReader& piece, const char* name) {
  if (auto value = piece.attribute<Value>(name)) return *value;
  throw InputError(piece.file() + " is not a picture of this program, or of an older version: it has no " + name);
}

[[noreturn]] void refuse(const ExrReader& piece, const char* name, const std::string& value) {
  throw InputError(piece.file() + " is damaged: its " + name + " is " + printable(value));
}

/// The text as this program writes numbers.
template <class Number>
Number number(const ExrReader& piece, const char* name, const std::string& text) {
  Number value{};
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc() || std::to_string(value) != text)
    refuse(piece, name, "no number: " + text);
  return value;
}

bool flag(const ExrReader& piece, const char* name, int value) {
  if (value != 0 && value != 1) refuse(piece, name, std::to_string(value));
  return value == 1;
}

int unit_of(const ExrReader& piece, const char* name, int exponent) {
  if (!is_unit_exponent(exponent)) refuse(piece, name, std::to_string(exponent));
  return exponent;
}

Region region(const ExrReader& piece, const char* name) {
  const auto text = needed<std::string>(piece, name);
  const auto region = region_of(text);
  if (!region) refuse(piece, name, "no region: " + text);
  return *region;
}

SampleRange samples_of(const ExrReader& piece) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  SampleRange samples;
  samples.first = number<std::uint32_t>(piece, first_sample_name, needed<std::string>(piece, first_sample_name));
  const int count = needed<int>(piece, samples_name);
  if (count < 1 || std::int64_t{samples.first} + count > most) refuse(piece, samples_name, std::to_string(count));
  samples.count = static_cast<std::uint32_t>(count);
  samples.centered = flag(piece, centered_name, needed<int>(piece, centered_name));
  if (samples.centered && (samples.first != 0 || count != 1)) refuse(piece, centered_name, "1, with several samples");
  return samples;
}

std::optional<Tile> read_tile(const ExrReader& piece) {
  const auto text = piece.attribute<std::string>(tile_name);
  if (!text) return std::nullopt;
  const std::size_t slash = std::min(text->find('/'), text->size());
  const Tile tile{number<int>(piece, tile_name, text->substr(0, slash)),
                  number<int>(piece, tile_name, text->substr(std::min(slash + 1, text->size())))};
  return tile;
}

/// Where the piece lies: all that says so must agree.
void read_place(const ExrReader& piece, PieceIdentity& identity) {
  const PictureExtent& extent = identity.film.extent = piece.extent();
  identity.whole = region(piece, whole_name);
  if (const auto error = crop_error(identity.whole, extent.full_width, extent.full_height))
    refuse(piece, whole_name, text_of(identity.whole) + ": " + *error);
  const Region own = region(piece, region_name);
  const bool light_paths = flag(piece, light_paths_name, piece.attribute<int>(light_paths_name).value_or(0));
  if (light_paths) identity.film.light_paths_of = own;
  if ((light_paths ? identity.whole : own) != extent.region)
    throw InputError(piece.file() + " is damaged: its data window is " + text_of(extent.region) + ", its " +
                     region_name + " " + text_of(own));
  identity.tile = read_tile(piece);
  Region wanted = identity.whole;
  if (const auto& tile = identity.tile) {
    const std::int64_t pixels = std::int64_t{wanted.width()} * wanted.height();
    if (tile->index < 0 || tile->index >= tile->count || tile->count > pixels) refuse(piece, tile_name, text_of(*tile));
    wanted = tile_of(wanted, tile->index, tile->count);
  }
  if (own != wanted)
    throw InputError(piece.file() + " is damaged: its " + region_name + " is " + text_of(own) + ", not " +
                     text_of(wanted) + ", as its " + whole_name + (identity.tile ? " and tile say" : " says"));
}

std::string other(const std::string& what, const std::string& got, const std::string& wanted) {
  return what + " (" + got + ", not " + wanted + ")";
}

/// False if the text is none.
bool read_number(const std::string& text, double& number) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

ViewSettings read_view(const ExrReader& piece) {
  ViewSettings view;
  if (const auto name = piece.attribute<std::string>(view_transform_keyword)) {
    constexpr const auto& words = Choices<ViewTransform>::words;
    const auto* const found = std::find(words.begin(), words.end(), *name);
    if (found == words.end()) refuse(piece, view_transform_keyword, *name);
    view.transform = static_cast<ViewTransform>(found - words.begin());
  }
  if (const auto text = piece.attribute<std::string>(exposure_keyword)) {
    if (!read_number(*text, view.exposure) || !(std::abs(view.exposure) <= largest_exposure))
      refuse(piece, exposure_keyword, *text);
  }
  if (const auto text = piece.attribute<std::string>(auto_exposure_keyword)) {
    if (*text != "1") refuse(piece, auto_exposure_keyword, *text);
    view.auto_exposure = true;
  }
  if (const auto text = piece.attribute<std::string>(white_balance_keyword))
    if (!read_number(*text, view.white_balance) || !is_temperature(view.white_balance))
      refuse(piece, white_balance_keyword, *text);
  return view;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

AovSettings aovs_of(const ExrReader& piece, const std::string& names) {
  const std::vector<std::string> all = aov_names(), wanted = split(names);
  for (const std::string& name : wanted)
    if (std::find(all.begin(), all.end(), name) == all.end() && !light_group_of(name))
      throw InputError(piece.file() + " has an AOV that this version does not know: " + printable(name));
  std::vector<int> units;
  for (const std::string& unit : split(needed<std::string>(piece, aov_units_name)))
    units.push_back(unit_of(piece, aov_units_name, number<int>(piece, aov_units_name, unit)));
  AovSettings aovs = aov_settings(aov_set(wanted));
  if (aovs.wanted.empty() || joined(aov_names(aovs.wanted), ",") != names) refuse(piece, aovs_name, names);
  if (units.size() != aovs.mean_units.size())
    throw InputError(piece.file() + " is damaged: its " + aov_units_name + " do not fit its AOVs");
  aovs.mean_units = units;
  return aovs;
}

std::string size_text(const PictureExtent& extent) {
  return std::to_string(extent.full_width) + " x " + std::to_string(extent.full_height);
}

/// "frame 7, size=2": what of it is another in `other`; empty if nothing is.
std::string settings_apart(const PieceIdentity& identity, const PieceIdentity& other) {
  std::string text;
  if (identity.frame != other.frame) text = identity.frame ? "frame " + std::to_string(*identity.frame) : "no frame";
  if (identity.variables == other.variables) return text;
  return text + (text.empty() ? "" : ", ") + (identity.variables.empty() ? "no -D" : printable(identity.variables));
}

}  // namespace

std::string variables_text(const std::map<std::string, std::string>& variables) {
  std::string text;
  for (const auto& [name, value] : variables) {
    text += (text.empty() ? "" : " ") + name + "=";
    for (const char c : value) {
      if (c == ' ' || c == '\\') text += '\\';
      text += c;
    }
  }
  return text;
}

std::vector<ImageAttribute> wished_view(const ViewSettings& view) {
  std::vector<ImageAttribute> attributes;
  if (view.transform != ViewTransform::srgb) attributes.push_back({view_transform_keyword, name_of(view.transform)});
  if (view.exposure != 0) attributes.push_back({exposure_keyword, shortest_text(view.exposure)});
  if (view.white_balance != 0) attributes.push_back({white_balance_keyword, shortest_text(view.white_balance)});
  if (view.auto_exposure) attributes.push_back({auto_exposure_keyword, "1"});
  return attributes;
}

std::string software_name() { return "raytrace " RAYTRACE_VERSION; }

Provenance provenance_of(const Scene& scene, const SceneDescription& description, int threads) {
  const SceneStatistics statistics = scene.statistics();
  return {software_name(), statistics.embree_version, statistics.isa, scene_hash(description, threads)};
}

std::vector<ImageAttribute> identity_attributes(const PieceIdentity& identity) {
  const SampleRange& samples = identity.film.samples;
  std::vector<ImageAttribute> attributes = {
      {embree_name, identity.provenance.embree_version},
      {isa_name, identity.provenance.isa},
      {scene_name, identity.provenance.scene},
      {first_sample_name, std::to_string(samples.first)},  // EXR's integers have a sign
      {centered_name, samples.centered ? 1 : 0},
      {unit_name, identity.film.unit_exponent},
      {whole_name, text_of(identity.whole)},
      {region_name, text_of(identity.film.rendered())}};
  if (identity.tile) attributes.push_back({tile_name, text_of(*identity.tile)});
  const AovSettings& aovs = identity.film.aovs;
  if (!aovs.wanted.empty()) {
    attributes.push_back({aovs_name, joined(aov_names(aovs.wanted), ",")});
    std::vector<std::string> units;
    for (const int unit : aovs.mean_units) units.push_back(std::to_string(unit));
    attributes.push_back({aov_units_name, joined(units, ",")});
  }
  if (identity.film.light_paths_of) attributes.push_back({light_paths_name, 1});
  if (identity.film.transparent) attributes.push_back({transparent_name, 1});
  if (identity.partial) attributes.push_back({partial_name, 1});
  if (identity.frame) attributes.push_back({frame_name, *identity.frame});
  if (!identity.variables.empty()) attributes.push_back({variables_name, identity.variables});
  return attributes;
}

std::vector<ImageAttribute> partial_attributes(PieceIdentity identity, const Film& film) {
  identity.partial = true;
  std::vector<ImageAttribute> attributes = identity_attributes(identity);
  const SamplesDone done = samples_done(film);
  attributes.push_back({least_samples_name, static_cast<int>(done.least)});
  attributes.push_back({most_samples_name, static_cast<int>(done.most)});
  return attributes;
}

std::map<std::string, std::string> picture_attributes(const PieceIdentity& identity, bool any_samples) {
  std::map<std::string, std::string> texts = {{seed_name, std::to_string(identity.film.seed)}};
  for (const char* const name :
       {scene_name, first_sample_name, centered_name, whole_name, region_name, transparent_name})
    texts[name];
  for (const ImageAttribute& attribute : identity_attributes(identity)) {
    const auto wanted = texts.find(attribute.name);
    if (wanted == texts.end()) continue;
    const auto* const text = std::get_if<std::string>(&attribute.value);
    wanted->second = text != nullptr ? *text : std::to_string(std::get<int>(attribute.value));
  }
  if (!any_samples) texts[samples_name] = std::to_string(identity.film.samples.count);
  return texts;
}

PieceIdentity identity_of(const ExrReader& piece) {
  PieceIdentity identity;
  identity.provenance = {needed<std::string>(piece, creator_name), needed<std::string>(piece, embree_name),
                         needed<std::string>(piece, isa_name), needed<std::string>(piece, scene_name)};
  FilmSettings& film = identity.film;
  read_place(piece, identity);
  film.seed = number<std::uint64_t>(piece, seed_name, needed<std::string>(piece, seed_name));
  film.samples = samples_of(piece);
  film.unit_exponent = unit_of(piece, unit_name, needed<int>(piece, unit_name));
  if (const auto names = piece.attribute<std::string>(aovs_name)) film.aovs = aovs_of(piece, *names);
  film.transparent = flag(piece, transparent_name, piece.attribute<int>(transparent_name).value_or(0));
  identity.partial = flag(piece, partial_name, piece.attribute<int>(partial_name).value_or(0));
  identity.frame = piece.attribute<int>(frame_name);
  identity.view = read_view(piece);
  identity.denoise = flag(piece, denoise_name, piece.attribute<int>(denoise_name).value_or(0));
  film.single_splats = identity.denoise && film.light_paths_of;
  identity.variables = piece.attribute<std::string>(variables_name).value_or("");
  return identity;
}

void refuse_other_channels(const ExrReader& piece, const std::vector<Channel>& wanted) {
  std::map<std::string, ChannelType> left;
  for (const Channel& channel : piece.channels()) left.emplace(channel.name, channel.type);
  for (const Channel& channel : wanted) {
    const auto found = left.find(channel.name);
    if (found == left.end()) throw InputError(piece.file() + " lacks the channel " + channel.name);
    if (found->second != channel.type)
      throw InputError(piece.file() + " is damaged: its channel " + channel.name + " is of another type");
    left.erase(found);
  }
  if (!left.empty())
    throw InputError(piece.file() + " is damaged: no such piece has a channel " + printable(left.begin()->first));
}

std::optional<std::string> difference(const PieceIdentity& wanted, const PieceIdentity& got) {
  const Provenance &a = wanted.provenance, &b = got.provenance;
  const FilmSettings &c = wanted.film, &d = got.film;
  // Before the scene, whose hash holds it, too.
  if (c.extent.full_width != d.extent.full_width || c.extent.full_height != d.extent.full_height)
    return other("the resolution", size_text(d.extent), size_text(c.extent));
  if (a.scene != b.scene) {
    const std::string settings = settings_apart(got, wanted);
    return settings.empty() ? "the scene" : other("the scene", settings, settings_apart(wanted, got));
  }
  if (c.seed != d.seed) return other("the seed", std::to_string(d.seed), std::to_string(c.seed));
  if (a.software != b.software) return other("the version", printable(b.software), printable(a.software));
  if (a.embree_version != b.embree_version)
    return other("Embree's version", printable(b.embree_version), printable(a.embree_version));
  if (a.isa != b.isa) return other("the instruction set", printable(b.isa), printable(a.isa)) + ": pin one with --isa";
  if (c.samples.centered != d.samples.centered)
    return "the position of the samples: one has a single sample in each pixel's center; render it with "
           "--sample-offset 0";
  if (c.transparent != d.transparent) {
    const auto text = [](const FilmSettings& film) { return film.transparent ? "transparent" : "opaque"; };
    return other("the background", text(d), text(c)) + ": use --transparent for all of them, or none";
  }
  if (c.light_paths_of.has_value() != d.light_paths_of.has_value()) return "its light paths: only one has any";
  if (c.single_splats != d.single_splats)
    return "its light paths, which differ if the picture is to be denoised: use --denoise for all of them, or none";
  if (c.aovs.wanted != d.aovs.wanted) {
    const auto text = [](const AovSettings& aovs) {
      return aovs.wanted.empty() ? "none" : joined(aov_names(aovs.wanted), ",");
    };
    return other("the AOVs", text(d.aovs), text(c.aovs));
  }
  if (c.unit_exponent != d.unit_exponent || c.aovs != d.aovs)
    return "the precision of the sums: too many samples per pixel";
  return std::nullopt;
}

}  // namespace raytrace
