#include "raytrace/scene/traced_scene.h"

#include <algorithm>

#include "raytrace/integrators/render_pixels.h"

namespace raytrace {

TracedScene::TracedScene(const SceneDescription& description, int threads, const char* isa_name, const char* embree_isa)
    : viewplane_(description.viewplane), accelerator_(description, threads, embree_isa), isa_name_(isa_name) {
  for_each_type(Cameras{}, [&](auto type) {
    using Type = typename decltype(type)::type;
    if (const auto* parameters = std::get_if<typename Type::Parameters>(&description.camera)) {
      camera_ = std::make_unique<CameraOf<Type>>(Type(*parameters, viewplane_.pixelsize));
      const CameraMatrices matrices = Type::matrices(*parameters, viewplane_);
      const float* const m = matrices.world_to_camera;  // its third column turns points into -z, behind the camera
      viewing_direction_ = Vec3f(-m[2], -m[6], -m[10]);
    }
  });

  for_each_type(Lights{}, [&](auto type) {
    using Light = typename decltype(type)::type;
    for (const auto& item : std::get<LightItems<Light>>(description.lights)) {
      const Light light(item.parameters);
      if constexpr (Light::ambient) {
        ambient_radiance_ += light.radiance();
      } else {
        lights_.push_back(std::make_unique<LightSourceOf<Light>>(light));
      }
    }
  });

  std::int32_t material_count = 0;
  for_each_type(Materials{}, [&](auto type) {
    using Material = typename decltype(type)::type;
    first_material_[index_of<Material>(Materials{})] = material_count;
    std::vector<typename Material::template Brdfs<float>> brdfs;
    for (const auto& item : std::get<MaterialItems<Material>>(description.materials))
      brdfs.push_back(Material::brdfs(item.parameters));
    material_count += static_cast<std::int32_t>(brdfs.size());
    materials_[index_of<Material>(Materials{})] = std::make_unique<MaterialTableOf<Material>>(std::move(brdfs));
  });

  Rgb<float> light_radiance(0, 0, 0);
  for (const auto& light : lights_) light_radiance += light->largest_radiance();
  Rgb<float> largest(viewplane_.background);
  for (const auto& table : materials_)
    largest = max(largest, table->largest_radiance(ambient_radiance_, light_radiance));
  largest_radiance_ = std::max({largest.red, largest.green, largest.blue});

  object_materials_.reserve(accelerator_.primitive_count());
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    first_object_[index_of<Shape>(Shapes{})] = static_cast<std::int32_t>(object_materials_.size());
    for (const auto& item : std::get<ObjectItems<Shape>>(description.objects))
      object_materials_.push_back(
          {static_cast<std::int32_t>(item.material.kind), static_cast<std::int32_t>(item.material.index)});
  });
}

float TracedScene::largest_albedo() const {
  Rgb<float> largest(0, 0, 0);
  for (const auto& table : materials_) largest = max(largest, table->largest_albedo());
  return std::max({largest.red, largest.green, largest.blue});
}

IntN TracedScene::object(const Hits& hits) const {
  const auto first_lane = static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(hits.hit)));
  // Lanes that hit nothing follow the first that did.
  const IntN shape = select_lanes(hits.hit, std::bit_cast<IntN>(hits.kind),
                                  IntN(static_cast<std::int32_t>(hits.kind.get(first_lane))));
  return gather(first_object_.data(), shape) +
         select_lanes(hits.hit, hits.primitive, IntN(hits.primitive.get(first_lane)));
}

TracedScene::ObjectMaterial<IntN> TracedScene::materials(const Hits& hits) const {
  return gather_records<ObjectMaterial, IntN>(object_materials_.data(), object(hits));
}

IntN TracedScene::material(const Hits& hits) const {
  const ObjectMaterial<IntN> material = materials(hits);
  return gather(first_material_.data(), material.kind) + material.index;
}

template <class Answer>
Rgb<FloatN> TracedScene::by_material(const Hits& hits, const Answer& answer) const {
  const ObjectMaterial<IntN> material = materials(hits);
  Rgb<FloatN> result(FloatN(0), FloatN(0), FloatN(0));
  for (std::uint32_t lanes_left = bits_of<FloatN>(hits.hit); lanes_left != 0;) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes_left));
    const std::int32_t kind = material.kind.get(lane);
    const MaskN here = float_mask<FloatN>(material.kind == IntN(kind));
    const IntN index = select_lanes(here, material.index, IntN(material.index.get(lane)));
    result = select(here, answer(*materials_[static_cast<std::size_t>(kind)], index), result);
    lanes_left &= ~bits_of<FloatN>(here);
  }
  return result;
}

Rgb<FloatN> TracedScene::albedo(const Hits& hits) const {
  return by_material(hits, [](const MaterialTable& table, const IntN& index) { return table.albedo(index); });
}

Rgb<FloatN> TracedScene::shade(const Hits& hits, const Vec3<FloatN>& wo, const Vec3<FloatN>& normal,
                               const Rgb<float>& ambient_radiance, std::span<const ArrivingLight> lights) const {
  return by_material(hits, [&](const MaterialTable& table, const IntN& index) {
    return table.shade(index, wo, normal, ambient_radiance, lights);
  });
}

RenderReport TracedScene::render_region(const Region& region, std::uint32_t samples, Film& film,
                                        const std::atomic<bool>* stop) const {
  return render_pixels(*this, region, samples, film, stop);
}

SceneStatistics TracedScene::statistics() const {
  SceneStatistics statistics;
  statistics.primitives = accelerator_.primitive_count();
  statistics.bvh_bytes = accelerator_.bvh_bytes();
  statistics.isa = isa_name_;
  statistics.lanes = native_lanes;
  statistics.embree_version = accelerator_.embree_version();
  return statistics;
}

}  // namespace raytrace
