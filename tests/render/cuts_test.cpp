// However a picture is cut - threads, crops (also beyond the picture), tiles, ranges of samples, passes - its pixels
// have the same bits. The gallery's scenes are cut at random, rendered piece by piece into files, and merged;
// command/test_pieces.py does one of each kind through the program.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/merge_pieces.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/description/light_groups.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/film/light_pass.h"
#include "raytrace/film/tiles.h"
#include "raytrace/output/exr_reader.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"
#include "raytrace/render/renderer.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr int width = 40, height = 28;  // no multiples of the blocks of 8 x 8 pixels that are traced together
constexpr Region whole_picture = {0, 0, width, height}, overscan = {-17, -13, width + 19, height + 14};

std::vector<std::string> gallery() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(RAYTRACE_SOURCE_DIR "/scenes/gallery"))
    if (entry.path().extension() == ".xml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

SceneDescription small_scene(const std::string& file, int samples) {
  Diagnostics diagnostics(file);
  std::optional<SceneDescription> description = load_scene(file, diagnostics);
  if (!description || !load_meshes(*description, diagnostics)) {
    std::ostringstream text;
    diagnostics.print(text);
    FAIL(text.str());
  }
  description->viewplane = with_resolution(description->viewplane, width, height);
  description->viewplane.samples = samples;
  return std::move(*description);
}

/// With so many paths that go on from camera rays' first points, where paths are traced.
SceneDescription with_branches(SceneDescription description, int branches) {
  if (description.integrator)
    if (auto* const path = std::get_if<Path::Parameters>(&*description.integrator)) path->indirectsamples = branches;
  return description;
}

class Chance {
 public:
  explicit Chance(unsigned seed) : bits_(seed) {}

  /// From `least` to `most`, both included.
  int number(int least, int most) {
    return least + static_cast<int>(bits_() % static_cast<unsigned>(most - least + 1));
  }

  /// Inside `bounds`, and no larger than the picture.
  Region crop(const Region& bounds) {
    Region r;
    do {
      r = {number(bounds.x0, bounds.x1 - 1), number(bounds.y0, bounds.y1 - 1), 0, 0};
      r.x1 = number(r.x0 + 1, std::min(r.x0 + width, bounds.x1));
      r.y1 = number(r.y0 + 1, std::min(r.y0 + height, bounds.y1));
    } while (r.width() * r.height() < 8);  // enough pixels for all tiles
    return r;
  }

  /// [0, total) as so many ranges that are not empty, or fewer: where they begin, and `total`.
  std::vector<int> edges(int total, int parts) {
    std::set<int> all = {0, total};
    for (int i = 1; i < parts; ++i) all.insert(number(1, total - 1));
    return {all.begin(), all.end()};
  }

  template <class Items>
  void shuffle(Items& items) {
    std::shuffle(items.begin(), items.end(), bits_);
  }

 private:
  std::mt19937 bits_;
};

/// The colours of a picture, and what each light group brings to it, as its file holds them.
struct Colors {
  Region region;
  std::vector<std::vector<float>> planes;

  /// The same pixels' bits in both.
  friend bool same(const Colors& part, const Colors& whole) {
    const auto row_length = static_cast<std::size_t>(part.region.width());
    if (part.planes.size() != whole.planes.size()) return false;
    for (std::size_t plane = 0; plane < part.planes.size(); ++plane)
      for (int y = part.region.y0; y < part.region.y1; ++y) {
        const auto at = [&](const Colors& picture) {
          const auto row = static_cast<std::size_t>(y - picture.region.y0);
          const auto column = static_cast<std::size_t>(part.region.x0 - picture.region.x0);
          return picture.planes[plane].data() + row * static_cast<std::size_t>(picture.region.width()) + column;
        };
        if (std::memcmp(at(part), at(whole), row_length * sizeof(float)) != 0) return false;
      }
    return true;
  }
};

/// One gallery scene, and the ways to render it.
class CutRender {
 public:
  /// isa: as build_scene() takes it. finer: the film's unit is 2^finer times smaller than the scene's.
  CutRender(const std::string& file, int samples, bool transparent, const std::string& isa, unsigned seed,
            int finer = 0)
      : chance_(seed),
        finer_(finer),
        samples_(samples),
        transparent_(transparent),
        single_splats_(seed % 2 == 1),
        description_(with_branches(small_scene(file, samples), seed % 4 == 1 ? 3 : 1)),
        scene_(build_scene(description_, {8, isa})),
        aovs_(aovs_of(description_)),
        whole_(in_one(overscan, 1)) {}

  /// Whether the picture, or a crop of it, has the same bits when it is rendered in a way of this kind. What was done
  /// is added to `steps`.
  bool same_after(const std::string& kind, std::string& steps) {
    const Region crop = kind.ends_with("of a crop")             ? chance_.crop(whole_picture)
                        : kind.ends_with("of an overscan crop") ? chance_.crop(overscan)
                                                                : whole_picture;
    steps = kind + " " + text_of(crop) + ", " + std::to_string(samples_) + " samples" +
            (transparent_ ? ", transparent:" : ":");
    steps_ = &steps;
    if (kind.starts_with("threads")) return same(in_one(crop, chance_.number(1, 8)), whole_);
    if (kind.starts_with("passes")) return same(in_passes(crop), whole_);
    if (kind.starts_with("tiles")) return same(merged(tiles(crop, 6, 1)), whole_);
    if (kind.starts_with("samples")) return same(merged(ranges(crop, std::nullopt, chance_.number(2, 5))), whole_);
    return same(merged(tiles(crop, 3, 3)), whole_);
  }

  /// Whether some pieces had sums beyond 64 bits, and others none.
  bool had_both() const { return with_high_ > 0 && without_high_ > 0; }

 private:
  static std::string text_of(const Region& r) {
    std::ostringstream text;
    text << r.x0 << ',' << r.y0 << ',' << r.x1 << ',' << r.y1;
    return text.str();
  }

  /// whole: that the region is a part of.
  Film empty_film(const Region& region, const SampleRange& samples, const Region& whole) const {
    FilmSettings settings =
        film_settings(*scene_, description_, {1, 0, region, samples, aovs_, transparent_, whole, single_splats_});
    settings.unit_exponent -= finer_;
    return Film(settings);
  }

  Colors in_one(const Region& region, int threads) {
    Film film = empty_film(region, all_samples(), region);
    render(*scene_, film, all_samples().count, threads);
    return colors_of(film);
  }

  Colors in_passes(const Region& region) {
    Film film = empty_film(region, all_samples(), region);
    for (const int samples : chance_.edges(samples_, 4))
      render(*scene_, film, static_cast<std::uint32_t>(samples), chance_.number(1, 4));
    return colors_of(film);
  }

  /// Pieces of so many tiles at most, each in so many ranges of samples at most.
  std::vector<std::string> tiles(const Region& whole, int parts, int splits) {
    std::vector<std::string> files;
    const int count = chance_.number(2, parts);
    for (int i = 0; i < count; ++i)
      for (std::string& file : ranges(whole, Tile{i, count}, chance_.number(1, splits)))
        files.push_back(std::move(file));
    return files;
  }

  /// Pieces of a tile, or of all, in so many ranges of the samples.
  std::vector<std::string> ranges(const Region& whole, const std::optional<Tile>& tile, int parts) {
    std::vector<std::string> files;
    const std::vector<int> edges = chance_.edges(samples_, parts);
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(edges[i - 1]), end = static_cast<std::uint32_t>(edges[i]);
      files.push_back(piece(whole, tile, {first, end - first, false}, parts > 1));
    }
    return files;
  }

  std::string piece(const Region& whole, const std::optional<Tile>& tile, const SampleRange& samples, bool keeps_sums) {
    const Region region = tile ? tile_of(whole, tile->index, tile->count) : whole;
    *steps_ +=
        " " + text_of(region) + " from " + std::to_string(samples.first) + " on " + std::to_string(samples.count) + ";";
    Film film = empty_film(region, samples, whole);
    if (film.settings().rendered() != film.region()) keeps_sums = true;  // others' light paths belong to them
    render(*scene_, film, samples.count, chance_.number(1, 4));
    PieceIdentity identity;
    identity.provenance = provenance_of(*scene_, description_);
    identity.film = film.settings();
    identity.whole = whole;
    identity.tile = tile;
    ImageMetadata metadata;
    metadata.software = identity.provenance.software;
    metadata.samples = static_cast<int>(samples.count);
    metadata.attributes = identity_attributes(identity);
    std::vector<Channel> channels = picture_channels();
    const std::vector<Channel> sums = keeps_sums ? sum_channels(film) : std::vector<Channel>();
    ++(film.has_high() ? with_high_ : without_high_);
    channels.insert(channels.end(), sums.begin(), sums.end());
    const std::string file = folder_.file("piece" + std::to_string(pieces_++) + ".exr");
    ImageFile image(file, film.settings().extent, channels, metadata, {.full_float = true, .threads = 1});
    ImageBand band;
    fill_color(band, film, film.region().y0, film.region().y1);
    fill_aovs(band, ImageBand::colors, film);
    if (keeps_sums) append_sums(band, sums, film);
    image.write(band);
    image.commit();
    return file;
  }

  Colors merged(std::vector<std::string> pieces) {
    chance_.shuffle(pieces);
    const std::string file = folder_.file("merged.exr");
    MergeSettings settings;
    settings.pieces = std::move(pieces);
    settings.outputs = {file};
    settings.threads = 1;
    merge_pieces(settings);
    ExrReader reader(file);
    const Region& region = reader.extent().region;
    return colors_in(reader.read(picture_channels(), region.y0, region.y1), region);
  }

  Colors colors_of(const Film& film) const {
    ImageBand band;
    fill_color(band, film, film.region().y0, film.region().y1);
    fill_aovs(band, ImageBand::colors, film);
    return colors_in(band, film.region());
  }

  static Colors colors_in(const ImageBand& band, const Region& region) {
    Colors colors{region, {}};
    for (const ChannelValues& plane : band.planes) colors.planes.push_back(std::get<std::vector<float>>(plane));
    return colors;
  }

  /// Of all light groups and passes, and what a denoiser looks at, which paths bring.
  static AovSet aovs_of(const SceneDescription& description) {
    std::vector<std::string> names(std::begin(light_pass_names), std::end(light_pass_names));
    names.insert(names.end(), {"denoise_albedo", "denoise_normal"});
    AovSet aovs = aov_set(names);
    aovs.wants_all_light_groups = true;
    return with_light_groups(aovs, light_group_names(description));
  }

  std::vector<Channel> picture_channels() const {
    std::vector<Channel> channels = color_channels(true);
    for (const Channel& channel : aov_channels(aovs_)) channels.push_back(channel);
    return channels;
  }

  SampleRange all_samples() const { return {0, static_cast<std::uint32_t>(samples_), false}; }

  TemporaryFolder folder_;
  Chance chance_;
  int finer_, samples_;
  bool transparent_, single_splats_;
  SceneDescription description_;
  std::unique_ptr<const Scene> scene_;
  AovSet aovs_;
  int pieces_ = 0, with_high_ = 0, without_high_ = 0;
  std::string* steps_ = nullptr;
  Colors whole_;
};

}  // namespace

