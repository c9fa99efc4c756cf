// PNG files: RGB or RGBA of 8 or 16 bits, compressed row by row as bands come.
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <sstream>

#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/output/picture_date.h"
#include "raytrace/output/pixel_format.h"
#include "raytrace/output/png_errors.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/utf8.h"

namespace raytrace {
namespace {
/// The nearest whole number, halves upwards: what std::round() gives, but no call of a function.
unsigned nearest(float value) {
  const auto floor = static_cast<unsigned>(value);
  return floor + (value - static_cast<float>(floor) >= 0.5F ? 1 : 0);
}

/// Values in [0, 1]; most significant byte first.
void quantize(const std::vector<float>& values, int bit_depth, std::uint8_t* bytes) {
  if (bit_depth == 8) {
    for (const float value : values) *bytes++ = static_cast<std::uint8_t>(nearest(value * 255.0F));
    return;
  }
  for (const float value : values) {
    const unsigned number = nearest(value * 65535.0F);
    *bytes++ = static_cast<std::uint8_t>(number >> 8U);
    *bytes++ = static_cast<std::uint8_t>(number & 0xFFU);
  }
}

struct PngText {
  std::string keyword, text;
};

std::string matrix_text(const float (&matrix)[16]) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);  // every float survives
  for (int i = 0; i < 16; ++i) text << (i == 0 ? "" : " ") << matrix[i];
  return text.str();
}

