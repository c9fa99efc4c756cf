#include "raytrace/output/openimageio/openimageio_encoder.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <new>
#include <system_error>
#include <vector>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/openimageio/edge_limits.h"
#include "raytrace/output/openimageio/metadata.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/text/nearest_name.h"
#include "raytrace/text/quoted.h"

namespace raytrace {

namespace {

using Names = std::vector<std::string>;

std::unique_ptr<OIIO::ImageOutput> create_writer(const std::string& extension) {
  auto writer = OIIO::ImageOutput::create("picture" + extension);
  OIIO::geterror();  // told better by the caller
  if (!writer) return writer;
  // Two of OpenImageIO's writers make no file: a text terminal and a bin. EXR and PNG files are written elsewhere.
  const std::string_view format = writer->format_name();
  if (format == "term" || format == "null" || format == "openexr" || format == "png") return {};
  return writer;
}

/// "; did you mean '.exr'?", if an extension that can be written is like the wrong one.
std::string suggestion(const std::string& wrong) {
  Names candidates = {".exr", ".png", ".jpg", ".tif", ".hdr"};  // the first of equals wins
  for (const auto& [format, extensions] : OIIO::get_extension_map()) {
    for (const std::string& extension : extensions) {
      if (create_writer("." + extension)) candidates.push_back("." + extension);
    }
  }
  const std::vector<std::string_view> views(candidates.begin(), candidates.end());
  const std::string_view nearest = nearest_name(wrong, views);
  return nearest.empty() ? "; .exr and .png are usual" : "; did you mean " + in_quotes(nearest) + "?";
}

bool is_known(const std::string& extension) {
  const auto known = OIIO::get_extension_map();
  return std::any_of(known.begin(), known.end(), [&](const auto& format) {
    const auto& names = format.second;
    return std::find(names.begin(), names.end(), extension.substr(1)) != names.end();
  });
}

/// 0, or an error number.
int copy(std::FILE* from, std::FILE* to) {
  if (std::fseek(from, 0, SEEK_SET) != 0) return errno;
  std::array<char, 65536> buffer;
  std::size_t size = buffer.size();
  while (size == buffer.size()) {
    size = std::fread(buffer.data(), 1, buffer.size(), from);
    if (std::ferror(from) != 0) return EIO;
    if (std::fwrite(buffer.data(), 1, size, to) != size) return errno;
  }
  return std::fflush(to) == 0 ? 0 : errno;
}

}  // namespace

/// A file that remembers why a write failed and pretends to go on: some of OpenImageIO's writers do not tell of a
/// failure, and the JPEG writer ends the process.
class OpenImageIOEncoder::CheckedFile final : public OIIO::Filesystem::IOFile {
 public:
  explicit CheckedFile(std::FILE* file) : IOFile(file, Write) {}

  const char* proxytype() const override { return "checked"; }  // were it "file", libjpeg would write past us

  std::size_t write(const void* data, std::size_t size) override {
    if (error_ == 0) {
      errno = 0;
      if (IOFile::write(data, size) == size) return size;
      note_failure();
    }
    m_pos += static_cast<std::int64_t>(size);
    return size;
  }

  bool seek(std::int64_t offset) override {
    if (error_ == 0) {
      errno = 0;
      if (IOFile::seek(offset)) return true;
      note_failure();
    }
    m_pos = offset;
    return true;
  }

  /// Empties the buffer; 0, or the error number of the first failure.
  int finish() {
    errno = 0;
    if (error_ == 0 && (std::fflush(handle()) != 0 || std::ferror(handle()) != 0)) note_failure();
    return error_;
  }

 private:
  void note_failure() { error_ = errno != 0 ? errno : EIO; }

