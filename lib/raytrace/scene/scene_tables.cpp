#include "raytrace/scene/scene_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "raytrace/description/default_integrator.h"
#include "raytrace/description/light_groups.h"
#include "raytrace/math/float_origin.h"
#include "raytrace/math/gather.h"

namespace raytrace {

extern template class MaterialTableOf<OpenPbr>;

namespace {

Vec3d origin_of(const CameraParameters& camera) {
  return std::visit(
      [](const auto& parameters) {
        const double away = std::min(length(parameters.eye), length(parameters.lookat));
        const double view = length(parameters.lookat - parameters.eye);
        return away > near_the_origin || is_coarse(away, view) ? rounded_origin(parameters.eye, view) : Vec3d(0, 0, 0);
      },
      camera);
}

bool have_vertex_alphas(const SceneDescription& description) {
  const auto any_in = [](const ObjectLists& objects) {
    return std::ranges::any_of(std::get<ObjectItems<Mesh>>(objects), [](const ObjectItem<Mesh>& mesh) {
      return !mesh.data->alphas.empty() ||
             std::ranges::any_of(mesh.data->copies, [](const auto& copies) { return !copies.mesh->alphas.empty(); });
    });
  };
  return any_in(description.objects) ||
         std::ranges::any_of(description.groups, [&](const Group& group) { return any_in(group.objects); });
}

/// Whether an object that the camera does not see has such a material; of instances, any object of any group may be in.
template <class HasMedium>
bool have_invisible_media(const SceneDescription& description, const HasMedium& has_medium) {
  const auto any_in = [&](const ObjectLists& objects, const auto& is_meant) {
    bool any = false;
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      for (const auto& item : std::get<ObjectItems<T>>(objects)) any = any || is_meant(item);
    });
    return any;
  };
  const auto any_of_all = [&](const auto& is_meant) {
    return any_in(description.objects, is_meant) ||
           std::ranges::any_of(description.groups, [&](const Group& group) { return any_in(group.objects, is_meant); });
  };
  const auto has_own = [&](const auto& item) {
    if constexpr (requires { item.materials; })
      return std::ranges::any_of(item.materials, has_medium);
    else
      return item.material != no_material && has_medium(item.material);
  };
  return any_of_all([&](const auto& item) {
    if (item.visible) return false;
    if (has_own(item)) return true;
    return requires { item.motion; } && item.material == no_material && any_of_all(has_own);
  });
}

}  // namespace

SceneTables::SceneTables(const SceneDescription& description, int threads, const TexturePointOf& point_of)
    : origin_(origin_of(description.camera)),
      viewplane_(description.viewplane),
      pixel_filter_(description.viewplane),
      integrator_(integrator_of(description)),
      parts_(description) {
  for (std::string& name : light_group_names(description)) light_groups_.push_back({std::move(name)});
  textures_ = std::make_unique<const TextureTable>(description);
  has_second_uvset_ = textures_->has_second_uvset();
  has_object_space_ = textures_->has_object_space();
  has_vertex_alphas_ = have_vertex_alphas(description);
  add_materials(description);
  const MeshMaterials materials = mesh_materials(description);
  has_vertex_tangents_ = !materials.want_tangents[0].empty() || !materials.want_tangents[1].empty();
  geometry_ = std::make_unique<const GeometryTable>(description, origin_, materials, has_object_space_, threads);
  if (camera_is_far_from(geometry_->bounding_sphere(), description)) {
    if (length(origin_) > 0) {
      const auto [center, radius] = geometry_->bounding_sphere();
      origin_ += rounded_origin(center, radius);
      geometry_ = std::make_unique<const GeometryTable>(description, origin_, materials, has_object_space_, threads);
    }
    camera_target_ = geometry_->bounding_sphere();
  }
  set_camera(description);
  add_lights(description, threads);
  used_materials_ = geometry_->used_materials(first_material_.back());
  std::vector<MaterialEmission> emissions;
  std::vector<std::optional<Medium>> media;
  for (std::size_t i = 0; i < details_.size(); ++i) {
    has_cutouts_ |= used_materials_[i] != 0 && details_[i].is_cutout();
    has_relief_ |= used_materials_[i] != 0 && (details_[i].has_relief() || details_[i].has_layers());
    has_turned_tangents_ |= used_materials_[i] != 0 && details_[i].has_turned_tangent();
    has_subsurface_ |= used_materials_[i] != 0 && details_[i].has_subsurface;
    has_emission_ |= used_materials_[i] != 0 && details_[i].emission.radiance > 0;
    media.push_back(used_materials_[i] != 0 ? details_[i].medium : std::nullopt);
    const MaterialEmission& emission = details_[i].emission;
    shining_sides_.push_back(!(emission.radiance > 0) ? 0 : emission.two_sided ? 2 : 1);
    emissions.push_back(details_[i].is_cutout() ? MaterialEmission{} : emission);
    emissions.back().textured = !textured_.empty() && textured_[i] != 0;
  }
  has_cutouts_ |= geometry_->has_invisible();
  densities_ = DensityTable(description, first_material_[index_of<Fog>(Materials{})], used_materials_, *geometry_,
                            origin_, *textures_, threads);
  media_.set(media, densities_.places());
  has_invisible_media_ = geometry_->has_invisible() && !media_.empty() &&
                         have_invisible_media(description, [&](const MaterialReference& material) {
                           const auto number = static_cast<std::size_t>(first_material_[material.type]);
                           return details_[number + material.index].medium.has_value();
                         });
  const auto* const path = std::get_if<Path::Parameters>(&integrator_);
  if (path == nullptr) emissions.clear();
  emitters_.emplace(*geometry_, emissions, path == nullptr ? LightSampling::tree : path->lightsampling,
                    [&](const Hits& hits, const SurfaceInteraction<FloatN>& surface, const FloatN& radius) {
                      // No way from the camera over a surface is shorter, so light is looked up at least so blurred.
                      const FloatN way = length(surface.p - Vec3<FloatN>(camera_eye_));
                      const TexturePoint<FloatN> point =
                          point_of(*this, max(radius, ray_cone_.half_width(way)), hits, surface);
                      const Rgb<FloatN> radiance = emitted(hits, surface, &point);
                      return abs(radiance.red) + abs(radiance.green) + abs(radiance.blue);
                    });
  if (path != nullptr && path->caustics != Caustics::none) {
    add_caustics();
    // With two points, there is none to look them up at.
    has_photons_ = caustics_ && path->caustics == Caustics::photons && path->maxdepth > 2;
  }
  if (path != nullptr && path->maxdepth > 1 && (!caustics_ || media_.has_fog())) add_panes();
  // Shadow rays know nothing of what is inside of clear things in these scenes; fibres have nothing inside.
  add_scattering_through(path == nullptr || (has_panes_ && caustics_) || media_.scatters());
}

