// glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html.
#include "raytrace/import/gltf_model.h"

#include <algorithm>
#include <utility>

#include "raytrace/import/converted_model.h"
#include "raytrace/import/gltf_animation.h"
#include "raytrace/import/gltf_draco.h"
#include "raytrace/import/gltf_instancing.h"
#include "raytrace/import/gltf_material.h"
#include "raytrace/import/gltf_meshopt.h"
#include "raytrace/import/gltf_texture.h"
#include "raytrace/import/gltf_view.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/text/message.h"

namespace raytrace::gltf {
namespace {

/// A list that an extension has at the root.
std::optional<Item> extension_list(const Item& root, const char* name, const char* list) {
  const std::optional<Item> all = extension(root, name);
  return all ? all->find(list) : std::nullopt;
}

class ModelReader {
 public:
  ModelReader(std::string_view file, const std::string& name, const MeshReadSettings& settings)
      : settings_(settings),
        document_(*(model_.document = std::make_unique<Document>(file, name, settings.threads))),
        root_(document_.root()),
        textures_(document_),
        draco_(document_) {}

  Model read(Diagnostics& diagnostics) {
    check_version();
    check_extensions(diagnostics);
    const std::optional<Item> animations = root_.find("animations");
    pose_ = read_pose(document_, settings_.animation, settings_.time);
    if (animations && animations->size() > 0) model_.animation_end = pose_.end;
    if (!settings_.variant.empty())
      variant_ = document_.number_by_name(extension_list(root_, variants_extension, "variants"), settings_.variant,
                                          "material variant");
    read_nodes();
    document_.report(diagnostics);
    return std::move(model_);
  }

 private:
  void check_version() const;
  void check_extensions(Diagnostics& diagnostics) const;
  void read_nodes();
  void read_node(const Item& node, std::uint64_t number, const Affine& transform);
  Affine transform_of(const Item& node, std::uint64_t number) const;
  void add_mesh(const Item& node, std::uint64_t number, const Affine& transform);
  const std::vector<double>& weights_of(const Item& node, std::uint64_t number, const Item& mesh);
  const Skin& skin(const Item& number);
  void add_light(const Item& number, const Affine& transform);
  const std::vector<Primitive>& mesh(const Item& number);
  PrimitiveMaterial material(const Item& number);

