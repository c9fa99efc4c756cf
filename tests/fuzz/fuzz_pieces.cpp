// libFuzzer target: any bytes as a piece of a picture, and as a checkpoint. They are merged and resumed from without a
// crash, a hang, a report of a sanitizer, or memory that follows from a claim; what is refused leaves no file.
//
// Few changes of bytes pass OpenEXR's own reading, so the mutator takes files apart and changes what headers say:
// windows, attributes, channels and sums, alone or so that several agree.
//
// `fuzz_pieces CORPUS_FOLDER` fills an empty folder with pieces first.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "fuzz/require.h"
#include "raytrace/batch/checkpoint.h"
#include "raytrace/batch/merge_pieces.h"
#include "support/exr_bytes.h"
#include "support/sample_pieces.h"
#include "support/temporary_folder.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace raytrace;
using namespace raytrace::test;
namespace fs = std::filesystem;

constexpr Region overscan{-9, -7, 30, 25};

std::vector<SamplePiece> kinds() {
  const Region whole{0, 0, sample_width, sample_height};
  std::vector<SamplePiece> all(12);
  all[1].tile = Tile{1, 2};
  all[2] = {whole, Tile{0, 3}, {0, 5}, false, true, false, false};
  all[3] = {whole, std::nullopt, {3, 5}, true, true, false, false};
  all[4] = {whole, Tile{1, 2}, {3, 5}, true, true, true, false};
  all[5] = {whole, Tile{1, 2}, {0, 8}, true, true, false, true};
  all[6] = {overscan, std::nullopt, {0, 5}, false, false, true, false};
  all[7] = {overscan, Tile{2, 4}, {0, 3}, false, true, false, true};
  all[8].samples = {0, 1, true};
  all[9] = {whole, std::nullopt, {0, 5}, true, false, true, false};
  all[10] = {whole, Tile{1, 2}, {0, 5}, false, true, true, false};
  all[11] = {overscan, Tile{0, 2}, {3, 5}, true, true, false, true};
  all[10].light_paths = all[11].light_paths = true;
  all[4].large = all[7].large = all[11].large = true;
  return all;
}

SamplePiece checkpoint_kind(bool aovs) {
  SamplePiece piece;
  piece.aovs = aovs;
  piece.light_paths = !aovs;
  piece.partial = true;
  return piece;
}

void write_checkpoint_of(const std::string& file, const SamplePiece& piece) {
  const PieceIdentity identity = identity_of(piece);
  ImageMetadata metadata;
  metadata.software = identity.provenance.software;
  metadata.seed = identity.film.seed;
  write_checkpoint(file, film_of(piece), identity, metadata);
}

/// In memory where the system has such a folder.
const TemporaryFolder& work_folder() {
  static const TemporaryFolder folder = [] {
    if (fs::is_directory("/dev/shm")) setenv("TMPDIR", "/dev/shm", 1);
    return TemporaryFolder();
  }();
  return folder;
}

void make_corpus(const fs::path& folder) {
  int number = 0;
  for (const SamplePiece& kind : kinds()) write_piece(folder / ("piece" + std::to_string(number++) + ".exr"), kind);
  for (const bool aovs : {false, true})
    write_checkpoint_of(folder / (aovs ? "checkpoint_aovs.exr" : "checkpoint.exr"), checkpoint_kind(aovs));
}

/// Pictures that a header may ask for with --partial, and that would only take time.
bool is_large(const std::string& file) {
  try {
    const Region whole = raytrace::identity_of(ExrReader(file)).whole;
    return double{1} * whole.width() * whole.height() > 1e6;
  } catch (const InputError&) {
    return false;
  }
}

void merge(const std::vector<std::string>& pieces, bool partial) {
  MergeSettings settings;
  settings.pieces = pieces;
  settings.outputs = {work_folder().file("merged.exr")};
  settings.partial = partial;
  settings.threads = 1;
  try {
    merge_pieces(settings);
    fs::remove(settings.outputs[0]);
  } catch (const MergeError& error) {
    require(error.what()[0] != '\0', "refused without a reason\n");
  }
  require(!fs::exists(settings.outputs[0]), "refused, and yet a picture\n");
}

void resume(const std::string& file, const SamplePiece& piece) {
  const PieceIdentity identity = identity_of(piece);
  Film film(identity.film);
  try {
    read_checkpoint(file, identity, film);
    for (const PixelSum& sum : film.sums())
      require(sum.samples <= piece.samples.count, "more samples than asked for\n");
  } catch (const InputError& error) {
    require(std::string(error.what()).find(file) != std::string::npos, "refused without its name\n");
  }
}

