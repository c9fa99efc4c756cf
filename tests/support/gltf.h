// glTF files that tests make.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace raytrace::test {

inline std::string base64(const std::string& bytes) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k < bytes.size() + 1 ? digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Of arrays, each with a buffer view and an accessor of the same number.
class GltfFile {
 public:
  /// more: further members of the accessor, ',' first.
  template <class T>
  GltfFile& add(const std::vector<T>& values, const std::string& type, int component_type, std::size_t count,
                const std::string& more = "") {
    add_view(bytes_of(values));
    accessors_ += (accessors_.empty() ? "" : ",") + ("{\"bufferView\":" + std::to_string(views_ - 1)) + ",\"type\":\"" +
                  type + "\",\"componentType\":" + std::to_string(component_type) +
                  ",\"count\":" + std::to_string(count) + more + '}';
    return *this;
  }
  GltfFile& add_view(const std::string& bytes) {
    while (buffer_.size() % 4 != 0) buffer_ += '\0';
    view_texts_ += (views_ == 0 ? "" : ",") + ("{\"buffer\":0,\"byteOffset\":" + std::to_string(buffer_.size())) +
                   ",\"byteLength\":" + std::to_string(bytes.size()) + '}';
    ++views_;
    buffer_ += bytes;
    return *this;
  }
  /// A view of `count` elements in a second buffer, which is not there, that an extension has compressed into these
  /// bytes.
  GltfFile& add_compressed_view(const std::string& bytes, std::size_t count, std::size_t stride,
                                const std::string& mode, const std::string& filter = "NONE",
                                const std::string& extension = "EXT_meshopt_compression") {
    add_view(bytes);
    const std::string stored = view_texts_.substr(view_texts_.rfind('{') + 1);  // with its '}'
    view_texts_.erase(view_texts_.rfind('{'));
    const std::string of_stride = ",\"byteStride\":" + std::to_string(stride);
    view_texts_ += "{\"buffer\":1,\"byteLength\":" + std::to_string(count * stride) +
                   (mode == "ATTRIBUTES" ? of_stride : "") + ",\"extensions\":{\"" + extension + "\":{\"mode\":\"" +
                   mode + "\",\"filter\":\"" + filter + "\",\"count\":" + std::to_string(count) + of_stride + ',' +
                   stored + "}}";
    fallback_ = ",{\"byteLength\":1000000,\"extensions\":{\"" + extension + "\":{\"fallback\":true}}}";
    return *this;
  }
  GltfFile& add_accessor(const std::string& text) {
    accessors_ += (accessors_.empty() ? "" : ",") + text;
    return *this;
  }

  /// members: "meshes", "nodes" and what else there is, without braces. uri: of the buffer; empty: it has none.
  std::string json(const std::string& members, const std::string& uri) const {
    return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(buffer_.size()) +
           (uri.empty() ? "" : ",\"uri\":\"" + uri + '"') + '}' + fallback_ + "],\"bufferViews\":[" + view_texts_ +
           "],\"accessors\":[" + accessors_ + "]," + members + '}';
  }
  std::string text(const std::string& members) const {
    return json(members, "data:application/octet-stream;base64," + base64(buffer_));
  }
  std::string glb(const std::string& members) const { return glb_of(json(members, ""), buffer_); }
  const std::string& buffer() const { return buffer_; }

  static std::string glb_of(std::string json, std::string binary) {
    while (json.size() % 4 != 0) json += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    const auto word = [](std::size_t value) { return bytes_of(std::vector{static_cast<std::uint32_t>(value)}); };
    return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
  }

 private:
  std::string buffer_, view_texts_, accessors_, fallback_;
  std::size_t views_ = 0;
};

}  // namespace raytrace::test