template <class Value>
std::string attribute_text(const Value& value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

/// All as text, for PNG has no numbers.
std::vector<PngText> png_texts(const ImageMetadata& metadata, const ImageFileSettings& settings) {
  std::vector<PngText> all;
  if (!metadata.software.empty()) all.push_back({"Software", metadata.software});
  all.push_back({"worldToCamera", matrix_text(metadata.camera.world_to_camera)});
  if (metadata.camera.is_projection) all.push_back({"worldToNDC", matrix_text(metadata.camera.world_to_ndc)});
  all.push_back({"raytrace:scene", metadata.scene_file});
  all.push_back({"raytrace:samples", std::to_string(metadata.samples)});
  all.push_back({"raytrace:seed", std::to_string(metadata.seed)});
  if (!picture_date().fixed) {
    all.push_back({"raytrace:threads", std::to_string(metadata.threads)});
    if (metadata.render_seconds) all.push_back({"raytrace:renderSeconds", attribute_text(*metadata.render_seconds)});
  }
  for (const auto& attributes : {view_attributes(settings), metadata.attributes})
    for (const ImageAttribute& attribute : attributes)
      all.push_back(
          {attribute.name, std::visit([](const auto& value) { return attribute_text(value); }, attribute.value)});
  return all;
}

/// tEXt holds Latin-1, of which ASCII is a part; iTXt holds UTF-8.
int text_format(const std::string& text) {
  const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  return ascii || find_invalid_utf8(text, 1) != std::string_view::npos ? PNG_TEXT_COMPRESSION_NONE
                                                                       : PNG_ITXT_COMPRESSION_NONE;
}

/// What libpng writes.
struct OpenPng {
  explicit OpenPng(std::FILE* file)
      : destination(file),
        png(png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &errors, PngErrors::note_error, PngErrors::ignore_warning,
                                      &errors, PngErrors::allocate, PngErrors::release)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {
    if (info == nullptr) {
      png_destroy_write_struct(&png, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png, this, write_bytes, flush_nothing);
  }
  ~OpenPng() { png_destroy_write_struct(&png, &info); }
  OpenPng(const OpenPng&) = delete;
  OpenPng& operator=(const OpenPng&) = delete;

  static void write_bytes(png_structp png, png_bytep data, std::size_t size) {
    auto* const file = static_cast<OpenPng*>(png_get_io_ptr(png));
    if (!file->destination.write(data, size)) png_error(png, "the destination failed");
  }
  static void flush_nothing(png_structp) {}

  CheckedFile destination;
  PngErrors errors;
  png_structp png;
  png_infop info;
};

class PngEncoder final : public ImageEncoder {
 public:
  PngEncoder(const std::string& file, const ImageFileSettings& settings)
      : ImageEncoder(file, settings), pixels_(display_format(settings)) {
    pixels_.ocio = ocio_transform(settings.ocio);
  }

  ImageFormat format() const override { return {.floats = false, .data = false, .alpha = true, .for_display = true}; }

  void begin(const PictureExtent& extent, const std::vector<Channel>& /*only the first are stored*/,
             const ImageMetadata& metadata, std::FILE* destination) override {
    std::vector<PngText> texts = png_texts(metadata, settings_);
    std::vector<png_text_struct> chunks(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      chunks[i].compression = text_format(texts[i].text);
      chunks[i].key = texts[i].keyword.data();
      chunks[i].text = texts[i].text.data();
      chunks[i].text_length = texts[i].text.size();
    }
    const std::tm utc = picture_date().utc;
    const auto width = static_cast<png_uint_32>(extent.region.width());
    const auto height = static_cast<png_uint_32>(extent.region.height());
    const int color = pixels_.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
    const bool is_srgb = !pixels_.ocio;  // of which only its configuration knows
    open_ = std::make_unique<OpenPng>(destination);
    const png_structp png = open_->png;
    const png_infop info = open_->info;
    guard([&] {
      png_set_IHDR(png, info, width, height, settings_.bit_depth, color, PNG_INTERLACE_NONE,
                   PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      if (is_srgb) png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
      png_time time;
      png_convert_from_struct_tm(&time, &utc);
      png_set_tIME(png, info, &time);
      png_set_text(png, info, chunks.data(), static_cast<int>(chunks.size()));
      // Differences to the left neighbour. Those of 8 bits repeat in runs, or not at all: docs/design.md, Output.
      png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
      png_set_compression_level(png, Z_BEST_SPEED);
      if (settings_.bit_depth == 8) png_set_compression_strategy(png, Z_RLE);
      png_set_compression_buffer_size(png, 65536);
      png_write_info(png, info);
    });
  }

  void write(const ImageBand& band) override {
    const auto row_values =
        static_cast<std::size_t>(pixels_.channels()) * static_cast<std::size_t>(band.region.width());
    const std::size_t row_bytes = row_values * static_cast<std::size_t>(settings_.bit_depth / 8);
    const auto rows = static_cast<std::size_t>(band.region.height());
    bytes_.resize(rows * row_bytes);
    std::vector<Repairs> repairs(rows);
    for_each_index(band.region.height(), settings_.threads, [&](int index) {
      const auto row = static_cast<std::size_t>(index);
      std::vector<float> values(row_values);
      repairs[row] = stored_row(band, index, pixels_, values.data());
      quantize(values, settings_.bit_depth, bytes_.data() + row * row_bytes);
    });
    for (const Repairs& of_row : repairs) repairs_ += of_row;
    guard([&] {
      for (std::size_t row = 0; row < rows; ++row) png_write_row(open_->png, bytes_.data() + row * row_bytes);
    });
  }

  Repairs finish() override {
    guard([&] { png_write_end(open_->png, nullptr); });
    if (!open_->destination.flush()) fail(open_->destination.error());
    return repairs_;
  }

 private:
  /// run_png_calls(). Throws an OutputError with the true reason of a failure, or std::bad_alloc.
  template <class Calls>
  void guard(const Calls& calls) {
    if (run_png_calls(open_->png, calls)) return;
    if (open_->destination.error() != 0) fail(open_->destination.error());
    if (open_->errors.out_of_memory) throw std::bad_alloc();
    fail(open_->errors.message);
  }

  PixelFormat pixels_;
  std::vector<std::uint8_t> bytes_;  ///< of a band; kept from band to band
  std::unique_ptr<OpenPng> open_;
};

}  // namespace

std::unique_ptr<ImageEncoder> make_png_encoder(const std::string& file, const ImageFileSettings& settings) {
  return std::make_unique<PngEncoder>(file, settings);
}

}  // namespace raytrace
