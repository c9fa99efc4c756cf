// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/EXT_mesh_gpu_instancing
#include "raytrace/import/gltf_instancing.h"

#include "raytrace/memory/process_status.h"
#include "raytrace/text/message.h"

namespace raytrace::gltf {

Affine affine_of(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                 const std::array<double, 3>& scale) {
  const auto& [x, y, z, w] = rotation;
  const double square = x * x + y * y + z * z + w * w, s = square > 0 ? 2 / square : 0;
  return {Vec3d{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)} * scale[0],
          Vec3d{s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)} * scale[1],
          Vec3d{s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)} * scale[2],
          {translation[0], translation[1], translation[2]}};
}

std::vector<Affine> read_instances(Document& document, const Item& instancing) {
  struct Place {
    std::array<double, 3> translation{0, 0, 0};
    std::array<double, 4> rotation{0, 0, 0, 1};
    std::array<double, 3> scale{1, 1, 1};
  };
  const Item attributes = instancing["attributes"];
  std::optional<std::vector<Place>> places;
  const auto read = [&]<std::size_t count>(const char* name, std::array<double, count> Place::* member) {
    const std::optional<Item> number = attributes.find(name);
    if (!number) return;
    const Accessor accessor = document.accessor(*number);
    const std::size_t instances = accessor.elements.count;
    if (accessor.elements.components != count)
      number->fail(accessor.place + " has elements of " + counted(accessor.elements.components, "number") +
                   ", and not of " + std::to_string(count));
    const std::size_t bytes = instances * (sizeof(Place) + sizeof(Affine));
    if (!places && bytes / 64 > document.size() && bytes > available_memory() / 4)
      number->fail("has " + std::to_string(instances) +
                   " instances, more than fit into a quarter of the memory that is available");
    if (!places) places.emplace(instances);
    if (places->size() != instances)
      number->fail(accessor.place + " has " + std::to_string(instances) + " elements, and there are " +
                   counted(places->size(), "instance"));
    for_each_element(accessor, document.threads(), [&](std::size_t i, const auto& values) {
      for (std::size_t k = 0; k < count; ++k) ((*places)[i].*member)[k] = values[k];
    });
  };
  read("TRANSLATION", &Place::translation);
  read("ROTATION", &Place::rotation);
  read("SCALE", &Place::scale);
  if (!places) return {Affine{}};
  std::vector<Affine> affines;
  affines.reserve(places->size());
  for (const Place& place : *places) affines.push_back(affine_of(place.translation, place.rotation, place.scale));
  return affines;
}

}  // namespace raytrace::gltf
