// glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html.
#include "raytrace/import/gltf_model.h"

#include <filesystem>
#include <set>
#include <utility>

#include "raytrace/import/gltf_json.h"
#include "raytrace/import/gltf_material.h"
#include "raytrace/import/gltf_view.h"

namespace raytrace::gltf {
namespace {

using nlohmann::json;

/// A sparse accessor without values of its own has at most so many for each that it changes.
constexpr std::size_t most_zeros = 256;

json parsed(std::string_view text) {
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::exception& error) {
    std::string reason = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    reason.erase(0, reason.find("] ") + 2);
    throw Error("is no glTF: " + printable(reason));
  }
}

std::string file_name(const Item& uri) {
  std::string name = percent_decoded(uri.text());
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.find('\0') != std::string::npos) uri.fail("is no name of a file");
  return name;
}

class ModelReader {
 public:
  ModelReader(std::string_view file, std::string name, int threads)
      : chunks_(chunks_of(file)),
        json_(parsed(chunks_.json)),
        root_(json_, ""),
        name_(std::move(name)),
        threads_(threads) {}

  Model read(Diagnostics& diagnostics) {
    check_version();
    check_extensions(diagnostics);
    read_nodes();
    for (const std::string& warning : warnings_) diagnostics.warning({}, warning);
    return std::move(model_);
  }

 private:
  /// The item of a list at the root that `from` names by its number.
  Item listed(const char* list, const Item& from) const {
    const std::uint64_t number = from.whole();
    const std::optional<Item> items = root_.find(list);
    if (!items || number >= items->size())
      from.fail("there is no " + std::string(list) + '[' + std::to_string(number) + ']');
    return (*items)[number];
  }

  void check_version() const;
  void check_extensions(Diagnostics& diagnostics) const;
  void read_nodes();
  void add_light(const Item& number, const Affine& transform);
  static Affine transform_of(const Item& node);
  const std::vector<Primitive>& mesh(const Item& number);
  std::vector<Primitive> primitives_of(const Item& mesh);
  Accessor accessor(const Item& number);
  void read_values(const Item& item, const Item& view, Elements& elements);
  std::string_view view_bytes(const Item& view);
  std::string_view buffer(const Item& number);
  std::uint32_t material(const Item& number);
  MeshTexture texture(const Item& info);
  void warn_once(const std::string& place, const std::string& message);

  Chunks chunks_;
  json json_;
  Item root_;
  std::string name_;
  int threads_;
  Model model_;
  std::map<std::uint64_t, std::uint32_t> materials_;                    ///< their numbers in the model
  std::map<std::uint64_t, std::shared_ptr<const std::string>> images_;  ///< those in buffers and URIs
  std::vector<std::string> warnings_;
  std::set<std::string> warned_;  ///< of what is said of the first place alone
};

void ModelReader::check_version() const {
  const std::string version = root_["asset"]["version"].text();
  if (!version.starts_with("2.")) root_.fail("is glTF " + in_quotes(version) + ", and not 2.0");
}

void ModelReader::check_extensions(Diagnostics& diagnostics) const {
  const auto is_read = [](std::string_view name) {
    return name == "KHR_mesh_quantization" || name == "KHR_texture_transform" || name == lights_extension ||
           is_material_extension(name);
  };
  const auto names = [&](const char* key) {
    std::vector<std::string> unknown;
    if (const auto list = root_.find(key))
      for (std::size_t i = 0; i < list->size(); ++i)
        if (const std::string name = (*list)[i].text(); !is_read(name)) unknown.push_back(in_quotes(name));
    return joined(unknown, ", ");
  };
  if (const std::string required = names("extensionsRequired"); !required.empty())
    root_.fail("requires extensions that are not read: " + required);
  if (const std::string used = names("extensionsUsed"); !used.empty())
    diagnostics.warning({}, "uses extensions that are not read: " + used);
}

