// The formats that OpenImageIO writes, but for EXR and PNG, and whether files of them are whole.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <sstream>
#include <vector>

#include "raytrace/film/region.h"
#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/output/picture_date.h"
#include "raytrace/output/pixel_format.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {
using Names = std::vector<std::string>;

std::unique_ptr<OIIO::ImageOutput> create_writer(const std::string& extension) {
  auto writer = OIIO::ImageOutput::create("picture" + extension);
  OIIO::geterror();  // the caller's message is better
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

/// How large and how small pictures of a format can be: each edge, in pixels.
struct EdgeLimits {
  int least, most;
};

/// What OpenImageIO's writers take, and its readers give back, in all versions from 2.4 on. Not all of them say so
/// themselves: libjpeg ends the process, and a GIF gets the width modulo 65536. oiio_name: "jpeg", "targa".
EdgeLimits edge_limits(const std::string& oiio_name) {
  constexpr int unlimited = std::numeric_limits<int>::max();
  constexpr int sixteen_bits = 65535;
  static const std::map<std::string, EdgeLimits> limits = {
      {"bmp", {1, sixteen_bits}},                        // OpenImageIO's own limit from 2.5 on, as for pnm
      {"gif", {1, sixteen_bits}}, {"heif", {1, 32768}},  // beyond it libheif reads nothing
      {"ico", {1, 256}},          {"iff", {1, 8192}},
      {"jpeg", {1, 65500}},       {"jpeg2000", {32, unlimited}},  // five times halved, it still has a pixel
      {"pnm", {1, sixteen_bits}}, {"rla", {1, sixteen_bits}},
      {"sgi", {1, sixteen_bits}}, {"targa", {1, sixteen_bits}},
      {"webp", {1, 16383}},
  };
  const auto found = limits.find(oiio_name);
  return found == limits.end() ? EdgeLimits{1, unlimited} : found->second;
}

/// ", view transform agx, exposure -1.5"; empty where all is the default.
std::string view_text(const ImageFileSettings& settings) {
  std::string text;
  for (const ImageAttribute& attribute : view_attributes(settings)) {
    const std::string& value = std::get<std::string>(attribute.value);
    if (attribute.name == view_transform_keyword) text += ", view transform " + value;
    if (attribute.name == ocio_keyword) text += ", OpenColorIO " + value;
    if (attribute.name == exposure_keyword) text += ", exposure " + value;
    if (attribute.name == white_balance_keyword) text += ", white balance " + value + " K";
  }
  return text;
}

/// Adds the metadata as standard attributes, which are all that these formats keep: one line of description holds most
/// of it. view: view_text() of a picture for display. Throws OutputError if SOURCE_DATE_EPOCH is not a time.
void add_metadata(OIIO::ImageSpec& spec, const ImageMetadata& metadata, const std::string& view) {
  spec.attribute("DateTime", picture_date().text);
  if (!metadata.software.empty()) spec.attribute("Software", metadata.software);  // JPEG's IPTC aborts on empty text
  std::ostringstream description;
  description.imbue(std::locale::classic());
  description << "scene " << metadata.scene_file << ", " << metadata.samples << " samples per pixel, seed "
              << metadata.seed << view;
  for (const ImageAttribute& attribute : metadata.attributes)
    if (attribute.name == "raytrace:partial") description << ", partial";
  spec.attribute("ImageDescription", description.str());
}

/// 0, or an error number.
int copy(std::FILE* from, CheckedFile& to) {
  if (std::fseek(from, 0, SEEK_SET) != 0) return errno;
  std::array<char, 65536> buffer;
  std::size_t size = buffer.size();
  while (size == buffer.size()) {
    size = std::fread(buffer.data(), 1, buffer.size(), from);
    if (std::ferror(from) != 0) return EIO;
    if (!to.write(buffer.data(), size)) break;
  }
  to.flush();
  return to.error();
}

/// Pretends to go on after a failure, which the file remembers: some of OpenImageIO's writers do not report one, and
/// the JPEG writer ends the process.
class Proxy final : public OIIO::Filesystem::IOFile {
 public:
  explicit Proxy(std::FILE* file) : IOFile(file, Write), file_(file) {}

  const char* proxytype() const override { return "checked"; }  // were it "file", libjpeg would write past us

  std::size_t write(const void* data, std::size_t size) override {
    file_.write(data, size);
    m_pos += static_cast<std::int64_t>(size);
    m_size = std::max(m_size, static_cast<std::size_t>(m_pos));
    return size;
  }

  bool seek(std::int64_t offset) override {
    file_.seek(static_cast<std::uint64_t>(offset));
    m_pos = offset;
    return true;
  }

  /// Empties the buffer; 0, or the error number of the first failure.
  int finish() {
    file_.flush();
    return file_.error();
  }

 private:
  CheckedFile file_;
};

class OpenImageIOEncoder final : public ImageEncoder {
 public:
  /// extension: in lower case, with its dot. Throws OutputError.
  OpenImageIOEncoder(const std::string& file, const std::string& extension, const ImageFileSettings& settings)
      : ImageEncoder(file, settings), extension_(extension), writer_(create_writer(extension)) {
    if (!writer_) {
      throw FormatError("cannot write " + file + ": " +
                        (is_known(extension) ? in_quotes(extension) + " is a format that can be read but not written"
                                             : "no picture format has the extension " + in_quotes(extension)) +
                        suggestion(extension));
    }
    choose_pixels(extension);
    // A pool of the whole process; where it cannot be started, the process crashes at its end. TIFF alone has work for
    // it.
    constexpr int most_threads = 8;
    OIIO::attribute("threads", is_tiff() ? std::min(settings.threads, most_threads) : 1);
  }

  ImageFormat format() const override {
    return {.floats = type_ == OIIO::TypeFloat, .data = false, .alpha = is_tiff(), .for_display = pixels_.for_display};
  }

  void check_size(int width, int height) const override {
    const auto [least, most] = edge_limits(writer_->format_name());
    if (std::min(width, height) >= least && std::max(width, height) <= most) return;
    const bool too_large = std::max(width, height) > most;
    throw SizeError("cannot write " + file_ + ": a " + in_quotes(extension_) + " file has edges of at " +
                    (too_large ? "most " + std::to_string(most) : "least " + std::to_string(least)) + " pixels, not " +
                    std::to_string(width) + " x " + std::to_string(height) + "; .exr and .png have room for it");
  }

  void begin(const PictureExtent& extent, const std::vector<Channel>& /*only the first are stored*/,
             const ImageMetadata& metadata, std::FILE* destination) override {
    check_size(extent.region.width(), extent.region.height());
    extent_ = extent;
    destination_ = destination;
    std::string name = file_;
    // OpenImageIO 2.4's TIFF writer leaves a file without a directory when it goes through a proxy.
    if (writer_->supports("ioproxy") && writer_->format_name() != std::string("tiff")) {
      proxy_ = std::make_unique<Proxy>(destination);
      writer_->set_ioproxy(proxy_.get());
    } else {
      // By name, a writer may overlook a full disk. It writes to memory, and copying that is checked.
      memory_ = open_memory_file();
      name = "/proc/self/fd/" + std::to_string(fileno(memory_.get()));
    }
    const OIIO::ImageSpec spec = image_spec(metadata);
    guard([&] {
      check(writer_->open(name, spec));
      if (writer_->spec().format.size() < type_.size()) {
        throw FormatError("cannot write " + file_ + ": this format holds " +
                          std::to_string(8 * writer_->spec().format.size()) + " bits a channel, not " +
                          std::to_string(8 * type_.size()));
      }
    });
  }

  void write(const ImageBand& band) override {
    const auto row_values =
        static_cast<std::size_t>(pixels_.channels()) * static_cast<std::size_t>(band.region.width());
    std::vector<float> values(row_values * static_cast<std::size_t>(band.region.height()));
    for (int row = 0; row < band.region.height(); ++row)
      repairs_ += stored_row(band, row, pixels_, values.data() + static_cast<std::size_t>(row) * row_values);
    const int y0 = band.region.y0 - extent_.region.y0, y1 = band.region.y1 - extent_.region.y0;
    guard([&] { check(writer_->write_scanlines(y0, y1, 0, OIIO::TypeFloat, values.data())); });
  }

  Repairs finish() override {
    guard([&] { check(writer_->close()); });
    writer_.reset();  // before the file that it writes to
    CheckedFile destination(destination_);
    const int error = proxy_ ? proxy_->finish() : copy(memory_.get(), destination);
    if (error != 0) fail(error);
    return repairs_;
  }

 private:
  bool is_tiff() const { return writer_->format_name() == std::string_view("tiff"); }

  static PixelFormat linear_format(bool alpha, float lowest, float highest) {
    PixelFormat format;
    format.alpha = alpha;
    format.for_display = false;
    format.lowest = lowest;
    format.highest = highest;
    return format;
  }

  void choose_pixels(const std::string& extension) {
    constexpr float largest_float = std::numeric_limits<float>::max();
    constexpr float largest_rgbe = 1.6e38F;  // 255/256 x 2^127, with room for its rounding
    type_ = OIIO::TypeFloat;
    if (writer_->format_name() == std::string_view("hdr")) {
      pixels_ = linear_format(false, 0, largest_rgbe);
    } else if (extension == ".pfm" || (is_tiff() && settings_.full_float)) {
      pixels_ = linear_format(is_tiff() && settings_.transparent, -largest_float, largest_float);
    } else {
      type_ = settings_.bit_depth == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8;
      pixels_ = display_format(settings_);
      if (!settings_.ocio.empty()) raytrace_openimageio_color_transform(settings_.ocio, pixels_.ocio);
      pixels_.alpha = is_tiff() && settings_.transparent;
    }
  }

  OIIO::ImageSpec image_spec(const ImageMetadata& metadata) const {
    OIIO::ImageSpec spec(extent_.region.width(), extent_.region.height(), pixels_.channels(), type_);
    const bool is_srgb = pixels_.for_display && !pixels_.ocio;  // of which only its configuration knows
    if (is_srgb) spec.attribute("oiio:ColorSpace", "sRGB");
    if (is_tiff() && !is_srgb) {
      constexpr int uncalibrated = 0xFFFF;
      spec.attribute("Exif:ColorSpace",
                     uncalibrated);  // OpenImageIO 2.4 reports an error where there is no Exif at all
    }
    if (pixels_.for_display && pixels_.alpha)
      spec.attribute("oiio:UnassociatedAlpha", 1);  // else its files say that the colour is premultiplied
    add_metadata(spec, metadata, pixels_.for_display ? view_text(settings_) : "");
    return spec;
  }

  /// Runs it; where a failed write is the cause of its error, throws that instead.
  template <class Action>
  void guard(const Action& action) {
    try {
      action();
    } catch (const OutputError&) {
      const int error = proxy_ ? proxy_->finish() : 0;
      writer_.reset();
      if (error != 0) fail(error);
      throw;
    }
  }

  void check(bool done) const {
    if (done && !writer_->has_error()) return;
    std::string reason = writer_->geterror();
    if (says_out_of_memory(reason)) throw std::bad_alloc();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    fail(reason.empty() ? "OpenImageIO's writer failed" : reason);
  }

  std::string extension_;
  PictureExtent extent_;
  std::FILE* destination_ = nullptr;
  std::unique_ptr<Proxy> proxy_;  ///< the destination, for writers that take such a thing
  FileHandle memory_;             ///< to be copied there, for the others
  std::unique_ptr<OIIO::ImageOutput> writer_;
  OIIO::TypeDesc type_;  ///< of a stored channel
  PixelFormat pixels_;
};

/// Whether the file ends as those of its format do. Readers make up what is missing of some.
bool has_its_end(const std::string& file, const std::string& format) {
  static const std::map<std::string, std::string> ends = {
      {"gif", ";"}, {"jpeg", "\xff\xd9"}, {"targa", std::string("TRUEVISION-XFILE.\0", 18)}};
  const auto end = ends.find(format);
  if (end == ends.end()) return true;
  const FileHandle stream(std::fopen(file.c_str(), "rb"));
  std::string bytes(end->second.size(), '\0');
  return stream && std::fseek(stream.get(), -static_cast<long>(bytes.size()), SEEK_END) == 0 &&
         std::fread(bytes.data(), 1, bytes.size(), stream.get()) == bytes.size() && bytes == end->second;
}

}  // namespace

ImageEncoder* raytrace_make_openimageio_encoder(const std::string& file, const std::string& extension,
                                                const ImageFileSettings& settings) {
  return new OpenImageIOEncoder(file, extension, settings);
}

bool raytrace_openimageio_reads_all_of(const std::string& file, int width, int height) {
  const auto picture = OIIO::ImageInput::create(file);
  OIIO::geterror();  // the answer is enough
  OIIO::ImageSpec spec;
  if (!picture || picture->format_name() == std::string("ico") || !picture->open(file, spec)) return false;
  const std::string format = picture->format_name();
  if (!is_allowed_size(spec.width, spec.height) || (width > 0 && (spec.width != width || spec.height != height)))
    return false;
  // The date is what TIFF files of ours have last.
  if (format == "tiff" && spec.get_string_attribute("DateTime").empty()) return false;
  std::vector<float> row(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels));
  // The last row; and the first, which some formats have at their end.
  const bool read = picture->read_scanline(spec.y, 0, OIIO::TypeFloat, row.data()) &&
                    picture->read_scanline(spec.y + spec.height - 1, 0, OIIO::TypeFloat, row.data());
  return read && !picture->has_error() && has_its_end(file, format);
}

}  // namespace raytrace
