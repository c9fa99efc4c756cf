#include "raytrace/output/image_encoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <system_error>
#include <vector>

#include "raytrace/description/nearest_name.h"
#include "raytrace/description/quoted.h"
#include "raytrace/output/metadata.h"

namespace raytrace {

namespace {

using Names = std::vector<std::string>;

/// A file that remembers why a write failed and pretends to go on: some of OpenImageIO's writers do not tell of a
/// failure, and the JPEG writer ends the process.
class CheckedFile final : public OIIO::Filesystem::IOFile {
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

/// The name's extension in lower case, with its dot; empty if it has none.
std::string extension_of(const std::string& file) { return OIIO::Strutil::lower(OIIO::Filesystem::extension(file)); }

std::unique_ptr<OIIO::ImageOutput> create_writer(const std::string& extension) {
  auto writer = OIIO::ImageOutput::create("picture" + extension);
  OIIO::geterror();  // told better by the caller
  // Two of OpenImageIO's writers make no file: a text terminal and a bin.
  if (writer && (writer->format_name() == std::string("term") || writer->format_name() == std::string("null")))
    return {};
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

FileHandle open_memory_file() {
  const int number = memfd_create("picture", MFD_CLOEXEC);
  FileHandle file(number < 0 ? nullptr : fdopen(number, "w+b"));
  if (!file) {
    if (number >= 0) close(number);
    throw std::bad_alloc();
  }
  return file;
}

ImageEncoder::ImageEncoder(const std::string& file, const ImageFileSettings& settings) : file_(file) {
  const std::string extension = extension_of(file);
  if (extension.size() < 2) fail("the name has no extension to tell the format; .exr and .png are usual");
  writer_ = create_writer(extension);
  if (!writer_) {
    fail((is_known(extension) ? in_quotes(extension) + " is a format that can be read but not written"
                              : "no picture format has the extension " + in_quotes(extension)) +
         suggestion(extension));
  }
  pixels_ = raytrace::pixel_format(writer_->format_name(), extension, settings);
  // Both are pools of the whole process.
  OIIO::attribute("threads", settings.threads);
  OIIO::attribute("exr_threads", settings.threads == 1 ? -1 : settings.threads);  // -1: none beside the caller
}

Repairs ImageEncoder::encode(const Film& film, const ImageMetadata& metadata, std::FILE* destination) {
  const OIIO::ImageSpec spec = image_spec(film, metadata);
  Repairs repairs;
  int error = 0;
  // OpenImageIO 2.4's TIFF writer leaves a file without a directory when it goes through a proxy.
  if (writer_->supports("ioproxy") && writer_->format_name() != std::string("tiff")) {
    CheckedFile checked(destination);
    writer_->set_ioproxy(&checked);
    try {
      repairs = write_pixels(film, file_, spec);
    } catch (...) {
      error = checked.finish();  // the cause, and clearer than the consequence
      writer_.reset();           // before the file that it writes to
      if (error == 0) throw;
    }
    writer_.reset();
    if (error == 0) error = checked.finish();
  } else {
    // By name, a writer may overlook a full disk. It writes to memory, and copying that is checked.
    const FileHandle memory = open_memory_file();
    repairs = write_pixels(film, "/proc/self/fd/" + std::to_string(fileno(memory.get())), spec);
    error = copy(memory.get(), destination);
  }
  if (error != 0) fail(std::generic_category().message(error));
  return repairs;
}

OIIO::ImageSpec ImageEncoder::image_spec(const Film& film, const ImageMetadata& metadata) const {
  const Region& region = film.region();
  const std::string format = writer_->format_name();
  OIIO::ImageSpec spec(region.width(), region.height(), pixels_.channels, pixels_.type);
  if (format == "openexr") {
    spec.x = region.x0;
    spec.y = region.y0;
    spec.full_width = film.full_width();
    spec.full_height = film.full_height();
    spec.attribute("compression", "zip");
  }
  if (pixels_.srgb) {
    spec.attribute("oiio:ColorSpace", "sRGB");
  } else if (format == "tiff") {
    constexpr int uncalibrated = 0xFFFF;
    spec.attribute("Exif:ColorSpace", uncalibrated);  // OpenImageIO 2.4 reports an error where there is no Exif at all
  }
  add_metadata(spec, format, metadata);
  return spec;
}

Repairs ImageEncoder::write_pixels(const Film& film, const std::string& name, const OIIO::ImageSpec& spec) {
  check(writer_->open(name, spec));
  if (writer_->spec().format.size() < pixels_.type.size()) {
    fail("this format holds " + std::to_string(8 * writer_->spec().format.size()) + " bits a channel, not " +
         std::to_string(8 * pixels_.type.size()));
  }
  // A band of rows at a time, so that no second copy of the picture is needed.
  constexpr std::size_t band_values = 4U << 20U;
  constexpr std::size_t chunk = 16;  // rows that EXR's zip compresses together
  const auto row_values = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
  const auto band_rows = static_cast<int>(std::max<std::size_t>(1, band_values / row_values / chunk) * chunk);

  Repairs repairs;
  std::vector<float> values;
  for (int done = 0; done < spec.height; done += band_rows) {
    const int rows = std::min(band_rows, spec.height - done);
    const int film_y = film.region().y0 + done;
    convert_rows(film, film_y, film_y + rows, pixels_, values, repairs);
    check(writer_->write_scanlines(spec.y + done, spec.y + done + rows, 0, OIIO::TypeFloat, values.data()));
  }
  check(writer_->close());
  return repairs;
}

void ImageEncoder::check(bool done) const {
  if (done && !writer_->has_error()) return;
  const std::string reason = writer_->geterror();
  fail(reason.empty() ? "OpenImageIO's writer failed" : reason);
}

void ImageEncoder::fail(const std::string& reason) const { throw OutputError("cannot write " + file_ + ": " + reason); }

}  // namespace raytrace