TEST_CASE("the gallery's scenes have the same bits however they are cut") {
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : std::vector<std::pair<std::string, int>>{{"threads", 3},
                                                                            {"threads of a crop", 4},
                                                                            {"threads of an overscan crop", 2},
                                                                            {"passes", 2},
                                                                            {"passes of a crop", 2},
                                                                            {"tiles", 2},
                                                                            {"tiles of a crop", 1},
                                                                            {"samples", 3},
                                                                            {"samples of a crop", 1},
                                                                            {"mixed", 4},
                                                                            {"mixed of a crop", 1},
                                                                            {"mixed of an overscan crop", 1}})
    kinds.insert(kinds.end(), static_cast<std::size_t>(count), kind);
  const std::vector<std::string> files = gallery();
  CHECK(files.size() >= 7);
  for (unsigned i = 0; i < files.size(); ++i) {
    CutRender cut(files[i], Chance(i).number(8, 12), i % 2 == 1, {}, i);
    for (unsigned k = 0; k < kinds.size(); ++k) {
      if (is_sanitized && (i + k) % 3 != 0) continue;  // of each scene others: all kinds, where each takes long
      std::string steps;
      const bool same = cut.same_after(kinds[k], steps);
      INFO(files[i] << ": " << steps);
      CHECK(same);
    }
  }
}

