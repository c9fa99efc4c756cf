#include "raytrace/batch/checkpoint.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "raytrace/film/samples_done.h"
#include "raytrace/math/content_hash.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

constexpr const char* hash_name = "raytrace:sumsHash";
constexpr const char* error_name = "raytrace:errorOfPasses";

std::string hash_of(const Film& film) {
  ContentHash hash;
  film.add_to(hash);
  return hash.digits();
}

/// With all their bits.
std::string text_of(const ErrorOfPasses::Sums& error) { return formatted("%a %a", error.variance, error.samples); }

/// Takes a number as text_of() writes it from the text's start.
bool take_number(std::string_view& text, double& number) {
  if (!text.starts_with("0x")) return false;
  text.remove_prefix(2);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::hex);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc();
}

/// Nothing where the text is none of text_of().
ErrorOfPasses::Sums error_sums(std::string_view text) {
  ErrorOfPasses::Sums error;
  if (!take_number(text, error.variance) || !text.starts_with(' ')) return {};
  text.remove_prefix(1);
  if (!take_number(text, error.samples) || !text.empty()) return {};
  const auto is_good = [](double sum) { return std::isfinite(sum) && sum >= 0; };
  return is_good(error.variance) && is_good(error.samples) ? error : ErrorOfPasses::Sums();
}

}  // namespace

FileIdentity write_checkpoint(const std::string& file, const Film& film, const PieceIdentity& identity,
                              ImageMetadata metadata, const ErrorOfPasses::Sums& error) {
  metadata.samples = static_cast<int>(film.settings().samples.count);
  metadata.attributes = partial_attributes(identity, film);
  metadata.attributes.push_back({hash_name, hash_of(film)});
  metadata.attributes.push_back({error_name, text_of(error)});

  metadata.data_attributes.clear();  // of AOVs, which come when the picture is done

  std::vector<Channel> channels = color_channels(false);
  const std::vector<Channel> sums = sum_channels(film);
  channels.insert(channels.end(), sums.begin(), sums.end());
  ImageFileSettings settings;
  settings.compressed = false;
  ImageFile image(file, make_exr_encoder(file, settings), film.settings().extent, channels, metadata);
  const Region& region = film.region();
  for (int y = region.y0; y < region.y1;) {
    const int end = std::min(y + band_rows(region.width(), channels.size()), region.y1);
    ImageBand band;
    fill_color(band, film, y, end);
    append_sums(band, sums, film);
    image.write(band);
    y = end;
  }
  image.commit();
  return image.identity();
}

ErrorOfPasses::Sums read_checkpoint(const std::string& file, const PieceIdentity& identity, Film& film) {
  const auto refuse = [&](const std::string& why) { throw InputError("cannot resume from " + file + ": " + why); };
  ExrReader reader(file);
  const PieceIdentity got = identity_of(reader);
  if (const auto other = difference(identity, got)) refuse("it differs in " + *other);
  if (got.film.extent.region != film.region())
    refuse("it holds the crop " + text_of(got.film.extent.region) + ", not " + text_of(film.region()));
  if (got.film.rendered() != film.settings().rendered())
    refuse("it is of the tile " + text_of(got.film.rendered()) + ", not " + text_of(film.settings().rendered()));
  if (got.film.samples.first != film.settings().samples.first)
    refuse("its samples begin at " + std::to_string(got.film.samples.first) + ", not " +
           std::to_string(film.settings().samples.first));
  if (std::none_of(reader.channels().begin(), reader.channels().end(), is_sum))
    refuse("it is a picture without the sums of its samples");
  const std::vector<Channel> sums = sum_channels(got.film, reader.channels());
  std::vector<Channel> channels = color_channels(false);
  channels.insert(channels.end(), sums.begin(), sums.end());
  refuse_other_channels(reader, channels);
  const Region& region = film.region();
  for (int y = region.y0; y < region.y1;) {
    const int end = std::min(y + band_rows(region.width(), sums.size()), region.y1);
    if (!add_sums(reader.read(sums, y, end), sums, got.film.samples, film)) refuse("it is damaged");
    y = end;
  }
  if (reader.attribute<std::string>(hash_name) != hash_of(film)) refuse("it is damaged");
  if (samples_done(film).most > film.settings().samples.count)
    refuse("it has more samples per pixel than are asked for");
  return error_sums(reader.attribute<std::string>(error_name).value_or(""));
}

CheckpointFile::CheckpointFile(std::string file, double interval)
    : file_(std::move(file)),
      interval_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(interval))) {}

ErrorOfPasses::Sums CheckpointFile::read(const PieceIdentity& identity, Film& film) {
  last_ = file_identity(file_);  // first: a file that replaces it meanwhile is not ours to remove
  return read_checkpoint(file_, identity, film);
}

bool CheckpointFile::write(const Film& film, const PieceIdentity& identity, const ImageMetadata& metadata,
                           const ErrorOfPasses::Sums& error, RenderObserver& observer) {
  const Clock::time_point begin = Clock::now();
  bool written = true;
  try {
    last_ = write_checkpoint(file_, film, identity, metadata, error);
    observer.on_message(MessageLevel::step, "wrote checkpoint " + file_ + ": " + samples_done_text(film));
  } catch (const OutputError& failure) {
    observer.on_message(MessageLevel::error, failure.what());
    written = false;
  }
  // However long it took, it takes no more than a hundredth of the time.
  const Clock::time_point end = Clock::now();
  next_ = end + std::max(interval_, 100 * (end - begin));
  return written;
}

void CheckpointFile::remove(RenderObserver& observer) const {
  if (!last_ || remove_file(file_, *last_)) return;
  observer.on_message(MessageLevel::warning,
                      "the checkpoint " + file_ + " is not removed: another file has replaced it");
}

}  // namespace raytrace
