// MTL, the materials of OBJ files: https://paulbourke.net/dataformats/mtl/, with the usual additions for roughness
// (Pr), metalness (Pm), sheen (Ps), a coat (Pc, Pcr), anisotropy (aniso) and normal maps (norm). Of statements that say
// how a surface looks, but mean nothing here, there is a warning; others are skipped.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "raytrace/import/face_color.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/import/mesh_text.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace mtl {
namespace {

template <class Member>
struct Field {
  std::string_view name;  // in lower case
  Member MeshMaterial::* member;
};
constexpr Field<std::optional<Rgb<double>>> color_fields[] = {
    {"kd", &MeshMaterial::kd}, {"ks", &MeshMaterial::ks}, {"ke", &MeshMaterial::ke}, {"tf", &MeshMaterial::tf}};
constexpr Field<std::optional<double>> number_fields[] = {
    {"ns", &MeshMaterial::ns},   {"d", &MeshMaterial::d},        {"tr", &MeshMaterial::d},  {"ni", &MeshMaterial::ni},
    {"pr", &MeshMaterial::pr},   {"pm", &MeshMaterial::pm},      {"ps", &MeshMaterial::ps}, {"pc", &MeshMaterial::pc},
    {"pcr", &MeshMaterial::pcr}, {"aniso", &MeshMaterial::aniso}};
constexpr Field<MeshTexture> texture_fields[] = {
    {"map_kd", &MeshMaterial::map_kd},     {"map_ke", &MeshMaterial::map_ke}, {"map_d", &MeshMaterial::map_d},
    {"map_pr", &MeshMaterial::map_pr},     {"map_pm", &MeshMaterial::map_pm}, {"norm", &MeshMaterial::norm},
    {"map_bump", &MeshMaterial::map_bump}, {"bump", &MeshMaterial::map_bump}};
/// Textures that are left out.
constexpr std::string_view unread[] = {"disp", "map_ks", "map_ns", "refl", "decal"};

template <class Fields>
auto find_field(const Fields& fields, std::string_view name) {
  const auto found = std::find_if(std::begin(fields), std::end(fields), [&](const auto& f) { return f.name == name; });
  return found == std::end(fields) ? nullptr : &*found;
}

/// Up to three numbers; how many there are.
int read_numbers(LineWords& words, std::array<double, 3>& numbers) {
  int count = 0;
  while (count < 3 && words.number(numbers[static_cast<std::size_t>(count)])) ++count;
  return count;
}

/// The options, of which each has words of its own, and then the name, which may have spaces in it.
MeshTexture read_texture(LineWords& words) {
  MeshTexture texture;
  while (words.skip_space() && *words.at() == '-') {
    LineWords after = words;
    const std::string_view option = after.word();
    std::array<double, 3> numbers{};
    double number = 0;
    if (option == "-s" || option == "-o" || option == "-t") {
      const int count = read_numbers(after, numbers);
      auto& values = option == "-s" ? texture.scale : texture.offset;
      if (option != "-t") std::copy_n(numbers.begin(), std::min(count, 2), values.begin());
    } else if (option == "-bm") {
      if (after.number(number)) texture.strength = number;
    } else if (option == "-clamp") {
      texture.edge_u = texture.edge_v = after.word() == "on" ? MeshTexture::Edge::clamp : MeshTexture::Edge::repeat;
    } else if (option == "-mm") {
      if (after.number(number)) after.number(number);
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-boost" ||
               option == "-texres" || option == "-imfchan" || option == "-type") {
      after.word();
    } else {
      break;  // a name that begins so
    }
    words = after;
  }
  std::string_view name = words.rest();
  if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  texture.file = name;
  std::replace(texture.file.begin(), texture.file.end(), '\\', '/');
  return texture;
}

/// In OpenPBR's terms, what no Lambertian and Phong's highlight can show: metals, glass, lamps, and what says how rough
/// it is. Which materials are glass is said by illum (4, 6, 7 and 9), and mirrors (3, 5 and 8). An opacity without a Tf
/// is an opacity all the same, as Blender writes it with illum 6 and 9; but d 0, which shows nothing, is glass for all
/// illums that others write.
void set_physical(MeshMaterial& material) {
  const Rgb<double> black(0, 0, 0), white(1, 1, 1);
  const auto largest = [](const Rgb<double>& c) { return std::max({c.red, c.green, c.blue}); };
  const auto inside = [](double share) { return std::clamp(share, 0.0, 1.0); };
  const auto inside_color = [&](const Rgb<double>& c) {
    return Rgb<double>(inside(c.red), inside(c.green), inside(c.blue));
  };
  const int illum = material.illum.value_or(2);
  const Rgb<double> diffuse = material.kd.value_or(white), specular = material.ks.value_or(black);
  const Rgb<double> emitted = material.ke.value_or(material.map_ke.file.empty() ? black : white);
  const double opacity = material.d.value_or(1);
  const bool is_see_through =
                 !material.tf && ((opacity < 1 && (opacity > 0 || illum == 9)) || !material.map_d.file.empty()),
             is_lamp = largest(emitted) > 0,
             is_glass = (illum == 4 || illum == 6 || illum == 7 || illum == 9) && !is_see_through &&
                        largest(material.tf.value_or(white)) > 0,
             is_mirror = (illum == 3 || illum == 5 || illum == 8) && largest(specular) > 0 && largest(diffuse) == 0,
             is_rough = material.pr || material.pm || !material.map_pr.file.empty() || !material.map_pm.file.empty();
  if (!is_lamp && !is_glass && !is_mirror && !is_rough) return;
  const auto add = [&](std::string_view name, double value, const MeshTexture& texture = {}) {
    material.openpbr.push_back({name, {value, value, value}, texture});
  };
  // A number that a texture gives is 1 where the file says nothing more.
  const auto number = [](const std::optional<double>& value, const MeshTexture& map, double otherwise) {
    return value.value_or(map.file.empty() ? otherwise : 1);
  };
  material.openpbr.push_back(
      {"base_color", inside_color(is_mirror ? specular : diffuse), is_mirror ? MeshTexture{} : material.map_kd});
  material.openpbr.back().of_vertices = !is_mirror && material.map_kd.file.empty();
  add("base_metalness", inside(is_mirror ? 1 : number(material.pm, material.map_pm, 0)), material.map_pm);
  // The alpha of facets that reflect about as Phong's lobe does (Walter and others, 2007).
  const double of_highlight =
      is_glass || is_mirror ? 0 : std::pow(2 / (std::max(material.ns.value_or(20), 0.0) + 2), 0.25);
  add("specular_roughness", inside(number(material.pr, material.map_pr, of_highlight)), material.map_pr);
  if (!is_rough && !is_glass && !is_mirror && (illum < 2 || largest(specular) == 0)) add("specular_weight", 0);
  const double ior = material.ni.value_or(1.5);
  add("specular_ior", std::clamp(ior > 1 ? ior : 1.5, 1.0, 10.0));
  if (is_glass) {
    add("transmission_weight", 1);
    material.openpbr.push_back({"transmission_color", color_of_one_face(inside_color(material.tf.value_or(white)))});
    material.d.reset();
  }
  if (is_lamp) {
    add("emission_luminance", 1);
    material.openpbr.push_back({"emission_color", emitted, material.map_ke});
  }
  if (material.ps.value_or(0) > 0) add("fuzz_weight", inside(*material.ps));
  if (material.pc.value_or(0) > 0) {
    add("coat_weight", inside(*material.pc));
    add("coat_roughness", inside(material.pcr.value_or(0)));
    add("coat_ior", 1.5);  // as glTF's, whose base keeps its colour
    add("coat_darkening", 0);
  }
  if (material.aniso.value_or(0) > 0) add("specular_roughness_anisotropy", inside(*material.aniso));
}

/// Adds the materials of a file. Calls report(line, message) for what is wrong, which is skipped, but for materials
/// that are overridden.
void read_text(std::string_view text, std::vector<MeshMaterial>& materials, const MeshReadSettings& settings,
               const std::function<void(std::uint32_t, const std::string&)>& report) {
  const std::size_t first = materials.size();
  bool any = false;
  std::vector<std::string> left_out;
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  for_each_line<true>(text, [&](const char* start, const char* end) {
    LineWords words(start, end);
    std::string keyword(words.word());
    std::transform(keyword.begin(), keyword.end(), keyword.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (keyword.empty()) return true;
    const bool is_overridden = any && settings.overrides(materials.back().name);
    const auto refuse = [&](const std::string& what) {
      if (is_overridden) return true;
      report(locate(text, static_cast<std::size_t>(start - text.data())).line, what);
      return true;
    };
    if (keyword == "newmtl") {
      materials.push_back({});
      materials.back().name = words.rest();
      any = true;
      return true;
    }
    const auto* const color = find_field(color_fields, keyword);
    const auto* const number = find_field(number_fields, keyword);
    const auto* const texture = find_field(texture_fields, keyword);
    if (!is_overridden && std::find(std::begin(unread), std::end(unread), keyword) != std::end(unread) &&
        std::find(left_out.begin(), left_out.end(), keyword) == left_out.end()) {
      left_out.push_back(keyword);
      return refuse(in_quotes(keyword) + " is left out, here and in the rest of the file");
    }
    if (color == nullptr && number == nullptr && texture == nullptr && keyword != "illum") return true;
    if (!any) return refuse(in_quotes(keyword) + " before the first newmtl");
    MeshMaterial& material = materials.back();
    if (texture != nullptr) {
      material.*texture->member = read_texture(words);
      return true;
    }
    LineWords after = words;
    if (after.word() == "-halo") words = after;
    std::array<double, 3> values{};
    const int count = read_numbers(words, values);
    if (color != nullptr) {
      if (count != 1 && count != 3) return refuse(in_quotes(keyword) + " needs one or three numbers");
      const auto [red, green, blue] = values;
      material.*color->member = count == 1 ? Rgb<double>(red, red, red) : Rgb<double>(red, green, blue);
    } else if (count < 1) {
      return refuse(in_quotes(keyword) + " needs a number");
    } else if (number != nullptr) {
      material.*number->member = keyword == "tr" ? 1 - values[0] : values[0];
    } else {
      material.illum = values[0] >= 0 && values[0] <= 10 ? static_cast<int>(values[0]) : 0;
    }
    return true;
  });
  for (std::size_t i = first; i < materials.size(); ++i) set_physical(materials[i]);
}

}  // namespace
}  // namespace mtl

void read_material_libraries(std::string_view names, const std::string& folder, std::uint32_t line,
                             std::vector<MeshMaterial>& materials, std::vector<std::string>& files,
                             const MeshReadSettings& settings, Diagnostics& diagnostics) {
  const auto read = [&](std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::string path = (std::filesystem::path(folder) / name).string();
    Diagnostics of_library(path);
    std::optional<MeshFile> file = MeshFile::open(path, of_library);
    if (!file || !file->load(1, of_library)) {
      diagnostics.warning({line, 0}, in_quotes(name) + ": " + of_library.kept().front().message);
      return;
    }
    files.push_back(path);
    mtl::read_text(file->text(true), materials, settings, [&](std::uint32_t in_line, const std::string& message) {
      diagnostics.warning({line, 0}, name + ":" + std::to_string(in_line) + ": " + message);
    });
  };
  std::error_code unknown;
  if (std::filesystem::exists(std::filesystem::path(folder) / names, unknown)) return read(std::string(names));
  LineWords words(names.data(), names.data() + names.size());
  for (std::string_view name = words.word(); !name.empty(); name = words.word()) read(std::string(name));
}

}  // namespace raytrace
