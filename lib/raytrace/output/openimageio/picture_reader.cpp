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

/// What OpenImageIO says, and no more than once.
std::string latest_error(OIIO::ImageInput* input) { return input != nullptr ? input->geterror() : OIIO::geterror(); }

}  // namespace

void raytrace_openimageio_read_picture(const std::string& file, std::string_view encoded, Picture& picture) {
  OIIO::ImageSpec wishes;
  wishes["oiio:UnassociatedAlpha"] = 1;
  OIIO::Filesystem::IOMemReader memory(encoded.data(), encoded.size());  // which `input` needs for as long as it lives
  OIIO::Filesystem::IOProxy* const proxy = &memory;
  if (!encoded.empty()) wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto input = OIIO::ImageInput::open(file, &wishes);
  if (!input) fail_to_read(latest_error(nullptr));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.deep)
    throw PictureError("it is no picture with rows and columns");
  if (std::max(spec.width, spec.height) > largest_picture_edge ||
      std::int64_t{spec.width} * spec.height > most_picture_pixels)
    throw PictureError("it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                       " pixels; a texture has 16384 x 16384 at most, or as many");
  picture.width = spec.width;
  picture.height = spec.height;
  picture.channels = spec.nchannels == 1 ? 1 : 4;
  picture.has_alpha = spec.nchannels == 2 || spec.nchannels >= 4;
  picture.format = format_of(spec);
  const std::size_t bytes = bytes_of(picture.format), stride = bytes * static_cast<std::size_t>(picture.channels);
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  picture.pixels = LargeArray<std::byte>::unset(pixels * stride);
  const int channels = std::min(spec.nchannels, 4);
  const auto pixel_stride = static_cast<OIIO::stride_t>(stride);
  if (!input->read_image(0, 0, 0, channels, type_of(picture.format), picture.pixels.data(), pixel_stride) ||
      input->has_error())
    fail_to_read(latest_error(input.get()));
  if (channels == 1 || channels == 4) return;
  const std::uint32_t alpha = opaque(picture.format);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::byte* const pixel = picture.pixels.data() + i * stride;
    if (channels == 2) {  // grey and alpha
      std::memcpy(pixel + 3 * bytes, pixel + bytes, bytes);
      for (std::size_t c = 1; c < 3; ++c) std::memcpy(pixel + c * bytes, pixel, bytes);
    } else {
      std::memcpy(pixel + 3 * bytes, &alpha, bytes);
    }
  }
}

}  // namespace raytrace
