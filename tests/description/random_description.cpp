#include "random_description.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/description/read_transform.h"

namespace raytrace::test {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t end) { return static_cast<std::size_t>(random() % end); }

double random_number(Random& random, Range range) {
  if (range != Range::positive && below(random, 4) == 0) return static_cast<double>(below(random, 3));
  const double mantissa = 1 + static_cast<double>(random() >> 11) * 0x1p-53;
  const double size = mantissa * std::pow(10.0, static_cast<double>(below(random, 33)) - 16.0);
  return range == Range::any && below(random, 2) == 0 ? -size : size;
}

std::string random_name(Random& random) {
  static const char* const chunks[] = {
      "a", "Z", "7", "&", "<", ">", "]]>", "\"", "'", " b", "\xc3\xa4", "\xf0\x9f\x98\x80", "--", ";", "#"};
  std::string name = "n";
  for (std::size_t i = below(random, 12); i > 0; --i) name += chunks[below(random, std::size(chunks))];
  return name;
}

void randomize(Random& random, Range range, double& value) { value = random_number(random, range); }
void randomize(Random& random, Range range, int& value) {
  // Squares of edges must stay below the limit of a picture; the levels of a subdivision are few.
  value = static_cast<int>(below(random, below(random, 2) == 0 ? 5 : 10000)) + (range == Range::positive ? 1 : 0);
}
void randomize(Random& random, Range, bool& value) { value = below(random, 2) == 0; }
void randomize(Random& random, Range, const ChoiceReference& value) { value.set(below(random, value.words().size())); }
void randomize(Random& random, Range, FileName& value) {
  value.path = below(random, 2) == 0 ? "" : "models/" + random_name(random) + ".ply";
}
void randomize(Random& random, Range range, Reference& value) {
  value.name = range != Range::identifier ? "a group" : below(random, 2) == 0 ? "" : "Key_light-1";
}
void randomize(Random& random, Range, NumberGroups& value) {
  // Such as a mesh takes for positions, faces, normals and uvs.
  value = {};
  if (below(random, 2) == 0) return;
  for (std::size_t i = 0; i < 9; ++i) value.numbers.push_back(static_cast<double>(below(random, 3)));
  value.ends = below(random, 2) == 0 ? std::vector<std::uint32_t>{9} : std::vector<std::uint32_t>{3, 9};
}
void randomize(Random& random, Range range, WordOrGroups& value) {
  value.word = below(random, value.words.size());
  randomize(random, range, value.groups);
}
void randomize(Random& random, Range range, Vec3d& value) {
  const Range each = range == Range::nonzero ? Range::any : range;
  value = {random_number(random, each), random_number(random, each),
           range == Range::nonzero ? 1.5 : random_number(random, each)};
}
void randomize(Random& random, Range range, Vec2d& value) {
  value = {random_number(random, range), random_number(random, range)};
}
void randomize(Random& random, Range range, Rgb<double>& value) {
  value = {random_number(random, range), random_number(random, range), random_number(random, range)};
}

void randomize(Random& random, const ElementType& type, void* parameters) {
  const auto refused = [&] { return type.check != nullptr && type.check(parameters); };
  // From what is accepted, value by value: of many together, hardly any would be.
  const bool accepted = !refused();
  do {
    for (const Field& field : type.fields)
      field.visit(parameters, [&]<class Value>(Value& value) {
        if constexpr (std::is_same_v<std::remove_const_t<Value>, ChoiceReference>) {
          const std::size_t before = value.index();
          randomize(random, field.range, value);
          if (accepted && refused()) value.set(before);
        } else {
          const Value before = value;
          randomize(random, field.range, value);
          if (accepted && refused()) value = before;
        }
      });
  } while (refused());
}

