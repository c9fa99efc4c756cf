// glTF's metallic-roughness model and its extensions, in OpenPBR's terms: both have GGX's alpha as the square of the
// roughness, and dielectrics of index 1.5.
#include "raytrace/import/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>

#include "raytrace/import/face_color.h"
#include "raytrace/import/specular_glossiness.h"

namespace raytrace::gltf {
namespace {

enum Channel { red, green, blue, alpha };
constexpr double coat_index = 1.5, most_index = 10;

double number(const std::optional<Item>& object, const char* key, double otherwise) {
  const std::optional<Item> found = object ? object->find(key) : std::nullopt;
  return found ? found->number() : otherwise;
}
double share(const std::optional<Item>& object, const char* key, double otherwise) {
  return std::clamp(number(object, key, otherwise), 0.0, 1.0);
}
Rgb<double> color(const std::optional<Item>& object, const char* key, double otherwise, double most = 1e15) {
  const auto found = object ? object->numbers<3>(key) : std::nullopt;
  const auto [r, g, b] = found.value_or(std::array{otherwise, otherwise, otherwise});
  return {std::clamp(r, 0.0, most), std::clamp(g, 0.0, most), std::clamp(b, 0.0, most)};
}
double largest(const Rgb<double>& c) { return std::max({c.red, c.green, c.blue}); }

class MaterialReader {
 public:
  MaterialReader(const Item& item, const MaterialContext& context) : item_(item), context_(context) {}

  MeshMaterial read() {
    const std::optional<Item> name = item_.find("name");
    material_.name = name ? name->text() : item_.place();
    // In place of the other, which it may be beside.
    const auto glossy = context_.is_converted ? std::nullopt : find("KHR_materials_pbrSpecularGlossiness");
    surface_ = glossy ? glossy : item_.find("pbrMetallicRoughness");
    const char* const factor_key = glossy ? "diffuseFactor" : "baseColorFactor";
    if (const auto factor = surface_ ? surface_->numbers<4>(factor_key) : std::nullopt) {
      base_color_ = {std::clamp((*factor)[0], 0.0, 1.0), std::clamp((*factor)[1], 0.0, 1.0),
                     std::clamp((*factor)[2], 0.0, 1.0)};
      base_alpha_ = std::clamp((*factor)[3], 0.0, 1.0);
    }
    base_texture_ = texture(surface_, glossy ? "diffuseTexture" : "baseColorTexture");
    read_opacity();
    if (extension(item_, "KHR_materials_unlit")) {
      add("base_weight", 0);
      add("specular_weight", 0);
      add("emission_luminance", 1);
      add_base_color("emission_color");
      material_.thin_walled = is_double_sided();
      return std::move(material_);
    }
    if (glossy)
      read_specular_glossiness();
    else
      read_surface();
    read_normals();
    read_emission();
    read_transmission();
    read_diffuse_transmission();
    read_coat();
    read_sheen();
    read_anisotropy();
    read_iridescence();
    return std::move(material_);
  }

 private:
  std::optional<Item> find(const char* extension_name) const { return extension(item_, extension_name); }

  MeshTexture texture(const std::optional<Item>& object, const char* key) const {
    const std::optional<Item> info = object ? object->find(key) : std::nullopt;
    return info ? context_.texture(*info) : MeshTexture{};
  }
  void add(std::string_view name, double value, const MeshTexture& texture = {}, Channel channel = red) {
    material_.openpbr.push_back({name, {value, value, value}, texture, channel});
  }
  void add(std::string_view name, const Rgb<double>& value, const MeshTexture& texture = {}) {
    material_.openpbr.push_back({name, value, texture});
  }
  void add_base_color(std::string_view name) {
    add(name, base_color_, base_texture_);
    material_.openpbr.back().of_vertices = true;
  }
  bool is_double_sided() const {
    const std::optional<Item> found = item_.find("doubleSided");
    return found && found->is_true();
  }

  void read_opacity() {
    const std::optional<Item> mode = item_.find("alphaMode");
    if (!mode || mode->text() == "OPAQUE") return;
    if (mode->text() != "MASK" && mode->text() != "BLEND") mode->fail("is none of OPAQUE, MASK and BLEND");
    material_.map_d = base_texture_;
    material_.map_d.alpha = true;
    material_.d = base_alpha_;
    if (mode->text() == "BLEND") return;
    const double cutoff = number(item_, "alphaCutoff", 0.5);
    // Alphas of vertices are at most 1: what is below the cutoff without them stays so.
    material_.d = !material_.map_d.file.empty() || base_alpha_ >= cutoff ? 1 : 0;
    // All or nothing, but for a hundredth about the cutoff.
    constexpr double steep = 100;
    material_.map_d.value_scale = steep * base_alpha_;
    material_.map_d.value_offset = 0.5 - steep * cutoff;
  }