void SceneTables::add_panes() {
  for (std::size_t i = 0; i < details_.size(); ++i) {
    const SurfaceDetail& detail = details_[i];
    panes_.push_back(used_materials_[i] != 0 && detail.is_pane && !detail.has_relief() && !detail.has_layers() ? 1 : 0);
    has_panes_ |= panes_.back() != 0;
  }
  has_cutouts_ |= has_panes_;
}

void SceneTables::add_scattering_through(bool fibres_alone) {
  std::vector<std::int32_t> scattering, fibres;
  for (std::size_t i = 0; i < details_.size(); ++i) {
    const bool is_used = used_materials_[i] != 0, is_fibre = is_used && details_[i].is_fibre;
    scattering.push_back(is_fibre || (is_used && details_[i].scatters_through && !fibres_alone) ? 1 : 0);
    fibres.push_back(is_fibre ? 1 : 0);
  }
  const auto is_any = [](const std::vector<std::int32_t>& marked) {
    return std::ranges::find(marked, 1) != marked.end();
  };
  if (is_any(scattering)) scattering_through_ = std::move(scattering);
  if (is_any(fibres)) fibres_ = std::move(fibres);
}

MaskN SceneTables::is_fibre(const Hits& hits) const {
  if (fibres_.empty()) return MaskN(false);
  return hits.hit & float_mask<FloatN>(gather(fibres_.data(), material(hits)) != IntN(0));
}

MaskN SceneTables::scatters_through(const Hits& hits, const SurfaceInteraction<FloatN>& surface) const {
  const MaskN scatters = hits.hit & float_mask<FloatN>(gather(scattering_through_.data(), material(hits)) != IntN(0));
  return surface.has_emerging ? scatters & !surface.emerges : scatters;
}

MaskN SceneTables::is_pane(const IntN& material) const {
  return float_mask<FloatN>(gather(panes_.data(), material) != IntN(0));
}

void SceneTables::add_caustics() {
  std::vector<std::uint8_t> focusing;
  for (const SurfaceDetail& detail : details_) focusing.push_back(detail.focuses ? 1 : 0);
  CausticTable table(*geometry_, focusing, {lights_, *emitters_, environment()});
  if (!table.empty()) caustics_.emplace(std::move(table));
}

template <class Material>
TexturedMaterial<Material> SceneTables::textured_material(const MaterialItem<Material>& item,
                                                          std::int32_t index) const {
  TexturedMaterial<Material> result{index, {}, textures_->factors<Material>(item.textures)};
  typename Material::template Values<double> values;
  if constexpr (requires { Material::values(item.parameters); })
    values = Material::values(item.parameters);
  else
    values = item.parameters;
  const auto* const from = reinterpret_cast<const double*>(&values);
  auto* const to = reinterpret_cast<float*>(&result.values);
  for (std::size_t i = 0; i < sizeof(result.values) / sizeof(float); ++i) to[i] = static_cast<float>(from[i]);
  return result;
}

