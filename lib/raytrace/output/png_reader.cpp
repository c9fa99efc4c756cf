// PNG pictures of all kinds, as textures want them.
#include <png.h>

#include <bit>
#include <new>
#include <utility>

#include "raytrace/output/picture_codecs.h"
#include "raytrace/output/png_errors.h"

namespace raytrace {
namespace {

class PngReader final : public PictureReader {
 public:
  explicit PngReader(FileHandle file)
      : file_(std::move(file)),
        png_(png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &errors_, PngErrors::note_error, PngErrors::ignore_warning,
                                      &errors_, PngErrors::allocate, PngErrors::release)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    try {
      read_header();
    } catch (...) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw;
    }
  }
  ~PngReader() override { png_destroy_read_struct(&png_, &info_, nullptr); }

  Picture read() override {
    Picture picture{layout(), {}, has_alpha_};
    picture.pixels = LargeArray<std::byte>::unset(picture.bytes());
    auto* const pixels = reinterpret_cast<png_bytep>(picture.pixels.data());
    const std::size_t row_bytes = picture.row_bytes();
    guard([&] {
      for (int pass = 0; pass < passes_; ++pass)
        for (int y = 0; y < picture.height; ++y)
          png_read_row(png_, pixels + static_cast<std::size_t>(y) * row_bytes, nullptr);
    });
    return picture;
  }

 private:
  void read_header() {
    PictureLayout layout;
    guard([&] {
      png_init_io(png_, file_.get());
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // set_layout() has its own
      png_read_info(png_, info_);
      png_set_expand(png_);  // palettes, fewer than 8 bits, a colour that is clear
      const bool is_deep = png_get_bit_depth(png_, info_) == 16;
      if (is_deep && std::endian::native == std::endian::little) png_set_swap(png_);
      has_alpha_ = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                   png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
      const bool is_grey = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) == 0;
      if (is_grey && has_alpha_) png_set_gray_to_rgb(png_);
      if (!is_grey && !has_alpha_) png_set_add_alpha(png_, is_deep ? 0xffff : 0xff, PNG_FILLER_AFTER);
      passes_ = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      layout = {static_cast<int>(png_get_image_width(png_, info_)), static_cast<int>(png_get_image_height(png_, info_)),
                png_get_channels(png_, info_), is_deep ? TexelFormat::shorts : TexelFormat::bytes};
    });
    set_layout(layout);
  }

  template <class Calls>
  void guard(const Calls& calls) {
    if (run_png_calls(png_, calls)) return;
    if (errors_.out_of_memory) throw std::bad_alloc();
    if (std::feof(file_.get()) != 0) throw PictureError("the PNG file is truncated");
    if (std::ferror(file_.get()) != 0) throw PictureError("it cannot be read");
    throw PictureError("the PNG file is damaged (" + std::string(errors_.message) + ")");
  }

  FileHandle file_;
  PngErrors errors_;
  png_structp png_;
  png_infop info_;
  int passes_ = 1;
  bool has_alpha_ = false;
};

}  // namespace

std::unique_ptr<PictureReader> make_png_reader(FileHandle file) { return std::make_unique<PngReader>(std::move(file)); }

}  // namespace raytrace