  void read_normals() {
    const auto info = item_.find("normalTexture");
    if (!info) return;
    material_.norm = context_.texture(*info);
    material_.norm.strength = number(info, "scale", 1);
  }

  static bool is_at_same_place(const MeshTexture& a, const MeshTexture& b) {
    const auto place = [](const MeshTexture& t) {
      return std::tie(t.scale, t.offset, t.rotation, t.edge_u, t.edge_v, t.by_uvs2);
    };
    return a.file.empty() || b.file.empty() || place(a) == place(b);
  }

  /// As metal and dielectric. Where there are pictures, others are made of them when they are loaded.
  void read_specular_glossiness() {
    const MeshTexture both = texture(surface_, "specularGlossinessTexture");
    const Rgb<double> specular = color(surface_, "specularFactor", 1, 1);
    const double glossiness = share(surface_, "glossinessFactor", 1);
    roughness_ = 1 - glossiness;
    if (base_texture_.file.empty() && both.file.empty()) {
      const MetalShare one = metal_share(base_color_, specular);
      base_color_ = one.base_color;
      add_base_color("base_color");
      add("base_metalness", one.metalness);
      add("specular_weight", one.specular_weight);
      return add("specular_roughness", roughness_);
    }
    if (!is_at_same_place(base_texture_, both)) {
      context_.warn(surface_->place(), "has its textures at different places, and is no metal anywhere");
      add_base_color("base_color");
      add("base_metalness", 0);
      add("specular_weight", metal_share(base_color_, specular).specular_weight);
      MeshTexture roughness = both;
      roughness.value_scale = -glossiness;
      roughness.value_offset = 1;
      return add("specular_roughness", 1, roughness, alpha);
    }
    SpecularGlossiness from{
        {base_texture_.file, base_texture_.bytes}, {both.file, both.bytes}, base_color_, specular, glossiness, true};
    MeshTexture shares = both.file.empty() ? base_texture_ : both;
    if (base_texture_.file.empty()) base_texture_ = both;
    base_texture_.made_of = std::make_shared<const SpecularGlossiness>(from);
    base_color_ = {1, 1, 1};
    from.is_color = false;
    shares.made_of = std::make_shared<const SpecularGlossiness>(from);
    add_base_color("base_color");
    add("base_metalness", 1, shares, blue);
    add("specular_weight", 1, shares, red);
    add("specular_roughness", 1, shares, green);
  }

  void read_surface() {
    add_base_color("base_color");
    const MeshTexture both = texture(surface_, "metallicRoughnessTexture");
    metalness_ = share(surface_, "metallicFactor", 1);
    roughness_ = share(surface_, "roughnessFactor", 1);
    add("base_metalness", metalness_, both, blue);
    add("specular_roughness", roughness_, both, green);
    // They are of what is no metal; OpenPBR's are of metals, too.
    const bool is_metal = metalness_ == 1 && both.file.empty();
    const auto specular = is_metal ? std::nullopt : find("KHR_materials_specular");
    const Rgb<double> tint = color(specular, "specularColorFactor", 1);
    const double brightest = largest(tint);
    read_index(brightest);
    if (!specular) return;
    add("specular_weight", share(specular, "specularFactor", 1), texture(specular, "specularTexture"), alpha);
    add("specular_color", is_clear() || brightest == 0 ? tint : tint * (1 / brightest),
        texture(specular, "specularColorTexture"));
  }

  bool is_clear() const { return share(find("KHR_materials_transmission"), "transmissionFactor", 0) > 0; }

