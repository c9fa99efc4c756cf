// https://github.com/KhronosGroup/glTF/blob/main/extensions/2.0/Khronos/KHR_draco_mesh_compression/README.md, and
// https://google.github.io/draco/spec/, which has the format.
#include "raytrace/import/gltf_draco.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/text/message.h"

#if defined(RAYTRACE_DRACO)
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/draco_version.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#endif

namespace raytrace::gltf {

std::string draco_version() {
#if defined(RAYTRACE_DRACO)
  return std::string("Draco ") + draco::kDracoVersion;
#else
  return {};
#endif
}

#if defined(RAYTRACE_DRACO)

namespace {

/// How many there may be, as the primitive's accessors say.
struct DracoLimits {
  std::size_t faces, points;
};

/// The library's decoder takes memory for as many faces, points and attributes as the data claims: this one asks
/// before. It keeps what is wrong, as the library is not made for exceptions.
template <class Decoder>
class LimitedDecoder : public Decoder {
 public:
  LimitedDecoder(Document& document, const Item& place, const DracoLimits& limits)
      : document_(document), place_(place), limits_(limits) {}

  /// None: the library's status says it.
  const std::optional<Error>& error() const { return error_; }

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t faces = 0, points = 0, symbols = 0, split_symbols = 0;
    std::uint8_t layers = 0;  // of attributes that have a connectivity of their own
    if constexpr (std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>) {
      if (!draco::DecodeVarint(&points, &ahead) || !draco::DecodeVarint(&faces, &ahead) || !ahead.Decode(&layers) ||
          !draco::DecodeVarint(&symbols, &ahead) || !draco::DecodeVarint(&split_symbols, &ahead))
        return false;
    } else if (!draco::DecodeVarint(&faces, &ahead) || !draco::DecodeVarint(&points, &ahead)) {
      return false;
    }
    constexpr std::size_t of_face = 64, of_face_in_layer = 24, of_point = 24;
    return may_have(faces, limits_.faces, "faces") && may_have(points, limits_.points, "points") &&
           may_take(faces * (of_face + layers * of_face_in_layer) + (std::size_t{points} + split_symbols) * of_point) &&
           Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    const std::size_t points = cloud.num_points();
    std::size_t of_point = 0;
    for (std::int32_t i = 0; i < cloud.num_attributes(); ++i) {
      // The numbers, the integers that they are made of, and where it has them.
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      const auto size = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type()));
      of_point += attribute.num_components() * (size + sizeof(std::int32_t)) + sizeof(std::uint32_t);
    }
    return may_have(points, limits_.points, "points") && may_take(points * of_point) && Decoder::DecodeAllAttributes();
  }

 private:
  bool may_have(std::size_t count, std::size_t most, const char* what) {
    return passes([&] {
      if (count > most)
        place_.fail("its data has " + std::to_string(count) + ' ' + what + ", and its accessors have " +
                    std::to_string(most));
    });
  }
  bool may_take(std::size_t bytes) {
    return passes([&] { document_.expand(bytes, place_); });
  }
  template <class Check>
  bool passes(const Check& check) {
    try {
      check();
    } catch (const Error& error) {
      error_ = error;
    }
    return !error_;
  }

  Document& document_;
  const Item& place_;
  DracoLimits limits_;
  std::optional<Error> error_;
};

template <class Decoder>
void decode_with(std::string_view bytes, Document& document, const Item& place, const DracoLimits& limits,
                 draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  LimitedDecoder<Decoder> decoder(document, place, limits);
  std::string reason;
  try {
    const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh);
    if (status.ok()) return;
    reason = status.error_msg_string();
  } catch (const std::length_error& error) {
    reason = error.what();
  }
  if (decoder.error()) throw *decoder.error();
  place.fail("its data is damaged: " + reason);
}

void decode_mesh(std::string_view bytes, Document& document, const Item& place, const DracoLimits& limits,
                 draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() || header.encoder_type != draco::TRIANGULAR_MESH)
    place.fail("its data is no mesh that Draco has compressed");
  if (header.version_major != 2 || header.version_minor != 2)
    place.fail("its data is of Draco's format " + std::to_string(header.version_major) + '.' +
               std::to_string(header.version_minor) + ", and not 2.2");
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
    decode_with<draco::MeshEdgebreakerDecoder>(bytes, document, place, limits, mesh);
  else
    decode_with<draco::MeshSequentialDecoder>(bytes, document, place, limits, mesh);
}

