// OpenEXR files: scanlines of any channels, each of its own type, compressed in zip blocks.
#include <ImathBox.h>
#include <ImathMatrix.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <half.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/picture_date.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {
/// Throws OutputError where it fails, as OpenEXR wants it.
class ExrDestination final : public Imf::OStream {
 public:
  explicit ExrDestination(std::FILE* file) : OStream("picture"), file_(file) {}

  void write(const char data[], int size) override {
    require(file_.write(data, static_cast<std::size_t>(size)));
    position_ += static_cast<std::uint64_t>(size);
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override {
    require(file_.seek(position));
    position_ = position;
  }
  void finish() { require(file_.flush()); }
  int error() const { return file_.error(); }

 private:
  static void require(bool done) {
    if (!done) throw OutputError("the destination failed");
  }

  CheckedFile file_;
  std::uint64_t position_ = 0;
};

Imath::M44f matrix_of(const float (&values)[16]) {
  Imath::M44f matrix;
  std::copy(std::begin(values), std::end(values), &matrix[0][0]);
  return matrix;
}

Imf::PixelType pixel_type(ChannelType type) {
  if (type == ChannelType::half) return Imf::HALF;
  return type == ChannelType::float32 ? Imf::FLOAT : Imf::UINT;
}

void insert(Imf::Header& header, const ImageAttribute& attribute) {
  const std::string& name = attribute.name;
  if (const auto* const text = std::get_if<std::string>(&attribute.value)) {
    header.insert(name, Imf::StringAttribute(*text));
  } else if (const auto* const integer = std::get_if<int>(&attribute.value)) {
    header.insert(name, Imf::IntAttribute(*integer));
  } else {
    header.insert(name, Imf::FloatAttribute(std::get<float>(attribute.value)));
  }
}

/// Of zlib's 1 to 9. Half as long as OpenEXR's 4, for files a tenth larger.
constexpr int zip_level = 2;

Imf::Header header_of(const PictureExtent& extent, const std::vector<Channel>& channels, const ImageMetadata& metadata,
                      bool compressed) {
  const Region& region = extent.region;
  Imf::Header header(Imath::Box2i({0, 0}, {extent.full_width - 1, extent.full_height - 1}),
                     Imath::Box2i({region.x0, region.y0}, {region.x1 - 1, region.y1 - 1}));
  header.compression() = compressed ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
  header.zipCompressionLevel() = zip_level;
  for (const Channel& channel : channels)
    header.channels().insert(channel.name, Imf::Channel(pixel_type(channel.type)));

  const PictureDate date = picture_date();
  Imf::addCapDate(header, date.text);
  Imf::addUtcOffset(header, 0.0F);
  Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709 is the default
  header.insert("worldToCamera", Imf::M44fAttribute(matrix_of(metadata.camera.world_to_camera)));
  if (metadata.camera.is_projection)
    header.insert("worldToNDC", Imf::M44fAttribute(matrix_of(metadata.camera.world_to_ndc)));
  if (!metadata.software.empty()) header.insert("Software", Imf::StringAttribute(metadata.software));
  header.insert("raytrace:scene", Imf::StringAttribute(metadata.scene_file));
  header.insert("raytrace:samples", Imf::IntAttribute(metadata.samples));
  header.insert("raytrace:seed", Imf::StringAttribute(std::to_string(metadata.seed)));  // EXR's integers have 32 bit
  if (!date.fixed) {
    header.insert("raytrace:threads", Imf::IntAttribute(metadata.threads));
    if (metadata.render_seconds)
      header.insert("raytrace:renderSeconds", Imf::FloatAttribute(static_cast<float>(*metadata.render_seconds)));
  }
  for (const ImageAttribute& attribute : metadata.attributes) insert(header, attribute);
  for (const ImageAttribute& attribute : metadata.data_attributes) insert(header, attribute);
  return header;
}

template <class Value>
constexpr float largest = std::numeric_limits<float>::max();
template <>
constexpr float largest<Imath::half> = 65504;

template <class Value>
Value storable(float value, Repairs& repairs) {
  if (std::abs(value) <= largest<Value>) return Value(value);  // false for NaN
  ++(std::isfinite(value) ? repairs.clamped : repairs.not_finite);
  return Value(std::isnan(value) ? 0.0F : std::copysign(largest<Value>, value));
}

/// A row of a plane of so many values, to the same row of what is stored.
template <class Value>
void convert_row(const ChannelValues& plane, std::size_t row, std::size_t width, std::vector<std::byte>& stored,
                 Repairs& repairs) {
  const float* const values = std::get<std::vector<float>>(plane).data() + row * width;
  auto* const converted = reinterpret_cast<Value*>(stored.data()) + row * width;
  for (std::size_t i = 0; i < width; ++i) converted[i] = storable<Value>(values[i], repairs);
}

std::size_t value_bytes(Imf::PixelType type) { return type == Imf::HALF ? sizeof(Imath::half) : sizeof(float); }

/// Values where OpenEXR finds them: row by row within the window, with so many from one of a channel to its next.
Imf::Slice slice(Imf::PixelType type, const void* values, const Imath::Box2i& window, std::size_t step = 1) {
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  return Imf::Slice::Make(type, values, window, step * value_bytes(type), width * step * value_bytes(type));
}

/// OpenEXR's pool is one for the whole process, and must not change while a file is written: the first to ask decides.
void make_thread_pool(int threads) {
  static const bool made = [threads] {
    Imf::setGlobalThreadCount(threads == 1 ? 0 : threads);
    return true;
  }();
  static_cast<void>(made);
}

struct OpenExr {
  OpenExr(std::FILE* file, const std::vector<Channel>& its_channels)
      : destination(file), channels(its_channels), stored(channels.size()) {}