  const MeshReadSettings& settings_;
  Model model_;
  Document& document_;
  const Item& root_;
  TextureReader textures_;
  DracoReader draco_;
  Pose pose_;
  std::optional<std::uint64_t> variant_;
  std::map<std::uint64_t, PrimitiveMaterial> materials_;
  std::vector<std::optional<Affine>> transforms_;  ///< of the scene's nodes, by their numbers
};

void ModelReader::check_version() const {
  const std::string version = root_["asset"]["version"].text();
  if (!version.starts_with("2.")) root_.fail("is glTF " + in_quotes(version) + ", and not 2.0");
}

void ModelReader::check_extensions(Diagnostics& diagnostics) const {
  const auto is_read = [](std::string_view name) {
    return name == "KHR_mesh_quantization" || name == "KHR_texture_transform" || name == webp_extension ||
           name == lights_extension || name == instancing_extension || name == variants_extension ||
           name == visibility_extension || is_material_extension(name) ||
           (name == draco_extension && can_read_draco()) || (is_meshopt_extension(name) && can_read_meshopt());
  };
  const auto without = [](std::string_view name) -> std::string {
    if (name == basisu_extension)
      return " (its KTX2 images become PNG by: gltf-transform ktxdecompress model.glb decoded.glb)";
    if (name == draco_extension) return " (this program was built without the library Draco)";
    return is_meshopt_extension(name) ? " (this program was built without the library meshoptimizer)" : "";
  };
  const auto names = [&](const char* key) {
    std::vector<std::string> unknown;
    if (const auto list = root_.find(key))
      for (std::size_t i = 0; i < list->size(); ++i)
        if (const std::string name = (*list)[i].text(); !is_read(name))
          unknown.push_back(in_quotes(name) + without(name));
    return joined(unknown, ", ");
  };
  if (const std::string required = names("extensionsRequired"); !required.empty())
    root_.fail("requires extensions that are not read: " + required);
  if (is_converted_model(document_.name())) return;  // it says nothing to users of other formats
  if (const std::string used = names("extensionsUsed"); !used.empty())
    diagnostics.warning({}, "uses extensions that are not read: " + used);
}

bool is_shown(const Item& node) {
  const auto visibility = extension(node, visibility_extension);
  const std::optional<Item> visible = visibility ? visibility->find("visible") : std::nullopt;
  return !visible || visible->is_true();
}

void ModelReader::read_nodes() {
  const std::optional<Item> first = root_.find("scene"), scenes = root_.find("scenes");
  if (!scenes || scenes->size() == 0) root_.fail("has no scenes");
  const Item scene = first ? document_.listed("scenes", *first) : (*scenes)[std::size_t{0}];
  const std::optional<Item> nodes = root_.find("nodes");
  transforms_.resize(nodes ? nodes->size() : 0);
  std::vector<char> known(transforms_.size());
  struct Open {
    std::size_t number;
    Affine parent;
    bool is_visible;
  };
  std::vector<Open> open;  // with its parent's transform; the last is the next
  const auto add = [&](const std::optional<Item>& children, const Affine& parent, bool is_visible) {
    for (std::size_t i = children ? children->size() : 0; i-- > 0;) {
      const Item child = (*children)[i];
      const std::uint64_t number = child.whole();
      if (number >= known.size()) child.fail("there is no nodes[" + std::to_string(number) + ']');
      if (known[number]++ != 0) child.fail("names nodes[" + std::to_string(number) + "], which has a parent already");
      open.push_back({number, parent, is_visible});
    }
  };
  add(scene.find("nodes"), {}, true);
  std::vector<std::uint64_t> in_order;
  while (!open.empty()) {
    const auto [number, parent, parent_is_visible] = open.back();
    open.pop_back();
    const Item node = (*nodes)[number];
    const Affine transform = parent * transform_of(node, number);
    transforms_[number] = transform;
    const bool is_visible = parent_is_visible && is_shown(node);
    if (is_visible) in_order.push_back(number);
    add(node.find("children"), transform, is_visible);
  }
  // Skins ask where nodes are that come later.
  for (const std::uint64_t number : in_order) read_node((*nodes)[number], number, *transforms_[number]);
}

void ModelReader::read_node(const Item& node, std::uint64_t number, const Affine& transform) {
  if (node.find("mesh")) add_mesh(node, number, transform);
  if (const auto camera = node.find("camera"))
    model_.cameras.push_back(read_camera(document_.listed("cameras", *camera), transform));
  if (const auto light = extension(node, lights_extension)) add_light((*light)["light"], transform);
}

Affine ModelReader::transform_of(const Item& node, std::uint64_t number) const {
  const auto found = pose_.nodes.find(number);
  static const NodePose rest;
  const NodePose& pose = found == pose_.nodes.end() ? rest : found->second;
  if (const auto m = node.numbers<16>("matrix")) {
    if (pose.translation || pose.rotation || pose.scale) node.fail("has a matrix, and an animation that would move it");
    const auto column = [&](std::size_t i) { return Vec3d{(*m)[4 * i], (*m)[4 * i + 1], (*m)[4 * i + 2]}; };
    return {column(0), column(1), column(2), column(3)};
  }
  const auto of = [&]<std::size_t count>(const std::optional<std::array<double, count>>& posed, const char* key,
                                         const std::array<double, count>& otherwise) {
    return posed ? *posed : node.numbers<count>(key).value_or(otherwise);
  };
  return affine_of(of(pose.translation, "translation", std::array<double, 3>{0, 0, 0}),
                   of(pose.rotation, "rotation", std::array<double, 4>{0, 0, 0, 1}),
                   of(pose.scale, "scale", std::array<double, 3>{1, 1, 1}));
}

void ModelReader::add_mesh(const Item& node, std::uint64_t number, const Affine& transform) {
  const Item mesh_number = node["mesh"];
  const std::vector<Primitive>& primitives = mesh(mesh_number);
  const std::vector<double>& weights = weights_of(node, number, document_.listed("meshes", mesh_number));
  const std::optional<Item> skin_number = node.find("skin");
  Instance instance{&primitives, transform, &weights, skin_number ? &skin(*skin_number) : nullptr, number};
  const std::string name = node.name();
  model_.node_names[number] = !name.empty() ? name : "node#" + std::to_string(number);
  // Elements of sparse accessors may be far more than the file has values.
  constexpr std::size_t elements_a_value = 16;
  for (const Primitive& primitive : primitives) {
    if (!primitive.targets.empty() && !weights.empty() && weights.size() != primitive.targets.size())
      node.fail("its mesh has " + counted(primitive.targets.size(), "morph target") + ", and " +
                counted(weights.size(), "weight"));
    const auto active = static_cast<std::size_t>(
        std::count_if(weights.begin(), weights.end(), [](double weight) { return weight != 0; }));
    const std::size_t parts = active + (instance.skin != nullptr ? primitive.joint_sets.size() : 0);
    document_.spend(parts * (1 + primitive.positions.elements.count / elements_a_value), node);
  }
  const std::optional<Item> instancing = extension(node, instancing_extension);
  if (!instancing || instance.skin != nullptr) return model_.instances.push_back(instance);
  const std::vector<Affine> places = read_instances(document_, *instancing);
  const std::size_t bytes = (model_.instances.size() + places.size()) * sizeof(Instance);
  if (bytes / 64 > document_.size() && bytes > available_memory() / 4)
    instancing->fail("has more instances than fit into a quarter of the memory that is available");
  for (const Affine& place : places) {
    instance.transform = transform * place;
    model_.instances.push_back(instance);
  }
}

const std::vector<double>& ModelReader::weights_of(const Item& node, std::uint64_t number, const Item& mesh) {
  std::vector<double>& weights = model_.weights[number];
  const auto posed = pose_.nodes.find(number);
  if (posed != pose_.nodes.end() && posed->second.weights) {
    weights = *posed->second.weights;
    return weights;
  }
  std::optional<Item> items = node.find("weights");
  if (!items) items = mesh.find("weights");
  for (std::size_t i = 0; items && i < items->size(); ++i) weights.push_back((*items)[i].number());
  return weights;
}

const Skin& ModelReader::skin(const Item& number) {
  const Item item = document_.listed("skins", number);
  const auto [known, is_new] = model_.skins.try_emplace(number.whole());
  if (is_new) known->second = read_skin(document_, item, [&](const Item& node) { return transforms_[node.whole()]; });
  return known->second;
}

void ModelReader::add_light(const Item& number, const Affine& transform) {
  const std::optional<Item> lights = extension_list(root_, lights_extension, "lights");
  if (!lights || number.whole() >= lights->size()) number.fail("there is no such light");
  if (const auto light = read_light((*lights)[number.whole()], transform, document_)) model_.lights.push_back(*light);
}

const std::vector<Primitive>& ModelReader::mesh(const Item& number) {
  const Item item = document_.listed("meshes", number);
  const auto [known, is_new] = model_.meshes.try_emplace(number.whole());
  if (is_new)
    known->second = read_primitives(
        document_, draco_, item, variant_, [&](const Item& of_primitive) { return material(of_primitive); },
        model_.other_primitives);
  return known->second;
}

PrimitiveMaterial ModelReader::material(const Item& number) {
  const Item item = document_.listed("materials", number);
  const auto [known, is_new] = materials_.try_emplace(number.whole());
  if (!is_new) return known->second;
  known->second.number = static_cast<std::uint32_t>(model_.materials.size());
  textures_.begin_material();
  known->second.is_overridden = settings_.overrides(item.name());
  document_.be_quiet(known->second.is_overridden);
  model_.materials.push_back(
      read_material(item, {[&](const Item& info) { return textures_.read(info); },
                           [&](const std::string& place, const std::string& what) { document_.warn(place, what); },
                           is_converted_model(document_.name())}));
  document_.be_quiet(false);
  known->second.coordinates = textures_.coordinates();
  const MeshMaterial& read = model_.materials.back();
  known->second.shows_alpha = read.map_d.alpha && !known->second.is_overridden;
  known->second.is_thin_glass =
      read.thin_walled && std::ranges::any_of(read.openpbr, [](const MeshParameter& parameter) {
        return parameter.name == "transmission_weight";
      });
  return known->second;
}

}  // namespace

Model read_model(std::string_view file, const std::string& name, const MeshReadSettings& settings,
                 Diagnostics& diagnostics) {
  return ModelReader(file, name, settings).read(diagnostics);
}

}  // namespace raytrace::gltf