template <class T>
typename T::Parameters random_parameters(Random& random) {
  typename T::Parameters parameters;
  if constexpr (std::is_same_v<T, Hair>) {  // which has to say its colour, in one of three ways
    const std::size_t way = below(random, 3);
    if (way == 0) parameters.melanin = 0.5;
    if (way == 1) parameters.color = {0.5, 0.25, 1};
    if (way == 2) parameters.absorption = {0.5, 2, 4};
  }
  randomize(random, element_type<T>(), &parameters);
  return parameters;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(int a, int b) { return a == b; }
bool same(bool a, bool b) { return a == b; }
bool same(const ChoiceReference& a, const ChoiceReference& b) { return a.index() == b.index(); }
bool same(const FileName& a, const FileName& b) { return a == b; }
bool same(const Reference& a, const Reference& b) { return a == b; }
bool same(const NumberGroups& a, const NumberGroups& b) { return a == b; }
bool same(const WordOrGroups& a, const WordOrGroups& b) { return a == b; }
bool same(const Vec3d& a, const Vec3d& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }
bool same(const Vec2d& a, const Vec2d& b) { return same(a.x, b.x) && same(a.y, b.y); }
bool same(const ItemReference& a, const ItemReference& b) { return a.type == b.type && a.index == b.index; }
bool same(const TextureUse& a, const TextureUse& b) {
  return a.field == b.field && same(a.texture, b.texture) && a.channel == b.channel;
}
bool same(const Rgb<double>& a, const Rgb<double>& b) {
  return same(a.red, b.red) && same(a.green, b.green) && same(a.blue, b.blue);
}

bool same_parameters(const Fields& fields, const void* a, const void* b) {
  return std::all_of(fields.begin(), fields.end(), [&](const Field& field) {
    return field.visit(a, [&]<class Value>(const Value& one) {
      return field.visit(b, [&]<class Other>(const Other& other) {
        if constexpr (std::is_same_v<Value, Other>) return same(one, other);
        return false;
      });
    });
  });
}

template <class T>
bool same_parameters(const typename T::Parameters& a, const typename T::Parameters& b) {
  return same_parameters(element_type<T>().fields, &a, &b);
}

/// Of variants that hold the parameters of one type in the list.
template <class List, class Parameters>
bool same_choice(List list, const Parameters& a, const Parameters& b) {
  if (a.index() != b.index()) return false;
  return with_type(list, a.index(), [&]<class T>(std::type_identity<T>) {
    return same_parameters<T>(std::get<index_of<T>(List{})>(a), std::get<index_of<T>(List{})>(b));
  });
}

/// equal(item, item): what items of this type have beside their parameters.
template <class List, class Tuple, class Equal>
bool same_items(List list, const Tuple& a, const Tuple& b, Equal equal) {
  bool all = true;
  for_each_type(list, [&]<class T>(std::type_identity<T>) {
    const auto& x = std::get<index_of<T>(List{})>(a);
    const auto& y = std::get<index_of<T>(List{})>(b);
    all = all && x.size() == y.size();
    for (std::size_t i = 0; all && i < x.size(); ++i) {
      all = same_parameters<T>(x[i].parameters, y[i].parameters) && equal(x[i], y[i]);
    }
  });
  return all;
}

/// One for about half of the fields that may have one.
std::vector<TextureUse> random_uses(Random& random, const Fields& fields,
                                    const std::vector<TextureReference>& textures) {
  std::vector<TextureUse> uses;
  for (std::uint32_t i = 0; !textures.empty() && i < fields.size(); ++i) {
    if (!fields[i].may_be_textured() || below(random, 2) == 0) continue;
    uses.push_back({i, textures[below(random, textures.size())], {}});
    if (fields[i].is<double>() && !fields[i].whole_color)
      uses.back().channel = static_cast<TextureChannel>(below(random, 4));
  }
  return uses;
}

/// Numbers of textures have their default without one.
template <class T>
void reset_unused(auto& item) {
  const Fields& fields = element_type<T>().fields;
  for (std::uint32_t i = 0; i < fields.size(); ++i) {
    const bool used =
        std::any_of(item.textures.begin(), item.textures.end(), [&](const TextureUse& use) { return use.field == i; });
    if (fields[i].is_of_texture() && (!used || fields[i].number_attribute.empty()))
      fields[i].template get<double>(&item.parameters) = 1;
  }
}

Transform random_transform(Random& random) {
  Transform transform;
  do {
    transform.steps.clear();
    for (std::size_t i = below(random, 3); i > 0; --i) {
      TransformStep step;
      do {
        step = {static_cast<TransformStep::Type>(below(random, 4)), {}};
        for (std::size_t k = 0; k < step.value_count(); ++k) step.values[k] = random_number(random, Range::any);
        if (step.type == TransformStep::matrix)
          step.values = {2, 0, 0, step.values[3], 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1};
      } while (check_step(step));
      transform.steps.push_back(step);
    }
  } while (check_affine(transform.affine()));
  return transform;
}

/// Whether several such, within each other, keep to what a scene may have.
bool is_moderate(const Affine& affine) {
  return std::max({length(affine.x), length(affine.y), length(affine.z), length(affine.origin)}) < 1000;
}

/// Instances are of groups that the scene has.
ObjectLists random_objects(Random& random, const SceneDescription& scene,
                           const std::vector<MaterialReference>& materials,
                           const std::vector<TextureReference>& textures) {
  ObjectLists objects;
  int named = 0;
  for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
    for (std::size_t i = below(random, 8); i > 0; --i) {
      const std::string name = below(random, 2) == 0 ? "" : random_name(random) + std::to_string(++named);
      ObjectItem<T> item{random_parameters<T>(random), name, materials[below(random, materials.size())]};
      item.transform = random_transform(random);
      item.shadowcatcher = below(random, 4) == 0;
      item.visible = below(random, 4) != 0;
      if constexpr (std::is_same_v<T, Instance>) {
        if (scene.groups.empty()) continue;
        item.parameters.group.name = scene.groups[below(random, scene.groups.size())].name;
        while (!is_moderate(item.transform.affine())) item.transform = random_transform(random);
      }
      if constexpr (std::is_same_v<T, SphereCloud> || std::is_same_v<T, Model> || std::is_same_v<T, Curve>)
        item.parameters.file.path = random_name(random);
      if constexpr (std::is_same_v<T, Curve>) item.parameters.points = {};
      if constexpr (requires { item.textures; }) {
        item.textures = random_uses(random, element_type<T>().fields, textures);
        reset_unused<T>(item);
      }
      if constexpr (!std::is_same_v<T, Curve>)  // which alone may be of fibres
        if (item.material.type == index_of<Hair>(Materials{})) continue;
      if constexpr (std::is_same_v<T, Plane>)  // which has no end, as such a fog has
        if (item.material.type == index_of<Fog>(Materials{}) &&
            !std::get<MaterialItems<Fog>>(scene.materials)[item.material.index].textures.empty())
          continue;
      if constexpr (requires { T::may_lack_material; })
        if (below(random, 2) == 0) item.material = no_material;
      std::get<ObjectItems<T>>(objects).push_back(std::move(item));
    }
  });
  return objects;
}