  /// What is clear keeps the file's, since it refracts. Else it only says how much is reflected: `factor` times so much
  /// straight on, and at grazing angles all, as before; below a coat as much as without it, where OpenPBR's base has
  /// its index over the coat's.
  void read_index(double factor) {
    const auto ior = find("KHR_materials_ior");
    double index = number(ior, "ior", 1.5);
    index = index == 0 ? most_index : std::clamp(index, 1.0, most_index);  // 0: reflects all
    const auto coat = find("KHR_materials_clearcoat");
    MeshTexture map;
    if (!is_clear()) {
      const double root = std::min((index - 1) / (index + 1) * std::sqrt(factor), 0.99);
      if (factor != 1) index = (1 + root) / (1 - root);
      // The inverse of the kernel's mean of the index and that over the coat's.
      const double weight = share(coat, "clearcoatFactor", 0), over_coat = 1 / (1 - weight * (1 - 1 / coat_index));
      map = texture(coat, "clearcoatTexture");
      if (map.file.empty()) {
        index *= over_coat;
        film_index_factor_ = over_coat;
      }
      map.value_scale = over_coat - 1;
      map.value_offset = 1;
    }
    if (ior || index != 1.5 || !map.file.empty()) add("specular_ior", std::min(index, most_index), map);
  }

  void read_emission() {
    const Rgb<double> factor = color(item_, "emissiveFactor", 0);
    if (largest(factor) == 0) return;
    add("emission_luminance",
        std::clamp(number(find("KHR_materials_emissive_strength"), "emissiveStrength", 1), 0.0, 1e15));
    add("emission_color", factor, texture(item_, "emissiveTexture"));
    material_.thin_walled = is_double_sided();
  }

  void read_transmission() {
    const auto transmission = find("KHR_materials_transmission"), volume = find("KHR_materials_volume");
    const double weight = share(transmission, "transmissionFactor", 0);
    if (weight == 0) return;
    add("transmission_weight", weight, texture(transmission, "transmissionTexture"), red);
    material_.thin_walled = number(volume, "thicknessFactor", 0) <= 0;
    const double dispersion = number(find("KHR_materials_dispersion"), "dispersion", 0);
    if (dispersion > 0 && !material_.thin_walled) {
      add("transmission_dispersion_scale", 1);
      add("transmission_dispersion_abbe_number", std::clamp(20 / dispersion, 1.0, 1e15));
    }
    const double distance = number(volume, "attenuationDistance", 0);
    if (material_.thin_walled || !(distance > 0)) {
      add_base_color("transmission_color");
      if (!material_.thin_walled) material_.openpbr.back().value = color_of_one_face(base_color_);
      return;
    }
    add("transmission_depth", distance);
    add("transmission_color", color(volume, "attenuationColor", 1, 1));
  }

  /// Thin walls pass on all that they scatter. Of volumes, glTF says how light is absorbed inside, and not how often it
  /// is scattered: the distance of the one stands for that of the other.
  void read_diffuse_transmission() {
    const auto diffuse = find("KHR_materials_diffuse_transmission"), volume = find("KHR_materials_volume");
    const double weight = share(diffuse, "diffuseTransmissionFactor", 0);
    if (weight == 0) return;
    add("subsurface_weight", weight, texture(diffuse, "diffuseTransmissionTexture"), alpha);
    add("subsurface_color", color(diffuse, "diffuseTransmissionColorFactor", 1, 1),
        texture(diffuse, "diffuseTransmissionColorTexture"));
    const double thickness = number(volume, "thicknessFactor", 0);
    material_.thin_walled = thickness <= 0;
    if (material_.thin_walled) return add("subsurface_scatter_anisotropy", 1);
    const double distance = number(volume, "attenuationDistance", 0);
    const Rgb<double> left = color(volume, "attenuationColor", 1, 1);
    const auto path = [&](double c) { return 1 / -std::log(std::clamp(c, 1e-6, 0.99)); };
    if (!(distance > 0) || largest(left) == 0) {
      add("subsurface_radius", std::min(thickness * 0.1, 1e15));
      return add("subsurface_radius_scale", Rgb<double>(1, 1, 1));
    }
    add("subsurface_radius", std::min(distance, 1e15));
    add("subsurface_radius_scale", {path(left.red), path(left.green), path(left.blue)});
  }

  void read_coat() {
    const auto coat = find("KHR_materials_clearcoat");
    const double weight = share(coat, "clearcoatFactor", 0);
    if (weight == 0) return;
    add("coat_weight", weight, texture(coat, "clearcoatTexture"), red);
    add("coat_roughness", share(coat, "clearcoatRoughnessFactor", 0), texture(coat, "clearcoatRoughnessTexture"),
        green);
    add("coat_ior", coat_index);
    add("coat_darkening", 0);  // glTF's base keeps its colour
    if (const auto normals = coat->find("clearcoatNormalTexture"))
      add("coatnormalmap", number(normals, "scale", 1), context_.texture(*normals));
  }