void ModelReader::read_nodes() {
  const std::optional<Item> first = root_.find("scene"), scenes = root_.find("scenes");
  if (!scenes || scenes->size() == 0) root_.fail("has no scenes");
  const Item scene = first ? listed("scenes", *first) : (*scenes)[std::size_t{0}];
  const std::optional<Item> nodes = root_.find("nodes");
  std::vector<char> known(nodes ? nodes->size() : 0);
  std::vector<std::pair<std::size_t, Affine>> open;  // the last is the next
  const auto add = [&](const std::optional<Item>& children, const Affine& parent) {
    for (std::size_t i = children ? children->size() : 0; i-- > 0;) {
      const Item child = (*children)[i];
      const std::uint64_t number = child.whole();
      if (number >= known.size()) child.fail("there is no nodes[" + std::to_string(number) + ']');
      if (known[number]++ != 0) child.fail("names nodes[" + std::to_string(number) + "], which has a parent already");
      open.emplace_back(number, parent);
    }
  };
  add(scene.find("nodes"), {});
  while (!open.empty()) {
    const auto [number, parent] = open.back();
    open.pop_back();
    const Item node = (*nodes)[number];
    const Affine transform = parent * transform_of(node);
    if (const auto mesh_number = node.find("mesh")) model_.instances.push_back({&mesh(*mesh_number), transform});
    if (const auto camera = node.find("camera"))
      model_.cameras.push_back(read_camera(listed("cameras", *camera), transform));
    if (const auto light = extension(node, lights_extension)) add_light((*light)["light"], transform);
    add(node.find("children"), transform);
  }
}

void ModelReader::add_light(const Item& number, const Affine& transform) {
  const std::optional<Item> all = extension(root_, lights_extension);
  const std::optional<Item> lights = all ? all->find("lights") : std::nullopt;
  if (!lights || number.whole() >= lights->size()) number.fail("there is no such light");
  model_.lights.push_back(read_light((*lights)[number.whole()], transform));
}

Affine ModelReader::transform_of(const Item& node) {
  if (const auto m = node.numbers<16>("matrix")) {
    const auto column = [&](std::size_t i) { return Vec3d{(*m)[4 * i], (*m)[4 * i + 1], (*m)[4 * i + 2]}; };
    return {column(0), column(1), column(2), column(3)};
  }
  const auto [tx, ty, tz] = node.numbers<3>("translation").value_or(std::array<double, 3>{0, 0, 0});
  const auto [sx, sy, sz] = node.numbers<3>("scale").value_or(std::array<double, 3>{1, 1, 1});
  const auto [x, y, z, w] = node.numbers<4>("rotation").value_or(std::array<double, 4>{0, 0, 0, 1});
  const double square = x * x + y * y + z * z + w * w, s = square > 0 ? 2 / square : 0;
  return {Vec3d{1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)} * sx,
          Vec3d{s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)} * sy,
          Vec3d{s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)} * sz,
          {tx, ty, tz}};
}

const std::vector<Primitive>& ModelReader::mesh(const Item& number) {
  const Item item = listed("meshes", number);
  const auto [known, is_new] = model_.meshes.try_emplace(number.whole());
  if (is_new) known->second = primitives_of(item);
  return known->second;
}