TEST_CASE("packets of every shape give the same bits however a picture is cut") {
  // Numbers of samples that lead to packets of a single pixel, of two pixels and so on, up to as many pixels as lanes:
  // which leads to which depends on the instruction set's lanes (render_tile() in tracing/).
  const int samples = GENERATE(32, 16, 8, 4, 3);
  // The second has a lens and a pixel filter, the third pixels without rays; in the fourth things move, and in the last
  // light is split by its wavelength.
  const std::string scene = GENERATE("seed", "camera-thin-lens", "camera-fisheye", "motion-blur", "dispersion");
  const std::string file = RAYTRACE_SOURCE_DIR "/scenes/" + scene + ".xml";
  for (const std::string& isa : usable_isas()) {
    CutRender cut(file, samples, samples == 16, isa, static_cast<unsigned>(samples));
    for (const std::string kind : {"threads of a crop", "threads of a crop", "threads of an overscan crop",
                                   "passes of a crop", "mixed", "mixed of an overscan crop"}) {
      std::string steps;
      const bool same = cut.same_after(kind, steps);
      INFO(scene << ", " << isa << ": " << steps);
      CHECK(same);
    }
  }
}

TEST_CASE("pieces with sums beyond 64 bits are merged with others") {
  CutRender cut(gallery().front(), Chance(5).number(8, 12), false, {}, 5, 22);
  for (int i = 0; i < (is_sanitized ? 4 : 12); ++i) {
    std::string steps;
    const bool same = cut.same_after(i % 2 == 0 ? "samples" : "mixed of a crop", steps);
    INFO(steps);
    CHECK(same);
  }
  CHECK(cut.had_both());
}

}  // namespace raytrace::test
