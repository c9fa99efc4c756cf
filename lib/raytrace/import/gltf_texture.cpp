#include "raytrace/import/gltf_texture.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "raytrace/import/gltf_material.h"

namespace raytrace::gltf {
namespace {

MeshTexture::Edge edge(const Item& sampler, const char* key) {
  constexpr std::uint64_t repeat = 10497, mirrored_repeat = 33648, clamp_to_edge = 33071;
  const std::uint64_t mode = sampler.whole(key, repeat);
  return mode == clamp_to_edge     ? MeshTexture::Edge::clamp
         : mode == mirrored_repeat ? MeshTexture::Edge::mirror
                                   : MeshTexture::Edge::repeat;
}

}  // namespace

MeshTexture TextureReader::read(const Item& info) {
  MeshTexture texture;
  const Item item = document_.listed("textures", info["index"]);
  std::optional<Item> source = item.find("source");
  // Which a file may have in place of the other, or as well, for those that do not read it.
  if (const auto webp = extension(item, webp_extension)) source = webp->find("source");
  if (!source) {
    if (item.find("extensions"))
      document_.warn_once(item.place(), "has no image but that of an extension that is not read, and is left out");
    return texture;
  }
  std::uint64_t coordinates = info.whole("texCoord", 0);
  if (const auto transform = extension(info, "KHR_texture_transform")) {
    coordinates = transform->whole("texCoord", coordinates);
    place_texture(*transform, texture);
  }
  const auto known = std::find(coordinates_.begin(), coordinates_.end(), coordinates);
  texture.by_uvs2 = known - coordinates_.begin() == 1;
  texture.srgb = true;
  if (known == coordinates_.end()) {
    if (coordinates_.size() == 2) {
      document_.warn(info.place(), "has other coordinates than the material's TEXCOORD_" +
                                       std::to_string(coordinates_[0]) + " and TEXCOORD_" +
                                       std::to_string(coordinates_[1]) + ", and is left out");
      return texture;
    }
    coordinates_.push_back(coordinates);
  }
  if (const auto number = item.find("sampler")) {
    const Item sampler = document_.listed("samplers", *number);
    texture.edge_u = edge(sampler, "wrapS");
    texture.edge_v = edge(sampler, "wrapT");
    constexpr std::uint64_t nearest = 9728;
    texture.nearest = sampler.whole("magFilter", 0) == nearest;
  }
  const Item image = document_.listed("images", *source);
  const std::optional<Item> uri = image.find("uri");
  if (uri && !uri->text().starts_with("data:")) {
    texture.file = file_name(*uri);
    return texture;
  }
  texture.file = std::filesystem::path(document_.name()).filename().string() + '#' + image.place();
  std::shared_ptr<const std::string>& bytes = images_[source->whole()];
  if (bytes == nullptr) {
    try {
      bytes = std::make_shared<const std::string>(
          uri ? data_of_uri(uri->text()).value()
              : std::string(document_.view_bytes(document_.listed("bufferViews", image["bufferView"]))));
    } catch (const Error& error) {
      if (uri) uri->fail(error.what());
      throw;
    }
  }
  texture.bytes = bytes;
  return texture;
}

}  // namespace raytrace::gltf
