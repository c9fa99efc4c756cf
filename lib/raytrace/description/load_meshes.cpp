#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "raytrace/description/check_groups.h"
#include "raytrace/description/file_lights.h"
#include "raytrace/description/holds_normals.h"
#include "raytrace/description/load_images.h"
#include "raytrace/description/mesh_file_key.h"
#include "raytrace/description/read_value.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/import/read_mesh.h"
#include "raytrace/import/specular_glossiness.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

Wrap wrap_of(MeshTexture::Edge edge) {
  return edge == MeshTexture::Edge::clamp    ? Wrap::clamp
         : edge == MeshTexture::Edge::mirror ? Wrap::mirror
                                             : Wrap::repeat;
}

/// An MTL's Phong, limited so that no channel reflects more than comes in: straight on, the lobe reflects
/// 2 pi Ks / (Ns + 2) (GlossySpecular::rho()), which is far above 1 for the Ns 0 of many files. It keeps what Kd
/// leaves, or, where that is less, what glass reflects straight on, 0.04; and Kd at most what the lobe leaves.
Phong::Parameters glossy(Rgb<double> diffuse, const Rgb<double>& specular, double exponent) {
  constexpr double of_glass = 0.04;
  const double lobe = 2 * std::numbers::pi / (exponent + 2);
  double factor = 1;
  const auto limit = [&](double kd, double ks) {
    const double most = std::max(1 - kd, of_glass);
    if (lobe * ks > most) factor = std::min(factor, most / (lobe * ks));
  };
  limit(diffuse.red, specular.red);
  limit(diffuse.green, specular.green);
  limit(diffuse.blue, specular.blue);
  const auto left = [&](double kd, double ks) { return std::min(kd, 1 - factor * lobe * ks); };
  diffuse = {left(diffuse.red, specular.red), left(diffuse.green, specular.green), left(diffuse.blue, specular.blue)};
  return {1, 1, 1, diffuse, specular * factor, exponent};
}

bool has_faces_without(const MeshData& mesh) {
  return std::ranges::find(mesh.face_materials, MeshData::no_material) != mesh.face_materials.end();
}

