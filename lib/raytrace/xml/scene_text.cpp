#include "raytrace/xml/scene_text.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parallel/read_file_at.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/xml_characters.h"
#include "raytrace/xml/xml_scanner.h"

namespace raytrace {

namespace {

constexpr std::size_t largest_file = std::size_t(1) << 31;

struct Close {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};

/// A file of known size, by several threads: memory that is fresh from the system takes longer to get than the bytes to
/// copy. No value if the file does not have that size, or cannot be read from an offset on.
std::optional<TextBuffer> read_in_parallel(int file, std::size_t size, int threads) {
  constexpr std::size_t block = std::size_t(1) << 21;
  TextBuffer text(size);
  std::atomic<bool> complete{true};
  for_each_index(static_cast<int>((size + block - 1) / block), threads, [&](int index) {
    const std::size_t offset = static_cast<std::size_t>(index) * block, count = std::min(block, size - offset);
    if (read_file_at(file, text.data() + offset, count, offset) != count) complete = false;
  });
  char next = 0;
  if (!complete || read_file_at(file, &next, 1, size) != 0) return std::nullopt;
  text.lengthen_to(size);
  return text;
}

using namespace std::string_view_literals;

constexpr const char* picture = "; if it is the picture to write, put -o before it";
constexpr const char* piece = "; if it is a piece of a picture, use raytrace merge";
constexpr const char* packed = "; unpack it first";
constexpr const char* model = ", and models by their names' ends: .glb, .gltf, .obj, .ply, .stl, .fbx, .dae and others";
constexpr const char* other_model = ", and models in .glb, .gltf, .obj, .ply and .stl: export it as one of them";

struct FileType {
  std::string_view start;
  const char* name;
  const char* advice = "";
};

constexpr FileType file_types[] = {
    {"ply\n"sv, "a PLY model", model},
    {"ply\r"sv, "a PLY model", model},
    {"glTF"sv, "a glTF model (.glb)", model},
    {"BLENDER"sv, "a Blender file", other_model},
    {"Kaydara FBX Binary"sv, "an FBX model", model},
    {"; FBX"sv, "an FBX model", model},
    {"solid "sv, "an STL model", model},
    {"Ogawa"sv, "an Alembic model", other_model},
    {"OFF\n"sv, "an OFF model", model},
    {"PXR-USDC"sv, "a USD scene", other_model},
    {"#usda"sv, "a USD scene", other_model},
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
    if (is_one_of(word, povray))
      return FileType{{}, "a POV-Ray scene", "; docs/from-pov-ray.md tells how to come over"};
    if (is_one_of(word, pbrt)) return FileType{{}, "a pbrt scene"};
    if (is_one_of(word, obj)) return FileType{{}, "a Wavefront OBJ model", model};
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
    if (text.size() - stl_start == triangles * stl_triangle) return FileType{{}, "an STL model", model};
  }
  if (without_space(text).starts_with('{') && text.find("\"asset\"") != std::string_view::npos)
    return FileType{{}, "a glTF model", model};
  return type_by_words(text);
}

}  // namespace

SceneText::SceneText(TextBuffer text, std::span<const std::string_view> groups, int threads, Diagnostics& diagnostics,
                     std::uint32_t first_line)
    : text_(std::move(text)), first_line_(first_line), last_line_(first_line) {
  if (const auto error = find_xml_error(text_.text(), groups, chunks_, threads)) {
    LineMark mark = first_mark(text_.text(), first_line);
    mark.pass(text_.text().substr(0, error->offset));
    if (const auto type = explain_file_type(text_.text()))
      diagnostics.error({first_line, 1}, *type);
    else
      diagnostics.error(mark.location(), error->message);
    mark.pass(text_.text().substr(error->offset));
    last_line_ = mark.line;
    chunks_.clear();
    return;
  }
  measure(threads);
}

