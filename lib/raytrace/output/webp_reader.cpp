// WebP pictures, with colours that alpha does not multiply: OpenImageIO's have been multiplied, and rounded.
#include <webp/decode.h>

#include <string>
#include <utility>

#include "raytrace/output/picture_codecs.h"

namespace raytrace {
namespace {

class WebpReader final : public PictureReader {
 public:
  explicit WebpReader(std::string bytes) : bytes_(std::move(bytes)) {
    if (WebPGetFeatures(data(), bytes_.size(), &features_) != VP8_STATUS_OK) fail();
    if (features_.has_animation != 0) throw PictureError("it is an animation");
    set_layout({features_.width, features_.height, 4, TexelFormat::bytes});
  }

  Picture read() override {
    Picture picture{layout(), {}, features_.has_alpha != 0};
    picture.pixels = LargeArray<std::byte>::unset(picture.bytes());
    if (WebPDecodeRGBAInto(data(), bytes_.size(), reinterpret_cast<std::uint8_t*>(picture.pixels.data()),
                           picture.bytes(), static_cast<int>(picture.row_bytes())) == nullptr)
      fail();
    return picture;
  }

 private:
  const std::uint8_t* data() const { return reinterpret_cast<const std::uint8_t*>(bytes_.data()); }
  [[noreturn]] static void fail() { throw PictureError("the WebP file is damaged or truncated"); }

  std::string bytes_;
  WebPBitstreamFeatures features_{};
};

}  // namespace

std::unique_ptr<PictureReader> make_webp_reader(std::string bytes) {
  return std::make_unique<WebpReader>(std::move(bytes));
}

}  // namespace raytrace
