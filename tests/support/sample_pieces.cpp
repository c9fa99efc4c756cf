#include "support/sample_pieces.h"

#include <array>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/film/splat_layer.h"
#include "raytrace/output/image_band.h"

namespace raytrace::test {

PieceIdentity identity_of(const SamplePiece& piece) {
  PieceIdentity identity;
  identity.provenance = {"raytrace 1.2.3", "3.13.5", "x86-64-v3", "0123456789abcdef"};
  identity.whole = piece.whole;
  identity.tile = piece.tile;
  identity.partial = piece.partial;
  FilmSettings& film = identity.film;
  film.extent = {sample_width, sample_height,
                 piece.tile ? tile_of(piece.whole, piece.tile->index, piece.tile->count) : piece.whole};
  if (piece.light_paths) {
    film.light_paths_of = film.extent.region;
    film.extent.region = piece.whole;
  }
  film.samples = piece.samples;
  film.seed = 7;
  if (piece.aovs) {
    std::vector<std::string> names = aov_names();
    names.insert(names.end(), {"light_default", "light_key"});
    film.aovs = aov_settings(aov_set(names));
  }
  return identity;
}

Film film_of(const SamplePiece& piece) {
  Film film(identity_of(piece).film);
  const Region region = film.settings().rendered();
  const std::uint32_t count = piece.samples.count;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const auto number = static_cast<std::uint32_t>((x * 7 + y * 13) & 0xff);
      const std::uint32_t samples = piece.partial ? number % (count + 1) : count, hits = number % (samples + 1);
      if (samples == 0) continue;
      const std::int64_t light = std::int64_t{number} << 36;
      const std::int64_t high = piece.large ? std::int64_t{samples} * 1000 : 0;
      film.add(x, y, {light, light / 2, light / 3, hits, samples}, {high, -high, high});
      if (SplatLayer* const splats = film.splats(); splats != nullptr) {
        splats->add((region.x0 + x) / 2, (region.y0 + y) / 2, {light, from_limbs({light, high}), -light});
        splats->add_paths(samples * splats->paths_per_sample(x, y));
      }
      for (LightLayer& layer : film.lights()) {
        layer.samples->add(x, y, {light, from_limbs({light, high}), -light});
        if (layer.splats) layer.splats->add(x, y, {from_limbs({light, high}), 1, light});
      }
      AovFilm* const aovs = film.aovs();
      if (aovs == nullptr) continue;
      const std::array<std::uint32_t, 32> values{number};
      if (hits > 0) aovs->add_nearest(x, y, 1.5F, piece.samples.first + number % samples, values.data());
      for (std::size_t i = 0; i < aovs->settings().mean_units.size(); ++i) aovs->add_mean(x, y, i, light);
      for (std::size_t i = 0; i < aovs->settings().coverages; ++i)
        for (std::uint32_t hit = 0; hit < hits; ++hit) aovs->add_coverage(x, y, i, {1000 + (number + hit) % 3, 1});
    }
  return film;
}

void write_piece(const std::string& file, const SamplePiece& piece) {
  const Film film = film_of(piece);
  const PieceIdentity identity = identity_of(piece);
  ImageMetadata metadata;
  metadata.software = identity.provenance.software;
  metadata.scene_file = "scene.xml";
  metadata.samples = static_cast<int>(piece.samples.count);
  metadata.seed = identity.film.seed;
  metadata.render_seconds = 1.5;
  metadata.attributes = identity_attributes(identity);
  std::vector<Channel> channels = color_channels(false);
  for (const Channel& channel : aov_channels(identity.film.aovs.wanted)) channels.push_back(channel);
  const std::vector<Channel> sums = piece.sums ? sum_channels(film) : std::vector<Channel>();
  channels.insert(channels.end(), sums.begin(), sums.end());
  ImageFileSettings settings;
  settings.compressed = piece.compressed;
  settings.threads = 1;
  ImageFile image(file, film.settings().extent, channels, metadata, settings);
  ImageBand band;
  fill_color(band, film, film.region().y0, film.region().y1);
  fill_aovs(band, ImageBand::colors, film);
  if (piece.sums) append_sums(band, sums, film);
  image.write(band);
  image.commit();
}

}  // namespace raytrace::test