  int error_ = 0;
};

OpenImageIOEncoder::OpenImageIOEncoder(std::string file, const std::string& extension,
                                       const ImageFileSettings& settings)
    : file_(std::move(file)), extension_(extension), settings_(settings), writer_(create_writer(extension)) {
  if (!writer_) {
    fail((is_known(extension) ? in_quotes(extension) + " is a format that can be read but not written"
                              : "no picture format has the extension " + in_quotes(extension)) +
         suggestion(extension));
  }
  choose_pixels(extension);
  // A pool of the whole process; where it cannot be started, the process crashes at its end. TIFF alone has work for
  // it.
  constexpr int most_threads = 8;
  OIIO::attribute("threads", std::min(settings.threads, most_threads));
}

OpenImageIOEncoder::~OpenImageIOEncoder() = default;

void OpenImageIOEncoder::choose_pixels(const std::string& extension) {
  constexpr float largest_float = std::numeric_limits<float>::max();
  constexpr float largest_rgbe = 1.6e38F;  // 255/256 x 2^127, with room for its rounding
  type_ = OIIO::TypeFloat;
  if (writer_->format_name() == std::string_view("hdr")) {
    pixels_ = {false, false, 0, largest_rgbe};
  } else if (extension == ".pfm" || (is_tiff() && settings_.full_float)) {
    pixels_ = {is_tiff() && settings_.transparent, false, -largest_float, largest_float};
  } else {
    type_ = settings_.bit_depth == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8;
    pixels_ = display_format(settings_);
    pixels_.alpha = is_tiff() && settings_.transparent;
  }
}

void OpenImageIOEncoder::check_size(int width, int height) const {
  const auto [least, most] = edge_limits(writer_->format_name());
  if (std::min(width, height) >= least && std::max(width, height) <= most) return;
  const bool too_large = std::max(width, height) > most;
  throw SizeError("cannot write " + file_ + ": a " + in_quotes(extension_) + " file has edges of at " +
                  (too_large ? "most " + std::to_string(most) : "least " + std::to_string(least)) + " pixels, not " +
                  std::to_string(width) + " x " + std::to_string(height) + "; .exr and .png have room for it");
}

void OpenImageIOEncoder::begin(const PictureExtent& extent, const std::vector<Channel>& /*only the first are stored*/,
                               const ImageMetadata& metadata, std::FILE* destination) {
  check_size(extent.region.width(), extent.region.height());
  extent_ = extent;
  destination_ = destination;
  std::string name = file_;
  // OpenImageIO 2.4's TIFF writer leaves a file without a directory when it goes through a proxy.
  if (writer_->supports("ioproxy") && writer_->format_name() != std::string("tiff")) {
    checked_ = std::make_unique<CheckedFile>(destination);
    writer_->set_ioproxy(checked_.get());
  } else {
    // By name, a writer may overlook a full disk. It writes to memory, and copying that is checked.
    memory_ = open_memory_file();
    name = "/proc/self/fd/" + std::to_string(fileno(memory_.get()));
  }
  const OIIO::ImageSpec spec = image_spec(metadata);
  guard([&] {
    check(writer_->open(name, spec));
    if (writer_->spec().format.size() < type_.size()) {
      fail("this format holds " + std::to_string(8 * writer_->spec().format.size()) + " bits a channel, not " +
           std::to_string(8 * type_.size()));
    }
  });
}

OIIO::ImageSpec OpenImageIOEncoder::image_spec(const ImageMetadata& metadata) const {
  OIIO::ImageSpec spec(extent_.region.width(), extent_.region.height(), pixels_.channels(), type_);
  if (pixels_.srgb) {
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (pixels_.alpha) spec.attribute("oiio:UnassociatedAlpha", 1);  // else it tells that the colour is premultiplied
  } else if (is_tiff()) {
    constexpr int uncalibrated = 0xFFFF;
    spec.attribute("Exif:ColorSpace", uncalibrated);  // OpenImageIO 2.4 reports an error where there is no Exif at all
  }
  add_metadata(spec, metadata, pixels_.srgb ? settings_.exposure : 0);
  return spec;
}

void OpenImageIOEncoder::write(const ImageBand& band) {
  const auto row_values = static_cast<std::size_t>(pixels_.channels()) * static_cast<std::size_t>(band.region.width());
  std::vector<float> values(row_values * static_cast<std::size_t>(band.region.height()));
  for (int row = 0; row < band.region.height(); ++row)
    repairs_ += stored_row(band, row, pixels_, values.data() + static_cast<std::size_t>(row) * row_values);
  const int y0 = band.region.y0 - extent_.region.y0, y1 = band.region.y1 - extent_.region.y0;
  guard([&] { check(writer_->write_scanlines(y0, y1, 0, OIIO::TypeFloat, values.data())); });
}

Repairs OpenImageIOEncoder::finish() {
  guard([&] { check(writer_->close()); });
  writer_.reset();  // before the file that it writes to
  const int error = checked_ ? checked_->finish() : copy(memory_.get(), destination_);
  if (error != 0) fail(std::generic_category().message(error));
  return repairs_;
}

template <class Action>
void OpenImageIOEncoder::guard(const Action& action) {
  try {
    action();
  } catch (const OutputError&) {
    const int error = checked_ ? checked_->finish() : 0;
    writer_.reset();
    if (error != 0) fail(std::generic_category().message(error));
    throw;
  }
}

void OpenImageIOEncoder::check(bool done) const {
  if (done && !writer_->has_error()) return;
  std::string reason = writer_->geterror();
  if (says_out_of_memory(reason)) throw std::bad_alloc();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  fail(reason.empty() ? "OpenImageIO's writer failed" : reason);
}

void OpenImageIOEncoder::fail(const std::string& reason) const {
  throw OutputError("cannot write " + file_ + ": " + reason);
}

ImageEncoder* raytrace_make_openimageio_encoder(const std::string& file, const std::string& extension,
                                                const ImageFileSettings& settings) {
  return new OpenImageIOEncoder(file, extension, settings);
}

}  // namespace raytrace
