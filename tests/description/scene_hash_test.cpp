// Scenes that look different have different hashes, and others the same.
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>

#include "random_description.h"
#include "raytrace/description/scene_description.h"
#include "reported.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

void change(double& value) { value += value == 0 ? 1 : value; }
void change(int& value) { ++value; }
void change(bool& value) { value = !value; }
void change(std::string& value) { value += "x"; }
void change(FileName& value) { value.path += "x"; }
void change(Reference& value) { value.name += "x"; }
void change(NumberGroups& value) {
  value.numbers.push_back(1);
  value.ends.push_back(static_cast<std::uint32_t>(value.numbers.size()));
}
void change(WordOrGroups& value) { change(value.groups); }

/// Calls changed() after each change of a number, alone; it is undone then.
template <class Value, class Changed>
void change_each(Value& value, const Changed& changed) {
  if constexpr (std::is_same_v<Value, Vec3d>) {
    for (double* part : {&value.x, &value.y, &value.z}) change_each(*part, changed);
  } else if constexpr (std::is_same_v<Value, Vec2d>) {
    for (double* part : {&value.x, &value.y}) change_each(*part, changed);
  } else if constexpr (std::is_same_v<Value, Rgb<double>>) {
    for (double* part : {&value.red, &value.green, &value.blue}) change_each(*part, changed);
  } else if constexpr (std::is_same_v<std::remove_const_t<Value>, ChoiceReference>) {
    const std::size_t before = value.index();
    for (std::size_t other = 0; other < value.words().size(); ++other) {
      value.set(other);
      if (other != before) changed();
    }
    value.set(before);
  } else {
    const Value before = value;
    change(value);
    changed();
    value = before;
  }
}

/// Of the fields of the view plane, of cameras and of materials. A map of tangents has no number.
bool does_not_count(std::string_view field) {
  return field == "samples" || field == "viewtransform" || field == "exposure" || field == "autoexposure" ||
         field == "whitebalance" || field == "shutteropen" || field == "shutterclose" || field == "tangentmap";
}

void change_fields(const ElementType& type, void* parameters, const std::function<void()>& changed) {
  for (const Field& field : type.fields) {
    if (does_not_count(field.name)) continue;
    INFO("field " << field.name);
    field.visit(parameters, [&](auto& value) { change_each(value, changed); });
  }
}

template <class T>
void change_fields(typename T::Parameters& parameters, const std::function<void()>& changed) {
  change_fields(element_type<T>(), &parameters, changed);
}

void change_textures(std::vector<TextureUse>& uses, const std::function<void()>& changed) {
  for (TextureUse& use : uses) {
    for (std::uint32_t* part : {&use.field, &use.texture.type, &use.texture.index}) {
      ++*part;
      changed();
      --*part;
    }
    ChoiceReference channel(use.channel);
    change_each(channel, changed);
  }
}

/// Calls changed() after each change that makes another scene.
template <class Changed>
void change_everything(SceneDescription& scene, const Changed& changed) {
  change_fields<ViewPlane>(scene.viewplane, changed);
  for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) {
    if (auto* parameters = std::get_if<typename T::Parameters>(&scene.camera)) change_fields<T>(*parameters, changed);
  });
  const auto integrator = scene.integrator;
  for_each_type(Integrators{}, [&]<class T>(std::type_identity<T>) {
    constexpr std::size_t i = index_of<T>(Integrators{});
    if (integrator && integrator->index() == i) {
      change_fields<T>(std::get<i>(*scene.integrator), changed);
      return;
    }
    scene.integrator.emplace(std::in_place_index<i>);
    changed();
    scene.integrator = integrator;
  });
  for_each_type(Lights{}, [&]<class T>(std::type_identity<T>) {
    for (auto& light : std::get<LightItems<T>>(scene.lights)) change_fields<T>(light.parameters, changed);
  });
  for_each_type(Textures{}, [&]<class T>(std::type_identity<T>) {
    for (auto& texture : std::get<TextureItems<T>>(scene.textures)) {
      change_fields<T>(texture.parameters, changed);
      change_each(texture.name, changed);
    }
  });
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    for (auto& material : std::get<MaterialItems<T>>(scene.materials)) {
      change_fields<T>(material.parameters, changed);
      change_each(material.name, changed);
      if constexpr (requires { material.grid; }) {
        for (TransformStep& step : material.transform.steps)
          for (std::size_t k = 0; k < step.value_count(); ++k) change_each(step.values[k], changed);
        change_each(material.grid.hash, changed);
      }
      change_textures(material.textures, changed);
    }
  });
  for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
    auto& objects = std::get<ObjectItems<T>>(scene.objects);
    for (auto& object : objects) {
      change_fields<T>(object.parameters, changed);
      change_each(object.name, changed);
      change_each(object.shadowcatcher, changed);
      change_each(object.visible, changed);
      if constexpr (requires { object.textures; }) change_textures(object.textures, changed);
      for (TransformStep& step : object.transform.steps)
        for (std::size_t k = 0; k < step.value_count(); ++k) change_each(step.values[k], changed);
      for (std::uint32_t* part : {&object.material.type, &object.material.index}) {
        ++*part;
        changed();
        --*part;
      }
    }
    if (objects.empty()) return;
    objects.push_back(objects.back());
    changed();
    objects.pop_back();
  });
}

}  // namespace

