#include "raytrace/import/gltf_document.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "raytrace/import/gltf_meshopt.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/text/message.h"

namespace raytrace::gltf {
namespace {

/// A sparse accessor without values of its own has at most so many for each that it changes.
constexpr std::size_t most_zeros = 256;

/// A reason of nlohmann::json whole, but for what it quotes of the file, which may be a long string or number.
std::string with_short_quote(std::string_view reason) {
  std::size_t first = std::string_view::npos;
  for (const std::string_view before : {"last read: '", "overflow parsing '"})
    if (const std::size_t found = reason.find(before); first == std::string_view::npos && found < reason.size())
      first = found + before.size();
  const std::size_t end = std::min(reason.rfind("'; expected "), reason.rfind('\''));
  if (first == std::string_view::npos || end < first) return on_one_line(reason);
  return on_one_line(reason.substr(0, first)) + printable(reason.substr(first, end - first)) +
         on_one_line(reason.substr(end));
}

nlohmann::json parsed(std::string_view text) {
  try {
    return nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::exception& error) {
    std::string reason = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    reason.erase(0, reason.find("] ") + 2);
    throw Error("is no glTF: " + with_short_quote(reason));
  }
}

ComponentType component_type(const Item& of) {
  const Item number = of["componentType"];
  const auto value = static_cast<ComponentType>(std::min<std::uint64_t>(number.whole(), 9999));
  const bool is_integer = value >= ComponentType::byte && value <= ComponentType::unsigned_short;
  if (!is_integer && value != ComponentType::unsigned_integer && value != ComponentType::number)
    number.fail("is none of 5120 to 5123, 5125 and 5126");
  return value;
}

}  // namespace

std::string file_name(const Item& uri) {
  std::string name = percent_decoded(uri.text());
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.find('\0') != std::string::npos) uri.fail("is no name of a file");
  return name;
}

Document::Document(std::string_view file, std::string name, int threads)
    : chunks_(chunks_of(file)),
      json_(parsed(chunks_.json)),
      root_(json_, ""),
      name_(std::move(name)),
      threads_(threads),
      size_(file.size()) {}

