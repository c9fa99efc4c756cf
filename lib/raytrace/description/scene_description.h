// The passive description of a scene: names, numbers and lines of the file, before any Embree call.
//
// It is made as a whole by load_scene (or by hand, in tests and tools), validated as a whole, and never changes after.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "raytrace/cameras/registry.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/description/variables.h"
#include "raytrace/import/curve_data.h"
#include "raytrace/import/density_grid.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/integrators/registry.h"
#include "raytrace/lights/photometry.h"
#include "raytrace/lights/registry.h"
#include "raytrace/materials/registry.h"
#include "raytrace/math/type_list.h"
#include "raytrace/parameters/transform.h"
#include "raytrace/shapes/registry.h"
#include "raytrace/textures/registry.h"
#include "raytrace/textures/texel_image.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Where the scene's file has an item, a group, or the name of a file or something else.
inline SourceLocation location_of(const auto& thing) { return {thing.line, thing.column}; }

// Items have the line and the column of their elements, from 1; 0: nowhere.

template <class Light>
struct LightItem {
  typename Light::Parameters parameters;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

/// Those that may have an IES file.
template <class Light>
  requires requires(typename Light::Parameters parameters) { parameters.iesfile; }
struct LightItem<Light> {
  typename Light::Parameters parameters;
  std::uint32_t line = 0;
  LoadedPhotometry photometry{};  ///< once its file, if it has one, has been loaded (load_images.h)
  std::uint32_t column = 0;
};

template <>
struct LightItem<EnvironmentLight> {
  EnvironmentLight::Parameters parameters;
  std::uint32_t line = 0;
  Transform transform = {};
  LoadedImage image{};  ///< once its file, if it has one, has been loaded (load_images.h)
  std::uint32_t column = 0;
};

/// An item by its type (the index in the Textures or Materials registry) and its index among the items of that type.
struct ItemReference {
  std::uint32_t type = 0;
  std::uint32_t index = 0;

  friend bool operator==(const ItemReference&, const ItemReference&) = default;
};
using TextureReference = ItemReference;
using MaterialReference = ItemReference;

template <class Texture>
struct TextureItem {
  typename Texture::Parameters parameters;
  std::string name;
  std::uint32_t line = 0;
  bool imported = false;  ///< from a mesh's file, which brings it again when it is read again
  LoadedImage image{};    ///< of an Image, once its file has been loaded (load_images.h)
  std::uint32_t column = 0;
};

enum class TextureChannel {
  red,
  green,
  blue,
  alpha,
  automatic,  ///< alpha where the texture has it, else red: of fields that prefer it, where the scene names none
};
template <>
struct Choices<TextureChannel> {
  static constexpr std::array<std::string_view, 4> words = {"red", "green", "blue", "alpha"};
};

/// A colour or a number of a material that is multiplied by a texture.
struct TextureUse {
  std::uint32_t field = 0;  ///< its index in the material's fields()
  TextureReference texture;
  TextureChannel channel = TextureChannel::red;  ///< for numbers
};

/// What `automatic` means for a field.
inline TextureChannel channel_of(const FieldInfo& field, TextureChannel channel) {
  return channel == TextureChannel::automatic && !field.prefers_alpha ? TextureChannel::red : channel;
}

template <class Material>
struct MaterialItem {
  typename Material::Parameters parameters;
  std::string name;
  std::uint32_t line = 0;
  bool imported = false;               ///< from a mesh's file, which brings it again when it is read again
  std::vector<TextureUse> textures{};  ///< of a field no more than one
  std::uint32_t column = 0;
};

/// Those whose density may be that of a file.
template <>
struct MaterialItem<Fog> {
  Fog::Parameters parameters;
  std::string name;
  std::uint32_t line = 0;
  bool imported = false;
  std::vector<TextureUse> textures{};
  std::uint32_t column = 0;
  Transform transform = {};  ///< of the density
  LoadedGrid grid{};         ///< once its file, if it has one, has been loaded (load_images.h)
};

template <class Shape>
struct ObjectItem {
  typename Shape::Parameters parameters;
  std::string name;  ///< empty: unnamed
  MaterialReference material;
  std::uint32_t line = 0;
  bool shadowcatcher = false;  ///< a transparent picture shows the shadows on it alone
  bool visible = true;         ///< false: the camera's own rays pass it
  Transform transform = {};    ///< of what the parameters say
  std::uint32_t column = 0;
};

/// No material: that of its file, or none.
inline constexpr MaterialReference no_material{0xffffffff, 0xffffffff};

// What files hold, or may hold.

/// Of points or strands, which are one object.
template <class Object>
  requires std::is_same_v<Object, SphereCloud> || std::is_same_v<Object, Curve>
struct ObjectItem<Object> {
  typename Object::Parameters parameters;
  std::string name;
  MaterialReference material = no_material;  ///< where there is one, of all of it
  std::uint32_t line = 0;
  bool shadowcatcher = false, visible = true;
  Transform transform = {};

  // From load_meshes().
  std::shared_ptr<const typename Object::Data> data = nullptr;
  std::vector<MaterialReference> materials = {};  ///< those of the data, at least one
  std::uint32_t column = 0;
};

template <>
struct ObjectItem<Mesh> {
  Mesh::Parameters parameters;
  std::string name;
  MaterialReference material = no_material;  ///< where there is one, of all faces
  std::uint32_t line = 0;
  bool shadowcatcher = false, visible = true;
  Transform transform = {};

