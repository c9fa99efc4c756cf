#include "raytrace/description/refine_mesh.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "raytrace/description/displace_mesh.h"
#include "raytrace/import/subdivide_mesh.h"
#include "raytrace/import/vertex_normals.h"

namespace raytrace {

namespace {

template <class T>
MeshBuffer<T> copy_of(const MeshBuffer<T>& buffer) {
  if (buffer.empty()) return {};
  MeshBuffer<T> copy(buffer.size());
  std::copy(buffer.begin(), buffer.end(), copy.data());
  return copy;
}

/// A mesh without its copies.
MeshData copy_of(const MeshData& mesh) {
  MeshData copy = without_faces(mesh);
  copy.corners = mesh.corners;
  for (MeshBuffer<float> MeshData::* const buffer : {&MeshData::positions, &MeshData::normals, &MeshData::uvs,
                                                     &MeshData::uvs2, &MeshData::colors, &MeshData::alphas})
    copy.*buffer = copy_of(mesh.*buffer);
  copy.indices = copy_of(mesh.indices);
  copy.face_materials = copy_of(mesh.face_materials);
  return copy;
}

}  // namespace

std::shared_ptr<const MeshData> MeshRefiner::refined(const ObjectItem<Mesh>& mesh,
                                                     const std::shared_ptr<const MeshData>& data) {
  const Mesh::Parameters& parameters = mesh.parameters;
  if (parameters.subdivision == 0 && mesh.textures.empty()) return data;
  const WordOrGroups& normals = parameters.normals;
  const bool of_file = !normals.groups.empty() || normals.word == Mesh::of_file;
  Key key{data,
          parameters.subdivision,
          parameters.subdivisionscheme == SubdivisionScheme::flat,
          of_file,
          no_texture,
          0,
          TextureChannel::red,
          0,
          0};
  if (!mesh.textures.empty()) {
    const TextureUse& use = mesh.textures.front();
    key.texture_type = use.texture.type;
    key.texture = use.texture.index;
    key.channel = use.channel;
    key.height = parameters.displacement;
    key.midlevel = parameters.midlevel;
  }
  const auto [known, is_new] = made_.try_emplace(key);
  if (!is_new) return known->second;
  std::optional<std::string> fault;
  if (key.levels > 0)
    fault = too_many_subdivisions(*data, {.levels = key.levels, .flat = key.flat, .normals = key.has_normals});
  MeshData made;
  if (!fault) made = finer(*data, key, fault);
  for (std::size_t i = 0; i < data->copies.size() && !fault; ++i) {
    auto copy = std::make_shared<const MeshData>(finer(*data->copies[i].mesh, key, fault));
    if (!copy->indices.empty()) made.copies.push_back({std::move(copy), data->copies[i].places});
  }
  if (!fault && made.indices.empty()) fault = "has no face to subdivide: none has corners in three different places";
  if (fault)
    diagnostics_.error(location_of(mesh), "the mesh " + *fault);
  else
    known->second = std::make_shared<const MeshData>(std::move(made));
  return known->second;
}

MeshData MeshRefiner::finer(const MeshData& data, const Key& key, std::optional<std::string>& fault) const {
  const bool displaced = key.is_displaced();
  MeshData made = key.levels == 0 ? copy_of(data)
                                  : subdivided(data, {.levels = key.levels,
                                                      .flat = key.flat,
                                                      .normals = key.has_normals && !displaced,
                                                      .threads = threads_});
  if (made.indices.empty()) return made;
  if (displaced) {
    const ItemReference texture{key.texture_type, key.texture};
    fault = displace(made, scene_, {{0, texture, key.channel}, key.height, key.midlevel}, threads_);
  }
  // What a mesh of smooth or of flat faces is shaded with follows from its faces alone.
  const bool is_smooth = displaced || (key.levels > 0 && !key.flat);
  if (is_smooth && key.has_normals && !fault) made.normals = vertex_normals(made, made.positions.data(), threads_);
  return made;
}

}  // namespace raytrace