template <class Material>
SceneTables::SurfaceDetail SceneTables::surface_detail(const MaterialItem<Material>& item) {
  SurfaceDetail detail{{0}, {1}, {1}};  // of what has no surface
  if constexpr (requires { item.parameters.opacity; })
    detail.opacity.value = static_cast<float>(item.parameters.opacity);
  if constexpr (requires { item.parameters.normalmap; }) {
    detail.normalmap.value = static_cast<float>(item.parameters.normalmap);
    detail.bump.value = static_cast<float>(item.parameters.bump);
  }
  detail.is_even = requires { Material::is_even; };
  detail.is_fibre = requires { requires Material::is_fibre; };
  if constexpr (requires { Material::refracts(item.parameters); })
    detail.refracts = Material::refracts(item.parameters);
  if constexpr (requires { Material::has_layers; }) {
    detail.is_layered = true;
    detail.has_coat = Material::has_coat(item.parameters);
    detail.coatnormalmap.value = static_cast<float>(item.parameters.coatnormalmap);
  }
  if constexpr (requires { Material::is_anisotropic(item.parameters); }) {
    detail.is_anisotropic = Material::is_anisotropic(item.parameters);
    if constexpr (requires { item.parameters.tangentrotation; })
      detail.tangentrotation.value = static_cast<float>(item.parameters.tangentrotation / 360);
  }
  const auto is_textured = [&](std::string_view name) {
    return std::any_of(item.textures.begin(), item.textures.end(),
                       [&](const TextureUse& use) { return element_type<Material>().fields[use.field].name == name; });
  };
  if constexpr (requires { Material::focuses(item.parameters, is_textured); })
    detail.focuses = Material::focuses(item.parameters, is_textured);
  if constexpr (requires { Material::scatters_through(item.parameters, is_textured); })
    detail.scatters_through = Material::scatters_through(item.parameters, is_textured);
  if constexpr (requires { Material::is_pane(item.parameters, is_textured); })
    detail.is_pane = Material::is_pane(item.parameters, is_textured);
  for (const TextureUse& use : item.textures) {
    const std::string_view field = element_type<Material>().fields[use.field].name;
    if (field == opacity_field) detail.opacity.texture = use;
    if (field == normalmap_field) detail.normalmap.texture = use;
    if (field == bump_field) detail.bump.texture = use;
    if (field == coatnormalmap_field) detail.coatnormalmap.texture = use;
    if (field == tangentrotation_field) detail.tangentrotation.texture = use;
    if (field == tangentmap_field) detail.tangentmap = use;
  }
  return detail;
}

void SceneTables::add_materials(const SceneDescription& description) {
  const std::vector<std::string> names = light_group_names(description);
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    constexpr std::size_t type = index_of<Material>(Materials{});
    std::vector<typename Kernel<Material>::template Bsdf<float>> bsdfs;
    typename MaterialTableOf<Material>::TexturedMaterials textured;
    for (auto item : std::get<MaterialItems<Material>>(description.materials)) {
      // Other integrators than paths have no light that comes out elsewhere.
      if constexpr (requires { item.parameters.walks; })
        item.parameters.walks = std::holds_alternative<Path::Parameters>(integrator_) ? 1 : 0;
      auto parameters = item.parameters;
      details_.push_back(surface_detail<Material>(item));
      SurfaceDetail& detail = details_.back();
      if (const auto& map = detail.tangentmap ? detail.tangentmap : detail.normalmap.texture)
        detail.tangent_set = textures_->uvset(*map);
      auto textured_item = textured_material<Material>(item, static_cast<std::int32_t>(bsdfs.size()));
      textures_->multiply_by_largest(reinterpret_cast<double*>(&parameters), textured_item.factors);
      if (!textured_item.factors.empty() || detail.has_relief() || detail.has_layers())
        textured.push_back(std::move(textured_item));
      bsdfs.push_back(Kernel<Material>::bsdf(parameters));
      if constexpr (requires { bsdfs.back().subsurface; }) details_.back().has_subsurface = bsdfs.back().subsurface > 0;
      if constexpr (requires { Kernel<Material>::medium(parameters, bsdfs.back()); })
        details_.back().medium = Kernel<Material>::medium(parameters, bsdfs.back());
      // Where a texture says how dense it is, that is no factor of all of it.
      if constexpr (requires { item.grid; })
        details_.back().medium = Kernel<Material>::medium(item.parameters, bsdfs.back());
      Rgb<float> radiance(0, 0, 0);
      if constexpr (requires { bsdfs.back().emitted(); }) {
        radiance = bsdfs.back().emitted();
        const Rgb<float> size = abs(radiance);
        details_.back().emission = {size.red + size.green + size.blue, Material::is_two_sided(parameters)};
      }
      emitted_.insert(emitted_.end(), {radiance.red, radiance.green, radiance.blue});
      std::size_t group = 0;
      if constexpr (requires { parameters.group; }) group = find_light_group(names, parameters.group);
      groups_of_materials_.push_back(static_cast<std::int32_t>(group));
    }
    first_material_[type + 1] = first_material_[type] + static_cast<std::int32_t>(bsdfs.size());
    if (!textured.empty()) textured_.resize(static_cast<std::size_t>(first_material_[type]) + bsdfs.size());
    for (const auto& material : textured)
      textured_[static_cast<std::size_t>(first_material_[type] + material.index)] = 1;
    materials_[type] =
        std::make_unique<MaterialTableOf<Material>>(std::move(bsdfs), std::move(textured), textures_.get());
  });
  const auto has_frame = [](const SurfaceDetail& detail) { return detail.is_anisotropic; };
  if (std::any_of(details_.begin(), details_.end(), has_frame)) {
    textured_.resize(details_.size());
    for (const SurfaceDetail& detail : details_) anisotropic_.push_back(detail.is_anisotropic ? 1 : 0);
    // They want to know where u grows, as those with textures do.
    for (std::size_t i = 0; i < details_.size(); ++i) textured_[i] |= anisotropic_[i];
  }
  if (!textured_.empty()) textured_.resize(static_cast<std::size_t>(first_material_.back()));
}