  // From load_meshes(). The data are of the finer faces, if it has such.
  std::shared_ptr<const MeshData> data = nullptr;
  std::vector<MaterialReference> materials = {};  ///< those of the data, at least one
  std::uint32_t column = 0;
  std::vector<TextureUse> textures{};  ///< that of its displacement, if it has one
  /// Of data that a program has made: that they are of the finer faces already.
  bool refined = false;
};

template <>
struct ObjectItem<Model> {
  Model::Parameters parameters;
  std::string name;
  MaterialReference material = no_material;  ///< where there is one, of all its objects
  std::uint32_t line = 0;
  bool shadowcatcher = false, visible = true;  ///< all its objects
  Transform transform = {};
  std::uint32_t column = 0;
  std::vector<TextureUse> textures{};  ///< as a mesh's
};

template <>
struct ObjectItem<Instance> {
  Instance::Parameters parameters;
  std::string name;
  MaterialReference material = no_material;  ///< where there is one, of all its objects
  std::uint32_t line = 0;
  bool shadowcatcher = false, visible = true;  ///< all its objects
  Transform transform = {};
  /// Of an instance that moves while the shutter is open: its transform at each moment (motion.h).
  std::vector<Affine> motion{};
  std::uint32_t column = 0;
};

template <class T>
using LightItems = std::vector<LightItem<T>>;
template <class T>
using TextureItems = std::vector<TextureItem<T>>;
template <class T>
using MaterialItems = std::vector<MaterialItem<T>>;
template <class T>
using ObjectItems = std::vector<ObjectItem<T>>;

/// The parameters of one of a registry's types.
template <class List>
struct ParametersVariant;
template <class... Types>
struct ParametersVariant<TypeList<Types...>> {
  using type = std::variant<typename Types::Parameters...>;
};
using CameraParameters = ParametersVariant<Cameras>::type;
using IntegratorParameters = ParametersVariant<Integrators>::type;

using ObjectLists = TupleOf<Objects, ObjectItems>::type;

/// Objects that are in the picture where instances of them are. It may have instances of other groups.
struct Group {
  std::string name;
  ObjectLists objects;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

struct SceneDescription {
  std::string file;  ///< as given on the command line; "-" for standard input
  ViewPlane viewplane;
  CameraParameters camera;
  SourceLocation camera_location{};                ///< of its element
  std::vector<CameraParameters> moving_camera;     ///< at each moment while the shutter is open, if it moves (motion.h)
  std::optional<IntegratorParameters> integrator;  ///< none: the file leaves it open
  TupleOf<Lights, LightItems>::type lights;        ///< std::get<LightItems<PointLight>>(lights)
  TupleOf<Textures, TextureItems>::type textures;  ///< std::get<TextureItems<Checker>>(textures)
  TupleOf<Materials, MaterialItems>::type materials;  ///< std::get<MaterialItems<Matte>>(materials)
  ObjectLists objects;                                ///< std::get<ObjectItems<Sphere>>(objects)
  std::vector<Group> groups;
  std::vector<IncludedFile> included;  ///< by the lines of items; their names are as the program opens them
};

/// Reads and validates a scene file ("-": standard input), but not the meshes, clouds and strands that it names. All
/// errors and warnings go to `diagnostics`; no value if there is an error. A file that cannot be read is an error at
/// line 0. The files that textures name are loaded, too. threads: so many at most share the work; 0: all that the
/// machine has. The result does not depend on it. settings: variables that are not used are errors, as those that are
/// not set.
std::optional<SceneDescription> load_scene(const std::string& file, Diagnostics& diagnostics, int threads = 0,
                                           const SceneSettings& settings = {});

/// The same for a text that is already in memory. Files that textures name are left to load_images().
std::optional<SceneDescription> parse_scene(std::string_view text, Diagnostics& diagnostics, int threads = 0,
                                            const SceneSettings& settings = {});

/// Reads the files of meshes, clouds and curves, and makes the meshes and curves whose values stand in the scene; adds
/// materials for what has none in the scene: those of the file, else a matte grey. Each model becomes a mesh behind the
/// others of its lists, and the lights of its file become the scene's, behind its own, in the order of the models. What
/// is wrong with the files goes to `diagnostics`, with the files' names and lines. False if there is an error.
bool load_meshes(SceneDescription& description, Diagnostics& diagnostics, int threads = 0,
                 const TextureSettings& textures = {});

/// Writes the description as a scene file in canonical form: every value spelled out, defaults included; reading it
/// back gives an equal description (all doubles round-trip). It has neither variables nor keys, nor what moves while
/// the shutter is open (SceneSettings::still), nor what load_meshes() adds, but for the meshes and lights that it makes
/// of models.
std::string print_scene(const SceneDescription& description);

/// An XML Schema 1.0 document, made from the registries' tables of fields, so that it knows every type there is. A file
/// that it refuses is one that load_scene refuses. The reverse does not hold: no schema can say that a direction is not
/// 0, that a camera's eye is not where it looks, or that there is one ambient light in all; nor, since they may have
/// keys, that a number is one and a vector whole; nor, since names may have variables, that an object's material
/// exists; nor, since files may be included, that there is a camera.
std::string print_schema();

/// 32 hexadecimal digits (XXH3, 128 bits) of all names and values of the description but the number of samples, the
/// view of files for display and where in which file they stood: two files that mean the same have the same. Of meshes
/// and clouds, what load_meshes() read counts, not their files' names. threads: so many at most share the work; 0: all
/// that the machine has.
std::string scene_hash(const SceneDescription& description, int threads = 0);

}  // namespace raytrace