void SceneText::measure(int threads) {
  // At the end of each chunk, as if it started in line 0.
  std::vector<LineMark> ends(chunks_.size());
  for_each_index(static_cast<int>(chunks_.size()), threads, [&](int i) {
    const TextChunk& chunk = chunks_[static_cast<std::size_t>(i)];
    LineMark& end = ends[static_cast<std::size_t>(i)];
    end = {chunk.begin, 0, 0};
    end.pass(text_.text().substr(chunk.begin, chunk.end - chunk.begin));
  });
  const auto span_to = [](const LineMark& mark, std::size_t end) {
    return Span{mark.offset, end, mark.line, mark.line_start};
  };
  LineMark mark = first_mark(text_.text(), first_line_);  // where what has no span yet begins
  chunk_spans_.reserve(chunks_.size());
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (const std::size_t begin = chunks_[i].begin; mark.offset != begin) {
      skeleton_.push_back(span_to(mark, begin));
      mark.pass(text_.text().substr(mark.offset, begin - mark.offset));
    }
    chunk_spans_.push_back(span_to(mark, chunks_[i].end));
    mark = {chunks_[i].end, mark.line + ends[i].line, ends[i].line > 0 ? ends[i].line_start : mark.line_start};
  }
  skeleton_.push_back(span_to(mark, text_.text().size()));
  mark.pass(text_.text().substr(mark.offset));
  last_line_ = mark.line;
}

SceneText::ChunkRange SceneText::chunks_of(std::size_t group) const {
  const auto [first, last] = std::equal_range(chunks_.begin(), chunks_.end(), TextChunk{group, 0, 0},
                                              [](const TextChunk& a, const TextChunk& b) { return a.group < b.group; });
  std::size_t items = 0;
  for (auto chunk = first; chunk != last; ++chunk) items += chunk->items;
  return {static_cast<std::size_t>(first - chunks_.begin()), static_cast<std::size_t>(last - first), items};
}

SourceLocation SceneText::locate(std::size_t offset, LineMark& near) const {
  // The last mark that is not behind it: of the skeleton, of the chunks, or the near one.
  LineMark start = first_mark(text_.text(), first_line_);
  const auto use_later = [&](const LineMark& mark) {
    if (mark.offset <= offset && mark.offset >= start.offset) start = mark;
  };
  for (const std::vector<Span>* const spans : {&skeleton_, &chunk_spans_}) {
    const auto next = std::upper_bound(spans->begin(), spans->end(), offset,
                                       [](std::size_t wanted, const Span& span) { return wanted < span.begin; });
    if (next != spans->begin()) use_later((next - 1)->mark());
  }
  if (near.offset > start.offset) use_later(near);
  near = start;
  near.pass(text_.text().substr(start.offset, offset - start.offset));
  return near.location();
}

std::optional<TextBuffer> read_text_file(const std::string& file, int threads, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics.error({}, "cannot read the scene: " + reason);
    return std::nullopt;
  };
  const auto reason = [](int error) { return std::generic_category().message(error); };

  const std::unique_ptr<std::FILE, Close> input(file == "-" ? stdin : std::fopen(file.c_str(), "rb"));
  if (!input) return refuse(reason(errno));

  std::error_code unknown_size;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown_size);
  constexpr std::size_t large_file = std::size_t(1) << 22;
  if (!unknown_size && size >= large_file && size <= largest_file) {
    if (std::optional<TextBuffer> text = read_in_parallel(fileno(input.get()), static_cast<std::size_t>(size), threads))
      return text;
  }

  // A pipe or a device has no size beforehand, and a file may grow: the room is doubled while there is more.
  TextBuffer text(unknown_size ? std::size_t(1) << 16
                               : static_cast<std::size_t>(std::min<std::uintmax_t>(size, largest_file)) + 1);
  std::size_t length = 0;
  while (true) {
    errno = 0;
    length += std::fread(text.data() + length, 1, text.room() - length, input.get());
    if (std::ferror(input.get())) return refuse(reason(errno));
    if (length > largest_file) return refuse("it is larger than 2 GiB");
    text.lengthen_to(length);
    if (length < text.room()) return text;
    TextBuffer larger(2 * length);
    larger.append(text.text());
    text = std::move(larger);
  }
}

std::optional<std::string> explain_file_type(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  if (without_space(text).starts_with('<')) return std::nullopt;
  const std::optional<FileType> type = type_of(text);
  if (!type) return std::nullopt;
  return std::string("this seems to be ") + type->name +
         "; raytrace reads scenes in XML, which start with <raytracer>" + type->advice;
}

}  // namespace raytrace
