#include "raytrace/import/ply_header.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "raytrace/import/mesh_text.h"
#include "raytrace/text/message.h"

namespace raytrace::ply {
namespace {

constexpr std::size_t most_elements = 256, most_textures = 4096;

std::optional<Type> type_of_name(std::string_view name) {
  static constexpr std::pair<std::string_view, Type> types[] = {
      {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
      {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
      {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
      {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
  for (const auto& [known, type] : types)
    if (known == name) return type;
  return std::nullopt;
}

/// An empty text, or why the line is refused.
std::string read_header_line(LineWords words, Header& header) {
  const std::string_view keyword = words.word();
  if (keyword == "comment" && words.word() == "TextureFile" && header.textures.size() < most_textures)
    if (const std::string_view name = words.rest(); !name.empty()) header.textures.emplace_back(name);
  if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return {};
  if (keyword == "format") {
    const std::string_view format = words.word();
    if (format == "ascii") {
      header.format = Header::Format::ascii;
    } else if (format == "binary_little_endian") {
      header.format = Header::Format::little_endian;
    } else if (format == "binary_big_endian") {
      header.format = Header::Format::big_endian;
    } else {
      return "unknown format " + in_quotes(format) + "; known are ascii, binary_little_endian and binary_big_endian";
    }
    return {};
  }
  if (keyword == "element") {
    const std::string name(words.word());
    const std::string_view count = words.word();
    Element element{name, 0, {}};
    const auto [stop, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (name.empty() || count.empty() || error != std::errc() || stop != count.data() + count.size())
      return "an element needs a name and how many there are, such as: element vertex 8";
    if (header.find(name) != header.elements.size()) return "a second element " + in_quotes(name);
    if (header.elements.size() == most_elements) return "more than 256 elements";
    header.elements.push_back(std::move(element));
    return {};
  }
  if (keyword == "property") {
    if (header.elements.empty()) return "a property before the first element";
    Property property;
    std::string_view type = words.word();
    if (type == "list") {
      const std::string_view count_type = words.word();
      property.count_type = type_of_name(count_type);
      if (!property.count_type || is_float(*property.count_type))
        return in_quotes(count_type) + " is no type of integers, which a list's count needs";
      type = words.word();
    }
    const std::optional<Type> known = type_of_name(type);
    if (!known) return "unknown type " + in_quotes(type);
    property.type = *known;
    property.name = words.word();
    if (property.name.empty()) return "a property without a name";
    header.elements.back().properties.push_back(std::move(property));
    return {};
  }
  return "unknown word " + in_quotes(keyword) + " in the head of a PLY file";
}

}  // namespace

bool Element::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const Property& p) { return p.count_type.has_value(); });
}

std::optional<std::size_t> Element::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return i;
  return std::nullopt;
}

std::size_t Header::find(std::string_view element) const {
  std::size_t i = 0;
  while (i < elements.size() && elements[i].name != element) ++i;
  return i;
}

std::optional<Header> read_header(std::string_view text, Diagnostics& diagnostics) {
  Header header;
  const auto refuse = [&](const std::string& message) {
    diagnostics.error({header.lines, 0}, message);
    return std::nullopt;
  };
  // The first line shows how lines end: binary values behind the head may begin with what looks like a line feed.
  const std::size_t first_end = text.find_first_of("\r\n");
  header.lines = 1;
  if (first_end == std::string_view::npos || LineWords(text.data(), text.data() + first_end, '\0').rest() != "ply")
    return refuse("this is no PLY file: its first line is not 'ply'");
  const std::string_view line_end = text.substr(first_end).starts_with("\r\n") ? "\r\n"
                                    : text.substr(first_end).starts_with('\r') ? "\r"
                                                                               : "\n";
  bool has_format = false;
  std::size_t at = first_end + line_end.size();
  while (true) {
    ++header.lines;
    const std::size_t end = text.find(line_end, at);
    if (end == std::string_view::npos) return refuse("the head of the PLY file has no end_header");
    const LineWords words(text.data() + at, text.data() + end, '\0');
    at = end + line_end.size();
    const std::string_view keyword = LineWords(words).word();
    if (keyword == "end_header") break;
    has_format = has_format || keyword == "format";
    if (const std::string message = read_header_line(words, header); !message.empty()) return refuse(message);
  }
  if (!has_format) return refuse("the head of the PLY file has no line 'format'");
  header.size = at;
  return header;
}

}  // namespace raytrace::ply
