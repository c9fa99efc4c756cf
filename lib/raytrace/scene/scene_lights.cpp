// The lights of a scene as data, in the order of their groups.
#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "raytrace/description/light_groups.h"
#include "raytrace/lights/falloff.h"
#include "raytrace/lights/ground_picture.h"
#include "raytrace/lights/sky_model.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

/// By what a scene that is far smaller than 1 must grow to be as large; of others, 1. from_eye: how far away a light
/// is; view: what the camera looks at, which may be but a direction; objects: how far those with bounds reach, if all
/// have some.
double enlargement(double from_eye, double view, std::optional<double> objects) {
  constexpr double small = 0x1p-10, smallest = 0x1p-48;
  const double size = std::max(from_eye, objects.value_or(view));
  return size < small ? 1 / std::max(size, smallest) : 1;
}

}  // namespace

template <class LightKernel, class Parameters>
void SceneTables::add_light_bounds(const LightKernel& light, const Parameters& parameters, const Vec3d& eye) {
  const Rgb<float> radiance = abs(light.largest_radiance());
  double far = 1, near = 1;
  if constexpr (requires { light.falls_off(); })
    if (light.falls_off()) {
      far = std::max(1.0, length(parameters.location - eye));
      near = std::max(0x1p-10, far * 0x1p-13);
    }
  light_bounds_.usual += radiance;
  light_bounds_.largest += radiance * static_cast<float>(1 / (near * near));
  const auto add_dimmest = [&](float& dimmest, float channel) {
    if (channel > 0) dimmest = std::min(dimmest, channel * static_cast<float>(1 / (far * far)));
  };
  add_dimmest(light_bounds_.dimmest.red, radiance.red);
  add_dimmest(light_bounds_.dimmest.green, radiance.green);
  add_dimmest(light_bounds_.dimmest.blue, radiance.blue);
}

void SceneTables::add_lights(const SceneDescription& description, int threads) {
  const auto [eye, lookat] =
      std::visit([](const auto& camera) { return std::pair(camera.eye, camera.lookat); }, description.camera);
  const double view = length(lookat - eye);
  const Vec3d eye_from_origin = eye - origin_;
  std::optional<double> reach;
  if (const BoundingSphere objects = geometry_->bounding_sphere(); objects.radius >= 0)
    reach = length(eye_from_origin - objects.center) + objects.radius;
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    if constexpr (!requires { &Kernel<Shape>::bounds; })
      if (reach && !geometry_->table<Shape>().records.empty()) reach = std::max(*reach, view);
  });
  const std::vector<std::string> names = light_group_names(description);
  const auto find_group = [&](const Reference& group) {
    return static_cast<std::int32_t>(find_light_group(names, group));
  };
  const auto group_of = [&](const auto& item) { return find_group(item.parameters.group); };
  const auto group_of_light = [&](const auto& item) {
    if constexpr (requires { item.parameters.group_of_sun(); })
      return find_group(item.parameters.group_of_sun());
    else
      return group_of(item);
  };
  for (const auto& item : std::get<LightItems<EnvironmentLight>>(description.lights)) {
    LightItem<EnvironmentLight> light = item;
    if (light.parameters.ground != 1) {
      light.parameters.file.path = "ground";
      light.image.color =
          std::make_shared<const TexelImage>(picture_of_ground(light.parameters.ground), false, threads);
    }
    environment_.emplace(light, threads);
    environment_group_ = group_of(item);
  }
  for (const auto& item : std::get<LightItems<SkyLight>>(description.lights)) {
    environment_group_ = group_of(item);
    LightItem<EnvironmentLight> sky{{.file = {"sky"}, .visible = item.parameters.visible}};
    sky.image.color = std::make_shared<const TexelImage>(SkyModel(item.parameters, threads).picture(), false, threads);
    environment_.emplace(sky, threads);
  }
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light>) {
    if constexpr (!std::is_same_v<Light, EnvironmentLight>)
      for (const auto& item : std::get<LightItems<Light>>(description.lights)) {
        const auto light_of = [&](const typename Light::Parameters& parameters) {
          if constexpr (requires { item.photometry; })
            return Kernel<Light>(parameters, item.photometry);
          else
            return Kernel<Light>(parameters);
        };
        const auto light = light_of(moved<Light>(item.parameters));
        if constexpr (Kernel<Light>::ambient) {
          light_groups_[static_cast<std::size_t>(group_of_light(item))].ambient_radiance += light.radiance();
          light_bounds_.ambient += abs(light.radiance());
        } else {
          auto bounded = item.parameters;
          double times = 1;
          if constexpr (requires { bounded.falloff; }) {
            // The radiance at distance 1 says nothing of a small scene.
            if (bounded.falloff == Falloff::inverse_square)
              times = enlargement(length(bounded.location - eye), view, reach);
            bounded.location = bounded.location * times;
            bounded.scaleradiance *= times * times;
          }
          add_light_bounds(light_of(bounded), bounded, eye * times);
          lights_.push_back(std::make_unique<LightSourceOf<Kernel<Light>>>(light));
          groups_of_lights_.push_back(group_of_light(item));
          light_origins_.emplace_back();
          has_sampled_lights_ |= lights_.back()->takes_samples();
          if (!light.shadows() || lights_.back()->takes_samples()) continue;
          if constexpr (requires { light.location(); }) light_origins_.back() = BufferOrigin{light.location()};
          if constexpr (requires { light.direction(); }) light_origins_.back() = BufferOrigin{light.direction(), true};
        }
      }
  });
  sort_lights();
}

