#include "raytrace/batch/merge_pieces.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/merged_rows.h"
#include "raytrace/batch/output_files.h"
#include "raytrace/batch/picture_metadata.h"
#include "raytrace/batch/piece_layout.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/output/auto_exposure.h"
#include "raytrace/output/image_band.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

struct Piece {
  std::string file;
  PieceIdentity identity;
  std::vector<Channel> channels;  ///< colour first, then the AOVs, as image files want them
  std::vector<Channel> sums;      ///< empty if it has none
};

std::vector<Channel> all_channels(const Piece& piece) {
  std::vector<Channel> all = piece.channels;
  all.insert(all.end(), piece.sums.begin(), piece.sums.end());
  return all;
}

/// Throws InputError if the file holds what no piece does.
Piece piece_of(const ExrReader& reader) {
  Piece piece{reader.file(), identity_of(reader), {}, {}};
  if (reader.attribute<int>(denoised_name))
    throw InputError(piece.file +
                     " is denoised: pieces are rendered with --tile or --sample-offset, and --denoise then "
                     "denoises the picture that they are merged to");
  const AovSettings& aovs = piece.identity.film.aovs;
  const std::vector<Channel>& all = reader.channels();
  piece.channels = color_channels(std::find(all.begin(), all.end(), Channel{"R", ChannelType::float32}) != all.end());
  for (Channel& channel : aov_channels(aovs.wanted)) piece.channels.push_back(std::move(channel));
  if (std::any_of(all.begin(), all.end(), is_sum)) piece.sums = sum_channels(piece.identity.film, all);
  refuse_other_channels(reader, all_channels(piece));
  return piece;
}

PieceExtent extent_of(const Piece& piece) {
  const FilmSettings& film = piece.identity.film;
  return {piece.file, film.rendered(), film.samples.first, std::uint64_t{film.samples.first} + film.samples.count,
          piece.identity.tile};
}

std::string names_of(const std::vector<Channel>& channels) {
  std::string names;
  for (const Channel& channel : channels) names += (names.empty() ? "" : " ") + printable(channel.name);
  return names;
}

/// What does not let a piece be put together with the first.
std::optional<std::string> misfit(const Piece& first, const Piece& piece) {
  if (auto other = difference(first.identity, piece.identity)) return other;
  if (piece.identity.whole != first.identity.whole) return "the crop that it is a part of";
  if (piece.channels != first.channels)
    return "its channels (" + names_of(piece.channels) + ", not " + names_of(first.channels) + ")";
  return std::nullopt;
}

[[noreturn]] void refuse(const std::vector<std::string>& problems) {
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + on_one_line(problem);
  throw MergeError(text);
}

/// Throws for what no merge can be meant by.
void require_good_merge(const MergeSettings& settings) {
  if (settings.pieces.empty()) refuse({"no pieces are given"});
  if (settings.outputs.empty()) refuse({"--output: none is given; a picture needs a file"});
  UsedFiles files;
  for (const std::string& piece : settings.pieces) files.add_or_refuse({"the piece", piece, false});
  for (const std::string& output : settings.outputs) files.add_or_refuse({"--output", output, true});
}

struct Stopped {};

class Merger {
 public:
  Merger(const MergeSettings& settings, const std::function<bool()>& stop) : settings_(settings), stop_(stop) {}

  MergeReport merge() {
    read_headers();
    check_layout();
    write();
    return report_;
  }

 private:
  void read_headers() {
    for (const std::string& file : settings_.pieces) {
      heed_stop();
      try {
        const ExrReader reader(file);
        pieces_.push_back(piece_of(reader));
        const double seconds{reader.attribute<float>("raytrace:renderSeconds").value_or(0)};
        if (seconds > 0 && std::isfinite(seconds)) render_seconds_ += seconds;
        if (pieces_.size() == 1) metadata_ = metadata_of(reader);
      } catch (const InputError& error) {
        problems_.emplace_back(error.what());
      }
    }
    for (const Piece& piece : pieces_)
      if (const auto other = misfit(pieces_.front(), piece))
        problems_.push_back(piece.file + " does not belong to " + pieces_.front().file + ": it differs in " + *other);
    for (const Piece& piece : pieces_)
      if (piece.identity.partial && !settings_.partial)
        problems_.push_back(piece.file + " was stopped before its end: render it to its end with " +
                            options_of(extent_of(piece)) + "--resume, or use --partial");
    refuse_problems();
  }