std::vector<Primitive> ModelReader::primitives_of(const Item& mesh) {
  const Item items = mesh["primitives"];
  std::vector<Primitive> primitives;
  std::map<std::array<std::uint64_t, 4>, std::size_t> with_vertices;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Item item = items[i];
    const std::uint64_t mode = item.whole("mode", static_cast<std::uint64_t>(Mode::triangles));
    if (mode > static_cast<std::uint64_t>(Mode::fan)) item.fail("its mode is none of 0 to 6");
    const Item attributes = item["attributes"];
    const std::optional<Item> positions = attributes.find("POSITION");
    if (mode < static_cast<std::uint64_t>(Mode::triangles) || !positions) {
      ++model_.other_primitives;
      continue;
    }
    Primitive primitive{accessor(*positions), {}, {}, {}, {}, static_cast<Mode>(mode)};
    const std::size_t count = primitive.positions.elements.count;
    std::array<std::uint64_t, 4> numbers{positions->whole()};  // and those of the others, counted from 1
    const auto check = [](const Accessor& of, std::size_t components, std::size_t most, const Item& place) {
      if (of.elements.components < components || of.elements.components > most)
        place.fail(of.place + " has elements of " + counted(of.elements.components, "number") + ", and not of " +
                   std::to_string(components));
    };
    const auto read = [&](const char* name, std::size_t components, std::size_t most,
                          std::uint64_t& number) -> std::optional<Accessor> {
      const std::optional<Item> place = attributes.find(name);
      if (!place) return std::nullopt;
      Accessor values = accessor(*place);
      check(values, components, most, *place);
      if (values.elements.count != count)
        place->fail(values.place + " has " + std::to_string(values.elements.count) + " elements, and there are " +
                    std::to_string(count) + " positions");
      number = place->whole() + 1;
      return values;
    };
    check(primitive.positions, 3, 3, *positions);
    primitive.normals = read("NORMAL", 3, 3, numbers[1]);
    primitive.uvs = read("TEXCOORD_0", 2, 2, numbers[2]);
    primitive.colors = read("COLOR_0", 3, 4, numbers[3]);
    if (primitive.colors) primitive.colors->elements.normalized = primitive.colors->changed_values.normalized = true;
    if (const auto indices = item.find("indices")) {
      primitive.indices = accessor(*indices);
      check(*primitive.indices, 1, 1, *indices);
      if (!primitive.indices->elements.has_whole_numbers()) indices->fail("its accessor is none of whole numbers");
      primitive.indices->elements.normalized = primitive.indices->changed_values.normalized = false;
    }
    if (primitive.faces() == 0) continue;
    if (const auto number = item.find("material")) primitive.material = material(*number);
    primitive.vertices_of = with_vertices.try_emplace(numbers, primitives.size()).first->second;
    primitives.push_back(std::move(primitive));
  }
  return primitives;
}

