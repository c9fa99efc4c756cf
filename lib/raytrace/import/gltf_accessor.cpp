#include "raytrace/import/gltf_accessor.h"

#include <cstring>
#include <limits>
#include <type_traits>

namespace raytrace::gltf {

namespace {

template <class T>
void read_elements_of(const Elements& elements, std::size_t first, std::size_t last, std::size_t most, double* values) {
  const std::size_t components = std::min(elements.components, most);
  for (std::size_t i = first; i < last; ++i, values += most) {
    for (std::size_t c = 0; c < components; ++c) {
      T value{};
      std::memcpy(&value, elements.first + i * elements.stride + c * sizeof value, sizeof value);
      values[c] = static_cast<double>(value);
      if constexpr (std::is_integral_v<T>)
        if (elements.normalized) values[c] = std::max(values[c] / double{std::numeric_limits<T>::max()}, -1.0);
    }
  }
}

}  // namespace

std::size_t size_of(ComponentType type) {
  return with_component_type(type, []<class T>(std::type_identity<T>) { return sizeof(T); });
}

void read_elements(const Elements& elements, std::size_t first, std::size_t last, std::size_t most, double* values) {
  if (elements.first == nullptr) return;  // all are 0
  with_component_type(
      elements.type, [&]<class T>(std::type_identity<T>) { read_elements_of<T>(elements, first, last, most, values); });
}

std::array<double, Elements::of_matrix> element_at(const Accessor& accessor, std::size_t i) {
  std::array<double, Elements::of_matrix> result{};
  const auto read = [&](Elements elements, std::size_t number) {
    if (elements.first != nullptr) elements.first += number * elements.stride;
    elements.count = 1;
    for_each_element<Elements::of_matrix>(elements, 1, [&](std::size_t, const auto& values) { result = values; });
  };
  read(accessor.elements, i);
  std::size_t changed_by = accessor.changed_indices.count;  // the last, as where all are read
  for_each_element(accessor.changed_indices, 1, [&](std::size_t k, const auto& values) {
    if (values[0] == static_cast<double>(i)) changed_by = k;
  });
  if (changed_by < accessor.changed_indices.count) read(accessor.changed_values, changed_by);
  return result;
}

}  // namespace raytrace::gltf
