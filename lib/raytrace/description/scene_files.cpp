#include "raytrace/description/scene_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "raytrace/description/scene_layout.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

// A few files that include each other's copies could otherwise be any number.
constexpr std::size_t most_files = 20000, most_at_hand = 64;

/// Empty for a file, and for what does not exist.
std::string explain_no_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) return "it is a folder";
  // A pipe might never answer, and a device never end.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return "it is not a regular file";
  return {};
}

/// By its name: what other programs write points to.
bool is_file_of_points(const std::string& file) {
  static constexpr std::array<std::string_view, 8> types = {".xyz", ".csv", ".pdb", ".pts",
                                                            ".las", ".laz", ".e57", ".vtk"};
  return std::find(types.begin(), types.end(), std::filesystem::path(file).extension().string()) != types.end();
}

/// The root may name its schema, as editors like it.
void refuse_root_attributes(Element root, Diagnostics& diagnostics) {
  for (Attribute attribute = root.first_attribute(); attribute; attribute = attribute.next()) {
    const bool declaration =
        attribute.name() == "xmlns:xsi" && attribute.value() == "http://www.w3.org/2001/XMLSchema-instance";
    if (declaration || attribute.name() == "xsi:noNamespaceSchemaLocation") continue;
    diagnostics.error(attribute, [&] {
      return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(root.name()) + "; remove it";
    });
  }
}

/// False if nothing that is in it would be understood.
bool check_root(Element root, Diagnostics& diagnostics) {
  if (root.name() != root_element) {
    diagnostics.error(root, [&] {
      const bool is_mitsuba =
          root.name() == "scene" && root.first_attribute() && root.first_attribute().name() == "version";
      return "the scene starts with " + tag(root.name()) + "; it must be " + tag(root_element) +
             (is_mitsuba ? ". This seems to be a Mitsuba scene: docs/from-mitsuba.md tells how to come over" : "");
    });
    if (nearest_name(root.name(), {&root_element, 1}).empty()) return false;
  }
  refuse_root_attributes(root, diagnostics);
  return true;
}

}  // namespace

bool may_have_keys(const SceneFile& file, Element group) {
  const auto [first, count, items] = file.text.chunks_of(group.offset());
  for (std::size_t i = first; i < first + count; ++i)
    if (file.text.of(file.text.chunk(i)).find("<key") != std::string_view::npos) return true;
  return false;
}

const SceneFile* SceneFiles::add(TextBuffer text, const std::string& file) {
  const auto folder = std::filesystem::path(file).parent_path().string();
  SceneFile& added =
      files_.emplace_back(SceneText(std::move(text), group_elements(), threads_, diagnostics_, next_line_), next_chunk_,
                          folder, ReadContext{variables_, diagnostics_, {}});
  added.context.folder = added.folder;
  next_line_ = added.text.last_line() + 1;
  next_chunk_ += added.text.chunk_count();
  if (added.text.well_formed()) added.skeleton.parse_skeleton(diagnostics_);
  const Element root = added.skeleton.root();
  if (!root || !check_root(root, diagnostics_)) return nullptr;
  at_hand_.push_back(file);
  return &added;
}

const SceneFile* SceneFiles::open(TextBuffer text, const std::string& file) {
  if (is_file_of_points(file) && text.text().find("<raytracer") == std::string_view::npos) {
    diagnostics_.error(
        {next_line_, 1},
        std::string("this is no scene by its name: points are read by the <spherecloud> of a scene, from a "
                    ".ply with x, y and z"));
    return nullptr;
  }
  return add(std::move(text), file);
}

const SceneFile* SceneFiles::include(const FileName& file) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics_.error(location_of(file), on_one_line(file.path) + ": " + reason);
    return nullptr;
  };
  const auto is_this = [&](const std::string& other) {
    std::error_code error;
    return std::filesystem::equivalent(other, file.path, error);
  };
  if (std::any_of(at_hand_.begin(), at_hand_.end(), is_this)) return refuse("it would include itself");
  if (at_hand_.size() >= most_at_hand)
    return refuse("a file that is included may include others, but not more than " + std::to_string(most_at_hand) +
                  " one in the other");
  if (files_.size() >= most_files) return refuse("a scene has at most " + std::to_string(most_files) + " files");
  if (const std::string reason = explain_no_file(file.path); !reason.empty())
    return refuse("cannot read the scene: " + reason);
  Diagnostics found(file.path);
  // "-" is a file's name here.
  std::optional<TextBuffer> text = read_text_file(file.path == "-" ? "./-" : file.path, threads_, found);
  if (!text) return refuse(found.kept().front().message);
  if (text->text().size() + 1 >= std::numeric_limits<std::uint32_t>::max() - next_line_)
    return refuse("the files of the scene are larger than 4 GiB");
  const auto is_same = [&](const IncludedFile& other) { return is_this(other.name); };
  if (text->text().find("<name>") != std::string_view::npos && std::any_of(included_.begin(), included_.end(), is_same))
    return refuse("it is included twice, and its names can be there but once");
  included_.push_back({file.path, next_line_});
  diagnostics_.add_files({&included_.back(), 1});
  return add(std::move(*text), file.path);
}

Element SceneFiles::item_at(ItemPosition position, std::unique_ptr<Document>& document) const {
  const auto next = std::upper_bound(files_.begin(), files_.end(), position.chunk,
                                     [](std::size_t chunk, const SceneFile& file) { return chunk < file.first_chunk; });
  const SceneFile& file = *(next - 1);
  document = std::make_unique<Document>(file.text);
  Diagnostics none = Diagnostics::counter();
  document->parse_items(file.text.chunk(position.chunk - file.first_chunk), none);
  std::uint32_t number = 0;
  Node node = document->root().first_child();
  while (!node.element() || number++ < position.number) node = node.next();
  return node.element();
}

}  // namespace raytrace
