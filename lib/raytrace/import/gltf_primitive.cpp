#include "raytrace/import/gltf_primitive.h"

#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "raytrace/import/gltf_material.h"
#include "raytrace/math/vec3.h"
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

/// "'glass': ", if it has a name.
std::string named(const Item& item) {
  const std::string name = item.name();
  return name.empty() ? "" : in_quotes(name) + ": ";
}

std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 32U)) * 0xd6e8feb86659fd93U;
  bits = (bits ^ (bits >> 32U)) * 0xd6e8feb86659fd93U;
  return bits ^ (bits >> 32U);
}

/// Of a place: of both zeros the same.
std::uint64_t key_of(const Vec3d& p) {
  std::uint64_t key = 0;
  for (const double x : {p.x, p.y, p.z}) key = mixed(key + std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x));
  return key;
}

/// 0 in sum over edges, each of which is there as often in one direction as in the other; else hardly ever.
std::uint64_t directed(std::uint64_t from, std::uint64_t to) { return mixed(3 * from + to) - mixed(3 * to + from); }

/// Whether its faces enclose something that is no mere pane: they have no edges where they end, and what they enclose
/// is thicker than some half a percent of their extent. Vertices at the same place are one.
bool is_solid(const Primitive& primitive) {
  std::vector<Vec3d> places(primitive.positions.elements.count);
  for_each_element(primitive.positions, 1,
                   [&](std::size_t i, const auto& values) { places[i] = {values[0], values[1], values[2]}; });
  std::vector<std::size_t> corners(primitive.corners());
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = i;
  if (primitive.indices)
    for_each_element(*primitive.indices, 1,
                     [&](std::size_t i, const auto& values) { corners[i] = static_cast<std::size_t>(values[0]); });
  std::vector<std::uint64_t> keys;
  keys.reserve(places.size());
  for (const Vec3d& place : places) keys.push_back(key_of(place));
  std::uint64_t open = 0;
  double volume = 0, area = 0;
  for (std::size_t i = 0; i < primitive.faces(); ++i) {
    std::array<std::size_t, 3> face = primitive.face(i);
    for (std::size_t& corner : face) {
      corner = corners[corner];
      if (corner >= places.size()) return false;  // an error, which comes later
    }
    for (std::size_t k = 0; k < 3; ++k) open += directed(keys[face[k]], keys[face[(k + 1) % 3]]);
    const Vec3d a = places[face[0]] - places[0], b = places[face[1]] - places[0], c = places[face[2]] - places[0];
    volume += dot(a, cross(b, c)) / 6;
    area += length(cross(b - a, c - a)) / 2;
  }
  // A sheet of two sides has half the area each, and their distance is the volume over that.
  constexpr double least = 0.002;
  return open == 0 && std::abs(volume) > least * std::pow(area, 1.5);
}

/// Glass that is solid in the program it comes from, and has no volume in the file. Looked for in what files of usual
/// sizes have.
void warn_of_thin_glass(const Primitive& primitive, const Item& material, Document& document) {
  if (!document.may_look_at(primitive.corners()) || !is_solid(primitive)) return;
  document.warn_once(material.place(),
                     named(material) +
                         "it is clear, and a thin wall, which does not refract, though what has it is solid: a "
                         "thicknessFactor above 0 (KHR_materials_volume) makes it solid");
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
    primitive.shows_alpha = of_model.shows_alpha;
    if (number && !of_model.is_overridden && of_model.is_thin_glass)
      warn_of_thin_glass(primitive, document.listed("materials", *number), document);
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
