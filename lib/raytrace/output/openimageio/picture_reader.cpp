// Pictures of all formats that OpenImageIO reads.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/openimageio_module.h"

namespace raytrace {
namespace {

[[noreturn]] void fail_to_read(std::string reason) {
  if (says_out_of_memory(reason)) throw std::bad_alloc();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  while (!reason.empty() && reason.back() == ' ') reason.pop_back();
  throw PictureError(reason.empty() ? "OpenImageIO cannot read it" : reason);
}

/// Which keeps all that the file's numbers say.
TexelFormat format_of(const OIIO::ImageSpec& spec) {
  if (!spec.channelformats.empty()) return TexelFormat::floats;
  switch (spec.format.basetype) {
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
      return TexelFormat::bytes;
    case OIIO::TypeDesc::UINT16:
    case OIIO::TypeDesc::INT16:
      return TexelFormat::shorts;
    case OIIO::TypeDesc::HALF:
      return TexelFormat::halves;
    default:
      return TexelFormat::floats;
  }
}

OIIO::TypeDesc type_of(TexelFormat format) {
  if (format == TexelFormat::bytes) return OIIO::TypeUInt8;
  if (format == TexelFormat::shorts) return OIIO::TypeUInt16;
  return format == TexelFormat::halves ? OIIO::TypeHalf : OIIO::TypeFloat;
}

/// The bytes of alpha 1.
std::uint32_t opaque(TexelFormat format) {
  if (format == TexelFormat::bytes) return 255;
  if (format == TexelFormat::shorts) return 65535;
  return format == TexelFormat::halves ? 0x3c00U : std::bit_cast<std::uint32_t>(1.0F);
}

/// The first line of what OpenImageIO says, which may have one for each row, and no more than once.
std::string latest_error(OIIO::ImageInput* input) {
  constexpr std::size_t most = 300;
  const std::string error = input != nullptr ? input->geterror() : OIIO::geterror();
  return error.substr(0, std::min(error.find('\n'), most));
}

class OpenImageIOReader final : public PictureReader {
 public:
  OpenImageIOReader(const std::string& file, std::string_view encoded)
      : memory_(encoded.data(), encoded.size()), proxy_(&memory_) {
    OIIO::ImageSpec wishes;
    wishes["oiio:UnassociatedAlpha"] = 1;
    if (!encoded.empty()) wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy_);
    input_ = OIIO::ImageInput::open(file, &wishes);
    if (!input_) fail_to_read(latest_error(nullptr));
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.depth > 1 || spec.nchannels < 1 || spec.deep) throw PictureError("it is no picture with rows and columns");
    set_layout({spec.width, spec.height, spec.nchannels == 1 ? 1 : 4, format_of(spec)});
  }

  Picture read() override {
    const int of_file = input_->spec().nchannels, channels = std::min(of_file, 4);
    Picture picture{layout(), {}, of_file == 2 || of_file >= 4};
    const std::size_t bytes = bytes_of(picture.format), stride = bytes * static_cast<std::size_t>(picture.channels);
    picture.pixels = LargeArray<std::byte>::unset(picture.bytes());
    if (!input_->read_image(0, 0, 0, channels, type_of(picture.format), picture.pixels.data(),
                            static_cast<OIIO::stride_t>(stride)) ||
        input_->has_error())
      fail_to_read(latest_error(input_.get()));
    if (channels == 1 || channels == 4) return picture;
    const std::uint32_t alpha = opaque(picture.format);
    const std::size_t pixels = picture.bytes() / stride;
    for (std::size_t i = 0; i < pixels; ++i) {
      std::byte* const pixel = picture.pixels.data() + i * stride;
      if (channels == 2) {  // grey and alpha
        std::memcpy(pixel + 3 * bytes, pixel + bytes, bytes);
        for (std::size_t c = 1; c < 3; ++c) std::memcpy(pixel + c * bytes, pixel, bytes);
      } else {
        std::memcpy(pixel + 3 * bytes, &alpha, bytes);
      }
    }
    return picture;
  }

 private:
  OIIO::Filesystem::IOMemReader memory_;  // which `input_` needs for as long as it lives
  OIIO::Filesystem::IOProxy* proxy_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace

void raytrace_make_openimageio_reader(const std::string& file, std::string_view bytes,
                                      std::unique_ptr<PictureReader>& reader) {
  reader = std::make_unique<OpenImageIOReader>(file, bytes);
}

}  // namespace raytrace