void SceneTables::sort_lights() {
  const auto* const path = std::get_if<Path::Parameters>(&integrator_);
  std::vector<std::size_t> falling_off(light_groups_.size(), 0);  // of each group
  const auto group_of = [&](std::size_t light) { return static_cast<std::size_t>(groups_of_lights_[light]); };
  for (std::size_t i = 0; i < lights_.size(); ++i) falling_off[group_of(i)] += lights_[i]->falls_off() ? 1 : 0;
  const auto is_drawn = [&](std::size_t light) {
    return path != nullptr && path->maxdepth > 1 && lights_[light]->falls_off() &&
           falling_off[group_of(light)] >= ManyLights::least;
  };
  const auto place = [&](std::size_t light) { return std::pair(groups_of_lights_[light], is_drawn(light)); };
  std::vector<std::size_t> order(lights_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  const auto sorted = [&](auto& values) {
    std::remove_reference_t<decltype(values)> result;
    for (const std::size_t from : order) result.push_back(std::move(values[from]));
    values = std::move(result);
  };
  sorted(lights_);
  sorted(light_origins_);
  sorted(groups_of_lights_);
  for (std::size_t i = 0; i < light_groups_.size(); ++i) {
    const auto [first, last] =
        std::equal_range(groups_of_lights_.begin(), groups_of_lights_.end(), static_cast<std::int32_t>(i));
    LightGroup& group = light_groups_[i];
    group.first_light = static_cast<std::size_t>(first - groups_of_lights_.begin());
    group.last_light = static_cast<std::size_t>(last - groups_of_lights_.begin());
    group.first_drawn = group.last_light;
    if (group.first_light == group.last_light || !is_drawn(group.last_light - 1)) continue;
    group.first_drawn -= falling_off[i];
    group.drawn.emplace();
    for (std::size_t light = group.first_drawn; light < group.last_light; ++light) {
      lights_[light]->add_to(*group.drawn);
      if (falling_off[i] > ManyLights::most_asked) light_origins_[light].reset();
    }
    group.drawn->build(path->lightsampling);
    if (!group.drawn->empty()) continue;
    group.drawn.reset();
    group.last_light = group.first_drawn;
  }
}

}  // namespace raytrace