  ExrDestination destination;
  std::optional<Imf::OutputFile> exr;
  std::vector<Channel> channels;
  std::vector<std::vector<std::byte>> stored;  ///< halves or floats of each channel; kept from band to band
  std::vector<Imath::half> half_colors;
};

class ExrEncoder final : public ImageEncoder {
 public:
  ExrEncoder(const std::string& file, const ImageFileSettings& settings) : ImageEncoder(file, settings) {
    if (settings_.threads <= 0) settings_.threads = tbb::this_task_arena::max_concurrency();
  }

  ImageFormat format() const override {
    return {.floats = settings_.full_float, .data = true, .alpha = true, .for_display = false};
  }

  void begin(const PictureExtent& extent, const std::vector<Channel>& channels, const ImageMetadata& metadata,
             std::FILE* destination) override {
    // OpenEXR compresses this many rows together, so that threads have work for no more of them.
    constexpr int block_rows = 16;
    const int threads = std::min(settings_.threads, (extent.region.height() + block_rows - 1) / block_rows);
    // 0: the calling thread does it. A few rows are not worth threads, in which OpenEXR does not survive that it is out
    // of memory: so the trial of a format is without them.
    constexpr std::size_t few_pixels = std::size_t{64} * 64;
    const int helpers = threads == 1 || extent.region.pixels() <= few_pixels ? 0 : threads;
    if (helpers > 0) make_thread_pool(settings_.threads);
    const Imf::Header header = header_of(extent, channels, metadata, settings_.compressed);
    open_ = std::make_unique<OpenExr>(destination, channels);
    guard([&] { open_->exr.emplace(open_->destination, header, helpers); });
  }

  void write(const ImageBand& band) override {
    const Region& region = band.region;
    const Imath::Box2i window({region.x0, region.y0}, {region.x1 - 1, region.y1 - 1});
    Imf::FrameBuffer frame;
    std::size_t first_plane = 0;
    if (band.half_colors != nullptr) {
      const Imath::half* const colors = storable_colors(band);
      for (; first_plane < ImageBand::colors; ++first_plane)
        frame.insert(open_->channels[first_plane].name,
                     slice(Imf::HALF, colors + first_plane, window, ImageBand::colors));
    }
    convert_values(band, first_plane);
    for (std::size_t i = first_plane; i < open_->channels.size(); ++i) {
      const Channel& channel = open_->channels[i];
      const auto* const integers = std::get_if<std::vector<std::uint32_t>>(&band.planes[i]);
      const void* const values =
          integers != nullptr ? static_cast<const void*>(integers->data()) : open_->stored[i].data();
      frame.insert(channel.name, slice(pixel_type(channel.type), values, window));
    }
    guard([&] {
      open_->exr->setFrameBuffer(frame);
      open_->exr->writePixels(region.height());
    });
  }