/// One element for each point, as `elements` has its components.
std::string values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const Elements& elements,
                      const Item& place) {
  return with_component_type(elements.type, [&]<class T>(std::type_identity<T>) {
    const std::size_t element = elements.components * sizeof(T);
    std::string bytes(mesh.num_points() * element, '\0');
    std::vector<T> values(elements.components);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
      const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
      if (index.value() >= attribute.size() ||
          !attribute.ConvertValue(index, static_cast<std::int8_t>(elements.components), values.data()))
        place.fail("has values that are none of its accessor's componentType");
      std::memcpy(bytes.data() + i * element, values.data(), element);
    }
    return bytes;
  });
}

/// What the file says of an accessor whose values are compressed.
Accessor described(const Document& document, const Item& number) {
  const Item item = document.listed("accessors", number);
  if (item.find("sparse")) item.fail("is sparse, and of a primitive that Draco has compressed");
  return document.accessor_of_zeros(number);
}

/// What is decoded becomes an accessor's elements.
void set_elements(Accessor& accessor, std::size_t count, const std::string& bytes) {
  accessor.elements.count = count;
  accessor.elements.stride = bytes.size() / std::max<std::size_t>(count, 1);
  accessor.elements.first = bytes.data();
}

}  // namespace

const DracoPrimitive& DracoReader::read(const Item& primitive, const Item& extension) {
  const Item view = extension["bufferView"], ids = extension["attributes"], numbers = primitive["attributes"];
  const Item indices = primitive["indices"];
  std::string key = std::to_string(view.whole()) + ' ' + std::to_string(indices.whole());
  struct Wanted {
    std::string name;
    Item id;
    Accessor accessor;
  };
  std::vector<Wanted> wanted;
  for (const std::string& name : ids.keys()) {
    const Item id = ids[name.c_str()], number = numbers[name.c_str()];
    key += ' ' + name + ' ' + std::to_string(id.whole()) + ' ' + std::to_string(number.whole());
    wanted.push_back({name, id, described(document_, number)});
  }
  const auto [known, is_new] = known_.try_emplace(std::move(key));
  DracoPrimitive& result = known->second;
  if (!is_new) return result;
  result.indices = described(document_, indices);
  const Accessor positions = described(document_, numbers["POSITION"]);
  const std::size_t corners_of_mode = result.indices.elements.count;
  constexpr std::uint64_t triangle_strip = 5;
  const DracoLimits limits{primitive.whole("mode", 4) == triangle_strip ? corners_of_mode : corners_of_mode / 3,
                           positions.elements.count};
  draco::Mesh mesh;
  decode_mesh(document_.view_bytes(document_.listed("bufferViews", view)), document_, extension, limits, mesh);
  for (Wanted& one : wanted) {
    const draco::PointAttribute* const attribute =
        one.id.whole() <= 0xffffffff ? mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(one.id.whole()))
                                     : nullptr;
    if (attribute == nullptr) one.id.fail("the compressed mesh has no attribute of this id");
    if (attribute->num_components() != one.accessor.elements.components)
      one.id.fail("the compressed mesh has elements of " + counted(attribute->num_components(), "number") + ", and " +
                  one.accessor.place + " of " + std::to_string(one.accessor.elements.components));
    document_.expand(mesh.num_points() * one.accessor.elements.components * sizeof(float), one.id);
    set_elements(one.accessor, mesh.num_points(),
                 document_.keep(values_of(mesh, *attribute, one.accessor.elements, one.id)));
    result.attributes.emplace(one.name, one.accessor);
  }
  const std::size_t faces = mesh.num_faces();
  std::string corners(faces * 3 * sizeof(std::uint32_t), '\0');
  for (std::size_t i = 0; i < faces; ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(i)));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = face[k].value();
      std::memcpy(corners.data() + (3 * i + k) * sizeof corner, &corner, sizeof corner);
    }
  }
  result.indices.elements.type = ComponentType::unsigned_integer;
  result.indices.elements.components = 1;
  set_elements(result.indices, 3 * faces, document_.keep(std::move(corners)));
  return result;
}

#else

const DracoPrimitive& DracoReader::read(const Item&, const Item& extension) {
  extension.fail("cannot be read without Draco");
}

#endif

}  // namespace raytrace::gltf
