// Accessors of a glTF file: numbers in its buffers, some to each element. Inside of read_gltf().
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "raytrace/import/gltf_bytes.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace::gltf {

/// As the format numbers them.
enum class ComponentType { byte = 5120, unsigned_byte, short_integer, unsigned_short, unsigned_integer = 5125, number };

/// Calls f with std::type_identity of the C++ type.
template <class Function>
auto with_component_type(ComponentType type, const Function& f) {
  switch (type) {
    case ComponentType::byte:
      return f(std::type_identity<std::int8_t>{});
    case ComponentType::unsigned_byte:
      return f(std::type_identity<std::uint8_t>{});
    case ComponentType::short_integer:
      return f(std::type_identity<std::int16_t>{});
    case ComponentType::unsigned_short:
      return f(std::type_identity<std::uint16_t>{});
    case ComponentType::unsigned_integer:
      return f(std::type_identity<std::uint32_t>{});
    default:
      return f(std::type_identity<float>{});
  }
}

/// In bytes.
std::size_t size_of(ComponentType type);

struct Elements {
  static constexpr std::size_t most_components = 4, of_matrix = 16;

  const char* first = nullptr;  ///< null: all are 0
  std::size_t count = 0, stride = 0, components = 0;
  ComponentType type = ComponentType::number;
  bool normalized = false;  ///< integers are from 0 to 1, or from -1 to 1

  bool has_whole_numbers() const {
    return type == ComponentType::unsigned_byte || type == ComponentType::unsigned_short ||
           type == ComponentType::unsigned_integer;
  }
};

struct Accessor {
  std::string place;  ///< such as "accessors[3]"
  Elements elements;
  Elements changed_indices{}, changed_values{};  ///< those that a sparse accessor has in place of others
};

/// Writes the first `most` components of each of the elements [first, last) to `values`, one after the other. Those
/// that the elements do not have are left as they are.
void read_elements(const Elements& elements, std::size_t first, std::size_t last, std::size_t most, double* values);

/// Calls store(i, components) for each element, with so many components at most. Threads call it at the same time.
template <std::size_t most = Elements::most_components, class Store>
void for_each_element(const Elements& elements, int threads, const Store& store) {
  for_each_chunk(elements.count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    // Some at a time, so that how they are stored is looked at once for all of them.
    std::array<std::array<double, most>, 128> some{};
    for (std::size_t begin = first; begin < last; begin += some.size()) {
      const std::size_t end = std::min(begin + some.size(), last);
      read_elements(elements, begin, end, most, some.front().data());
      for (std::size_t i = begin; i < end; ++i) store(i, some[i - begin]);
    }
  });
}

/// The same; what a sparse accessor changes is stored once more.
template <class Store>
void for_each_element(const Accessor& accessor, int threads, const Store& store) {
  for_each_element(accessor.elements, threads, store);
  if (accessor.changed_indices.count == 0) return;
  std::vector<std::size_t> indices(accessor.changed_indices.count);
  for_each_element(accessor.changed_indices, 1,
                   [&](std::size_t i, const auto& values) { indices[i] = static_cast<std::size_t>(values[0]); });
  for_each_element(accessor.changed_values, 1, [&](std::size_t i, const auto& values) {
    if (indices[i] >= accessor.elements.count)
      throw Error(accessor.place + ".sparse: changes element " + std::to_string(indices[i]) + " of " +
                  std::to_string(accessor.elements.count));
    store(indices[i], values);
  });
}

/// Element i alone, which must be there.
std::array<double, Elements::of_matrix> element_at(const Accessor& accessor, std::size_t i);

}  // namespace raytrace::gltf