  /// Whether they cover the picture exactly.
  void check_layout() {
    const PieceIdentity& first = pieces_.front().identity;
    std::vector<PieceExtent> extents;
    for (const Piece& piece : pieces_) {
      extents.push_back(extent_of(piece));
      samples_ = std::max(samples_, extents.back().last_sample);
      report_.missing_parts = report_.missing_parts || piece.identity.partial;
    }
    WantedExtent wanted{first.whole, samples_, first.film.samples.centered, {}};
    const PictureExtent& extent = first.film.extent;
    if (first.whole != Region{0, 0, extent.full_width, extent.full_height}) wanted.crop = text_of(first.whole);
    const auto no_sums = [](const Piece& piece) { return piece.sums.empty(); };
    if (settings_.samples && std::uint64_t(*settings_.samples) != samples_ && !settings_.partial) {
      problems_.push_back("the pieces hold " + std::to_string(samples_) + " samples per pixel, not " +
                          std::to_string(*settings_.samples));
      // To those that keep their sums, more can be added.
      if (std::none_of(pieces_.begin(), pieces_.end(), no_sums))
        wanted.samples = std::max(samples_, std::uint64_t(*settings_.samples));
    }
    add_problems(overlaps(extents));
    const std::vector<std::string> missing = missing_parts(extents, wanted);
    report_.missing_parts = report_.missing_parts || !missing.empty();
    if (!settings_.partial) add_problems(missing);
    for (const Piece& piece : pieces_)
      if (!is_finished(piece) && no_sums(piece))
        problems_.push_back(piece.file +
                            " holds some of the samples only, without their sums: render it with --sample-offset");
    refuse_problems();
    report_.pieces = pieces_.size();
    report_.samples = static_cast<int>(samples_);
  }

  void add_problems(const std::vector<std::string>& more) {
    problems_.insert(problems_.end(), more.begin(), more.end());
  }

  void refuse_problems() const {
    if (!problems_.empty()) refuse(problems_);
  }

  /// Whether its pixels have all the samples, and light paths of all others, so that they can be taken as they are.
  bool is_finished(const Piece& piece) const {
    const FilmSettings& film = piece.identity.film;
    return film.samples.first == 0 && film.samples.count == samples_ && !piece.identity.partial &&
           film.rendered() == film.extent.region;
  }

  ImageMetadata metadata_of(const ExrReader& reader) const {
    ImageMetadata metadata;
    metadata.software = pieces_.front().identity.provenance.software;
    metadata.scene_file = reader.attribute<std::string>("raytrace:scene").value_or("");
    metadata.seed = pieces_.front().identity.film.seed;
    metadata.threads = reader.attribute<int>("raytrace:threads").value_or(1);
    metadata.camera = reader.camera();
    for (const ImageAttribute& attribute : reader.attributes())
      if (attribute.name.starts_with("cryptomatte/") || attribute.name.starts_with("raytrace:manifest/"))
        metadata.data_attributes.push_back(attribute);
    return metadata;
  }