  Repairs finish() override {
    guard([&] {
      open_->exr.reset();  // writes the table of where rows begin, and reports no failure
      open_->destination.finish();
    });
    return repairs_;
  }

 private:
  /// Of the planes from first_plane on, to what the file stores.
  void convert_values(const ImageBand& band, std::size_t first_plane) {
    if (first_plane == open_->channels.size()) return;
    const auto width = static_cast<std::size_t>(band.region.width());
    const auto rows = static_cast<std::size_t>(band.region.height());
    for (std::size_t i = first_plane; i < open_->channels.size(); ++i)
      if (open_->channels[i].type != ChannelType::uint32)
        open_->stored[i].resize(width * rows * value_bytes(pixel_type(open_->channels[i].type)));
    std::vector<Repairs> repairs(rows);
    for_each_index(band.region.height(), settings_.threads, [&](int index) {
      const auto row = static_cast<std::size_t>(index);
      for (std::size_t i = first_plane; i < open_->channels.size(); ++i) {
        const ChannelType type = open_->channels[i].type;
        if (type == ChannelType::half)
          convert_row<Imath::half>(band.planes[i], row, width, open_->stored[i], repairs[row]);
        if (type == ChannelType::float32)
          convert_row<float>(band.planes[i], row, width, open_->stored[i], repairs[row]);
      }
    });
    for (const Repairs& of_row : repairs) repairs_ += of_row;
  }

  /// Of a band's half_colors: themselves, but for infinities.
  const Imath::half* storable_colors(const ImageBand& band) {
    const auto* const colors = reinterpret_cast<const Imath::half*>(band.half_colors);
    const std::size_t row_values = ImageBand::colors * static_cast<std::size_t>(band.region.width());
    const auto rows = static_cast<std::size_t>(band.region.height());
    std::vector<std::size_t> infinite(rows);
    for_each_index(band.region.height(), settings_.threads, [&](int index) {
      const auto row = static_cast<std::size_t>(index);
      // By their bits, which the compiler makes a loop of wide instructions.
      const std::uint16_t* const bits = band.half_colors + row * row_values;
      std::uint32_t count = 0;
      for (std::size_t i = 0; i < row_values; ++i) count += (bits[i] & 0x7fffU) >= 0x7c00U ? 1U : 0U;
      infinite[row] = count;
    });
    if (std::all_of(infinite.begin(), infinite.end(), [](std::size_t count) { return count == 0; })) return colors;
    std::vector<Imath::half>& stored = open_->half_colors;
    stored.assign(colors, colors + rows * row_values);
    for (Imath::half& value : stored)
      if (!value.isFinite()) value = storable<Imath::half>(std::copysign(2 * largest<Imath::half>, value), repairs_);
    return stored.data();
  }

  /// Runs it, and throws an OutputError with the true reason for whatever it throws, or std::bad_alloc where that is
  /// it.
  template <class Action>
  void guard(const Action& action) const {
    try {
      action();
    } catch (const std::exception& exception) {
      const int error = open_->destination.error();
      if (error == 0) rethrow_out_of_memory(exception);
      if (error != 0) fail(error);
      fail(exception.what());
    }
  }

  std::unique_ptr<OpenExr> open_;
};

}  // namespace

std::unique_ptr<ImageEncoder> make_exr_encoder(const std::string& file, const ImageFileSettings& settings) {
  return std::make_unique<ExrEncoder>(file, settings);
}

}  // namespace raytrace
