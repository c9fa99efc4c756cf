#include "raytrace/xml/file_type.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "raytrace/xml/diagnostics.h"

namespace raytrace {

namespace {

using namespace std::string_view_literals;

constexpr const char* picture = "; if it is the picture to write, put -o before it";
constexpr const char* piece = "; if it is a piece of a picture, use raytrace merge";
constexpr const char* packed = "; unpack it first";

struct FileType {
  std::string_view start;
  const char* name;
  const char* advice = "";
};

constexpr FileType file_types[] = {
    {"ply\n"sv, "a PLY model"},
    {"ply\r"sv, "a PLY model"},
    {"glTF"sv, "a glTF model (.glb)"},
    {"BLENDER"sv, "a Blender file"},
    {"Kaydara FBX Binary"sv, "an FBX model"},
    {"; FBX"sv, "an FBX model"},
    {"solid "sv, "an STL model"},
    {"Ogawa"sv, "an Alembic model"},
    {"OFF\n"sv, "an OFF model"},
    {"PXR-USDC"sv, "a USD scene"},
    {"#usda"sv, "a USD scene"},
    {"##RenderMan"sv, "a RenderMan scene (RIB)"},
    {"\x76\x2f\x31\x01"sv, "an OpenEXR picture", piece},
    {"\x89PNG"sv, "a PNG picture", picture},
    {"\xff\xd8\xff"sv, "a JPEG picture", picture},
    {"GIF8"sv, "a GIF picture", picture},
    {"II*\0"sv, "a TIFF picture", picture},
    {"MM\0*"sv, "a TIFF picture", picture},
    {"#?R"sv, "a Radiance picture (.hdr)", picture},
    {"RIFF"sv, "a WebP picture or another RIFF file", picture},
    {"\x1f\x8b"sv, "packed with gzip", packed},
    {"BZh"sv, "packed with bzip2", packed},
    {"\xfd"
     "7zXZ"sv,
     "packed with xz", packed},
    {"\x28\xb5\x2f\xfd"sv, "packed with zstd, as Blender does with its files", packed},
    {"PK\x03\x04"sv, "a ZIP archive", packed},
    {"7z\xbc\xaf"sv, "a 7z archive", packed},
    {"%PDF"sv, "a PDF document"},
    {"\x7f"
     "ELF"sv,
     "a program"},
    {"#!"sv, "a script"},
};

std::string_view without_space(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

std::string_view first_word(std::string_view line) { return line.substr(0, line.find_first_of(" \t\r\n{\"[(")); }

/// By the words that the first lines begin with, comments left out.
std::optional<FileType> type_by_words(std::string_view text) {
  static constexpr std::string_view obj[] = {"v", "vt", "vn", "vp", "f", "o", "g", "s", "mtllib", "usemtl"};
  static constexpr std::string_view pbrt[] = {"LookAt",     "Camera",      "Film",   "Sampler",
                                              "Integrator", "WorldBegin",  "Scale",  "Option",
                                              "Transform",  "PixelFilter", "Rotate", "Translate"};
  static constexpr std::string_view povray[] = {"#include",        "#version", "#declare", "camera", "light_source",
                                                "global_settings", "sphere",   "union",    "plane"};
  const auto is_one_of = [](std::string_view word, const auto& words) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
  };
  for (int lines = 0; lines < 100 && !(text = without_space(text)).empty(); ++lines) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::string_view word = first_word(line);
    if (is_one_of(word, povray)) return FileType{{}, "a POV-Ray scene"};
    if (is_one_of(word, pbrt)) return FileType{{}, "a pbrt scene"};
    if (is_one_of(word, obj)) return FileType{{}, "a Wavefront OBJ model"};
    if (!line.starts_with('#') && !line.starts_with("//")) return std::nullopt;
    text.remove_prefix(line.size());
  }
  return std::nullopt;
}

std::optional<FileType> type_of(std::string_view text) {
  for (const FileType& type : file_types)
    if (text.starts_with(type.start)) return type;
  // Its first 80 bytes are anything; a number of triangles of 50 bytes each follows.
  constexpr std::size_t stl_header = 80, stl_start = 84, stl_triangle = 50;
  if (text.size() >= stl_start) {
    std::size_t triangles = 0;
    for (std::size_t i = 4; i-- > 0;) triangles = triangles << 8U | static_cast<unsigned char>(text[stl_header + i]);
    if (text.size() - stl_start == triangles * stl_triangle) return FileType{{}, "an STL model"};
  }
  if (without_space(text).starts_with('{') && text.find("\"asset\"") != std::string_view::npos)
    return FileType{{}, "a glTF model"};
  return type_by_words(text);
}

}  // namespace

std::optional<std::string> explain_file_type(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  if (without_space(text).starts_with('<')) return std::nullopt;
  const std::optional<FileType> type = type_of(text);
  if (!type) return std::nullopt;
  return std::string("this seems to be ") + type->name +
         "; raytrace reads scenes in XML, which start with <raytracer>" + type->advice;
}

}  // namespace raytrace
