#include "raytrace/output/complete_picture.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <system_error>
#include <vector>

#include "raytrace/memory/out_of_memory.h"

namespace raytrace {
namespace {

/// Throws where a copy was cut off.
void read_last_row(Imf::MultiPartInputFile& picture, int part) {
  const Imf::Header& header = picture.header(part);
  Imath::Box2i row = header.dataWindow();
  row.min.y = row.max.y;
  const auto channel = header.channels().begin();
  const Imf::Channel& layout = channel.channel();
  std::vector<float> samples(static_cast<std::size_t>(row.max.x - row.min.x) + 1);
  Imf::FrameBuffer frame_buffer;
  frame_buffer.insert(channel.name(),
                      Imf::Slice::Make(Imf::FLOAT, samples.data(), row, 0, 0, layout.xSampling, layout.ySampling));
  Imf::InputPart input(picture, part);
  input.setFrameBuffer(frame_buffer);
  input.readPixels(row.max.y, row.max.y);
}

bool is_complete_exr(const std::string& file) {
  try {
    Imf::MultiPartInputFile picture(file.c_str(), 0);
    for (int part = 0; part < picture.parts(); ++part) {
      const auto* const partial = picture.header(part).findTypedAttribute<Imf::IntAttribute>("raytrace:partial");
      if (!picture.partComplete(part) || (partial && partial->value() != 0)) return false;
      read_last_row(picture, part);
    }
    return true;
  } catch (const std::exception& exception) {
    rethrow_out_of_memory(exception);
    return false;
  }
}

}  // namespace

bool is_complete_picture(const std::string& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension != ".exr" || is_complete_exr(file);
}

}  // namespace raytrace
