// Writes a film to an image file; the format follows from the file name's extension.
//
// .exr and .hdr (and .pfm, where OpenImageIO writes it) hold linear radiance as it is. PNG and every other format that
// OpenImageIO writes (.jpg, .tif, ...) hold it exposed, through a view transform (by default none), clamped to [0, 1]
// and encoded with the sRGB curve.
//
// EXR has alpha always, with premultiplied colour. Of a transparent picture so have PNG and TIFF: of 8 and 16 bits with
// straight colour, that of the covered part alone; TIFF of floats with premultiplied colour. All others hold it as it
// is over black.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "raytrace/cameras/camera_matrices.h"
#include "raytrace/film/film.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/view_options.h"

namespace raytrace {

struct ImageFileSettings {
  bool full_float = false;   ///< EXR: colours in 32 bit instead of half. TIFF: linear 32 bit float instead of sRGB.
  int bit_depth = 8;         ///< 8 or 16: PNG, TIFF and others that can; no matter to formats that hold linear radiance
  bool compressed = true;    ///< EXR: with zip
  int threads = 0;           ///< for compression; 0: all processors. Holds for the process, as OpenImageIO has it.
  bool transparent = false;  ///< FilmSettings::transparent: PNG and TIFF get alpha
  double exposure = 0;       ///< formats for display: the linear colour is multiplied by 2^exposure

  // Formats for display, too.
  double white_balance = 0;  ///< ViewPlane::whitebalance
  ViewTransform view_transform = ViewTransform::srgb;
  OcioSettings ocio{};                    ///< in its place
  bool dither = false;                    ///< of 8 bits: values are rounded up or down so that their mean is right
  std::optional<double> auto_exposure{};  ///< `exposure` is this, and what the picture itself asked for
};

/// Something more that a picture says about itself. EXR keeps the type, PNG stores text, and other formats nothing but
/// that a picture is partial.
struct ImageAttribute {
  std::string name;  ///< "raytrace:...", "cryptomatte/..."; at most 79 bytes, which is what PNG takes
  std::variant<std::string, int, float> value;
};

/// What a picture says about itself.
struct ImageMetadata {
  std::string software;  ///< "raytrace 1.2.3"
  std::string scene_file;
  int samples = 1;  ///< per pixel
  std::uint64_t seed = 0;
  int threads = 1;
  std::optional<double> render_seconds;  ///< absent where the file is begun before the render ends
  CameraMatrices camera;
  std::vector<ImageAttribute> attributes;
  std::vector<ImageAttribute> data_attributes;  ///< only of formats that hold linear data
};

/// Values (not pixels) that were changed because the format, or any format, cannot hold them.
struct Repairs {
  std::uint64_t clamped = 0;     ///< linear formats: beyond the largest number (half: 65504), which is stored instead
  std::uint64_t not_finite = 0;  ///< NaN, stored as 0, and infinities, stored as the largest number
  std::uint64_t negative = 0;    ///< pixels, not values: in formats without a sign, with a colour below 0, stored as 0
  Repairs& operator+=(const Repairs& other) {
    clamped += other.clamped;
    not_finite += other.not_finite;
    negative += other.negative;
    return *this;
  }
};

/// What files of a format hold.
struct ImageFormat {
  bool floats = false;       ///< linear colour in 32 bits
  bool data = false;         ///< channels besides color_channels(), and ImageMetadata::data_attributes
  bool alpha = false;        ///< that of a transparent picture
  bool for_display = false;  ///< a picture for eyes, which ImageFileSettings::exposure and its view are for

  /// Whether FilmContent::half_means is all that they want.
  bool halves() const { return data && !floats; }
};

/// Of files of this name with these settings. Throws FormatError if the extension is unknown.
ImageFormat image_format(const std::string& file, const ImageFileSettings& settings = {});

/// Throws FormatError if files of this name cannot be written for their format: no known extension, a bit depth that
/// the format lacks. To be called before the render, so that hours of work do not end in an error that was
/// there before.
void check_format(const std::string& file, const ImageFileSettings& settings);

/// Throws SizeError if files of this name cannot hold a picture of the region's size. To be called before the render,
/// too, as soon as the size is known.
void check_size(const std::string& file, const Region& region, const ImageFileSettings& settings);

class ImageEncoder;

/// An image file that is written band by band, so that no more than a band of a large picture need be in memory, and
/// appears whole or not at all (AtomicFile).
///
/// EXR: half (or float) RGBA and further channels, zip, scanlines, the film's region as data window in the full display
/// window. All others: RGB, or RGBA, of just the region.
/// Dates are UTC. Where the environment has SOURCE_DATE_EPOCH, it is the date, and what differs from one run to the
/// next (the render time, the number of threads) is left out: same picture, same bytes.
class ImageFile {
 public:
  /// Begins it under a temporary name. Throws OutputError, as all of these. channels: the first four are
  /// color_channels().
  ImageFile(const std::string& file, const PictureExtent& extent, const std::vector<Channel>& channels,
            const ImageMetadata& metadata, const ImageFileSettings& settings);
  /// In the encoder's format, whatever the file's name.
  ImageFile(const std::string& file, std::unique_ptr<ImageEncoder> encoder, const PictureExtent& extent,
            const std::vector<Channel>& channels, const ImageMetadata& metadata);
  ~ImageFile();
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;

  /// band: whole rows of the extent's region, the next below those written before.
  void write(const ImageBand& band);
  /// The same from a film, for a file of color_channels() alone.
  void write(const Film& band);

  /// After the last row: flushes it to disk and gives it its name.
  Repairs commit();

  FileIdentity identity() const { return atomic_.identity(); }

 private:
  AtomicFile atomic_;
  std::unique_ptr<ImageEncoder> encoder_;
};

/// The whole film as one ImageFile.
Repairs write_image(const std::string& file, const Film& film, const ImageMetadata& metadata,
                    const ImageFileSettings& settings);

}  // namespace raytrace
