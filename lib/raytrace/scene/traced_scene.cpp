#include "raytrace/scene/traced_scene.h"

#include <algorithm>

#include "raytrace/integrators/render_pixels.h"
#include "raytrace/math/gather.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

TracedScene::TracedScene(const SceneDescription& description, int threads, const char* isa_name, const char* embree_isa)
    : viewplane_(description.viewplane), accelerator_(description, threads, embree_isa), isa_name_(isa_name) {
  std::vector<std::optional<BufferOrigin>> vantages(1);
  for_each_type(Cameras{}, [&](auto type) {
    using Type = typename decltype(type)::type;
    if (const auto* parameters = std::get_if<typename Type::Parameters>(&description.camera)) {
      const Type camera(*parameters, viewplane_.pixelsize);
      camera_ = std::make_unique<CameraOf<Type>>(camera);
      if constexpr (requires { camera.origin(); }) vantages[0] = BufferOrigin{camera.origin()};
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
        vantages.emplace_back();
        if (!light.shadows()) continue;
        if constexpr (requires { light.location(); }) vantages.back() = BufferOrigin{light.location()};
        if constexpr (requires { light.direction(); }) vantages.back() = BufferOrigin{light.direction(), true};
      }
    }
  });

  look_from(std::move(vantages), threads);

  for_each_type(Materials{}, [&](auto type) {
    using Material = typename decltype(type)::type;
    constexpr std::size_t kind = index_of<Material>(Materials{});
    std::vector<typename Material::template Brdfs<float>> brdfs;
    for (const auto& item : std::get<MaterialItems<Material>>(description.materials))
      brdfs.push_back(Material::brdfs(item.parameters));
    first_material_[kind + 1] = first_material_[kind] + static_cast<std::int32_t>(brdfs.size());
    materials_[kind] = std::make_unique<MaterialTableOf<Material>>(std::move(brdfs));
  });

  Rgb<float> light_radiance(0, 0, 0);
  for (const auto& light : lights_) light_radiance += light->largest_radiance();
  Rgb<float> largest(viewplane_.background);
  for (const auto& table : materials_)
    largest = max(largest, table->largest_radiance(ambient_radiance_, light_radiance));
  largest_radiance_ = std::max({largest.red, largest.green, largest.blue});

  object_materials_.resize(accelerator_.primitive_count());
  std::size_t first_object = 0;
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    const auto& items = std::get<ObjectItems<Shape>>(description.objects);
    first_object_[index_of<Shape>(Shapes{})] = static_cast<std::int32_t>(first_object);
    for_each_chunk(items.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const MaterialReference& material = items[i].material;
        object_materials_[first_object + i] =
            first_material_[material.kind] + static_cast<std::int32_t>(material.index);
      }
    });
    first_object += items.size();
  });
}

void TracedScene::look_from(std::vector<std::optional<BufferOrigin>> vantages, int threads) {
  // For an object it takes about as long as is saved for the rays of half a pixel, with some samples. It takes memory,
  // too: some 100 bytes. Both by what all pieces of a picture have in common.
  constexpr std::uint64_t objects_a_pixel = 2, most_objects = 1U << 21U;
  const auto pixels = static_cast<std::uint64_t>(viewplane_.hres) * static_cast<std::uint64_t>(viewplane_.vres);
  const std::uint64_t affordable = std::min(objects_a_pixel * pixels, most_objects);
  std::uint64_t objects = 0;
  for (auto& vantage : vantages) {
    if (!vantage) continue;
    objects += accelerator_.primitive_count();
    if (objects > affordable) vantage.reset();
  }
  seen_from_ = accelerator_.seen_from(vantages, threads);

  // That of few takes no time. The others wait for a ray that wants them: there may be none.
  constexpr std::uint64_t few_objects = 1U << 14U;
  if (accelerator_.primitive_count() <= few_objects) accelerator_.embree_scene();
}

float TracedScene::largest_albedo() const {
  Rgb<float> largest(0, 0, 0);
  for (const auto& table : materials_) largest = max(largest, table->largest_albedo());
  return std::max({largest.red, largest.green, largest.blue});
}

IntN TracedScene::object(const Hits& hits) const {
  // Lanes that hit nothing follow the first that did.
  const IntN primitive = select_lanes(hits.hit, hits.primitive, IntN(hits.first_primitive));
  if (hits.one_shape_type) return primitive + IntN(first_object_[hits.first_shape_type]);
  const IntN kind =
      select_lanes(hits.hit, same_bits<IntN>(hits.shape_type), IntN(static_cast<std::int32_t>(hits.first_shape_type)));
  return primitive + gather(first_object_.data(), kind);
}

IntN TracedScene::material(const Hits& hits) const { return gather(object_materials_.data(), object(hits)); }

template <class Answer>
Rgb<FloatN> TracedScene::by_material(const Hits& hits, const Answer& answer) const {
  if (hits.one_object) {
    const std::int32_t object = first_object_[hits.first_shape_type] + hits.first_primitive;
    const std::int32_t number = object_materials_[static_cast<std::size_t>(object)];
    const auto kind = std::upper_bound(first_material_.begin(), first_material_.end() - 1, number) - 1;
    return answer(*materials_[static_cast<std::size_t>(kind - first_material_.begin())], LaneIndices(number - *kind));
  }
  const IntN number = material(hits);
  Rgb<FloatN> result(FloatN(0), FloatN(0), FloatN(0));
  for (std::size_t kind = 0; kind < materials_.size(); ++kind) {
    const IntN first(first_material_[kind]), end(first_material_[kind + 1]);
    const MaskN here = float_mask<FloatN>(number >= first) & float_mask<FloatN>(number < end);
    const std::uint32_t lanes = bits_of<FloatN>(here);
    if (lanes == 0) continue;
    const IntN place = number - first;
    // The other lanes follow the first of these, so that they read a material that exists.
    const LaneIndices places =
        select_lanes(here, place, IntN(place.get(static_cast<std::size_t>(std::countr_zero(lanes)))));
    result = select(here, answer(*materials_[kind], places), result);
  }
  return result;
}

Rgb<FloatN> TracedScene::albedo(const Hits& hits) const {
  return by_material(hits, [](const MaterialTable& table, const LaneIndices& places) { return table.albedo(places); });
}

Rgb<FloatN> TracedScene::shade(const Hits& hits, const Vec3<FloatN>& direction, const Vec3<FloatN>& normal,
                               const Rgb<float>& ambient_radiance, std::span<const ArrivingLight> lights) const {
  return by_material(hits, [&](const MaterialTable& table, const LaneIndices& places) {
    return table.shade(places, direction, normal, ambient_radiance, lights);
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
  statistics.lanes = packet_lanes;
  statistics.embree_version = accelerator_.embree_version();
  return statistics;
}

}  // namespace raytrace
