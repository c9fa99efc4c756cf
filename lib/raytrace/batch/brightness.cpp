#include "raytrace/batch/brightness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "raytrace/batch/fit_camera.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/description/default_integrator.h"
#include "raytrace/output/auto_exposure.h"
#include "raytrace/render/renderer.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {

/// Shown as 3 of 255 in sRGB: nothing can be made out.
constexpr double nearly_black = 0.001;
/// Pictures of bright things before white may well have less than this; and their white is hardly so many times as
/// bright as what is shown as white.
constexpr double nearly_all = 0.98, much_brighter = 2;

bool is_black(const Rgb<double>& color) { return color.red == 0 && color.green == 0 && color.blue == 0; }

/// Whether pixels are light, and not normals, say.
bool shows_light(const SceneDescription& description) {
  const IntegratorParameters integrator = integrator_of(description);
  return std::holds_alternative<Raycast::Parameters>(integrator) ||
         std::holds_alternative<Path::Parameters>(integrator);
}

bool has_object_in_view(const Scene& scene, const SceneDescription& description) {
  RenderSettings settings;
  settings.samples = SampleRange{0, 1};
  settings.transparent = true;
  RayCounts rays;
  const Film film = render(scene, description, settings, rays);
  const Region& region = film.region();
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x)
      if (film.pixel(x, y).alpha > 0) return true;
  return false;
}

/// Of a camera that looks one way.
bool is_all_behind(const SceneDescription& description) {
  return std::visit(
      [&](const auto& camera) {
        if constexpr (requires { camera.viewdistance; }) {
          try {
            const Vec3d forward = camera.lookat - camera.eye;
            return reach_along(description, forward) < dot(camera.eye, forward);
          } catch (const SettingsError&) {  // no objects, or planes alone
          }
        }
        return false;
      },
      description.camera);
}

/// None where all is well: black normals, say.
std::optional<std::string> cause_of_black(const Scene& scene, const SceneDescription& description) {
  if (!has_object_in_view(scene, description))
    return is_all_behind(description) ? "all objects are behind the camera; move its <eye> or <lookat>"
                                      : "no object is in view; move the camera's <eye> or <lookat>";
  if (!shows_light(description)) return std::nullopt;
  return "no light reaches what is in view; a light or the camera may be inside an object: --integrator normals shows "
         "what is in view";
}

/// Or one that may shine, which textures and files know.
bool has_shining_object(const ObjectLists& objects) {
  bool shines = false;
  for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
    for (const ObjectItem<T>& item : std::get<ObjectItems<T>>(objects)) {
      const auto is_of = [&]<class... Types>(TypeList<Types...>) {
        return ((item.material.type == index_of<Types>(Materials{})) || ...);
      };
      if (is_of(TypeList<Emissive, OpenPbr, Fog>{}) || item.material == no_material) shines = true;
    }
  });
  return shines;
}

struct Extremes {
  double brightest = 0;  ///< the largest colour channel, in radiance
  bool nearly_all_above_white = false;
  bool has_shadows = false;  ///< a transparent picture's pixels that are not empty
};

/// white: the radiance that is shown as white. Looks at no more pixels than it takes to know that both are moderate.
Extremes extremes_of(const Film& film, double white) {
  Extremes extremes;
  const Region& region = film.region();
  const auto most_below = static_cast<std::uint64_t>((1 - nearly_all) * static_cast<double>(region.pixels()));
  std::uint64_t below = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const Pixel pixel = film.pixel(x, y);
      extremes.brightest = std::max({extremes.brightest, double{pixel.red}, double{pixel.green}, double{pixel.blue}});
      extremes.has_shadows = extremes.has_shadows || (film.settings().transparent && pixel.alpha > 0);
      if (!(std::min({pixel.red, pixel.green, pixel.blue}) > much_brighter * white)) ++below;
      if (below > most_below && extremes.brightest >= nearly_black * white) return extremes;
    }
  extremes.nearly_all_above_white = below <= most_below;
  return extremes;
}

}  // namespace

std::optional<std::string> no_light_warning(const SceneDescription& description) {
  if (!shows_light(description) || !is_black(description.viewplane.background)) return std::nullopt;
  bool shines = has_shining_object(description.objects);
  for (const Group& group : description.groups) shines = shines || has_shining_object(group.objects);
  for_each_type(Lights{}, [&]<class T>(std::type_identity<T>) {
    for (const auto& item : std::get<LightItems<T>>(description.lights))
      shines = shines || item.parameters.scaleradiance > 0;
  });
  if (shines) return std::nullopt;
  return "the picture will be black: the scene has no light; add one to <lights>, or an object of an <emissive> "
         "material";
}

std::optional<std::string> brightness_warning(const Film& film, const Scene& scene, const SceneDescription& description,
                                              const std::optional<ShownAs>& shown) {
  const double white = shown ? std::exp2(-shown->exposure) : 1;
  const Extremes extremes = extremes_of(film, white);
  if (extremes.brightest <= 0) {
    if (no_light_warning(description) || extremes.has_shadows) return std::nullopt;
    const std::optional<std::string> cause = cause_of_black(scene, description);
    return cause ? std::optional("the picture is black: " + *cause) : std::nullopt;
  }
  if (!shows_light(description) || !shown) return std::nullopt;
  if (extremes.brightest < nearly_black * white)
    return formatted("the picture is nearly black: its brightest pixel has %.2g; --exposure %g shows it",
                     extremes.brightest, automatic_exposure(film));
  if (shown->clips && extremes.nearly_all_above_white)
    return formatted("nearly all of the picture is much brighter than white; --exposure %g shows it",
                     automatic_exposure(film));
  return std::nullopt;
}

}  // namespace raytrace
