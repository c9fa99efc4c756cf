// The bytes of a glTF file: its container, and what its URIs stand for. Inside of read_gltf().
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace raytrace::gltf {

/// What is wrong with a file, with the place in it first. Nothing more is read.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Chunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Of a file that is GLB, or JSON alone. Throws Error.
Chunks chunks_of(std::string_view file);

/// What a URI "data:" holds. No value if it is another one. Throws Error.
std::optional<std::string> data_of_uri(std::string_view uri);

/// With the bytes that stand as "%20".
std::string percent_decoded(std::string_view uri);

}  // namespace raytrace::gltf
