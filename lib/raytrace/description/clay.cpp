#include "raytrace/description/clay.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "raytrace/description/default_integrator.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Light grey to the eye, as plaster in a studio is, and what models without materials are of. White would hide forms
/// in the light that it sends on into all shadows; the 18 % of a photographer's card, in dark ones.
constexpr Rgb<double> clay{0.5, 0.5, 0.5};

bool is_textured(const std::vector<TextureUse>& textures, const Fields& fields, std::string_view field) {
  return std::ranges::any_of(textures, [&](const TextureUse& use) { return fields[use.field].name == field; });
}

/// What light comes through, or what is nothing but light.
template <class Material>
bool stays(const MaterialItem<Material>&) {
  return std::is_same_v<Material, Emissive> || std::is_same_v<Material, Dielectric> || std::is_same_v<Material, Fog>;
}
bool stays(const MaterialItem<OpenPbr>& item) {
  const bool is_metal = item.parameters.base_metalness == 1 &&
                        !is_textured(item.textures, element_type<OpenPbr>().fields, "base_metalness");
  return OpenPbr::refracts(item.parameters) && !is_metal;
}

template <class Material>
bool shines(const MaterialItem<Material>&) {
  return false;
}
bool shines(const MaterialItem<OpenPbr>& item) {
  const Rgb<double>& color = item.parameters.emission_color;
  return item.parameters.emission_luminance > 0 && (color.red > 0 || color.green > 0 || color.blue > 0);
}

/// The same with other parameters, and the textures of these fields alone.
template <class Clay, class Material>
MaterialItem<Clay> made_of(const MaterialItem<Material>& item, const typename Clay::Parameters& parameters,
                           std::initializer_list<std::string_view> fields) {
  MaterialItem<Clay> made{parameters, item.name, item.line, item.imported, {}, item.column};
  for (TextureUse use : item.textures) {
    const std::string_view field = element_type<Material>().fields[use.field].name;
    if (std::ranges::find(fields, field) == fields.end()) continue;
    use.field = static_cast<std::uint32_t>(find_field(element_type<Clay>().fields, field));
    made.textures.push_back(use);
  }
  return made;
}

/// How much of the ambient light it reflects, to all that it scatters: scenes whose ambient light is strong have little
/// here, and would be overexposed with all of it.
template <class Material>
double ambient_share(const typename Material::Parameters& parameters) {
  if constexpr (requires { parameters.ka, parameters.kd; }) {
    if (parameters.ka < parameters.kd) return parameters.ka / parameters.kd;
  }
  return 1;
}

template <class Material>
MaterialItem<Matte> matte(const MaterialItem<Material>& item) {
  Matte::Parameters parameters{ambient_share<Material>(item.parameters), 1, clay};
  if constexpr (requires { item.parameters.opacity; }) parameters.opacity = item.parameters.opacity;
  return made_of<Matte>(item, parameters, {opacity_field});
}

/// It may shine in a few places of a texture only, as the eyes of a robot do: the rest is clay.
MaterialItem<OpenPbr> shining(const MaterialItem<OpenPbr>& item) {
  const OpenPbr::Parameters& from = item.parameters;
  OpenPbr::Parameters parameters;
  // What reflected nothing, as glTF's unlit pictures do, is nothing but light.
  const bool is_light_alone = from.base_weight == 0 && from.specular_weight == 0;
  parameters.base_weight = is_light_alone ? 0 : 1;
  parameters.base_color = clay;
  parameters.specular_weight = 0;
  parameters.emission_luminance = from.emission_luminance;
  parameters.emission_color = from.emission_color;
  parameters.geometry_thin_walled = from.geometry_thin_walled;
  parameters.group = from.group;
  parameters.opacity = from.opacity;
  return made_of<OpenPbr>(item, parameters, {"emission_luminance", "emission_color", opacity_field});
}

/// The lists of a scene's materials, made anew, and where each of the old ones went.
class ClayMaterials {
 public:
  ClayMaterials(const SceneDescription& scene, const std::vector<std::string>& kept) {
    for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
      auto& places = places_[index_of<Material>(Materials{})];
      for (const auto& item : std::get<MaterialItems<Material>>(scene.materials)) {
        if (stays(item) || std::ranges::find(kept, item.name) != kept.end()) {
          places.push_back(add<Material>(item));
        } else if (shines(item)) {
          if constexpr (std::is_same_v<Material, OpenPbr>) places.push_back(add<OpenPbr>(shining(item)));
        } else {
          places.push_back(add<Matte>(matte(item)));
        }
      }
    });
  }

  void give_to(SceneDescription& scene) && {
    scene.materials = std::move(items_);
    give_to(scene.objects);
    for (Group& group : scene.groups) give_to(group.objects);
  }

 private:
  template <class Material>
  MaterialReference add(MaterialItem<Material> item) {
    auto& items = std::get<MaterialItems<Material>>(items_);
    items.push_back(std::move(item));
    return {static_cast<std::uint32_t>(index_of<Material>(Materials{})), static_cast<std::uint32_t>(items.size() - 1)};
  }

  void move(MaterialReference& material) const {
    if (material == no_material) return;
    material = places_.at(material.type).at(material.index);
  }

  void give_to(ObjectLists& objects) const {
    const auto move_all = [&](auto& items) {
      for (auto& item : items) {
        move(item.material);
        if constexpr (requires { item.materials; })
          for (MaterialReference& material : item.materials) move(material);
      }
    };
    std::apply([&](auto&... lists) { (move_all(lists), ...); }, objects);
  }

  TupleOf<Materials, MaterialItems>::type items_;
  std::array<std::vector<MaterialReference>, Materials::size> places_;
};

/// "'a', 'b' and 3 more"
std::string first_of(const std::vector<std::string_view>& names) {
  constexpr std::size_t most = 10;
  std::string text = names.empty() ? "none" : "";
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

}  // namespace

OptionalMessage make_clay(SceneDescription& scene, const std::vector<std::string>& kept) {
  std::vector<std::string_view> names;
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    for (const auto& item : std::get<MaterialItems<Material>>(scene.materials)) names.push_back(item.name);
  });
  for (const std::string& name : kept) {
    if (std::ranges::find(names, name) != names.end()) continue;
    const std::string_view nearest = nearest_name(name, names);
    const std::string start = "there is no material " + in_quotes(name);
    return start + (nearest.empty() ? "; there are " + first_of(names) : "; did you mean " + in_quotes(nearest) + "?");
  }
  // Clay alone would not ask for paths, and the light would be another.
  scene.integrator = integrator_of(scene);
  ClayMaterials(scene, kept).give_to(scene);
  return std::nullopt;
}

}  // namespace raytrace
