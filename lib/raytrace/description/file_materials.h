// The materials of models' files, as a scene may have them.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "raytrace/description/scene_description.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/import/specular_glossiness.h"

namespace raytrace {

class FileMaterials {
 public:
  /// What is added goes to that scene.
  explicit FileMaterials(SceneDescription& scene);

  /// A material of a file in that folder, with its images. It keeps its name, if that is free.
  MaterialReference add(const MeshMaterial& material, const std::filesystem::path& folder);
  /// Of what has none.
  MaterialReference grey();
  /// White, times the colours at vertices.
  MaterialReference painted();

 private:
  MaterialReference add_openpbr(const MeshMaterial& material, const std::filesystem::path& folder);
  template <class Material>
  MaterialReference add(const typename Material::Parameters& parameters, const std::string& usual_name);
  /// The same one for what uses an image in the same way.
  TextureReference image(const MeshTexture& texture, const std::filesystem::path& folder,
                         ColorSpace colorspace = ColorSpace::automatic);
  /// values: what is done to the numbers at vertices.
  TextureReference vertex_colors(const MeshTexture& values = {});
  void set_texture(const MaterialReference& material, std::string_view field, const TextureReference& texture,
                   TextureChannel channel = TextureChannel::automatic);

  SceneDescription& scene_;
  std::set<std::string> taken_names_;
  using ImageUse =
      std::tuple<std::string, std::array<double, 2>, std::array<double, 2>, double, double, double, MeshTexture::Edge,
                 MeshTexture::Edge, bool, bool, bool, ColorSpace, std::shared_ptr<const SpecularGlossiness>>;
  std::map<ImageUse, std::size_t> known_images_;
  MaterialReference grey_ = no_material, painted_ = no_material;
};

}  // namespace raytrace
