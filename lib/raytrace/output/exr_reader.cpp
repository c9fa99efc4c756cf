#include "raytrace/output/exr_reader.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/exr_header.h"
#include "raytrace/text/quoted.h"

namespace raytrace {

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw InputError("cannot read " + file + ": " + reason);
}

Imf::PixelType imf_type(ChannelType type) {
  // Halves are read as floats: every half is one.
  return type == ChannelType::uint32 ? Imf::UINT : Imf::FLOAT;
}

ChannelType channel_type(Imf::PixelType type) {
  return type == Imf::HALF ? ChannelType::half : type == Imf::FLOAT ? ChannelType::float32 : ChannelType::uint32;
}

std::size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

/// What the file's own size says of the header that it has.
void refuse_impossible(const Imf::Header& header, const Region& region, std::uint64_t file_size) {
  const bool compressed = header.compression() == Imf::ZIP_COMPRESSION;
  if (!compressed && header.compression() != Imf::NO_COMPRESSION)
    throw InputError("it is compressed otherwise than with zip, as this program writes none");
  if (header.lineOrder() != Imf::INCREASING_Y) throw InputError("its lines are not in the order from top to bottom");
  std::uint64_t pixel_bytes = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    const Imf::Channel& layout = channel.channel();
    if (layout.xSampling != 1 || layout.ySampling != 1)
      throw InputError("its channel " + printable(channel.name()) + " has not a value for each pixel");
    pixel_bytes += bytes_of(layout.type);
  }
  constexpr std::uint64_t most_bytes_of_a_byte = 1032;  // that zip makes
  const std::uint64_t pixels = static_cast<std::uint64_t>(region.width()) * static_cast<std::uint64_t>(region.height());
  if (pixels * pixel_bytes > file_size * (compressed ? most_bytes_of_a_byte : 1))
    throw InputError("it is not whole, or damaged: it is too small for its " + std::to_string(pixels) + " pixels");
}

template <class Array>
void copy_matrix(const Imf::Header& header, const char* name, Array& values) {
  if (const auto* attribute = header.findTypedAttribute<Imf::M44fAttribute>(name)) {
    const float* const first = &attribute->value()[0][0];
    std::copy(first, first + 16, std::begin(values));
  }
}

std::vector<ImageAttribute> attributes_of(const Imf::Header& header) {
  std::vector<ImageAttribute> attributes;
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::string name = attribute.name();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute())) {
      attributes.push_back({name, text->value()});
    } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&attribute.attribute())) {
      attributes.push_back({name, integer->value()});
    } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute.attribute())) {
      attributes.push_back({name, number->value()});
    } else if (name.starts_with("raytrace:")) {
      throw InputError("its " + printable(name) + " is of another type than this program's");
    }
  }
  return attributes;
}

}  // namespace

struct ExrReader::OpenFile {
  // The very file that was checked, whatever has its name by now. Without threads of its own: a file's rows are few,
  // and many files are open in turn.
  explicit OpenFile(std::FILE* file) : exr(("/proc/self/fd/" + std::to_string(fileno(file))).c_str(), 0, false) {}
  Imf::MultiPartInputFile exr;
};

ExrReader::ExrReader(const std::string& file) : file_(file) {
  const FileHandle checked = open_regular_file(file);
  try {
    extent_ = check_exr_header(checked.get());
    open_ = std::make_unique<OpenFile>(checked.get());
    const Imf::Header& header = open_->exr.header(0);
    refuse_impossible(header, extent_.region, file_size(checked.get()));
    if (!open_->exr.partComplete(0)) throw InputError("it is not whole");
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
      channels_.push_back({channel.name(), channel_type(channel.channel().type)});
    attributes_ = attributes_of(header);
    copy_matrix(header, "worldToCamera", camera_.world_to_camera);
    copy_matrix(header, "worldToNDC", camera_.world_to_ndc);
  } catch (const InputError& error) {
    refuse(file, error.what());
  } catch (const std::exception& exception) {
    rethrow_out_of_memory(exception);
    refuse(file, "it is not an EXR file, or not whole");
  }
}

void ExrReader::refuse_type(const std::string& attribute) const {
  refuse(file_, "its " + attribute + " is of another type than this program's");
}

ExrReader::~ExrReader() = default;
ExrReader::ExrReader(ExrReader&&) noexcept = default;
ExrReader& ExrReader::operator=(ExrReader&&) noexcept = default;

ImageBand ExrReader::read(const std::vector<Channel>& channels, int y0, int y1) {
  ImageBand band;
  band.region = {extent_.region.x0, y0, extent_.region.x1, y1};
  make_planes(band, 0, channels);
  const Imath::Box2i window({band.region.x0, y0}, {band.region.x1 - 1, y1 - 1});
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    void* const values = std::visit([](auto& plane) -> void* { return plane.data(); }, band.planes[i]);
    buffer.insert(channels[i].name, Imf::Slice::Make(imf_type(channels[i].type), values, window, 4,
                                                     4 * static_cast<std::size_t>(band.region.width())));
  }
  try {
    Imf::InputPart part(open_->exr, 0);
    part.setFrameBuffer(buffer);
    part.readPixels(y0, y1 - 1);
  } catch (const std::exception& exception) {
    rethrow_out_of_memory(exception);
    refuse(file_, "its pixels are damaged");
  }
  return band;
}

}  // namespace raytrace
