#include "raytrace/scene/traced_scene.h"

#include <algorithm>

#include "raytrace/integrators/render_pixels.h"

namespace raytrace {

TracedScene::TracedScene(const SceneDescription& description, int threads, const char* isa_name, const char* embree_isa)
    : viewplane_(description.viewplane), accelerator_(description, threads, embree_isa), isa_name_(isa_name) {
  for_each_type(Cameras{}, [&](auto type) {
    using Type = typename decltype(type)::type;
    if (const auto* parameters = std::get_if<typename Type::Parameters>(&description.camera))
      camera_ = std::make_unique<CameraOf<Type>>(Type(*parameters, viewplane_.pixelsize));
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

  for_each_type(Materials{}, [&](auto type) {
    using Material = typename decltype(type)::type;
    std::vector<typename Material::template Brdfs<float>> brdfs;
    for (const auto& item : std::get<MaterialItems<Material>>(description.materials))
      brdfs.push_back(Material::brdfs(item.parameters));
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

Rgb<FloatN> TracedScene::shade(const Hits& hits, const Vec3<FloatN>& wo, const Vec3<FloatN>& normal,
                               const Rgb<float>& ambient_radiance, std::span<const ArrivingLight> lights) const {
  const std::uint32_t hit_lanes = bits_of<FloatN>(hits.hit);
  const auto first_lane = static_cast<std::size_t>(std::countr_zero(hit_lanes));
  // Lanes that hit nothing follow the first that did.
  const IntN shape = select_lanes(hits.hit, std::bit_cast<IntN>(hits.kind),
                                  IntN(static_cast<std::int32_t>(hits.kind.get(first_lane))));
  const IntN object = gather(first_object_.data(), shape) +
                      select_lanes(hits.hit, hits.primitive, IntN(hits.primitive.get(first_lane)));
  const auto material = gather_records<ObjectMaterial, IntN>(object_materials_.data(), object);

  Rgb<FloatN> radiance(FloatN(0), FloatN(0), FloatN(0));
  for (std::uint32_t lanes_left = hit_lanes; lanes_left != 0;) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes_left));
    const std::int32_t kind = material.kind.get(lane);
    const MaskN here = float_mask<FloatN>(material.kind == IntN(kind));
    const IntN index = select_lanes(here, material.index, IntN(material.index.get(lane)));
    const Rgb<FloatN> shaded =
        materials_[static_cast<std::size_t>(kind)]->shade(index, wo, normal, ambient_radiance, lights);
    radiance = select(here, shaded, radiance);
    lanes_left &= ~bits_of<FloatN>(here);
  }
  return radiance;
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
