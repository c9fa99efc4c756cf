#include "raytrace/import/gltf_primitive.h"

#include <map>
#include <string>
#include <utility>

#include "raytrace/import/gltf_material.h"
#include "raytrace/text/message.h"

namespace raytrace::gltf {
namespace {

/// An attribute is one of so many numbers to each vertex.
void check_components(const Accessor& of, std::size_t components, std::size_t most, const Item& place) {
  if (of.elements.components < components || of.elements.components > most)
    place.fail(of.place + " has elements of " + counted(of.elements.components, "number") + ", and not of " +
               std::to_string(components));
}

/// Integers are from 0 to 1, whether they say so or not.
void be_normalized(Accessor& accessor) { accessor.elements.normalized = accessor.changed_values.normalized = true; }
void be_whole(Accessor& accessor, const Item& place) {
  if (!accessor.elements.has_whole_numbers()) place.fail("its accessor is none of whole numbers");
  accessor.elements.normalized = accessor.changed_values.normalized = false;
}

/// Of a primitive, as many elements as it has positions. Keeps the numbers of the accessors.
class VertexReader {
 public:
  /// compressed: null, none.
  VertexReader(Document& document, const Item& attributes, const DracoPrimitive* compressed)
      : document_(document), attributes_(attributes), compressed_(compressed) {}

  const std::vector<std::uint64_t>& numbers() const { return numbers_; }

  Accessor positions() {
    const Item place = attributes_["POSITION"];
    Accessor values = accessor("POSITION", place, compressed_);
    check_components(values, 3, 3, place);
    numbers_.push_back(place.whole());
    count_ = values.elements.count;
    return values;
  }

  std::optional<Accessor> attribute(const std::string& name, std::size_t components, std::size_t most) {
    return read(attributes_, name, components, most, compressed_);
  }

  std::vector<JointSet> joint_sets() {
    std::vector<JointSet> sets;
    for (;;) {
      const std::string joints_name = "JOINTS_" + std::to_string(sets.size()),
                        weights_name = "WEIGHTS_" + std::to_string(sets.size());
      std::optional<Accessor> joints = attribute(joints_name, 4, 4);
      std::optional<Accessor> weights = attribute(weights_name, 4, 4);
      if (!joints || !weights) return sets;
      be_whole(*joints, attributes_[joints_name.c_str()]);
      be_normalized(*weights);
      sets.push_back({std::move(*joints), std::move(*weights)});
    }
  }

  std::vector<MorphTarget> targets(const Item& primitive) {
    std::vector<MorphTarget> targets;
    const std::optional<Item> items = primitive.find("targets");
    for (std::size_t i = 0; items && i < items->size(); ++i) {
      const Item item = (*items)[i];
      targets.push_back({read(item, "POSITION", 3, 3, nullptr), read(item, "NORMAL", 3, 3, nullptr)});
      if (item.find("TEXCOORD_0") || item.find("COLOR_0"))
        document_.warn_once(item.place(), "morphs of texture coordinates and colours are left out");
    }
    return targets;
  }

 private:
  Accessor accessor(const std::string& name, const Item& number, const DracoPrimitive* compressed) {
    if (compressed != nullptr)
      if (const auto found = compressed->attributes.find(name); found != compressed->attributes.end())
        return found->second;
    return document_.accessor(number);
  }

  std::optional<Accessor> read(const Item& of, const std::string& name, std::size_t components, std::size_t most,
                               const DracoPrimitive* compressed) {
    const std::optional<Item> place = of.find(name.c_str());
    numbers_.push_back(place ? place->whole() + 1 : 0);
    if (!place) return std::nullopt;
    Accessor values = accessor(name, *place, compressed);
    check_components(values, components, most, *place);
    if (values.elements.count != count_)
      place->fail(values.place + " has " + std::to_string(values.elements.count) + " elements, and there are " +
                  std::to_string(count_) + " positions");
    return values;
  }