  void write() {
    const PieceIdentity& first = pieces_.front().identity;
    PieceIdentity identity = first;
    identity.film.extent.region = first.whole;
    if (identity.film.light_paths_of) identity.film.light_paths_of = first.whole;
    identity.tile.reset();
    identity.film.samples.first = 0;
    identity.partial = report_.missing_parts;
    metadata_.samples = report_.samples;
    if (render_seconds_ > 0) metadata_.render_seconds = render_seconds_;
    for (ImageAttribute& attribute : identity_attributes(identity))
      metadata_.attributes.push_back(std::move(attribute));

    channels_ = pieces_.front().channels;
    ImageFileSettings image_settings;
    image_settings.full_float = channels_.front().type == ChannelType::float32;
    image_settings.bit_depth = settings_.bit_depth;
    image_settings.threads = settings_.threads;
    image_settings.transparent = identity.film.transparent;
    image_settings.ocio = settings_.view.ocio;
    image_settings.dither = settings_.view.dither;
    refuse_useless_options(image_settings);
    const Region& whole = first.whole;
    std::size_t most_sums = 0;
    for (const Piece& piece : pieces_) most_sums = std::max(most_sums, piece.sums.size());
    // Each light path reaches any row, and how many there are says what each counts.
    const int rows =
        identity.film.light_paths_of ? whole.height() : band_rows(whole.width(), channels_.size() + most_sums);
    if (any_for_display(settings_.outputs, image_settings)) {
      refuse_other_views();
      const ViewSettings view = view_of(pieces_.front());
      set_view(image_settings, view, view.auto_exposure ? exposure_of(whole, rows) : 0);
    }
    if (agree_in_view())
      for (ImageAttribute& attribute : wished_view(settings_.view.over(first.view)))
        metadata_.data_attributes.push_back(std::move(attribute));
    std::vector<Channel> all = channels_;
    std::optional<DenoisedPicture> denoised;
    if (denoises()) {
      for (ImageAttribute& attribute : denoised_attributes()) metadata_.attributes.push_back(std::move(attribute));
      denoised = denoise(whole, rows);
      for (Channel& channel : noisy_channels(channels_, image_settings.transparent)) all.push_back(std::move(channel));
    }
    std::vector<std::unique_ptr<ImageFile>> files;
    for (const std::string& file : settings_.outputs)
      files.push_back(std::make_unique<ImageFile>(file, identity.film.extent, all, metadata_, image_settings));
    for_each_band(whole, rows, [&](ImageBand& band) {
      if (denoised) denoised->put_into(band);
      for (const auto& file : files) file->write(band);
    });
    for (std::size_t i = 0; i < files.size(); ++i) {
      const Repairs repairs = files[i]->commit();
      for (std::string& warning : warnings_of(repairs, settings_.outputs[i]))
        report_.warnings.push_back(std::move(warning));
      report_.outputs.push_back(settings_.outputs[i]);
    }
  }

  void refuse_useless_options(const ImageFileSettings& image_settings) const {
    const std::string option = settings_.view.first_given();
    if (!option.empty() && !any_for_display(settings_.outputs, image_settings))
      refuse({option + ": all outputs hold linear colour, which it does not change, for the pieces hold floats"});
  }

  /// The options', else the piece's.
  ViewSettings view_of(const Piece& piece) const {
    ViewSettings view = settings_.view.over(piece.identity.view);
    if (!settings_.view.ocio.empty()) view.transform = ViewTransform::srgb;  // whatever it was
    return view;
  }

  bool agree_in_view() const {
    return std::all_of(pieces_.begin(), pieces_.end(),
                       [&](const Piece& piece) { return view_of(piece) == view_of(pieces_.front()); });
  }

  void refuse_other_views() const {
    for (const Piece& piece : pieces_) {
      const ViewSettings view = view_of(pieces_.front()), other = view_of(piece);
      if (other == view) continue;
      const char* const option = other.transform != view.transform           ? "--view-transform"
                                 : other.exposure != view.exposure           ? "--exposure"
                                 : other.white_balance != view.white_balance ? "--white-balance"
                                                                             : "--auto-exposure";
      refuse({piece.file + " is to be shown in another way than " + pieces_.front().file + ": say how with " + option});
    }
  }

  /// That the merged picture asks for itself, which takes another reading of all pieces.
  double exposure_of(const Region& whole, int rows) {
    AutoExposure exposure;
    for_each_band(whole, rows, [&](const ImageBand& band) { exposure.add(band); });
    return exposure.stops();
  }

