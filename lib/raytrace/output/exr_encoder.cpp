#include "raytrace/output/exr_encoder.h"

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
#include <cerrno>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>

#include "raytrace/output/picture_date.h"

namespace raytrace {

namespace {

/// A stream that remembers why a write failed, since OpenEXR tells only that it did.
class Destination final : public Imf::OStream {
 public:
  explicit Destination(std::FILE* file) : OStream("picture"), file_(file) {}

  void write(const char data[], int size) override {
    errno = 0;
    if (std::fwrite(data, 1, static_cast<std::size_t>(size), file_) != static_cast<std::size_t>(size)) fail();
    position_ += static_cast<std::uint64_t>(size);
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override {
    errno = 0;
    if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail();
    position_ = position;
  }

  /// Empties the file's buffer. Throws if that or any write before failed.
  void finish() {
    errno = 0;
    if (error_ != 0 || std::fflush(file_) != 0) fail();
  }

  /// 0, or the error number of the first failure.
  int error() const { return error_; }

 private:
  [[noreturn]] void fail() {
    if (error_ == 0) error_ = errno != 0 ? errno : EIO;
    throw OutputError("the destination failed");
  }

  std::FILE* file_;
  std::uint64_t position_ = 0;
  int error_ = 0;
};

Imath::M44f matrix_of(const float (&values)[16]) {
  Imath::M44f matrix;
  std::copy(std::begin(values), std::end(values), &matrix[0][0]);
  return matrix;
}

Imf::Header header_of(const PictureExtent& extent, const ImageMetadata& metadata, bool full_float) {
  const Region& region = extent.region;
  Imf::Header header(Imath::Box2i({0, 0}, {extent.full_width - 1, extent.full_height - 1}),
                     Imath::Box2i({region.x0, region.y0}, {region.x1 - 1, region.y1 - 1}));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const char* channel : {"R", "G", "B", "A"})
    header.channels().insert(channel, Imf::Channel(full_float ? Imf::FLOAT : Imf::HALF));

  const PictureDate date = picture_date();
  Imf::addCapDate(header, date.text);
  Imf::addUtcOffset(header, 0.0F);
  Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709 is the default
  header.insert("worldToCamera", Imf::M44fAttribute(matrix_of(metadata.camera.world_to_camera)));
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
  return header;
}

template <class Value>
constexpr float largest = std::numeric_limits<float>::max();
template <>
constexpr float largest<Imath::half> = 65504;

template <class Value>
Value storable(float radiance, Repairs& repairs) {
  if (std::abs(radiance) <= largest<Value>) return Value(radiance);  // false for NaN
  ++(std::isfinite(radiance) ? repairs.clamped : repairs.not_finite);
  return Value(std::isnan(radiance) ? 0.0F : std::copysign(largest<Value>, radiance));
}

/// OpenEXR's pool is one for the whole process, and must not change while a file is written: the first to ask decides.
void make_thread_pool(int threads) {
  static const bool made = [threads] {
    Imf::setGlobalThreadCount(threads == 1 ? 0 : threads);
    return true;
  }();
  static_cast<void>(made);
}

}  // namespace

struct ExrEncoder::OpenFile {
  explicit OpenFile(std::FILE* file) : destination(file) {}

  Destination destination;
  std::optional<Imf::OutputFile> exr;
  std::vector<Imath::half> halves;
  std::vector<float> floats;
};

ExrEncoder::ExrEncoder(std::string file, const ImageFileSettings& settings)
    : file_(std::move(file)), settings_(settings) {
  if (settings_.threads <= 0) settings_.threads = tbb::this_task_arena::max_concurrency();
}

ExrEncoder::~ExrEncoder() = default;

void ExrEncoder::begin(const PictureExtent& extent, const ImageMetadata& metadata, std::FILE* destination) {
  // OpenEXR compresses this many rows together, so that threads have work for no more of them.
  constexpr int block_rows = 16;
  const int threads = std::min(settings_.threads, (extent.region.height() + block_rows - 1) / block_rows);
  const int helpers = threads == 1 ? 0 : threads;  // 0: the calling thread does it
  make_thread_pool(settings_.threads);
  const Imf::Header header = header_of(extent, metadata, settings_.full_float);
  open_ = std::make_unique<OpenFile>(destination);
  guard([&] { open_->exr.emplace(open_->destination, header, helpers); });
}

void ExrEncoder::write(const Film& band) {
  if (settings_.full_float) {
    write_rows(band, open_->floats);
  } else {
    write_rows(band, open_->halves);
  }
}

template <class Value>
void ExrEncoder::write_rows(const Film& band, std::vector<Value>& values) {
  // A few rows at a time, so that no second copy of the picture is needed.
  constexpr std::size_t most_values = 4U << 20U;
  constexpr std::size_t channels = 4;
  const Region& region = band.region();
  const auto width = static_cast<std::size_t>(region.width());
  const int most_rows = static_cast<int>(std::max<std::size_t>(1, most_values / (channels * width * 16)) * 16);
  values.resize(channels * width * static_cast<std::size_t>(std::min(most_rows, region.height())));

  for (int y0 = region.y0; y0 < region.y1; y0 += most_rows) {
    const int y1 = std::min(y0 + most_rows, region.y1);
    Value* value = values.data();
    for (int y = y0; y < y1; ++y) {
      for (int x = region.x0; x < region.x1; ++x) {
        const Pixel& pixel = band.at(x, y);
        for (const float channel : {pixel.red, pixel.green, pixel.blue, pixel.alpha})
          *value++ = storable<Value>(channel, repairs_);
      }
    }

    const Imath::Box2i window({region.x0, y0}, {region.x1 - 1, y1 - 1});
    Imf::FrameBuffer frame;
    const Value* first = values.data();
    for (const char* channel : {"R", "G", "B", "A"}) {
      frame.insert(channel, Imf::Slice::Make(settings_.full_float ? Imf::FLOAT : Imf::HALF, first++, window,
                                             channels * sizeof(Value), channels * width * sizeof(Value)));
    }
    guard([&] {
      open_->exr->setFrameBuffer(frame);
      open_->exr->writePixels(y1 - y0);
    });
  }
}

Repairs ExrEncoder::finish() {
  guard([&] {
    open_->exr.reset();  // writes the table of where rows begin, and tells of no failure
    open_->destination.finish();
  });
  return repairs_;
}

template <class Action>
void ExrEncoder::guard(const Action& action) const {
  try {
    action();
  } catch (const std::exception& exception) {
    const int error = open_->destination.error();
    throw OutputError("cannot write " + file_ + ": " +
                      (error != 0 ? std::generic_category().message(error) : std::string(exception.what())));
  }
}

}  // namespace raytrace
