#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "raytrace/description/check_fibres.h"
#include "raytrace/description/check_groups.h"
#include "raytrace/description/check_solids.h"
#include "raytrace/description/cut_strands.h"
#include "raytrace/description/file_lights.h"
#include "raytrace/description/file_materials.h"
#include "raytrace/description/holds_normals.h"
#include "raytrace/description/load_images.h"
#include "raytrace/description/mesh_file_key.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_value.h"
#include "raytrace/description/refine_mesh.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/import/empty_files.h"
#include "raytrace/import/read_mesh.h"
#include "raytrace/import/read_strands.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

bool has_faces_without(const MeshData& mesh) {
  return std::ranges::find(mesh.face_materials, MeshData::no_material) != mesh.face_materials.end();
}

/// Whether a material of the scene asks for the alphas of vertices.
bool wants_vertex_alphas(const SceneDescription& scene) {
  const auto is_by_them = [&](const TextureUse& use) {
    if (use.texture.type == index_of<VertexColor>(Textures{})) return use.channel == TextureChannel::alpha;
    return use.texture.type == index_of<Image>(Textures{}) &&
           std::get<TextureItems<Image>>(scene.textures).at(use.texture.index).parameters.vertexalpha;
  };
  bool any = false;
  for_each_displacement(scene, [&](const TextureUse& use) { any = any || is_by_them(use); });
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    for (const auto& item : std::get<MaterialItems<Material>>(scene.materials))
      any = any || std::ranges::any_of(item.textures, is_by_them);
  });
  return any;
}

class MeshLoader {
 public:
  MeshLoader(SceneDescription& scene, Diagnostics& diagnostics, int threads)
      : scene_(scene), diagnostics_(diagnostics), threads_(threads), added_(scene) {
    for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
      const auto& items = std::get<MaterialItems<Material>>(scene.materials);
      for (std::size_t i = 0; i < items.size(); ++i)
        own_materials_.try_emplace(items[i].name,
                                   MaterialReference{static_cast<std::uint32_t>(index_of<Material>(Materials{})),
                                                     static_cast<std::uint32_t>(i)});
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
    for (auto& curve : std::get<ObjectItems<Curve>>(objects)) load(curve);
    // Empty files, or those with errors.
    const auto has_no_data = [](const auto& item) { return item.data == nullptr; };
    std::erase_if(std::get<ObjectItems<Mesh>>(objects), has_no_data);
    std::erase_if(std::get<ObjectItems<SphereCloud>>(objects), has_no_data);
    std::erase_if(std::get<ObjectItems<Curve>>(objects), has_no_data);
  }

  /// objects: those that it is one of.
  void load(ObjectItem<Model>&& model, ObjectLists& objects) {
    ObjectItem<Mesh>& mesh = std::get<ObjectItems<Mesh>>(objects).emplace_back();
    auto& [file, animation, time, variant, overridematerials, subdivision, subdivisionscheme, displacement, midlevel] =
        model.parameters;
    mesh.parameters.file = std::move(file);
    mesh.parameters.animation = std::move(animation);
    mesh.parameters.time = time;
    mesh.parameters.variant = std::move(variant);
    mesh.parameters.overridematerials = overridematerials;
    mesh.parameters.subdivision = subdivision;
    mesh.parameters.subdivisionscheme = subdivisionscheme;
    mesh.parameters.displacement = displacement;
    mesh.parameters.midlevel = midlevel;
    mesh.textures = std::move(model.textures);
    for (TextureUse& use : mesh.textures) use.field = displacement_use_field<Mesh>();
    mesh.name = std::move(model.name);
    mesh.material = model.material;
    mesh.line = model.line;
    mesh.column = model.column;
    mesh.shadowcatcher = model.shadowcatcher;
    mesh.visible = model.visible;
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
    const bool is_made = mesh.data != nullptr && mesh.parameters.file.path.empty() && mesh.parameters.positions.empty();
    if (is_made)
      loaded = {mesh.data, mesh.materials};  // by a program
    else if (mesh.parameters.file.path.empty())
      loaded.data = made(mesh);
    else
      loaded = from_file(mesh);
    if (loaded.data == nullptr) return;
    mesh.data = is_made && mesh.refined ? loaded.data : refiner_.refined(mesh, loaded.data);
    mesh.refined = is_made;
    if (mesh.data == nullptr) return;
    mesh.materials = mesh.material == no_material ? std::move(loaded.materials) : std::vector{mesh.material};
    if (mesh.materials.empty()) mesh.materials = {mesh.data->colors.empty() ? added_.grey() : added_.painted()};
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
    cloud.materials = {own != no_material ? own : cloud.data->colors.empty() ? added_.grey() : added_.painted()};
  }

