#include "raytrace/scene/scene_tables.h"

#include <algorithm>
#include <bit>

#include "raytrace/math/gather.h"

namespace raytrace {

SceneTables::SceneTables(const SceneDescription& description, int threads)
    : viewplane_(description.viewplane), integrator_(description.integrator.value_or(Raycast::Parameters{})) {
  set_camera(description);
  add_lights(description);
  add_materials(description);
  geometry_ = std::make_unique<const GeometryTable>(description, first_material_, threads);
}

void SceneTables::set_camera(const SceneDescription& description) {
  for_each_type(Cameras{}, [&]<class Type>(std::type_identity<Type>) {
    const auto* parameters = std::get_if<typename Type::Parameters>(&description.camera);
    if (parameters == nullptr) return;
    const Kernel<Type> camera(*parameters, viewplane_);
    camera_ = std::make_unique<CameraOf<Kernel<Type>>>(camera);
    if constexpr (requires { camera.origin(); }) camera_origin_ = BufferOrigin{camera.origin()};
    const CameraMatrices matrices = Type::matrices(*parameters, viewplane_);
    const float* const m = matrices.world_to_camera;  // its third column turns points into -z, behind the camera
    viewing_direction_ = Vec3f(-m[2], -m[6], -m[10]);
  });
}

void SceneTables::add_lights(const SceneDescription& description) {
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light>) {
    for (const auto& item : std::get<LightItems<Light>>(description.lights)) {
      const Kernel<Light> light(item.parameters);
      if constexpr (Kernel<Light>::ambient) {
        ambient_radiance_ += light.radiance();
      } else {
        lights_.push_back(std::make_unique<LightSourceOf<Kernel<Light>>>(light));
        light_origins_.emplace_back();
        if (!light.shadows()) continue;
        if constexpr (requires { light.location(); }) light_origins_.back() = BufferOrigin{light.location()};
        if constexpr (requires { light.direction(); }) light_origins_.back() = BufferOrigin{light.direction(), true};
      }
    }
  });
}

void SceneTables::add_materials(const SceneDescription& description) {
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    constexpr std::size_t type = index_of<Material>(Materials{});
    std::vector<typename Kernel<Material>::template Bsdf<float>> bsdfs;
    for (const auto& item : std::get<MaterialItems<Material>>(description.materials))
      bsdfs.push_back(Kernel<Material>::bsdf(item.parameters));
    first_material_[type + 1] = first_material_[type] + static_cast<std::int32_t>(bsdfs.size());
    materials_[type] = std::make_unique<MaterialTableOf<Kernel<Material>>>(std::move(bsdfs));
  });
}

float SceneTables::largest_radiance() const {
  Rgb<float> light_radiance(0, 0, 0);
  for (const auto& light : lights_) light_radiance += light->largest_radiance();
  Rgb<float> largest(viewplane_.background);
  for (const auto& table : materials_)
    largest = max(largest, table->largest_radiance(ambient_radiance_, light_radiance));
  return std::max({largest.red, largest.green, largest.blue});
}

float SceneTables::largest_albedo() const {
  Rgb<float> largest(0, 0, 0);
  for (const auto& table : materials_) largest = max(largest, table->largest_albedo());
  return std::max({largest.red, largest.green, largest.blue});
}

template <class Answer>
Rgb<FloatN> SceneTables::by_material(const Hits& hits, const Answer& answer) const {
  if (hits.one_primitive) {
    const std::int32_t number = geometry_->first_material(hits);
    const auto type = std::upper_bound(first_material_.begin(), first_material_.end() - 1, number) - 1;
    return answer(*materials_[static_cast<std::size_t>(type - first_material_.begin())], LaneIndices(number - *type));
  }
  const IntN number = material(hits);
  Rgb<FloatN> result(FloatN(0), FloatN(0), FloatN(0));
  for (std::size_t type = 0; type < materials_.size(); ++type) {
    const IntN first(first_material_[type]), end(first_material_[type + 1]);
    const MaskN here = float_mask<FloatN>(number >= first) & float_mask<FloatN>(number < end);
    const std::uint32_t lanes = bits_of<FloatN>(here);
    if (lanes == 0) continue;
    const IntN index = number - first;
    // The other lanes follow the first of these, so that they read a material that exists.
    const LaneIndices indices =
        select_lanes(here, index, IntN(index.get(static_cast<std::size_t>(std::countr_zero(lanes)))));
    result = select(here, answer(*materials_[type], indices), result);
  }
  return result;
}

Rgb<FloatN> SceneTables::albedo(const Hits& hits) const {
  return by_material(hits,
                     [](const MaterialTable& table, const LaneIndices& materials) { return table.albedo(materials); });
}

Rgb<FloatN> SceneTables::shade(const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                               const Rgb<float>& ambient_radiance, std::span<const IncidentLight> lights) const {
  return by_material(hits, [&](const MaterialTable& table, const LaneIndices& materials) {
    return table.shade(materials, surface.wo, surface.ns, ambient_radiance, lights);
  });
}

}  // namespace raytrace