TEST_CASE("every value and name of a scene changes its hash, each in its own way") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 10; ++i) {
    SceneDescription scene = random_description(random);
    std::set<std::string> hashes{scene_hash(scene)};
    std::size_t scenes = 1;
    change_everything(scene, [&] {
      ++scenes;
      REQUIRE(hashes.insert(scene_hash(scene)).second);
    });
    CHECK(scenes > 50);
    CHECK(hashes.size() == scenes);
  }
}

TEST_CASE("what does not change the picture does not change the hash") {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20; ++i) {
    const SceneDescription scene = random_description(random);
    const std::string hash = scene_hash(scene);
    CHECK(hash.size() == 32);
    SceneDescription other = scene;
    other.viewplane.samples += 7;
    other.viewplane.viewtransform = ViewTransform::agx;
    other.viewplane.exposure += 1;
    other.viewplane.whitebalance += 1;
    other.viewplane.autoexposure = !other.viewplane.autoexposure;
    std::visit(
        [](auto& camera) {
          camera.shutteropen -= 1;
          camera.shutterclose += 1;
        },
        other.camera);
    other.file = "elsewhere.xml";
    CHECK(scene_hash(other) == hash);
    CHECK(scene_hash(accepted(print_scene(scene))) == hash);
  }
}

TEST_CASE("the hash of many objects is of all of them, and the same by any number of threads") {
  SceneDescription scene =
      accepted(scene_with_sphere("<center x='0' y='0' z='0'/><radius>1</radius><material>clay</material>"));
  auto& spheres = std::get<ObjectItems<Sphere>>(scene.objects);
  spheres.resize(100000, spheres.front());
  const std::string hash = scene_hash(scene, 1);
  CHECK(scene_hash(scene, 3) == hash);
  for (const std::size_t i : {std::size_t{0}, spheres.size() / 2, spheres.size() - 1}) {
    spheres[i].parameters.radius = 2;
    CHECK(scene_hash(scene, 3) != hash);
    spheres[i].parameters.radius = 1;
  }
  spheres.pop_back();
  CHECK(scene_hash(scene, 3) != hash);
}

TEST_CASE("the materials that a mesh's file names count in the hash") {
  SceneDescription scene;
  ObjectItem<Mesh>& mesh = std::get<ObjectItems<Mesh>>(scene.objects).emplace_back();
  mesh.materials = {{0, 0}, {0, 1}};
  const std::string hash = scene_hash(scene);
  mesh.materials = {{0, 1}, {0, 1}};
  CHECK(scene_hash(scene) != hash);
}

TEST_CASE("what a program has made of a mesh counts in the hash") {
  SceneDescription scene;
  MeshData data;
  data.corners = 3;
  ObjectItem<Mesh>& mesh = std::get<ObjectItems<Mesh>>(scene.objects).emplace_back();
  mesh.data = std::make_shared<const MeshData>(std::move(data));
  const std::string hash = scene_hash(scene);
  MeshData other;
  other.corners = 4;
  mesh.data = std::make_shared<const MeshData>(std::move(other));
  CHECK(scene_hash(scene) != hash);
}

TEST_CASE("layout, comments and the spelling of numbers do not change the hash") {
  const std::string hash = scene_hash(accepted(scene_with("")));
  CHECK(scene_hash(accepted(scene_with("<!-- a comment -->\n\n\t"))) == hash);
  CHECK(scene_hash(accepted(scene_with("<objects></objects>"))) == hash);
  const auto sphere = [](std::string_view children) { return scene_hash(accepted(scene_with_sphere(children))); };
  const std::string one = sphere("<center x='1' y='-2' z='0.5'/><radius>2</radius><material>clay</material>");
  CHECK(one != hash);
  CHECK(sphere("<material> clay </material>\n<radius><!-- -->2.0</radius> <center z='5e-1' y='-2.00' x='1'/>") == one);
  CHECK(sphere("<center x='1' y='-2' z='0.5'/><radius>2.0000001</radius><material>clay</material>") != one);
  CHECK(sphere("<center x='1' y='-2' z='0.5'/><radius>2</radius><material>steel</material>") != one);
  CHECK(sphere("<center x='0' y='0' z='0'/><radius>2</radius><material>clay</material>") ==
        sphere("<center x='-0' y='0' z='-0.0'/><radius>2</radius><material>clay</material>"));
}

}  // namespace raytrace::test
