// JPEG pictures of grey or colours of light.
#include <csetjmp>
#include <cstdio>
#include <new>
#include <utility>

#include "raytrace/output/picture_codecs.h"

// clang-format off: they need <cstdio>, and jerror.h needs jpeglib.h
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#ifndef JCS_ALPHA_EXTENSIONS
#error "libjpeg-turbo is needed, or a library that has its colour spaces"
#endif

namespace raytrace {
namespace {

/// What libjpeg reports through callbacks. Its errors are jumps to `jump`.
struct JpegErrors : jpeg_error_mgr {
  std::jmp_buf jump;
  bool out_of_memory = false, truncated = false;
  char message[JMSG_LENGTH_MAX] = {};

  JpegErrors() {
    jpeg_std_error(this);
    error_exit = note_error;
    emit_message = note_warning;
  }
  static JpegErrors& of(j_common_ptr jpeg) { return *static_cast<JpegErrors*>(jpeg->err); }
  static void note_error(j_common_ptr jpeg) {
    JpegErrors& errors = of(jpeg);
    errors.out_of_memory = errors.msg_code == JERR_OUT_OF_MEMORY;
    errors.format_message(jpeg, errors.message);
    std::longjmp(errors.jump, 1);
  }
  /// libjpeg goes on where data are missing, and makes them grey. Other warnings are of files that show well elsewhere.
  static void note_warning(j_common_ptr jpeg, int level) {
    JpegErrors& errors = of(jpeg);
    if (level < 0 && (errors.msg_code == JWRN_JPEG_EOF || errors.msg_code == JWRN_HIT_MARKER)) errors.truncated = true;
  }
};

class JpegReader final : public PictureReader {
 public:
  explicit JpegReader(FileHandle file) : file_(std::move(file)) {
    jpeg_.err = &errors_;
    progress_.progress_monitor = refuse_endless_scans;
    try {
      PictureLayout layout;
      guard([&] {
        jpeg_create_decompress(&jpeg_);
        jpeg_.progress = &progress_;
        jpeg_stdio_src(&jpeg_, file_.get());
        jpeg_read_header(&jpeg_, TRUE);
        const bool is_grey = jpeg_.num_components == 1;
        layout = {static_cast<int>(jpeg_.image_width), static_cast<int>(jpeg_.image_height), is_grey ? 1 : 4,
                  TexelFormat::bytes};
      });
      set_layout(layout);
    } catch (...) {
      jpeg_destroy_decompress(&jpeg_);
      throw;
    }
  }
  ~JpegReader() override { jpeg_destroy_decompress(&jpeg_); }

  /// Whether libjpeg turns its colours into light's.
  bool has_colors_of_light() const {
    return jpeg_.jpeg_color_space == JCS_GRAYSCALE || jpeg_.jpeg_color_space == JCS_RGB ||
           jpeg_.jpeg_color_space == JCS_YCbCr;
  }

  Picture read() override {
    Picture picture{layout(), {}, false};
    picture.pixels = LargeArray<std::byte>::unset(picture.bytes());
    auto* const pixels = reinterpret_cast<JSAMPROW>(picture.pixels.data());
    const std::size_t row_bytes = picture.row_bytes();
    guard([&] {
      jpeg_.out_color_space = picture.channels == 1 ? JCS_GRAYSCALE : JCS_EXT_RGBA;
      jpeg_start_decompress(&jpeg_);
      while (jpeg_.output_scanline < jpeg_.output_height) {
        JSAMPROW row = pixels + jpeg_.output_scanline * row_bytes;
        jpeg_read_scanlines(&jpeg_, &row, 1);
      }
    });
    return picture;
  }

 private:
  /// A small file may have thousands of scans, each of which goes over the whole picture.
  static void refuse_endless_scans(j_common_ptr jpeg) {
    constexpr int most_scans = 500;
    if (!jpeg->is_decompressor || reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= most_scans) return;
    std::snprintf(JpegErrors::of(jpeg).message, JMSG_LENGTH_MAX, "more than %d scans", most_scans);
    std::longjmp(JpegErrors::of(jpeg).jump, 1);
  }

  /// Runs calls of libjpeg: `calls` must make no object that has a destructor.
  template <class Calls>
  void guard(const Calls& calls) {
    if (setjmp(errors_.jump) == 0) {
      calls();
      if (!errors_.truncated) return;
    }
    if (errors_.out_of_memory) throw std::bad_alloc();
    if (std::ferror(file_.get()) != 0) throw PictureError("it cannot be read");
    if (errors_.truncated) throw PictureError("the JPEG file is truncated");
    throw PictureError("the JPEG file is damaged (" + std::string(errors_.message) + ")");
  }

  FileHandle file_;
  JpegErrors errors_;
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct jpeg_{};
};

}  // namespace

std::unique_ptr<PictureReader> make_jpeg_reader(FileHandle file) {
  auto reader = std::make_unique<JpegReader>(std::move(file));
  if (!reader->has_colors_of_light()) return nullptr;
  return reader;
}

}  // namespace raytrace