MeshMaterials SceneTables::mesh_materials(const SceneDescription& description) const {
  MeshMaterials result{first_material_};
  const auto add = [&](UvSet set, std::size_t material) {
    std::vector<std::uint8_t>& of_set = result.want_tangents[static_cast<std::size_t>(set)];
    of_set.resize(details_.size());
    of_set[material] = 1;
  };
  for (std::size_t i = 0; i < details_.size(); ++i) {
    const SurfaceDetail& detail = details_[i];
    for (const TexturedNumber* const map : {&detail.normalmap, &detail.coatnormalmap})
      if (map->texture) add(textures_->uvset(*map->texture), i);
    if (!detail.is_anisotropic) continue;
    add(UvSet::first, i);
    if (detail.has_turned_tangent()) add(detail.tangent_set, i);
  }
  const auto add_instances = [&](const ObjectLists& objects) {
    for (const auto& item : std::get<ObjectItems<Instance>>(objects))
      for (std::size_t set = 0; set < 2 && !(item.material == no_material); ++set) {
        const std::int32_t material =
            first_material_[item.material.type] + static_cast<std::int32_t>(item.material.index);
        const std::vector<std::uint8_t>& want = result.want_tangents[set];
        result.instances_want_tangents[set] |= !want.empty() && want[static_cast<std::size_t>(material)] != 0;
      }
  };
  add_instances(description.objects);
  for (const Group& group : description.groups) add_instances(group.objects);
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    if constexpr (requires { requires Material::is_fibre; }) {
      const auto type = index_of<Material>(Materials{});
      result.fibres.resize(details_.size());
      std::fill(result.fibres.begin() + first_material_[type], result.fibres.begin() + first_material_[type + 1], 1);
    }
  });
  return result;
}

std::vector<std::uint8_t> SceneTables::fogs() const {
  std::vector<std::uint8_t> fogs;
  if (!media_.has_fog()) return fogs;
  for (std::int32_t i = 0; i < first_material_.back(); ++i) fogs.push_back(is_fog(i) ? 1 : 0);
  return fogs;
}

RadianceRange SceneTables::background_range() const {
  RadianceRange range;
  const Rgb<float> background = abs(Rgb<float>(viewplane_.background));
  range.add_usual(background);
  range.add_largest(background);
  range.add_source(background);
  if (environment_) {
    range.add_usual(environment_->mean_radiance());
    range.add_largest(environment_->largest_radiance());
    range.add_source(environment_->mean_radiance());
  }
  return range;
}

RadianceRange SceneTables::radiance_range() const {
  RadianceRange range = background_range();
  for (std::size_t type = 0; type < materials_.size(); ++type)
    materials_[type]->add_to(range, light_bounds_, used_materials_.data() + first_material_[type]);
  return range;
}

float SceneTables::largest_albedo() const {
  Rgb<float> largest(0, 0, 0);
  for (std::size_t type = 0; type < materials_.size(); ++type)
    largest = max(largest, materials_[type]->largest_albedo(used_materials_.data() + first_material_[type]));
  return std::max({largest.red, largest.green, largest.blue});
}

}  // namespace raytrace