  void load(ObjectItem<Curve>& curve) {
    const auto& [file, points, radius, radiusscale, tipscale, basis] = curve.parameters;
    const bool is_made = curve.data != nullptr && file.path.empty() && points.empty();  // by a program
    if (!is_made) curve.data = cut(curve);
    if (curve.data == nullptr) return;
    if (!curve.transform.affine().uniform_scale())
      diagnostics_.error(location_of(curve),
                         std::string("the strands of a <curve> stay round: its <transform> cannot stretch it; put it "
                                     "into a <group>, and stretch an <instance> of that"));
    const MaterialReference own = curve.material;
    curve.materials = {own != no_material ? own : curve.data->colors.empty() ? added_.grey() : added_.painted()};
  }

  std::shared_ptr<const CurveData> cut(const ObjectItem<Curve>& curve) {
    const auto& [file, points, radius, radiusscale, tipscale, basis] = curve.parameters;
    const bool is_file = !file.path.empty();
    const SourceLocation place = is_file ? location_of(file) : location_of(curve);
    const std::string which = is_file ? on_one_line(file.path) : std::string("the curve");
    if (!is_file) {
      OptionalMessage fault = check_value(points, Range::any);
      if (!fault)
        if (const auto found = Curve::check(curve.parameters)) fault = found->message;
      if (fault) {
        diagnostics_.error(place, which + ": " + *fault);
        return nullptr;
      }
    }
    const auto key = std::tuple(is_file ? file.path : std::string(), radius, radiusscale, tipscale, basis);
    if (is_file)
      if (const auto known = curves_.find(key); known != curves_.end()) return known->second;
    std::optional<Strands> strands = is_file ? read(file, {}, read_strands) : made_strands(points);
    if (!strands) return nullptr;
    if (strands->radii.empty() && radius < smallest_size) {
      diagnostics_.error(place, which + ": has no radii; add <radius> to the <curve>");
      return nullptr;
    }
    CutStrands made = cut_strands(*strands, curve.parameters, threads_);
    const std::size_t strand_count = strands->ends.size();
    if (!made.fault.empty())
      diagnostics_.error(place, which + ": " + made.fault);
    else if (made.left_out == strand_count)
      diagnostics_.error(place, which + ": has no strand that can be rendered; " + left_out_reasons);
    else if (made.left_out > 0)
      diagnostics_.warning(place, which + ": " + std::to_string(made.left_out) + " of " + std::to_string(strand_count) +
                                      " strands are left out; " + left_out_reasons);
    std::shared_ptr<const CurveData> result;
    if (made.fault.empty() && made.left_out < strand_count)
      result = std::make_shared<const CurveData>(std::move(made.data));
    if (is_file) curves_.emplace(key, result);
    return result;
  }

  static constexpr const char* left_out_reasons =
      "a strand needs a length, a radius somewhere, at most 5e17 of each, and, as a bspline, four points";

  /// Of points that stand in the scene.
  static Strands made_strands(const NumberGroups& points) {
    Strands strands;
    strands.positions = MeshBuffer<float>(points.numbers.size());
    const auto fill = [&] {
      for (std::size_t i = 0; i < points.numbers.size(); ++i)
        strands.positions[i] =
            static_cast<float>(points.numbers[i] - component(strands.origin, static_cast<int>(i % 3)));
    };
    fill();
    strands.origin = near_origin({strands.positions.data(), strands.positions.size()});
    if (length(strands.origin) > 0) fill();
    for (const std::uint32_t end : points.ends) strands.ends.push_back(end / 3);
    return strands;
  }

  /// Of values that stand in a mesh; those of a file have none.
  static OptionalMessage fault_of(const Mesh::Parameters& values) {
    for (const auto& [name, groups] :
         {std::pair("positions", &values.positions), std::pair("faces", &values.faces),
          std::pair("normals", &values.normals.groups), std::pair("uvs", &values.uvs), std::pair("uvs2", &values.uvs2)})
      if (const OptionalMessage message = check_value(*groups, Range::any)) return tag(name) + " " + *message;
    if (const auto fault = Mesh::check(values)) return fault->message;
    return std::nullopt;
  }

