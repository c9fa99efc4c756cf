#include "raytrace/description/file_materials.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "raytrace/description/read_value.h"

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

}  // namespace

FileMaterials::FileMaterials(SceneDescription& scene) : scene_(scene) {
  for_each_type(Materials{}, [&]<class Material>(std::type_identity<Material>) {
    for (const auto& item : std::get<MaterialItems<Material>>(scene.materials)) taken_names_.insert(item.name);
  });
}

template <class Material>
MaterialReference FileMaterials::add(const typename Material::Parameters& parameters, const std::string& usual_name) {
  std::string name = usual_name;
  for (int i = 2; !taken_names_.insert(name).second; ++i) name = usual_name + '#' + std::to_string(i);
  auto& items = std::get<MaterialItems<Material>>(scene_.materials);
  items.push_back({parameters, name, 0, true});
  return {static_cast<std::uint32_t>(index_of<Material>(Materials{})), static_cast<std::uint32_t>(items.size() - 1)};
}

MaterialReference FileMaterials::add(const MeshMaterial& material, const std::filesystem::path& folder) {
  const Rgb<double> black(0, 0, 0), white(1, 1, 1);
  const Rgb<double> diffuse = material.kd.value_or(white), specular = material.ks.value_or(black);
  const bool is_glossy = material.illum.value_or(2) >= 2 && std::max({specular.red, specular.green, specular.blue}) > 0;
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
  else if (material.map_d.by_vertices)
    set_texture(added, opacity_field, vertex_colors(material.map_d), TextureChannel::alpha);
  if (!material.norm.file.empty()) set_texture(added, normalmap_field, image(material.norm, folder));
  with_type(Materials{}, added.type, [&]<class Material>(std::type_identity<Material>) {
    auto& parameters = std::get<MaterialItems<Material>>(scene_.materials)[added.index].parameters;
    if constexpr (requires { parameters.normalmap; }) {
      parameters.opacity = std::max(0.0, material.d.value_or(1));
      parameters.normalmap = material.norm.strength;
    }
  });
  return added;
}

MaterialReference FileMaterials::add_openpbr(const MeshMaterial& material, const std::filesystem::path& folder) {
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

TextureReference FileMaterials::image(const MeshTexture& texture, const std::filesystem::path& folder,
                                      ColorSpace colorspace) {
  auto& images = std::get<TextureItems<Image>>(scene_.textures);
  const std::string path = (folder / texture.file).string();
  const ImageUse key{
      path,           texture.scale,  texture.offset,  texture.rotation, texture.value_scale, texture.value_offset,
      texture.edge_u, texture.edge_v, texture.nearest, texture.by_uvs2,  texture.by_vertices, colorspace,
      texture.made_of};
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
  image.parameters.vertexalpha = texture.by_vertices;
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

TextureReference FileMaterials::vertex_colors(const MeshTexture& values) {
  auto& textures = std::get<TextureItems<VertexColor>>(scene_.textures);
  const auto known = std::ranges::find_if(textures, [&](const TextureItem<VertexColor>& item) {
    return item.parameters.valuescale == values.value_scale && item.parameters.valueoffset == values.value_offset;
  });
  const auto index = static_cast<std::uint32_t>(known - textures.begin());
  if (known == textures.end()) {
    const std::string number = textures.empty() ? "" : '#' + std::to_string(textures.size());
    textures.push_back({{values.value_scale, values.value_offset}, "vertex colors" + number, 0, true});
  }
  return {index_of<VertexColor>(Textures{}), index};
}

void FileMaterials::set_texture(const MaterialReference& material, std::string_view field,
                                const TextureReference& texture, TextureChannel channel) {
  with_type(Materials{}, material.type, [&]<class Material>(std::type_identity<Material>) {
    auto& item = std::get<MaterialItems<Material>>(scene_.materials)[material.index];
    const Fields& fields = element_type<Material>().fields;
    const std::size_t number = find_field(fields, field);
    item.textures.push_back({static_cast<std::uint32_t>(number), texture, channel_of(fields[number], channel)});
  });
}

MaterialReference FileMaterials::grey() {
  if (grey_ == no_material) grey_ = add<Matte>({1, 1, {0.5, 0.5, 0.5}}, "grey");
  return grey_;
}

MaterialReference FileMaterials::painted() {
  if (painted_ != no_material) return painted_;
  painted_ = add<Matte>({1, 1, {1, 1, 1}}, "painted");
  set_texture(painted_, "cd", vertex_colors());
  return painted_;
}

}  // namespace raytrace