  Document& document_;
  const Item& attributes_;
  const DracoPrimitive* compressed_;
  std::size_t count_ = 0;
  std::vector<std::uint64_t> numbers_;  ///< counted from 1; 0: none
};

/// Where the alpha of vertex colours would count, which a mesh has no place for.
void warn_of_alpha(const Primitive& primitive, const Item& material, Document& document) {
  const std::optional<Item> mode = material.find("alphaMode");
  if (!mode || mode->text() == "OPAQUE" || !primitive.colors || primitive.colors->elements.components < 4) return;
  if (!document.may_look_at(primitive.colors->elements.count)) return;
  bool is_opaque = true;
  for_each_element(*primitive.colors, 1, [&](std::size_t, const auto& values) { is_opaque &= values[3] >= 1; });
  if (is_opaque) return;
  const std::string name = material.name();
  document.warn_once(material.place(),
                     (name.empty() ? "" : in_quotes(name) + ": ") + "the alpha of its vertex colours is not used");
}

/// That of the variant, if it has one.
std::optional<Item> material_of(const Item& primitive, std::optional<std::uint64_t> variant) {
  const std::optional<Item> variants = variant ? extension(primitive, variants_extension) : std::nullopt;
  const std::optional<Item> mappings = variants ? variants->find("mappings") : std::nullopt;
  for (std::size_t i = 0; mappings && i < mappings->size(); ++i) {
    const Item mapping = (*mappings)[i], of = mapping["variants"];
    for (std::size_t k = 0; k < of.size(); ++k)
      if (of[k].whole() == *variant) return mapping["material"];
  }
  return primitive.find("material");
}

}  // namespace

std::vector<Primitive> read_primitives(Document& document, DracoReader& draco, const Item& mesh,
                                       std::optional<std::uint64_t> variant,
                                       const std::function<PrimitiveMaterial(const Item&)>& material,
                                       std::size_t& other_primitives) {
  const Item items = mesh["primitives"];
  std::vector<Primitive> primitives;
  std::map<std::vector<std::uint64_t>, std::size_t> with_vertices;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Item item = items[i];
    const std::uint64_t mode = item.whole("mode", static_cast<std::uint64_t>(Mode::triangles));
    if (mode > static_cast<std::uint64_t>(Mode::fan)) item.fail("its mode is none of 0 to 6");
    const Item attributes = item["attributes"];
    if (mode < static_cast<std::uint64_t>(Mode::triangles) || !attributes.find("POSITION")) {
      ++other_primitives;
      continue;
    }
    const std::optional<Item> of_draco = can_read_draco() ? extension(item, draco_extension) : std::nullopt;
    const DracoPrimitive* const compressed = of_draco ? &draco.read(item, *of_draco) : nullptr;
    VertexReader vertices(document, attributes, compressed);
    // What is decoded is triangles, of strips as well.
    Primitive primitive{
        vertices.positions(), {}, {}, {}, {}, {}, {}, {}, {}, of_draco ? Mode::triangles : static_cast<Mode>(mode)};
    primitive.normals = vertices.attribute("NORMAL", 3, 3);
    // Without normals, they are none.
    if (primitive.normals) primitive.tangents = vertices.attribute("TANGENT", 4, 4);
    primitive.colors = vertices.attribute("COLOR_0", 3, 4);
    if (primitive.colors) be_normalized(*primitive.colors);
    primitive.joint_sets = vertices.joint_sets();
    primitive.targets = vertices.targets(item);
    if (compressed != nullptr) {
      primitive.indices = compressed->indices;
    } else if (const auto indices = item.find("indices")) {
      primitive.indices = document.accessor(*indices);
      check_components(*primitive.indices, 1, 1, *indices);
      be_whole(*primitive.indices, *indices);
    }
    if (primitive.faces() == 0) continue;
    const std::optional<Item> number = material_of(item, variant);
    const PrimitiveMaterial of_model = number ? material(*number) : PrimitiveMaterial();
    primitive.material = of_model.number;
    if (number && !of_model.is_overridden) warn_of_alpha(primitive, document.listed("materials", *number), document);
    const auto coordinates = [&](std::uint64_t set) {
      return vertices.attribute("TEXCOORD_" + std::to_string(set), 2, 2);
    };
    primitive.uvs = coordinates(of_model.coordinates.empty() ? 0 : of_model.coordinates[0]);
    if (of_model.coordinates.size() > 1) primitive.uvs2 = coordinates(of_model.coordinates[1]);
    std::vector<std::uint64_t> numbers = vertices.numbers();
    numbers.push_back(of_draco ? (*of_draco)["bufferView"].whole() + 1 : 0);
    primitive.vertices_of = with_vertices.try_emplace(std::move(numbers), primitives.size()).first->second;
    primitives.push_back(std::move(primitive));
  }
  return primitives;
}

}  // namespace raytrace::gltf
