#include "raytrace/output/exr_reader.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfStringAttribute.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "raytrace/memory/out_of_memory.h"

namespace raytrace {

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& reason) {
  throw InputError("cannot read " + file + ": " + reason);
}

/// Before OpenEXR does, whose message would not be the system's.
void refuse_unreadable(const std::string& file) {
  if (access(file.c_str(), R_OK) != 0) refuse(file, std::generic_category().message(errno));
}

Imf::PixelType imf_type(ChannelType type) {
  // Halves are read as floats: every half is one.
  return type == ChannelType::uint32 ? Imf::UINT : Imf::FLOAT;
}

ChannelType channel_type(Imf::PixelType type) {
  return type == Imf::HALF ? ChannelType::half : type == Imf::FLOAT ? ChannelType::float32 : ChannelType::uint32;
}

PictureExtent extent_of(const Imf::Header& header) {
  const Imath::Box2i& display = header.displayWindow();
  const Imath::Box2i& data = header.dataWindow();
  return {display.max.x + 1, display.max.y + 1, {data.min.x, data.min.y, data.max.x + 1, data.max.y + 1}};
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
    }
  }
  return attributes;
}

}  // namespace

struct ExrReader::OpenFile {
  // Without threads of its own: a file's rows are few, and many files are open in turn.
  explicit OpenFile(const std::string& file) : exr(file.c_str(), 0) {}
  Imf::InputFile exr;
};

ExrReader::ExrReader(const std::string& file) : file_(file) {
  refuse_unreadable(file);
  try {
    open_ = std::make_unique<OpenFile>(file);
    if (!open_->exr.isComplete()) refuse(file, "it is not whole");
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& exception) {
    rethrow_out_of_memory(exception);
    refuse(file, "it is not an EXR file, or not whole");
  }
  const Imf::Header& header = open_->exr.header();
  extent_ = extent_of(header);
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    channels_.push_back({channel.name(), channel_type(channel.channel().type)});
  attributes_ = attributes_of(header);
  copy_matrix(header, "worldToCamera", camera_.world_to_camera);
  copy_matrix(header, "worldToNDC", camera_.world_to_ndc);
}

ExrReader::~ExrReader() = default;
ExrReader::ExrReader(ExrReader&&) noexcept = default;
ExrReader& ExrReader::operator=(ExrReader&&) noexcept = default;

ImageBand ExrReader::read(const std::vector<Channel>& channels, int y0, int y1) {
  ImageBand band;
  band.region = {extent_.region.x0, y0, extent_.region.x1, y1};
  const auto pixels = static_cast<std::size_t>(band.region.width()) * static_cast<std::size_t>(band.region.height());
  const Imath::Box2i window({band.region.x0, y0}, {band.region.x1 - 1, y1 - 1});
  Imf::FrameBuffer buffer;
  for (const Channel& channel : channels) {
    char* values = nullptr;
    if (channel.type == ChannelType::uint32) {
      band.planes.emplace_back(std::vector<std::uint32_t>(pixels));
      values = reinterpret_cast<char*>(std::get<std::vector<std::uint32_t>>(band.planes.back()).data());
    } else {
      band.planes.emplace_back(std::vector<float>(pixels));
      values = reinterpret_cast<char*>(std::get<std::vector<float>>(band.planes.back()).data());
    }
    buffer.insert(channel.name, Imf::Slice::Make(imf_type(channel.type), values, window, 4,
                                                 4 * static_cast<std::size_t>(band.region.width())));
  }
  try {
    open_->exr.setFrameBuffer(buffer);
    open_->exr.readPixels(y0, y1 - 1);
  } catch (const std::exception& exception) {
    rethrow_out_of_memory(exception);
    refuse(file_, "its pixels are damaged");
  }
  return band;
}

}  // namespace raytrace