// The mutator.

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t end) { return end == 0 ? 0 : random() % end; }

std::int32_t number(Random& random) {
  static constexpr std::int32_t numbers[] = {
      0,      1,      -1,     2,     -2,    5,     8,      17,       18,        23,        24,          25,
      47,     48,     -24,    -18,   -25,   96,    97,     -192,     -193,      255,       65535,       65536,
      -65536, 131071, 131072, 16383, 16384, 99999, 100000, 16777216, 268435456, 715827882, -2147483647, 2147483647};
  const std::size_t which = below(random, std::size(numbers) + 4);
  if (which < std::size(numbers)) return numbers[which];
  return which == std::size(numbers) ? INT32_MIN : static_cast<std::int32_t>(random() % 64) - 32;
}

std::string number_text(Random& random) {
  static const std::array<const char*, 8> forms = {"", "+", "-", "0", " ", "0x", "\t", "00"};
  std::string text = std::to_string(number(random));
  if (below(random, 4) == 0) text = forms[below(random, forms.size())] + text;
  if (below(random, 6) == 0) text += below(random, 2) == 0 ? " " : "x";
  return below(random, 16) == 0 ? "18446744073709551616" : text;
}

std::string some_text(Random& random) {
  static const std::array<const char*, 7> texts = {
      "", "0,0,24,18", "1,1,2,2", "0,0,65536,65536", "depth", "depth,normal,crypto_object", "-9,-7,30,25"};
  switch (below(random, 4)) {
    case 0:
      return number_text(random);
    case 1:
      return number_text(random) + "/" + number_text(random);
    case 2:
      return number_text(random) + "," + number_text(random) + "," + number_text(random) + "," + number_text(random);
    default:
      return texts[below(random, texts.size())];
  }
}

std::string mutated(Random& random, std::string value) {
  const std::size_t size = value.size();
  value.resize(size + 1 + below(random, 32));
  value.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(value.data()), size, value.size()));
  return value;
}

void edit_window(ExrBytes& exr, Random& random) {
  std::string& value = exr[below(random, 3) == 0 ? "displayWindow" : "dataWindow"].value;
  if (value.size() != 16) value.resize(16);
  value.replace(4 * below(random, 4), 4, little_endian(std::vector{number(random)}));
}

std::int32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
  return static_cast<std::int32_t>(number);
}

/// To the side, which changes no chunk; perhaps with what else says where the piece lies.
void shift(ExrBytes& exr, Random& random) {
  const std::string value = exr["dataWindow"].value;
  if (value.size() != 16) return;
  const std::int64_t by = below(random, 4) == 0 ? number(random) : static_cast<std::int32_t>(random() % 64) - 32;
  const auto moved = [&](std::size_t at) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(number_at(value, at) + by, INT32_MIN, INT32_MAX - 1));
  };
  const std::int32_t left = moved(0), right = moved(8), top = number_at(value, 4), bottom = number_at(value, 12);
  exr.set("dataWindow", "box2i", little_endian({left, top, right, bottom}));
  if (below(random, 3) == 0 || bottom == INT32_MAX) return;
  const std::string text = text_of(Region{left, top, right + 1, bottom + 1});
  exr.set_text("raytrace:region", text);
  if (below(random, 2) == 0) exr.set_text("raytrace:whole", text);
}

/// All that says where the piece lies, so that it agrees.
void move(ExrBytes& exr, Random& random) {
  const auto edge = [&] { return static_cast<std::int32_t>(random() % 80) - 30; };
  const int left = edge(), top = edge();
  const int right = left + 1 + static_cast<int>(below(random, 30)),
            bottom = top + 1 + static_cast<int>(below(random, 30));
  const std::string text = text_of(Region{left, top, right, bottom});
  exr.set("dataWindow", "box2i", little_endian({left, top, right - 1, bottom - 1}));
  exr.set_text("raytrace:region", text);
  if (below(random, 4) != 0) exr.set_text("raytrace:whole", text);
  if (below(random, 4) != 0) exr.remove("raytrace:tile");
  if (below(random, 8) == 0) exr.set("displayWindow", "box2i", little_endian({0, 0, right, bottom}));
}

