#include "raytrace/import/gltf_accessor.h"

namespace raytrace::gltf {

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