class MeshLoader {
 public:
  MeshLoader(SceneDescription& scene, Diagnostics& diagnostics, int threads)
      : scene_(scene), diagnostics_(diagnostics), threads_(threads) {
    for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
      const auto& items = std::get<MaterialItems<Material>>(scene.materials);
      for (std::size_t i = 0; i < items.size(); ++i) {
        taken_names_.insert(items[i].name);
        own_materials_.try_emplace(items[i].name,
                                   MaterialReference{static_cast<std::uint32_t>(index_of<Material>(Materials{})),
                                                     static_cast<std::uint32_t>(i)});
      }
    });
  }

  void load() {
    load(scene_.objects);
    for (Group& group : scene_.groups) load(group.objects);
  }

 private:
  void load(ObjectLists& objects) {
    for (auto& mesh : std::get<ObjectItems<Mesh>>(objects)) load(mesh);
    for (auto& model : std::exchange(std::get<ObjectItems<Model>>(objects), {})) load(std::move(model), objects);
    for (auto& cloud : std::get<ObjectItems<SphereCloud>>(objects)) load(cloud);
  }

  /// objects: those that it is one of.
  void load(ObjectItem<Model>&& model, ObjectLists& objects) {
    ObjectItem<Mesh>& mesh = std::get<ObjectItems<Mesh>>(objects).emplace_back();
    auto& [file, animation, time, variant, overridematerials] = model.parameters;
    mesh.parameters.file = std::move(file);
    mesh.parameters.animation = std::move(animation);
    mesh.parameters.time = time;
    mesh.parameters.variant = std::move(variant);
    mesh.parameters.overridematerials = overridematerials;
    mesh.name = std::move(model.name);
    mesh.material = model.material;
    mesh.line = model.line;
    mesh.column = model.column;
    mesh.shadowcatcher = model.shadowcatcher;
    mesh.transform = std::move(model.transform);
    load(mesh);
    if (mesh.data == nullptr || mesh.data->lights.empty()) return;
    if (&objects == &scene_.objects)
      add_file_lights(mesh.data->lights, mesh.transform.affine(), scene_);
    else if (unlit_.insert(mesh.parameters.file.path).second)
      diagnostics_.warning(location_of(mesh.parameters.file),
                           on_one_line(mesh.parameters.file.path) +
                               ": its lights are left out, since the <model> is in a <group>, which has none");
  }

  /// What several meshes have of one file.
  struct LoadedFile {
    std::shared_ptr<const MeshData> data;
    std::vector<MaterialReference> materials;
  };

  void load(ObjectItem<Mesh>& mesh) {
    LoadedFile loaded;
    if (mesh.parameters.file.path.empty())
      loaded.data = made(mesh);
    else
      loaded = from_file(mesh);
    if (loaded.data == nullptr) return;
    mesh.data = loaded.data;
    mesh.materials = mesh.material == no_material ? std::move(loaded.materials) : std::vector{mesh.material};
    if (mesh.materials.empty()) mesh.materials = {mesh.data->colors.empty() ? grey() : painted()};
  }

  void load(ObjectItem<SphereCloud>& cloud) {
    const auto& [file, radius] = cloud.parameters;
    const auto [known, is_new] = clouds_.try_emplace(file.path);
    if (is_new)
      if (std::optional<PointCloud> data = read(file, {}, read_point_cloud))
        known->second = std::make_shared<const PointCloud>(std::move(*data));
    if (known->second == nullptr) return;
    cloud.data = known->second;
    if (cloud.data->radii.empty() && radius < smallest_size)
      diagnostics_.error(location_of(file),
                         on_one_line(file.path) + ": has no radii; add <radius> to the <spherecloud>");
    if (!cloud.transform.affine().uniform_scale())
      diagnostics_.error(
          location_of(cloud),
          std::string("a <spherecloud> stays one of spheres: its <transform> cannot stretch it; put it into a <group>, "
                      "and stretch an <instance> of that"));
    const MaterialReference own = cloud.material;
    cloud.materials = {own != no_material ? own : cloud.data->colors.empty() ? grey() : painted()};
  }

  std::shared_ptr<const MeshData> made(const ObjectItem<Mesh>& mesh) {
    const auto& values = mesh.parameters;
    Diagnostics found(diagnostics_.file());
    std::optional<MeshData> data =
        make_mesh(values.positions.numbers, values.faces.numbers, Mesh::face_ends(values.faces),
                  values.normals.groups.numbers, values.uvs.numbers, values.uvs2.numbers, found);
    for (const Diagnostic& diagnostic : found.kept())
      diagnostics_.add(diagnostic.severity, location_of(mesh), "the mesh: " + diagnostic.message);
    return data ? std::make_shared<const MeshData>(std::move(*data)) : nullptr;
  }

  const LoadedFile& from_file(const ObjectItem<Mesh>& mesh) {
    const FileName& file = mesh.parameters.file;
    const Mesh::Parameters& values = mesh.parameters;
    MeshReadSettings settings{.animation = values.animation.name, .time = values.time, .variant = values.variant.name};
    const bool overrides = values.overridematerials;
    const MeshFileKey key = key_of(mesh.parameters);
    const auto [known, is_new] = files_.try_emplace(key);
    LoadedFile& loaded = known->second;
    if (!is_new) return loaded;
    const bool has_shown_materials = shown_materials_.contains(key);
    settings.is_overridden = [&](std::string_view name) {
      return !has_shown_materials || (overrides && own_materials_.contains(std::string(name)));
    };
    std::optional<MeshData> data = read(file, settings, read_mesh);
    if (!data) return loaded;
    if (has_shown_materials) {
      const auto folder = std::filesystem::absolute(file.path).parent_path();
      if (overrides) warn_of_no_override(file, data->materials);
      for (MeshMaterial& material : data->materials) {
        const bool is_overridden = settings.overrides(material.name);
        if (!is_overridden) take_bump_map(material, file, folder);
        loaded.materials.push_back(is_overridden ? own_materials_.at(material.name) : add(material, folder));
        material = {};  // the textures have its pictures
      }
      // Faces without a material have the last one.
      bool lacks_any = has_faces_without(*data);
      for (const MeshCopies& copies : data->copies) lacks_any = lacks_any || has_faces_without(*copies.mesh);
      if (lacks_any) loaded.materials.push_back(data->colors.empty() ? grey() : painted());
    }
    loaded.data = std::make_shared<const MeshData>(std::move(*data));
    return loaded;
  }

  /// Programs that write MTL call both normals and heights bumps: the picture says which it is.
  void take_bump_map(MeshMaterial& material, const FileName& file, const std::filesystem::path& folder) {
    const MeshTexture& map = material.map_bump;
    if (map.file.empty() || !material.norm.file.empty()) return;
    const auto [known, is_new] = normal_maps_.try_emplace((folder / map.file).string());
    if (is_new) {
      known->second = holds_normals(known->first);
      if (!known->second)
        diagnostics_.warning(location_of(file),
                             on_one_line(file.path) + ": the map_Bump " + in_quotes(map.file) +
                                 " holds heights, and MTL does not say how high they are: it is left out; a <bump> of "
                                 "a material of the scene may have it, with <overridematerials>");
    }
    if (known->second) material.norm = map;
  }

  /// Where a name may be misspelt.
  void warn_of_no_override(const FileName& file, const std::vector<MeshMaterial>& materials) {
    std::string names;
    constexpr std::size_t most = 10;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (own_materials_.contains(materials[i].name)) return;
      if (i < most) names += (i == 0 ? "" : ", ") + in_quotes(materials[i].name);
    }
    if (materials.size() > most) names += " and " + std::to_string(materials.size() - most) + " more";
    diagnostics_.warning(location_of(file),
                         on_one_line(file.path) +
                             ": <overridematerials> changes nothing: no material of the scene has a name "
                             "of the file's, which " +
                             (names.empty() ? "has none" : "are " + names));
  }

  /// reader: read_mesh() or read_point_cloud().
  template <class Data>
  std::optional<Data> read(const FileName& file, MeshReadSettings settings,
                           std::optional<Data> (*reader)(const std::string&, const MeshReadSettings&, Diagnostics&)) {
    settings.threads = threads_;
    Diagnostics found(on_one_line(file.path));
    std::optional<Data> data = reader(file.path, settings, found);
    if (data) {
      // Once more, less an origin, where floats have too few digits for it.
      settings.origin = near_origin({data->positions.data(), data->positions.size()});
      if (length(settings.origin) > 0) {
        data.reset();
        found = Diagnostics(on_one_line(file.path));
        data = reader(file.path, settings, found);
      }
    }
    const bool is_about_all = found.kept().size() == 1 && found.kept().front().location.line == 0;
    if (!data && is_about_all && file.line > 0)
      diagnostics_.error(location_of(file), found.file() + ": " + found.kept().front().message);
    else
      diagnostics_.append(found);
    return data;
  }

  /// A material of a file as the scene may have it. It keeps its name, if that is free.
  MaterialReference add(const MeshMaterial& material, const std::filesystem::path& folder) {
    const Rgb<double> black(0, 0, 0), white(1, 1, 1);
    const Rgb<double> diffuse = material.kd.value_or(white), specular = material.ks.value_or(black);
    const bool is_glossy =
        material.illum.value_or(2) >= 2 && std::max({specular.red, specular.green, specular.blue}) > 0;
    MaterialReference added{};
    if (!material.openpbr.empty())
      added = add_openpbr(material, folder);
    else if (is_glossy)
      added = add<Phong>(glossy(diffuse, specular, std::max(0.0, material.ns.value_or(20))), material.name);
    else
      added = add<Matte>({1, 1, diffuse}, material.name);
    if (material.openpbr.empty()) {
      if (!material.map_kd.file.empty())
        set_texture(added, "cd", image(material.map_kd, folder));
      else if (material.vertex_colors)
        set_texture(added, "cd", vertex_colors());
    }
    if (!material.map_d.file.empty())
      set_texture(added, opacity_field, image(material.map_d, folder),
                  material.map_d.alpha ? TextureChannel::alpha : TextureChannel::automatic);
    if (!material.norm.file.empty()) set_texture(added, normalmap_field, image(material.norm, folder));
    with_type(Materials{}, added.type, [&]<class Material>(std::type_identity<Material>) {
      auto& parameters = std::get<MaterialItems<Material>>(scene_.materials)[added.index].parameters;
      if constexpr (requires { parameters.opacity; }) {
        parameters.opacity = std::max(0.0, material.d.value_or(1));
        parameters.normalmap = material.norm.strength;
      }
    });
    return added;
  }

  MaterialReference add_openpbr(const MeshMaterial& material, const std::filesystem::path& folder) {
    OpenPbr::Parameters parameters;
    parameters.geometry_thin_walled = material.thin_walled;
    const Fields& fields = element_type<OpenPbr>().fields;
    for (const MeshParameter& parameter : material.openpbr) {
      const Field& field = fields[find_field(fields, parameter.name)];
      if (field.is<double>())
        field.get<double>(&parameters) = parameter.value.red;
      else
        field.get<Rgb<double>>(&parameters) = parameter.value;
    }
    const MaterialReference added = add<OpenPbr>(parameters, material.name);
    constexpr std::array channels{TextureChannel::red, TextureChannel::green, TextureChannel::blue,
                                  TextureChannel::alpha};
    for (const MeshParameter& parameter : material.openpbr) {
      const bool is_srgb = parameter.texture.srgb && fields[find_field(fields, parameter.name)].is<Rgb<double>>();
      if (!parameter.texture.file.empty())
        set_texture(added, parameter.name,
                    image(parameter.texture, folder, is_srgb ? ColorSpace::srgb : ColorSpace::automatic),
                    channels[static_cast<std::size_t>(parameter.channel)]);
      if (parameter.of_vertices && material.vertex_colors) set_texture(added, parameter.name, vertex_colors());
    }
    return added;
  }

  /// The same one for what uses an image in the same way.
  TextureReference image(const MeshTexture& texture, const std::filesystem::path& folder,
                         ColorSpace colorspace = ColorSpace::automatic) {
    auto& images = std::get<TextureItems<Image>>(scene_.textures);
    const std::string path = (folder / texture.file).string();
    const ImageUse key{
        path,           texture.scale,  texture.offset,  texture.rotation, texture.value_scale, texture.value_offset,
        texture.edge_u, texture.edge_v, texture.nearest, texture.by_uvs2,  colorspace,          texture.made_of};
    const auto [known, is_new] = known_images_.try_emplace(key, images.size());
    const auto index = static_cast<std::uint32_t>(known->second);
    if (!is_new) return {index_of<Image>(Textures{}), index};
    TextureItem<Image>& image = images.emplace_back();
    image.parameters.file.path = path;
    image.parameters.colorspace = colorspace;
    image.parameters.uvscale = {texture.scale[0], texture.scale[1]};
    image.parameters.uvoffset = {texture.offset[0], texture.offset[1]};
    image.parameters.uvrotation = texture.rotation;
    image.parameters.valuescale = texture.value_scale;
    image.parameters.valueoffset = texture.value_offset;
    image.parameters.wrap = wrap_of(texture.edge_u);
    if (texture.edge_v != texture.edge_u) image.parameters.wrapv = Image::own_wrap_v(wrap_of(texture.edge_v));
    if (texture.nearest) image.parameters.filter = TextureFilter::nearest;
    if (texture.by_uvs2) image.parameters.uvset = UvSet::second;
    image.image.bytes = texture.bytes;
    if (texture.made_of) {
      auto from = std::make_shared<SpecularGlossiness>(*texture.made_of);
      for (SpecularGlossiness::Source* const source : {&from->diffuse, &from->specular})
        if (!source->file.empty()) source->file = (folder / source->file).string();
      image.image.made_of = std::move(from);
    }
    image.name = image.parameters.file.path + '#' + std::to_string(images.size());
    image.imported = true;
    return {index_of<Image>(Textures{}), index};
  }

  TextureReference vertex_colors() {
    auto& textures = std::get<TextureItems<VertexColor>>(scene_.textures);
    if (textures.empty()) textures.push_back({{}, "vertex colors", 0, true});
    return {index_of<VertexColor>(Textures{}), 0};
  }

  void set_texture(const MaterialReference& material, std::string_view field, const TextureReference& texture,
                   TextureChannel channel = TextureChannel::automatic) {
    with_type(Materials{}, material.type, [&]<class Material>(std::type_identity<Material>) {
      auto& item = std::get<MaterialItems<Material>>(scene_.materials)[material.index];
      const Fields& fields = element_type<Material>().fields;
      const std::size_t number = find_field(fields, field);
      item.textures.push_back({static_cast<std::uint32_t>(number), texture, channel_of(fields[number], channel)});
    });
  }

  MaterialReference grey() {
    if (grey_ == no_material) grey_ = add<Matte>({1, 1, {0.5, 0.5, 0.5}}, "grey");
    return grey_;
  }

  /// White, times the colours at vertices.
  MaterialReference painted() {
    if (painted_ != no_material) return painted_;
    painted_ = add<Matte>({1, 1, {1, 1, 1}}, "painted");
    set_texture(painted_, "cd", vertex_colors());
    return painted_;
  }

  template <class Material>
  MaterialReference add(const typename Material::Parameters& parameters, const std::string& usual_name) {
    std::string name = usual_name;
    for (int i = 2; !taken_names_.insert(name).second; ++i) name = usual_name + '#' + std::to_string(i);
    auto& items = std::get<MaterialItems<Material>>(scene_.materials);
    items.push_back({parameters, name, 0, true});
    return {static_cast<std::uint32_t>(index_of<Material>(Materials{})), static_cast<std::uint32_t>(items.size() - 1)};
  }

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  int threads_;
  std::map<MeshFileKey, LoadedFile> files_;
  const std::set<MeshFileKey> shown_materials_ = files_with_shown_materials(scene_);
  std::map<std::string, std::shared_ptr<const PointCloud>> clouds_;
  std::map<std::string, bool> normal_maps_;  ///< of pictures that may be such, whether they are
  std::set<std::string> taken_names_;
  std::map<std::string, MaterialReference> own_materials_;  ///< those of the scene, by name
  std::set<std::string> unlit_;                             // files of models whose lights have been left out
  using ImageUse =
      std::tuple<std::string, std::array<double, 2>, std::array<double, 2>, double, double, double, MeshTexture::Edge,
                 MeshTexture::Edge, bool, bool, ColorSpace, std::shared_ptr<const SpecularGlossiness>>;
  std::map<ImageUse, std::size_t> known_images_;
  MaterialReference grey_ = no_material, painted_ = no_material;
};

}  // namespace

bool load_meshes(SceneDescription& description, Diagnostics& diagnostics, int threads,
                 const TextureSettings& textures) {
  diagnostics.add_files(description.included);
  const std::size_t errors_before = diagnostics.error_count();
  const std::size_t images_before = std::get<TextureItems<Image>>(description.textures).size();
  MeshLoader(description, diagnostics, threads).load();
  if (const auto error = too_many_copies(description)) diagnostics.error({}, *error);
  if (std::get<TextureItems<Image>>(description.textures).size() > images_before)
    load_images(description, diagnostics, threads, textures);
  return diagnostics.error_count() == errors_before;
}

}  // namespace raytrace