/// Of items that have any.
bool same_textures(const auto& x, const auto& y) {
  if constexpr (requires { x.textures; })
    return std::equal(x.textures.begin(), x.textures.end(), y.textures.begin(), y.textures.end(),
                      [](const TextureUse& u, const TextureUse& v) { return same(u, v); });
  return true;
}

bool same_objects(const ObjectLists& a, const ObjectLists& b) {
  return same_items(Objects{}, a, b, [](const auto& x, const auto& y) {
    return x.name == y.name && same(x.material, y.material) && x.transform == y.transform &&
           x.shadowcatcher == y.shadowcatcher && x.visible == y.visible && same_textures(x, y);
  });
}

/// What its density may be: that of a file, or of a texture in space.
void randomize_density(Random& random, const SceneDescription& scene, MaterialItem<Fog>& fog) {
  fog.textures.clear();
  const auto& noises = std::get<TextureItems<Noise>>(scene.textures);
  const bool has_texture = !noises.empty() && below(random, 2) == 0;
  if (has_texture) {
    const Fields& fields = element_type<Fog>().fields;
    for (std::uint32_t i = 0; i < fields.size(); ++i)
      if (fields[i].name == Fog::density_field)
        fog.textures.push_back({i,
                                {static_cast<std::uint32_t>(index_of<Noise>(Textures{})),
                                 static_cast<std::uint32_t>(below(random, noises.size()))},
                                static_cast<TextureChannel>(below(random, 4))});
  } else {
    fog.parameters.densityfade = Vec3d(0, 0, 0);
    if (below(random, 2) != 0) return;
    fog.parameters.densityfile.path = random_name(random) + ".vdb";
    if (below(random, 2) == 0) fog.parameters.densitygrid.name = "smoke_2";
  }
  fog.transform = random_transform(random);
}

}  // namespace