  std::shared_ptr<const MeshData> made(const ObjectItem<Mesh>& mesh) {
    const auto& values = mesh.parameters;
    if (const OptionalMessage message = fault_of(values)) {
      diagnostics_.error(location_of(mesh), "the mesh: " + *message);
      return nullptr;
    }
    Diagnostics found(diagnostics_.file());
    std::optional<MeshData> data = make_mesh(values.positions.numbers, values.faces.numbers,
                                             Mesh::face_ends(values.faces), values.normals.groups.numbers,
                                             values.uvs.numbers, values.uvs2.numbers, values.subdivision > 0, found);
    for (const Diagnostic& diagnostic : found.kept())
      diagnostics_.add(diagnostic.severity, location_of(mesh), "the mesh: " + diagnostic.message);
    return data ? std::make_shared<const MeshData>(std::move(*data)) : nullptr;
  }

  const LoadedFile& from_file(const ObjectItem<Mesh>& mesh) {
    const FileName& file = mesh.parameters.file;
    const Mesh::Parameters& values = mesh.parameters;
    MeshReadSettings settings{.animation = values.animation.name, .time = values.time, .variant = values.variant.name};
    const MeshFileKey key = key_of(mesh);
    settings.polygons = key.has_polygons;
    settings.joined = key.is_joined;
    const bool overrides = values.overridematerials;
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
        if (settings.overrides(material.name)) {
          loaded.materials.push_back(own_materials_.at(material.name));
        } else {
          // However often a file is read, for faces that are cut in one way or another, its materials are the same.
          const MeshFileKey of_any{key.file, key.animation, key.time, key.variant, false, false, false};
          const auto [added, is_first] =
              file_materials_.try_emplace({of_any, loaded.materials.size(), material.name}, no_material);
          if (is_first) {
            take_bump_map(material, file, folder);
            added->second = added_.add(material, folder);
          }
          loaded.materials.push_back(added->second);
        }
        material = {};  // the textures have its pictures
      }
      // Faces without a material have the last one.
      bool lacks_any = has_faces_without(*data);
      for (const MeshCopies& copies : data->copies) lacks_any = lacks_any || has_faces_without(*copies.mesh);
      if (lacks_any) loaded.materials.push_back(data->colors.empty() ? added_.grey() : added_.painted());
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

  /// reader: read_mesh(), read_point_cloud() or read_strands().
  template <class Data>
  std::optional<Data> read(const FileName& file, MeshReadSettings settings,
                           std::optional<Data> (*reader)(const std::string&, const MeshReadSettings&, Diagnostics&)) {
    settings.threads = threads_;
    settings.vertex_alphas = vertex_alphas_;
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
    if (!data && file.line > 0 && says_empty(found)) {
      for (const Diagnostic& one : found.kept())
        diagnostics_.warning(location_of(file), found.file() + ": " + one.message +
                                                    (one.severity == Severity::error ? "; it is left out" : ""));
      return data;
    }
    const bool is_about_all = found.kept().size() == 1 && found.kept().front().location.line == 0;
    if (!data && is_about_all && file.line > 0)
      diagnostics_.error(location_of(file), found.file() + ": " + found.kept().front().message);
    else
      diagnostics_.append(found);
    return data;
  }

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  int threads_;
  const bool vertex_alphas_ = wants_vertex_alphas(scene_);
  FileMaterials added_;
  MeshRefiner refiner_{scene_, diagnostics_, threads_};
  std::map<MeshFileKey, LoadedFile> files_;
  /// By the file, with the number and the name of each.
  std::map<std::tuple<MeshFileKey, std::size_t, std::string>, MaterialReference> file_materials_;
  const std::set<MeshFileKey> shown_materials_ = files_with_shown_materials(scene_);
  std::map<std::string, std::shared_ptr<const PointCloud>> clouds_;
  /// By the file and how it is cut.
  std::map<std::tuple<std::string, double, double, double, CurveBasis>, std::shared_ptr<const CurveData>> curves_;
  std::map<std::string, bool> normal_maps_;                 ///< of pictures that may be such, whether they are
  std::map<std::string, MaterialReference> own_materials_;  ///< those of the scene, by name
  std::set<std::string> unlit_;                             // files of models whose lights have been left out
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
  if (diagnostics.error_count() > errors_before) return false;
  check_fibres(description, diagnostics);  // of materials that files' ones were overridden by
  check_solids(description, diagnostics);
  return diagnostics.error_count() == errors_before;
}

}  // namespace raytrace
