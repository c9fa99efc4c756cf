// What follows the head of a PLY file. Inside of the reader: programs include read_mesh.h.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "raytrace/import/mesh_file.h"
#include "raytrace/import/ply_faces.h"
#include "raytrace/import/ply_header.h"

namespace raytrace::ply {

/// Where a property of the vertices goes, and what becomes of it.
struct Column {
  enum class Use : std::uint8_t { position, number, color, alpha, radius };
  std::size_t property = 0;
  Use use = Use::number;
  double origin = 0;     ///< of a position
  float* out = nullptr;  ///< of vertex 0
  std::size_t step = 1;  ///< from vertex to vertex
};

/// Calls f with what makes a column's float of a double.
template <class Function>
void with_conversion(const Column& column, Type type, const Function& f) {
  switch (column.use) {
    case Column::Use::position:
      return f([origin = column.origin](double value) { return rounded(value - origin); });
    case Column::Use::radius:
      return f([](double value) { return rounded(value); });
    case Column::Use::color:
      if (!is_float(type)) {
        const double most = size_of(type) == 2 ? 65535 : 255;
        return f([most](double value) { return srgb_to_linear(value, most); });
      }
      return f([](double value) { return finite_or_zero(rounded(value)); });
    case Column::Use::alpha: {
      const double most = is_float(type) ? 1 : size_of(type) == 2 ? 65535 : 255;
      return f([most](double value) { return rounded(value > 0 ? std::min(value / most, 1.0) : 0); });
    }
    case Column::Use::number:
      return f([](double value) { return finite_or_zero(rounded(value)); });
  }
}

/// Calls f with what loads a value of that type, which need not be aligned.
template <class Function>
auto with_loader(Type type, bool big_endian, const Function& f) {
  const auto of_type = [&]<class T>(T) {
    const auto load = []<bool swapped>(const char* from) {
      std::array<char, sizeof(T)> bytes;
      std::memcpy(bytes.data(), from, sizeof(T));
      if constexpr (swapped) std::reverse(bytes.begin(), bytes.end());
      return std::bit_cast<T>(bytes);
    };
    const bool swap = big_endian != (std::endian::native == std::endian::big);
    return swap ? f([=](const char* from) { return load.template operator()<true>(from); })
                : f([=](const char* from) { return load.template operator()<false>(from); });
  };
  switch (type) {
    case Type::int8:
      return of_type(std::int8_t{});
    case Type::uint8:
      return of_type(std::uint8_t{});
    case Type::int16:
      return of_type(std::int16_t{});
    case Type::uint16:
      return of_type(std::uint16_t{});
    case Type::int32:
      return of_type(std::int32_t{});
    case Type::uint32:
      return of_type(std::uint32_t{});
    case Type::float32:
      return of_type(float{});
    case Type::float64:
      break;
  }
  return of_type(double{});
}

/// Reads the elements behind a head. Each call returns false, and reports an error, if something is wrong.
class Body {
 public:
  Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  virtual ~Body() = default;

  /// Whether the file has the values of all elements `vertex`.
  virtual bool find_vertices() = 0;
  /// positions: where x, y and z go; bad: how many are (mark_bad_positions).
  virtual bool read_vertices(std::span<const Column> columns, float* positions, std::size_t& bad) = 0;
  /// mesh: has its positions. dented_quads: as finish_mesh() has it.
  virtual bool read_faces(const FaceColumns& columns, MeshData& mesh, FaceValues& values, MeshFaults& faults,
                          bool& dented_quads) = 0;
};

std::unique_ptr<Body> binary_body(MeshFile& file, const Header& header, int threads, Diagnostics& diagnostics);
std::unique_ptr<Body> text_body(MeshFile& file, const Header& header, int threads, Diagnostics& diagnostics);

}  // namespace raytrace::ply