SceneDescription random_description(Random& random) {
  SceneDescription scene;
  scene.viewplane = random_parameters<ViewPlane>(random);
  with_type(Cameras{}, below(random, Cameras::size), [&]<class T>(std::type_identity<T>) {
    scene.camera.template emplace<index_of<T>(Cameras{})>(random_parameters<T>(random));
  });
  if (below(random, 2) == 0) {
    with_type(Integrators{}, below(random, Integrators::size), [&]<class T>(std::type_identity<T>) {
      scene.integrator.emplace(std::in_place_index<index_of<T>(Integrators{})>, random_parameters<T>(random));
    });
  }
  for_each_type(Lights{}, [&]<class T>(std::type_identity<T>) {
    constexpr bool only_one = T::group.empty() || std::is_same_v<T, EnvironmentLight> || std::is_same_v<T, SkyLight>;
    if (std::is_same_v<T, SkyLight> && !std::get<LightItems<EnvironmentLight>>(scene.lights).empty()) return;
    for (std::size_t i = below(random, only_one ? 2 : 8); i > 0; --i) {
      std::get<LightItems<T>>(scene.lights).push_back({random_parameters<T>(random)});
      if constexpr (std::is_same_v<T, EnvironmentLight>) {
        auto& parameters = std::get<LightItems<T>>(scene.lights).back().parameters;
        if (!parameters.file.path.empty()) parameters.ground = 1;
      }
    }
  });
  std::vector<TextureReference> textures;
  for_each_type(Textures{}, [&]<class T>(std::type_identity<T>) {
    auto& items = std::get<TextureItems<T>>(scene.textures);
    for (std::size_t i = below(random, 4); i > 0; --i) {
      textures.push_back(
          {static_cast<std::uint32_t>(index_of<T>(Textures{})), static_cast<std::uint32_t>(items.size())});
      items.push_back({random_parameters<T>(random), random_name(random) + std::to_string(textures.size())});
      if constexpr (std::is_same_v<T, Noise>) items.back().parameters.space = TextureSpace::world;  // fogs may have it
    }
  });
  std::vector<MaterialReference> materials;
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    auto& items = std::get<MaterialItems<T>>(scene.materials);
    for (std::size_t i = below(random, 8); i > 0; --i) {
      materials.push_back(
          {static_cast<std::uint32_t>(index_of<T>(Materials{})), static_cast<std::uint32_t>(items.size())});
      items.push_back({random_parameters<T>(random), random_name(random) + std::to_string(materials.size())});
      if (below(random, 2) == 0) items.back().textures = random_uses(random, element_type<T>().fields, textures);
      reset_unused<T>(items.back());
      if constexpr (std::is_same_v<T, Fog>) randomize_density(random, scene, items.back());
    }
  });
  if (materials.empty()) return scene;
  for (std::size_t i = below(random, 3); i > 0; --i) {
    scene.groups.push_back(
        {random_name(random) + std::to_string(i), random_objects(random, scene, materials, textures)});
    std::get<ObjectItems<Plane>>(scene.groups.back().objects).clear();
  }
  scene.objects = random_objects(random, scene, materials, textures);
  return scene;
}

bool same_scene(const SceneDescription& a, const SceneDescription& b) {
  if (a.integrator.has_value() != b.integrator.has_value()) return false;
  if (a.integrator && !same_choice(Integrators{}, *a.integrator, *b.integrator)) return false;
  return same_choice(Cameras{}, a.camera, b.camera) && same_parameters<ViewPlane>(a.viewplane, b.viewplane) &&
         same_items(Lights{}, a.lights, b.lights, [](const auto&, const auto&) { return true; }) &&
         same_items(Textures{}, a.textures, b.textures,
                    [](const auto& x, const auto& y) { return x.name == y.name; }) &&
         same_items(Materials{}, a.materials, b.materials,
                    [](const auto& x, const auto& y) {
                      if constexpr (requires { x.transform; })
                        if (!(x.transform == y.transform)) return false;
                      return x.name == y.name && same_textures(x, y);
                    }) &&
         same_objects(a.objects, b.objects) &&
         std::equal(
             a.groups.begin(), a.groups.end(), b.groups.begin(), b.groups.end(),
             [](const Group& x, const Group& y) { return x.name == y.name && same_objects(x.objects, y.objects); });
}

}  // namespace raytrace::test