void edit_attribute(ExrBytes& exr, Random& random) {
  static const std::array<const char*, 7> types = {"string", "int", "float", "double", "box2i", "chlist", "nonsense"};
  const std::size_t at = below(random, exr.attributes.size());
  ExrBytes::Attribute& attribute = exr.attributes[at];
  switch (below(random, 8)) {
    case 0:
      attribute.type = types[below(random, types.size())];
      break;
    case 1:
      attribute.name += 'x';
      break;
    case 2:
      exr.attributes.push_back(ExrBytes::Attribute(attribute));
      break;
    case 3:
      exr.attributes.erase(exr.attributes.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    default:
      if (attribute.type == "string" && below(random, 2) == 0) {
        attribute.value = some_text(random);
      } else if (attribute.type == "int" && below(random, 2) == 0) {
        attribute.value = little_endian(std::vector{number(random)});
      } else {
        attribute.value = mutated(random, attribute.value);
      }
  }
}

void edit_own_attribute(ExrBytes& exr, Random& random) {
  static const std::array<const char*, 5> numbers = {"raytrace:samples", "raytrace:centered", "raytrace:unitExponent",
                                                     "raytrace:partial", "raytrace:threads"};
  static const std::array<const char*, 7> texts = {"raytrace:seed",    "raytrace:firstSample", "raytrace:whole",
                                                   "raytrace:region",  "raytrace:tile",        "raytrace:aovs",
                                                   "raytrace:aovUnits"};
  if (below(random, 2) == 0) {
    exr.set_int(numbers[below(random, numbers.size())], number(random));
  } else {
    exr.set_text(texts[below(random, texts.size())], some_text(random));
  }
}

void edit_channels(ExrBytes& exr, Random& random) {
  static const std::array<const char*, 8> names = {"sums.red.low",
                                                   "sums.samples",
                                                   "sums.extra",
                                                   "sums.aov.cover0.id000",
                                                   "sums.aov.cover0.count007",
                                                   "sums.aov.mean0.low",
                                                   "R",
                                                   "Z"};
  std::vector<ExrChannel> channels = channels_of(exr["channels"].value);
  if (channels.empty()) return;
  const std::size_t at = below(random, channels.size());
  switch (below(random, 5)) {
    case 0:
      channels[at].name = names[below(random, names.size())];
      break;
    case 1:
      channels[at].layout.replace(0, 4, little_endian(static_cast<std::uint32_t>(below(random, 4))));
      break;
    case 2:
      channels[at].layout.replace(8 + 4 * below(random, 2), 4, little_endian(std::vector{number(random)}));
      break;
    case 3:
      channels.insert(channels.begin() + static_cast<std::ptrdiff_t>(at), ExrChannel(channels[at]));
      break;
    default:
      channels.erase(channels.begin() + static_cast<std::ptrdiff_t>(at));
  }
  exr["channels"].value = channels_value(channels);
}

void edit_kind(ExrBytes& exr, Random& random) {
  const char value(static_cast<char>(below(random, 12)));
  switch (below(random, 3)) {
    case 0:
      exr.version ^= 1U << below(random, 32);
      break;
    case 1:
      exr.set("compression", "compression", std::string(1, value));
      break;
    default:
      exr.set("lineOrder", "lineOrder", std::string(1, value));
  }
}

void edit_pixels(ExrBytes& exr, Random& random) {
  if (exr.rest.size() < 4) return;
  for (std::size_t words = 1 + below(random, 4); words > 0; --words)
    exr.rest.replace(below(random, exr.rest.size() / 2 - 1) * 2, 4, little_endian(std::vector{number(random)}));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  for (int i = 1; i < *argc; ++i) {
    const fs::path folder = (*argv)[i];
    if (fs::is_directory(folder) && fs::is_empty(folder)) make_corpus(folder);
  }
  write_piece(work_folder().file("left.exr"), {kinds()[0].whole, Tile{0, 2}});
  SamplePiece before = kinds()[4];
  before.samples = {0, 3};
  write_piece(work_folder().file("before.exr"), before);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  using Edit = void (*)(ExrBytes&, Random&);
  static constexpr Edit edits[] = {edit_window,        shift,         move,      edit_attribute, edit_attribute,
                                   edit_own_attribute, edit_channels, edit_kind, edit_pixels,    edit_pixels};
  Random random(seed);
  std::optional<ExrBytes> exr = ExrBytes::parsed({reinterpret_cast<const char*>(data), size});
  if (!exr || below(random, 12) == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (std::size_t left = 1 + below(random, 3); left > 0; --left) edits[below(random, std::size(edits))](*exr, random);
  const std::string bytes = exr->bytes();
  if (bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(data));
  return bytes.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = work_folder().file("piece.exr");
  write_text(file, {reinterpret_cast<const char*>(data), size});
  for (const bool aovs : {false, true}) resume(file, checkpoint_kind(aovs));
  if (is_large(file)) return 0;
  merge({file}, true);
  merge({work_folder().file("left.exr"), file}, false);
  merge({file, work_folder().file("before.exr")}, true);
  return 0;
}