  bool denoises() const {
    return settings_.denoise ||
           std::all_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return piece.identity.denoise; });
  }

  /// The same of the merged picture's colours.
  DenoisedPicture denoise(const Region& whole, int rows) {
    const auto has = [&](const std::string& start) {
      return std::any_of(channels_.begin(), channels_.end(),
                         [&](const Channel& channel) { return channel.name.starts_with(start); });
    };
    for (const char* const aov : denoiser_aovs)
      if (!has(aov + std::string(".")))
        refuse({"--denoise: the pieces have no " + std::string(aov) + ": render them with --denoise, too"});
    DenoisedPicture picture(whole, channels_, pieces_.front().identity.film.transparent);
    for_each_band(whole, rows, [&](const ImageBand& band) { picture.add(band); });
    if (!picture.denoise(settings_.threads, stop_ ? stop_ : [] { return false; })) throw Stopped();
    return picture;
  }

  /// Calls use(band) with all rows of the merged picture, some at a time.
  template <class Use>
  void for_each_band(const Region& whole, int rows, const Use& use) {
    for (Region band = whole; band.y0 < whole.y1; band.y0 = band.y1) {
      heed_stop();
      band.y1 = std::min(band.y0 + rows, whole.y1);
      ImageBand merged = merged_band(band);
      use(merged);
    }
    refuse_problems();
  }

  ImageBand merged_band(const Region& region) {
    ImageBand band;
    band.region = region;
    make_planes(band, 0, channels_);
    if (report_.missing_parts && !pieces_.front().identity.film.transparent) fill_missing(band);
    add_up_sums(band);
    for (const Piece& piece : pieces_) {
      const auto [top, bottom] = common_rows(piece, region);
      if (top < bottom && is_finished(piece))
        read(piece, channels_, top, bottom, [&](const ImageBand& rows) { copy_rows(rows, band); });
    }
    return band;
  }

  /// Calls use(band) with the piece's rows [top, bottom). A piece whose pixels are damaged is a problem, and then
  /// passed over, so that all of them are named in the end.
  template <class Use>
  void read(const Piece& piece, const std::vector<Channel>& channels, int top, int bottom, const Use& use) {
    if (damaged_.contains(&piece)) return;
    try {
      ExrReader reader(piece.file);
      if (reader.extent() != piece.identity.film.extent)
        throw InputError(piece.file + " has changed while it was read");
      refuse_other_channels(reader, all_channels(piece));
      use(reader.read(channels, top, bottom));
    } catch (const InputError& error) {
      damaged_.insert(&piece);
      problems_.emplace_back(error.what());
    }
  }

  static std::pair<int, int> common_rows(const Piece& piece, const Region& region) {
    const Region& its = piece.identity.film.extent.region;
    return {std::max(its.y0, region.y0), std::min(its.y1, region.y1)};
  }

  /// From the pieces that have but some of the samples.
  void add_up_sums(ImageBand& band) {
    FilmSettings settings = pieces_.front().identity.film;
    settings.extent.region = band.region;
    if (settings.light_paths_of) settings.light_paths_of = band.region;
    Film film(settings);
    bool any = false;
    for (const Piece& piece : pieces_) {
      const auto [top, bottom] = common_rows(piece, band.region);
      if (top >= bottom || is_finished(piece)) continue;
      read(piece, piece.sums, top, bottom, [&](const ImageBand& rows) {
        if (!add_sums(rows, piece.sums, piece.identity.film.samples, film))
          throw InputError(piece.file + " is damaged: its sums cannot be those of its samples");
      });
      any = true;
    }
    if (any || report_.missing_parts) fill_aovs(band, 4, film);
    if (any) copy_means(film, band);
  }

  void heed_stop() const {
    if (stop_ && stop_()) throw Stopped();
  }

  const MergeSettings& settings_;
  const std::function<bool()>& stop_;
  std::vector<Piece> pieces_;
  std::vector<std::string> problems_;
  std::set<const Piece*> damaged_;  ///< their pixels
  std::vector<Channel> channels_;
  ImageMetadata metadata_;
  std::uint64_t samples_ = 0;
  double render_seconds_ = 0;
  MergeReport report_;
};

}  // namespace

MergeReport merge_pieces(const MergeSettings& settings, const std::function<bool()>& stop) {
  require_good_merge(settings);
  try {
    return Merger(settings, stop).merge();
  } catch (const Stopped&) {
    MergeReport report;
    report.stopped = true;
    return report;
  }
}

}  // namespace raytrace
