// MTL, the materials of OBJ files: https://paulbourke.net/dataformats/mtl/, with the usual additions for roughness
// (Pr), metalness (Pm) and normal maps (norm). Statements without a meaning here are skipped.
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <string>

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
constexpr Field<std::optional<Rgb<double>>> color_fields[] = {{"ka", &MeshMaterial::ka},
                                                              {"kd", &MeshMaterial::kd},
                                                              {"ks", &MeshMaterial::ks},
                                                              {"ke", &MeshMaterial::ke},
                                                              {"tf", &MeshMaterial::tf}};
constexpr Field<std::optional<double>> number_fields[] = {{"ns", &MeshMaterial::ns}, {"d", &MeshMaterial::d},
                                                          {"tr", &MeshMaterial::d},  {"ni", &MeshMaterial::ni},
                                                          {"pr", &MeshMaterial::pr}, {"pm", &MeshMaterial::pm}};
constexpr Field<MeshTexture> texture_fields[] = {
    {"map_ka", &MeshMaterial::map_ka},     {"map_kd", &MeshMaterial::map_kd}, {"map_ks", &MeshMaterial::map_ks},
    {"map_ke", &MeshMaterial::map_ke},     {"map_ns", &MeshMaterial::map_ns}, {"map_d", &MeshMaterial::map_d},
    {"map_bump", &MeshMaterial::map_bump}, {"bump", &MeshMaterial::map_bump}, {"map_pr", &MeshMaterial::map_pr},
    {"map_pm", &MeshMaterial::map_pm},     {"norm", &MeshMaterial::norm}};

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
      texture.edge = after.word() == "on" ? MeshTexture::Edge::clamp : MeshTexture::Edge::repeat;
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

/// Adds the materials of a file. Calls report(line, message) for what is wrong, which is skipped.
void read_text(std::string_view text, std::vector<MeshMaterial>& materials,
               const std::function<void(std::uint32_t, const std::string&)>& report) {
  bool any = false;
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  for_each_line<true>(text, [&](const char* start, const char* end) {
    LineWords words(start, end);
    std::string keyword(words.word());
    std::transform(keyword.begin(), keyword.end(), keyword.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (keyword.empty()) return true;
    const auto refuse = [&](const std::string& what) {
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
}

}  // namespace
}  // namespace mtl

void read_material_libraries(std::string_view names, const std::string& folder, std::uint32_t line,
                             std::vector<MeshMaterial>& materials, std::vector<std::string>& files,
                             Diagnostics& diagnostics) {
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
    mtl::read_text(file->text(true), materials, [&](std::uint32_t in_line, const std::string& message) {
      diagnostics.warning({line, 0}, name + ":" + std::to_string(in_line) + ": " + message);
    });
  };
  std::error_code unknown;
  if (std::filesystem::exists(std::filesystem::path(folder) / names, unknown)) return read(std::string(names));
  LineWords words(names.data(), names.data() + names.size());
  for (std::string_view name = words.word(); !name.empty(); name = words.word()) read(std::string(name));
}

}  // namespace raytrace
