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
#include <array>
#include <bit>
#include <map>
#include <set>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/text/message.h"

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
  const std::uint64_t pixels = region.pixels();
  if (pixels * pixel_bytes > file_size * (compressed ? most_bytes_of_a_byte : 1))
    throw InputError("it is not whole, or damaged: it is too small for its " + std::to_string(pixels) + " pixels");
}

/// False if there is none.
template <class Array>
bool copy_matrix(const Imf::Header& header, const char* name, Array& values) {
  const auto* const attribute = header.findTypedAttribute<Imf::M44fAttribute>(name);
  if (attribute == nullptr) return false;
  const float* const first = &attribute->value()[0][0];
  std::copy(first, first + 16, std::begin(values));
  return true;
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

constexpr std::size_t longest_name = 255;
constexpr const char* other_kind =
    "it is an EXR file of tiles, of deep pixels or of several parts, as this program writes none";

/// The bytes of a file, one after the other.
class Bytes {
 public:
  explicit Bytes(std::FILE* file) : file_(file), left_(file_size(file)) {}

  std::uint64_t left() const { return left_; }

  std::uint32_t next() {
    const int byte = left_ == 0 ? EOF : std::fgetc(file_);
    if (byte == EOF) throw InputError("it is not whole");
    --left_;
    return static_cast<std::uint32_t>(byte);
  }

  void pass(std::uint64_t count) {
    if (count > left_ || fseeko(file_, static_cast<off_t>(count), SEEK_CUR) != 0) throw InputError("it is not whole");
    left_ -= count;
  }

 private:
  std::FILE* file_;
  std::uint64_t left_;
};

std::uint32_t read_number(Bytes& bytes) {
  std::uint32_t number = 0;
  for (unsigned shift = 0; shift < 32; shift += 8) number |= bytes.next() << shift;
  return number;
}

/// Up to the 0 that ends it.
std::string read_name(Bytes& bytes) {
  std::string name;
  while (const std::uint32_t letter = bytes.next()) {
    if (name.size() == longest_name) throw InputError("its header is damaged");
    name += static_cast<char>(letter);
  }
  return name;
}

std::string read_text(Bytes& bytes, std::uint32_t size) {
  std::string text;
  while (text.size() < size) text += static_cast<char>(bytes.next());
  return text;
}

/// OpenEXR reads as many bytes as a value of the type has, or as it begins to say, whatever size its header gives:
/// where both differ, what follows is anything.
void refuse_other_size(const std::string& name, const std::string& type, std::uint32_t size) {
  static const std::map<std::string, std::uint32_t> sizes = {
      {"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
      {"compression", 1}, {"double", 8},   {"envmap", 1},
      {"float", 4},       {"int", 4},      {"keycode", 28},
      {"lineOrder", 1},   {"m33f", 36},    {"m44f", 64},
      {"rational", 8},    {"timecode", 8}, {"v2f", 8},
      {"v2i", 8},         {"v3f", 12},     {"v3i", 12}};
  if (type == "string" || type == "chlist") return;
  const auto found = sizes.find(type);
  if (found == sizes.end())
    throw InputError("its header has " + printable(name) + " of the type " + printable(type) +
                     ", of which this program knows none");
  if (found->second != size) throw InputError("its header is damaged at " + printable(name));
}

struct Window {
  std::array<std::int64_t, 4> edges{};  ///< the last column and row are in it
  std::int64_t width() const { return edges[2] - edges[0] + 1; }
  std::int64_t height() const { return edges[3] - edges[1] + 1; }
};

Window read_window(Bytes& bytes) {
  Window window;
  for (std::int64_t& edge : window.edges) edge = std::bit_cast<std::int32_t>(read_number(bytes));
  return window;
}

/// OpenEXR keeps the last of several channels of a name, and says nothing.
void refuse_doubled_channels(Bytes& bytes) {
  constexpr std::uint64_t bytes_after_name = 16;
  std::set<std::string> names;
  for (std::string name; !(name = read_name(bytes)).empty(); bytes.pass(bytes_after_name))
    if (!names.insert(name).second) throw InputError("it has the channel " + printable(name) + " twice");
}

PictureExtent extent_of(const Window& display, const Window& data) {
  if (display.edges[0] != 0 || display.edges[1] != 0)
    throw InputError("its display window does not begin at 0,0, as all of this program's do");
  const auto size_text = [](const Window& window) {
    return std::to_string(window.width()) + " x " + std::to_string(window.height());
  };
  if (!is_allowed_size(static_cast<double>(display.width()), static_cast<double>(display.height())))
    throw InputError("its display window of " + size_text(display) + " pixels is no size of a picture of this program");
  const auto fits = [](std::int64_t edge) {
    return edge >= -std::int64_t{2} * largest_edge && edge < std::int64_t{2} * largest_edge;
  };
  for (const std::int64_t edge : data.edges)
    if (!fits(edge)) throw InputError("its data window reaches too far beyond its display window");
  const auto edge = [&](std::size_t i) { return static_cast<int>(data.edges[i]); };
  const PictureExtent extent{static_cast<int>(display.width()),
                             static_cast<int>(display.height()),
                             {edge(0), edge(1), edge(2) + 1, edge(3) + 1}};
  if (const auto error = crop_error(extent.region, extent.full_width, extent.full_height))
    throw InputError("its data window " + text_of(extent.region) + " is none of this program's: " + *error);
  return extent;
}

/// Reads the header, from the file's beginning, before OpenEXR reads it and takes the memory that it asks for: a single
/// part of scan lines, no attribute or channel twice, each attribute within the file, and windows that this program
/// could have rendered, which are the result. Throws InputError, whose text does not name the file.
PictureExtent check_exr_header(std::FILE* file) {
  constexpr std::uint32_t magic = 20000630, version = 2, long_names = 0x400;
  Bytes bytes(file);
  if (bytes.left() < 8 || read_number(bytes) != magic) throw InputError("it is not an EXR file");
  if ((read_number(bytes) & ~long_names) != version) throw InputError(other_kind);
  std::set<std::string> names;
  std::optional<Window> display, data;
  for (std::string name; !(name = read_name(bytes)).empty();) {
    const std::string type = read_name(bytes);
    const std::uint32_t size = read_number(bytes);
    if (!names.insert(name).second) throw InputError("its header has " + printable(name) + " twice");
    if (size > bytes.left()) throw InputError("it is not whole: its header ends within " + printable(name));
    if (name == "tiles") throw InputError(other_kind);
    refuse_other_size(name, type, size);
    const std::uint64_t left_behind = bytes.left() - size;
    const bool is_window = type == "box2i";
    if (name == "displayWindow" && is_window) display = read_window(bytes);
    if (name == "dataWindow" && is_window) data = read_window(bytes);
    if (name == "type" && read_text(bytes, size) != "scanlineimage") throw InputError(other_kind);
    if (type == "chlist") {
      refuse_doubled_channels(bytes);
      if (bytes.left() != left_behind) throw InputError("its header is damaged at " + printable(name));
    }
    bytes.pass(bytes.left() - left_behind);
  }
  if (!display || !data) throw InputError("its header has no display window, or no data window");
  return extent_of(*display, *data);
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
    camera_.is_projection = copy_matrix(header, "worldToNDC", camera_.world_to_ndc);
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