Accessor ModelReader::accessor(const Item& number) {
  const Item item = listed("accessors", number);
  Accessor accessor{item.place(), {}};
  Elements& elements = accessor.elements;
  static constexpr std::pair<std::string_view, std::size_t> types[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  const Item type = item["type"];
  for (const auto& [name, components] : types)
    if (type.text() == name) elements.components = components;
  if (elements.components == 0) type.fail("is none of SCALAR, VEC2, VEC3 and VEC4");
  const auto component_type = [](const Item& of) {
    const Item number_of_type = of["componentType"];
    const auto value = static_cast<ComponentType>(std::min<std::uint64_t>(number_of_type.whole(), 9999));
    const bool is_integer = value >= ComponentType::byte && value <= ComponentType::unsigned_short;
    if (!is_integer && value != ComponentType::unsigned_integer && value != ComponentType::number)
      number_of_type.fail("is none of 5120 to 5123, 5125 and 5126");
    return value;
  };
  elements.type = component_type(item);
  elements.count = item["count"].whole();
  if (const auto normalized = item.find("normalized"))
    elements.normalized = normalized->is_true() && elements.type != ComponentType::number;
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

void ModelReader::read_values(const Item& item, const Item& view, Elements& elements) {
  const std::string_view bytes = view_bytes(view);
  const std::size_t size = with_component_type(elements.type, []<class T>(std::type_identity<T>) { return sizeof(T); });
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

std::string_view ModelReader::view_bytes(const Item& view) {
  const std::string_view bytes = buffer(view["buffer"]);
  const std::uint64_t offset = view.whole("byteOffset", 0), length = view["byteLength"].whole();
  if (offset > bytes.size() || length > bytes.size() - offset)
    view.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " + std::to_string(bytes.size()));
  return bytes.substr(offset, length);
}

std::string_view ModelReader::buffer(const Item& number) {
  const Item item = listed("buffers", number);
  const std::optional<Item> uri = item.find("uri");
  std::string_view bytes;
  if (!uri) {
    if (number.whole() != 0 || !chunks_.binary) item.fail("has no 'uri', and is not the binary chunk of a GLB file");
    bytes = *chunks_.binary;
  } else if (const auto known = model_.data.find(number.whole()); known != model_.data.end()) {
    bytes = known->second;
  } else if (uri->text().starts_with("data:")) {
    try {
      bytes = model_.data[number.whole()] = data_of_uri(uri->text()).value();
    } catch (const Error& error) {
      uri->fail(error.what());
    }
  } else {
    const std::string name = file_name(*uri);
    auto file = model_.files.find(name);
    if (file == model_.files.end()) {
      const std::string path = (std::filesystem::path(name_).parent_path() / name).string();
      Diagnostics found(path);
      std::optional<MeshFile> opened = MeshFile::open(path, found);
      if (!opened || !opened->load(threads_, found)) item.fail(in_quotes(name) + ": " + found.kept().front().message);
      file = model_.files.emplace(name, std::move(*opened)).first;
    }
    bytes = file->second.text(false);
  }
  const std::uint64_t length = item["byteLength"].whole();
  if (length > bytes.size())
    item.fail("claims " + std::to_string(length) + " bytes, and there are " + std::to_string(bytes.size()));
  return bytes.substr(0, length);
}

std::uint32_t ModelReader::material(const Item& number) {
  const Item item = listed("materials", number);
  const auto next = static_cast<std::uint32_t>(model_.materials.size());
  const auto [known, is_new] = materials_.try_emplace(number.whole(), next);
  if (!is_new) return known->second;
  model_.materials.push_back(read_material(
      item, [&](const Item& info) { return texture(info); },
      [&](const std::string& place, const std::string& message) { warn_once(place, message); }));
  return next;
}

void ModelReader::warn_once(const std::string& place, const std::string& message) {
  if (warned_.insert(message).second) warnings_.push_back(place + ": " + message);
}

MeshTexture ModelReader::texture(const Item& info) {
  MeshTexture texture;
  const Item item = listed("textures", info["index"]);
  const std::optional<Item> source = item.find("source");
  if (!source) return texture;  // that of an extension
  std::uint64_t coordinates = info.whole("texCoord", 0);
  if (const auto transform = extension(info, "KHR_texture_transform")) {
    coordinates = transform->whole("texCoord", coordinates);
    place_texture(*transform, texture);
  }
  if (coordinates != 0) {
    warnings_.push_back(info.place() + ": has coordinates other than TEXCOORD_0, and is left out");
    return texture;
  }
  if (const auto number = item.find("sampler")) {
    constexpr std::uint64_t repeat = 10497, mirrored_repeat = 33648, clamp_to_edge = 33071;
    const Item sampler = listed("samplers", *number);
    const std::uint64_t u = sampler.whole("wrapS", repeat), v = sampler.whole("wrapT", repeat);
    // Where one repeats the image, coordinates are more likely to be beyond it.
    if (u == clamp_to_edge && v == clamp_to_edge)
      texture.edge = MeshTexture::Edge::clamp;
    else if (u != repeat && v != repeat && (u == mirrored_repeat || v == mirrored_repeat))
      texture.edge = MeshTexture::Edge::mirror;
    if (u != v) warnings_.push_back(sampler.place() + ": has two wrap modes, of which one is used for both directions");
  }
  const Item image = listed("images", *source);
  const std::optional<Item> uri = image.find("uri");
  if (uri && !uri->text().starts_with("data:")) {
    texture.file = file_name(*uri);
    return texture;
  }
  texture.file = std::filesystem::path(name_).filename().string() + '#' + image.place();
  std::shared_ptr<const std::string>& bytes = images_[source->whole()];
  if (bytes == nullptr) {
    try {
      bytes = std::make_shared<const std::string>(
          uri ? data_of_uri(uri->text()).value() : std::string(view_bytes(listed("bufferViews", image["bufferView"]))));
    } catch (const Error& error) {
      if (uri) uri->fail(error.what());
      throw;
    }
  }
  texture.bytes = bytes;
  return texture;
}

}  // namespace

Model read_model(std::string_view file, const std::string& name, int threads, Diagnostics& diagnostics) {
  return ModelReader(file, name, threads).read(diagnostics);
}

}  // namespace raytrace::gltf
