#include "raytrace/description/scene_hash.h"

#include <cstddef>
#include <type_traits>
#include <vector>

#include "raytrace/math/content_hash.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

class SceneHash {
 public:
  explicit SceneHash(int threads) : threads_(threads) {}

  std::string of(const SceneDescription& scene) {
    Fields<ViewPlane> viewplane_fields = ViewPlane::fields();
    std::erase_if(viewplane_fields, [](const auto& field) { return field.name == "samples"; });
    add_parameters(viewplane_fields, scene.viewplane);
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      if (const auto* parameters = std::get_if<typename Camera::Parameters>(&scene.camera)) {
        add(Camera::element);
        add_parameters(Camera::fields(), *parameters);
      }
    });
    add_items(Lights{}, scene.lights, [](SceneHash&, const auto&) {});
    add_items(Materials{}, scene.materials, [](SceneHash& hash, const auto& item) { hash.add(item.name); });
    add_items(Shapes{}, scene.objects, [](SceneHash& hash, const auto& item) {
      hash.add(item.name);
      hash.add(item.material.kind);
      hash.add(item.material.index);
    });
    return hash_.digits();
  }

 private:
  /// Hashes of chunks that do not depend on the threads: one of a million objects would take as long as some renders.
  template <class List, class Tuple, class AddOthers>
  void add_items(List list, const Tuple& tuple, AddOthers add_others) {
    for_each_type(list, [&]<class T>(std::type_identity<T>) {
      const auto& items = std::get<index_of<T>(List{})>(tuple);
      add(T::element);
      add(static_cast<std::uint64_t>(items.size()));
      const auto fields = T::fields();
      std::vector<std::string> hashes(chunk_count(items.size()));
      for_each_chunk(items.size(), threads_, [&](std::size_t chunk, std::size_t first, std::size_t last) {
        SceneHash hash(1);
        for (std::size_t i = first; i < last; ++i) {
          hash.add_parameters(fields, items[i].parameters);
          add_others(hash, items[i]);
        }
        hashes[chunk] = hash.hash_.digits();
      });
      for (const std::string& hash : hashes) add(hash);
    });
  }

  template <class Parameters>
  void add_parameters(const Fields<Parameters>& fields, const Parameters& parameters) {
    for (const auto& field : fields) std::visit([&](auto member) { add(parameters.*member); }, field.member);
  }

  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    hash_.add(text.data(), text.size());
  }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(const Vec3d& v) {
    for (const double value : {v.x, v.y, v.z}) add(value);
  }
  void add(const Rgb<double>& color) {
    for (const double value : {color.red, color.green, color.blue}) add(value);
  }
  template <class Number>
    requires std::is_arithmetic_v<Number>
  void add(Number number) {
    number += Number(0);  // -0 is 0
    hash_.add(&number, sizeof number);
  }

  ContentHash hash_;
  int threads_;
};

}  // namespace

std::string scene_hash(const SceneDescription& description, int threads) { return SceneHash(threads).of(description); }

}  // namespace raytrace
