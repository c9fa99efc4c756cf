#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/math/content_hash.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

class SceneHash {
 public:
  explicit SceneHash(int threads) : threads_(threads) {}

  std::string of(const SceneDescription& scene) {
    for_each_single(scene, [&]<class T>(std::type_identity<T>, const auto& parameters) {
      // The view plane is always the same type. Its samples do not count, nor does what only files for display show.
      if constexpr (std::is_same_v<T, ViewPlane>) {
        add_parameters(element_type<T>().fields, &parameters,
                       {"samples", "viewtransform", "exposure", "autoexposure", "whitebalance"});
      } else {
        add(T::element);
        add_camera<T>(parameters);
      }
    });
    for (const CameraParameters& moment : scene.moving_camera)
      for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) {
        if (const auto* parameters = std::get_if<typename T::Parameters>(&moment)) add_camera<T>(*parameters);
      });
    for_each_item_type([&]<class Section, class T>(std::type_identity<Section>, std::type_identity<T>) {
      add_items<T>(items_of<Section, T>(scene));
    });
    for (const Group& group : scene.groups) {
      add(group_element);
      add(group.name);
      for_each_type(Objects{},
                    [&]<class T>(std::type_identity<T>) { add_items<T>(std::get<ObjectItems<T>>(group.objects)); });
    }
    return hash_.digits();
  }

 private:
  template <class T>
  void add_camera(const typename T::Parameters& parameters) {
    // What moves counts, not when the shutter opens and closes.
    add_parameters(element_type<T>().fields, &parameters, {"shutteropen", "shutterclose"});
  }

  /// Hashes of chunks that do not depend on the threads: one of a million objects would take as long as some renders.
  template <class T, class Item>
  void add_items(const std::vector<Item>& items) {
    add(T::element);
    add(static_cast<std::uint64_t>(items.size()));
    const Fields& fields = element_type<T>().fields;
    std::vector<std::string> hashes(chunk_count(items.size()));
    for_each_chunk(items.size(), threads_, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      SceneHash hash(1);
      for (std::size_t i = first; i < last; ++i) {
        const Item& item = items[i];
        if constexpr (requires { item.data; }) {
          hash.add_loaded(fields, item);
        } else if constexpr (requires { item.image; }) {
          hash.add_parameters(fields, &item.parameters, {item.image.hash.empty() ? "" : "file"});
          hash.add(item.image.hash);
        } else if constexpr (requires { item.photometry; }) {
          hash.add_parameters(fields, &item.parameters, {item.photometry.hash.empty() ? "" : "iesfile"});
          hash.add(item.photometry.hash);
        } else if constexpr (requires { item.grid; }) {
          hash.add_parameters(fields, &item.parameters, {item.grid.hash.empty() ? "" : "densityfile"});
          hash.add(item.grid.hash);
        } else {
          hash.add_parameters(fields, &item.parameters);
        }
        if constexpr (requires { item.transform; }) {
          hash.add(static_cast<std::uint64_t>(item.transform.steps.size()));
          for (const TransformStep& step : item.transform.steps) {
            hash.add(static_cast<int>(step.type));
            for (std::size_t k = 0; k < step.value_count(); ++k) hash.add(step.values[k]);
          }
        }
        if constexpr (requires { item.motion; })
          for (const Affine& map : item.motion) hash.add(map);
        if constexpr (requires { item.shadowcatcher; }) {
          hash.add(item.shadowcatcher);
          hash.add(item.visible);
        }
        if constexpr (requires { item.name; }) hash.add(item.name);
        if constexpr (requires { item.material; }) hash.add_reference(item.material);
        if constexpr (requires { item.materials; })
          for (const MaterialReference& material : item.materials) hash.add_reference(material);
        if constexpr (requires { item.textures; }) {
          hash.add(static_cast<std::uint64_t>(item.textures.size()));
          for (const TextureUse& use : item.textures) {
            hash.add(use.field);
            hash.add_reference(use.texture);
            hash.add(static_cast<std::uint32_t>(use.channel));
          }
        }
      }
      hashes[chunk] = hash.hash_.digits();
    });
    for (const std::string& hash : hashes) add(hash);
  }

  void add_reference(const ItemReference& item) {
    add(item.type);
    add(item.index);
  }

  /// left_out: the names of fields that do not count.
  void add_parameters(const Fields& fields, const void* parameters,
                      std::initializer_list<std::string_view> left_out = {}) {
    for (const Field& field : fields)
      if (std::find(left_out.begin(), left_out.end(), field.name) == left_out.end())
        field.visit(parameters, [&](const auto& value) { add(value); });
  }

  /// By what it was read from a file, if it was, and not by the file's name.
  template <class Item>
  void add_loaded(const Fields& fields, const Item& item) {
    const bool from_file = item.data != nullptr && !item.parameters.file.path.empty();
    add_parameters(fields, &item.parameters, {from_file ? "file" : ""});
    if (item.data == nullptr) return;
    add(item.data->origin);
    add(*item.data);
  }

  void add(const MeshData& data) {
    add(data.corners);
    add_values(data.positions);
    add_values(data.indices);
    add_values(data.normals);
    add_values(data.uvs);
    add_values(data.uvs2);
    add_values(data.colors);
    add_values(data.alphas);
    add_values(data.face_materials);
    add_values(data.tangents);
    // Cryptomatte's ids are of their names.
    for (const MeshPart& part : data.parts) {
      add(part.name);
      add(static_cast<std::uint64_t>(part.first_face));
    }
    for (const MeshCopies& copies : data.copies) {
      add(*copies.mesh);
      add(static_cast<std::uint64_t>(copies.places.size()));
      for (const MeshCopies::Place& place : copies.places) {
        add(place.affine);
        add(place.part);
      }
    }
  }

  void add(const Affine& map) {
    for (const Vec3d& column : {map.x, map.y, map.z, map.origin}) add(column);
  }

  void add(const PointCloud& data) {
    add_values(data.positions);
    add_values(data.radii);
    add_values(data.colors);
  }

  void add(const CurveData& data) {
    add_values(data.points);
    add_values(data.along);
    add_values(data.colors);
    add(data.is_smooth);
  }

  template <class Value>
  void add(const Value& value) {
    if constexpr (HasComponents<Value>) {
      for (const auto member : Components<Value>::members) add(value.*member);
    } else if constexpr (std::is_same_v<Value, NumberGroups>) {
      add_values(value.numbers);
      add_values(value.ends);
    } else if constexpr (std::is_same_v<Value, WordOrGroups>) {
      add(value.groups);
      if (value.groups.empty() && value.word < value.words.size()) add(value.words[value.word]);
    } else if constexpr (std::is_same_v<Value, FileName>) {
      add(value.path);
    } else if constexpr (std::is_same_v<Value, Reference>) {
      add(value.name);
    } else if constexpr (std::is_same_v<Value, ChoiceReference>) {
      add(value.words()[value.index()]);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      const Value number = value + Value(0);  // -0 is 0
      hash_.add(&number, sizeof number);
    } else {
      const std::string_view text = value;
      add(static_cast<std::uint64_t>(text.size()));
      hash_.add(text.data(), text.size());
    }
  }

  template <class Values>
  void add_values(const Values& values) {
    add(static_cast<std::uint64_t>(values.size()));
    hash_.add(values.data(), values.size() * sizeof(*values.data()));
  }

  ContentHash hash_;
  int threads_;
};

}  // namespace

std::string scene_hash(const SceneDescription& description, int threads) { return SceneHash(threads).of(description); }

}  // namespace raytrace