Accessor Document::accessor_of_zeros(const Item& number) const {
  const Item item = listed("accessors", number);
  Accessor accessor{item.place(), {}};
  Elements& elements = accessor.elements;
  static constexpr std::pair<std::string_view, std::size_t> types[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const Item type = item["type"];
  for (const auto& [name, components] : types)
    if (type.text() == name) elements.components = components;
  if (elements.components == 0) type.fail("is none of SCALAR, VEC2, VEC3, VEC4 and MAT4");
  elements.type = component_type(item);
  elements.count = item["count"].whole();
  if (const auto normalized = item.find("normalized"))
    elements.normalized = normalized->is_true() && elements.type != ComponentType::number;
  return accessor;
}

Accessor Document::accessor(const Item& number) {
  const Item item = listed("accessors", number);
  Accessor accessor = accessor_of_zeros(number);
  Elements& elements = accessor.elements;
  if (const auto view = item.find("bufferView"))
    read_values(item, listed("bufferViews", *view), elements);
  else if (!item.find("sparse"))
    item.fail("has neither 'bufferView' nor 'sparse'");
  if (const auto sparse = item.find("sparse")) {
    const Item indices = (*sparse)["indices"], values = (*sparse)["values"];
    Elements& changed = accessor.changed_indices;
    changed.count = (*sparse)["count"].whole();
    changed.components = 1;
    changed.type = component_type(indices);
    if (!changed.has_whole_numbers()) indices.fail("are no whole numbers");
    read_values(indices, listed("bufferViews", indices["bufferView"]), changed);
    accessor.changed_values = elements;
    accessor.changed_values.count = changed.count;
    read_values(values, listed("bufferViews", values["bufferView"]), accessor.changed_values);
    if (elements.first == nullptr && elements.count / most_zeros > changed.count)
      item.fail("claims " + std::to_string(elements.count) + " elements, of which the file has " +
                std::to_string(changed.count));
  }
  return accessor;
}

void Document::read_values(const Item& item, const Item& view, Elements& elements) {
  const std::string_view bytes = view_bytes(view);
  const std::size_t size = size_of(elements.type);
  const std::size_t element = elements.components * size;
  elements.stride = view.whole("byteStride", element);
  if (elements.stride < element || elements.stride > 252)
    view.fail("its byteStride, " + std::to_string(elements.stride) + ", is not from " + std::to_string(element) +
              " to 252");
  const std::size_t offset = item.whole("byteOffset", 0);
  const std::size_t room = offset > bytes.size() || bytes.size() - offset < element
                               ? 0
                               : (bytes.size() - offset - element) / elements.stride + 1;
  if (elements.count > room)
    item.fail("claims " + std::to_string(elements.count) + " elements, and " + view.place() + " has room for " +
              std::to_string(room));
  elements.first = bytes.data() + offset;
}

std::string_view Document::view_bytes(const Item& view) {
  const std::optional<MeshoptLayout> layout = meshopt_layout(view);
  if (!layout) return stored_bytes(view);
  const auto [known, is_new] = decoded_views_.try_emplace(view.place());
  if (is_new) {
    const std::string_view stored = stored_bytes(layout->compressed);
    expand(layout->size(), layout->compressed);
    known->second = keep(meshopt_decoded(*layout, stored));
  }
  return known->second;
}

std::string_view Document::stored_bytes(const Item& view) {
  const std::string_view bytes = buffer(view["buffer"]);
  const std::uint64_t offset = view.whole("byteOffset", 0), length = view["byteLength"].whole();
  if (offset > bytes.size() || length > bytes.size() - offset)
    view.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " + std::to_string(bytes.size()));
  return bytes.substr(offset, length);
}

std::string_view Document::buffer(const Item& number) {
  const Item item = listed("buffers", number);
  const std::optional<Item> uri = item.find("uri");
  std::string_view bytes;
  if (!uri) {
    if (number.whole() != 0 || !chunks_.binary) item.fail("has no 'uri', and is not the binary chunk of a GLB file");
    bytes = *chunks_.binary;
  } else if (const auto known = data_.find(number.whole()); known != data_.end()) {
    bytes = known->second;
  } else if (uri->text().starts_with("data:")) {
    try {
      bytes = data_[number.whole()] = data_of_uri(uri->text()).value();
    } catch (const Error& error) {
      uri->fail(error.what());
    }
  } else {
    const std::string name = file_name(*uri);
    auto file = files_.find(name);
    if (file == files_.end()) {
      const std::string path = beside(name);
      Diagnostics found(path);
      std::optional<MeshFile> opened = MeshFile::open(path, found);
      if (!opened || !opened->load(threads_, found)) item.fail(in_quotes(name) + ": " + found.kept().front().message);
      size_ += opened->size();
      file = files_.emplace(name, std::move(*opened)).first;
    }
    bytes = file->second.text(false);
  }
  const std::uint64_t length = item["byteLength"].whole();
  if (length > bytes.size())
    item.fail("claims " + std::to_string(length) + " bytes, and there are " + std::to_string(bytes.size()));
  return bytes.substr(0, length);
}

std::string Document::beside(const std::string& file) const {
  return (std::filesystem::path(name_).parent_path() / file).string();
}

std::vector<std::string> Document::files() const {
  std::vector<std::string> paths;
  for (const auto& [name, file] : files_) paths.push_back(beside(name));
  return paths;
}

void Document::spend(std::size_t values, const Item& place) {
  constexpr std::size_t most_of_small_file = 1'000'000;
  spent_ += std::min(values, std::size_t{1} << 48U);
  if (spent_ > 4 * size() + most_of_small_file) place.fail("asks for more numbers than the file can have");
}

bool Document::may_look_at(std::size_t values) {
  constexpr std::size_t most = 100'000'000;
  looked_at_ += values;
  return looked_at_ <= most;
}

void Document::expand(std::size_t bytes, const Item& place) {
  // A flat grid of a million triangles is written by Draco in an eighth of a byte for each, which takes this decoder a
  // thousand times as much; meshoptimizer writes 256 equal bytes as two bits.
  constexpr std::size_t most_of_each_byte = 4096, worth_a_look = 64;
  expanded_ += std::min(bytes, std::size_t{1} << 48U);
  if (expanded_ > most_of_each_byte * size_ || (expanded_ > worth_a_look * size_ && expanded_ > available_memory() / 4))
    place.fail("claims to be " + std::to_string(bytes) + " bytes when it is decoded, too many for a file of " +
               std::to_string(size_));
}

void Document::warn_once(const std::string& place, const std::string& message) {
  if (!is_quiet_ && warned_.insert(message).second) warn(place, message);
}

void Document::report(Diagnostics& diagnostics) const {
  for (const std::string& warning : warnings_) diagnostics.warning({}, warning);
}

std::uint64_t Document::number_by_name(const std::optional<Item>& list, const std::string& name,
                                       const char* what) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const std::string of_item = (*list)[i].name();
    if (of_item == name) return i;
    names.push_back(of_item.empty() ? std::to_string(i) : in_quotes(of_item));
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::to_string(i) == name) return i;
  root_.fail("has no " + std::string(what) + ' ' + in_quotes(name) +
             (names.empty() ? ", nor any other" : "; there are " + joined(names, ", ")));
}

}  // namespace raytrace::gltf
