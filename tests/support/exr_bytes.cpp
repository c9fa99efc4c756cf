#include "support/exr_bytes.h"

#include <algorithm>
#include <bit>

namespace raytrace::test {

namespace {

constexpr std::uint32_t magic = 20000630;
constexpr std::size_t layout_size = 16;

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i)
    number |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
  return number;
}

std::string digits(std::uint64_t number, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(number >> 8 * i & 0xffU);
  return bytes;
}

/// Up to the next 0, which is passed; none if there is no more.
std::optional<std::string> text_at(std::string_view bytes, std::size_t& at) {
  const std::size_t end = bytes.find('\0', at);
  if (end == std::string_view::npos) return std::nullopt;
  std::string text(bytes.substr(at, end - at));
  at = end + 1;
  return text;
}

}  // namespace

std::string little_endian(std::uint32_t number) { return digits(number, 4); }

std::string little_endian(const std::vector<std::int32_t>& numbers) {
  std::string bytes;
  for (const std::int32_t number : numbers) bytes += little_endian(std::bit_cast<std::uint32_t>(number));
  return bytes;
}

std::optional<ExrBytes> ExrBytes::parsed(std::string_view bytes) {
  if (bytes.size() < 8 || number_at(bytes, 0, 4) != magic) return std::nullopt;
  ExrBytes exr;
  exr.version = static_cast<std::uint32_t>(number_at(bytes, 4, 4));
  std::size_t at = 8;
  for (;;) {
    const auto name = text_at(bytes, at);
    if (!name) return std::nullopt;
    if (name->empty()) break;
    const auto type = text_at(bytes, at);
    if (!type || at + 4 > bytes.size()) return std::nullopt;
    const std::uint64_t size = number_at(bytes, at, 4);
    if (at + 4 + size > bytes.size()) return std::nullopt;
    exr.attributes.push_back({*name, *type, std::string(bytes.substr(at + 4, size))});
    at += 4 + size;
  }
  exr.start = at;
  exr.rest = bytes.substr(at);
  const std::string compression = exr["compression"].value, window = exr["dataWindow"].value;
  exr.rows_a_chunk = compression == std::string(1, '\3') ? 16 : 1;
  const std::uint64_t height = (number_at(window, 12, 4) - number_at(window, 4, 4) + 1) & 0xffffffffU;
  exr.chunks = std::min<std::uint64_t>((height + exr.rows_a_chunk - 1) / exr.rows_a_chunk, exr.rest.size() / 8);
  return exr;
}

std::string ExrBytes::bytes() const {
  std::string header = digits(magic, 4) + digits(version, 4);
  for (const auto& [name, type, value] : attributes)
    header += name + '\0' + type + '\0' + little_endian(static_cast<std::uint32_t>(value.size())) + value;
  header += '\0';
  std::string moved = rest;
  for (std::size_t i = 0; i < chunks; ++i)
    moved.replace(8 * i, 8, digits(number_at(rest, 8 * i, 8) - start + header.size(), 8));
  return header + moved;
}

ExrBytes::Attribute& ExrBytes::operator[](std::string_view name) {
  const auto found =
      std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& one) { return one.name == name; });
  if (found != attributes.end()) return *found;
  return attributes.emplace_back(Attribute{std::string(name), "string", ""});
}

void ExrBytes::remove(std::string_view name) {
  std::erase_if(attributes, [&](const Attribute& one) { return one.name == name; });
}

void ExrBytes::set(std::string_view name, const std::string& type, const std::string& value) {
  (*this)[name] = {std::string(name), type, value};
}

void ExrBytes::set_first_value(std::string_view channel, std::uint32_t value) {
  const std::string window = (*this)["dataWindow"].value;
  const std::uint64_t width = number_at(window, 8, 4) - number_at(window, 0, 4) + 1;
  std::size_t at = 8 * chunks + 8;  // behind the table, and the first chunk's row and size
  for (const ExrChannel& one : channels_of((*this)["channels"].value)) {
    if (one.name == channel) break;
    at += (one.layout[0] == '\1' ? 2 : 4) * (width & 0xffffffffU);
  }
  rest.replace(at, 4, digits(value, 4));
}

std::vector<ExrChannel> channels_of(std::string_view value) {
  std::vector<ExrChannel> channels;
  for (std::size_t at = 0;; at += layout_size) {
    const auto name = text_at(value, at);
    if (!name || name->empty() || at + layout_size > value.size()) return channels;
    channels.push_back({*name, std::string(value.substr(at, layout_size))});
  }
}

std::string channels_value(const std::vector<ExrChannel>& channels) {
  std::string value;
  for (const auto& [name, layout] : channels) value += name + '\0' + layout;
  return value + '\0';
}

}  // namespace raytrace::test