  void read_sheen() {
    const auto sheen = find("KHR_materials_sheen");
    const Rgb<double> factor = color(sheen, "sheenColorFactor", 0, 1);
    const double weight = largest(factor);
    if (weight == 0) return;
    add("fuzz_weight", weight);
    add("fuzz_color", factor * (1 / weight), texture(sheen, "sheenColorTexture"));
    add("fuzz_roughness", share(sheen, "sheenRoughnessFactor", 0), texture(sheen, "sheenRoughnessTexture"), alpha);
  }

  void read_anisotropy() {
    const auto anisotropy = find("KHR_materials_anisotropy");
    const double strength = share(anisotropy, "anisotropyStrength", 0);
    if (strength == 0) return;
    // glTF's alphas are those of the roughness across, and along of what grows to 1 with the strength.
    const double across = std::max(roughness_ * roughness_, 1e-6), along = across + (1 - across) * strength * strength;
    const MeshTexture map = texture(anisotropy, "anisotropyTexture");
    add("specular_roughness_anisotropy", 1 - across / along, map, blue);
    if (!map.file.empty()) add("tangentmap", 1, map);
    // Both count it from the tangent towards where the picture is up.
    if (const double rotation = number(anisotropy, "anisotropyRotation", 0); rotation != 0)
      add("tangentrotation", rotation * 180 / std::numbers::pi);
    for (MeshParameter& parameter : material_.openpbr)
      if (parameter.name == "specular_roughness")
        parameter.value.red = std::min(1.0, std::pow((along * along + across * across) / 2, 0.25));
  }

  void read_iridescence() {
    const auto film = find("KHR_materials_iridescence");
    const double weight = share(film, "iridescenceFactor", 0);
    if (weight == 0) return;
    add("thin_film_weight", weight, texture(film, "iridescenceTexture"), red);
    // As the base's; the way of light in the film stays what it is.
    add("thin_film_ior", std::clamp(film_index_factor_ * number(film, "iridescenceIor", 1.3), 1.0, most_index));
    // From nanometres.
    const double least =
                     std::clamp(number(film, "iridescenceThicknessMinimum", 100), 0.0, 1e6) * 1e-3 / film_index_factor_,
                 most =
                     std::clamp(number(film, "iridescenceThicknessMaximum", 400), 0.0, 1e6) * 1e-3 / film_index_factor_;
    MeshTexture map = texture(film, "iridescenceThicknessTexture");
    map.value_scale = most - least;
    map.value_offset = least;
    add("thin_film_thickness", map.file.empty() ? most : 1, map, green);
  }

  const Item& item_;
  const MaterialContext& context_;
  MeshMaterial material_;
  std::optional<Item> surface_;
  Rgb<double> base_color_{1, 1, 1};
  double base_alpha_ = 1, metalness_ = 1, roughness_ = 1;
  double film_index_factor_ = 1;  ///< that of an index below a coat
  MeshTexture base_texture_;
};

}  // namespace

bool is_material_extension(std::string_view name) {
  constexpr std::string_view start = "KHR_materials_";
  constexpr std::array<std::string_view, 13> read{"anisotropy",
                                                  "clearcoat",
                                                  "diffuse_transmission",
                                                  "dispersion",
                                                  "emissive_strength",
                                                  "ior",
                                                  "iridescence",
                                                  "pbrSpecularGlossiness",
                                                  "sheen",
                                                  "specular",
                                                  "transmission",
                                                  "unlit",
                                                  "volume"};
  return name.starts_with(start) && std::find(read.begin(), read.end(), name.substr(start.size())) != read.end();
}

MeshMaterial read_material(const Item& material, const MaterialContext& context) {
  return MaterialReader(material, context).read();
}

std::optional<Item> extension(const Item& object, const char* name) {
  const std::optional<Item> all = object.find("extensions");
  return all ? all->find(name) : std::nullopt;
}

void place_texture(const Item& transform, MeshTexture& texture) {
  const auto [x, y] = transform.numbers<2>("offset").value_or(std::array{0.0, 0.0});
  texture.scale = transform.numbers<2>("scale").value_or(std::array{1.0, 1.0});
  const double angle = number(transform, "rotation", 0), sine = std::sin(angle), cosine = std::cos(angle);
  // u' = x + c su u + s sv (1 - v), 1 - v' = 1 - y + s su u - c sv (1 - v).
  texture.rotation = angle * 180 / std::numbers::pi;
  texture.offset = {x + sine * texture.scale[1], 1 - y - cosine * texture.scale[1]};
}

}  // namespace raytrace::gltf
