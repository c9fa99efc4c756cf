// A mesh of triangles or quads, from a file or from the scene itself.
//
//   <mesh>
//     <file>bunny.ply</file> <normals>smooth</normals>
//     <material>clay</material>
//   </mesh>
//
//   <mesh> <file>fox.glb</file> <animation>run</animation> <time>0.25</time> </mesh>
//
//   <mesh>
//     <positions>0 0 0, 1 0 0, 1 1 0, 0 1 0</positions> <faces>0 1 2 3</faces>
//     <material>clay</material>
//   </mesh>
#pragma once

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/subdivision.h"

namespace raytrace {

struct MeshData;

class Mesh {
 public:
  /// Which normals it is shaded with.
  enum Normals : std::size_t {
    of_file,  ///< those that it has, at vertices; faces where it has none
    smooth,   ///< at vertices, the mean of the normals of the faces there, by their angles
    flat,     ///< of faces
  };
  static constexpr std::array<std::string_view, 3> normals_words = {"file", "smooth", "flat"};

  struct Parameters {
    FileName file;           ///< .ply, .obj, .stl, .gltf or .glb (import/read_mesh.h); or:
    NumberGroups positions;  ///< x y z of each vertex
    NumberGroups faces;      ///< the vertices of each, from 0, counter-clockwise as its front shows them (face_ends())
    WordOrGroups normals{normals_words, of_file, {}};  ///< one of the words, or x y z of each vertex
    NumberGroups uvs;                                  ///< u v of each vertex; (0, 0) is the lower left of an image
    NumberGroups uvs2;                                 ///< the same in a second set, for textures that ask for it
    // Of a glTF file (import/read_mesh.h).
    Reference animation;             ///< its name, or its number from 0, or all; none: the model is at rest
    double time = 0;                 ///< of the animation, in seconds
    Reference variant;               ///< of its materials; none: those that primitives have by themselves
    bool overridematerials = false;  ///< materials of the scene take the place of the file's of the same names
    // subdivision.h
    int subdivision = 0;
    SubdivisionScheme subdivisionscheme = SubdivisionScheme::smooth;
    double displacement = 1, midlevel = 0;
  };
  using Data = MeshData;  ///< of the file, or of the values
  static constexpr std::string_view group = "meshes";
  static constexpr std::string_view element = "mesh";
  static constexpr bool may_lack_material = true;  ///< then it has those of its file
  static Fields fields() {
    return with_subdivision<Parameters>(
        {optional("file", &Parameters::file), optional("positions", &Parameters::positions),
         optional("faces", &Parameters::faces), optional("normals", &Parameters::normals),
         optional("uvs", &Parameters::uvs), optional("animation", &Parameters::animation),
         constant("time", &Parameters::time), optional("variant", &Parameters::variant),
         optional("uvs2", &Parameters::uvs2), optional("overridematerials", &Parameters::overridematerials)});
  }

  static std::optional<ParameterDiagnostic> check(const Parameters& parameters);
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    return subdivision_warnings(parameters, is_textured);
  }

  /// Where each face ends among its corners: without commas, those of triangles, or of one face if their number is no
  /// multiple of 3.
  static std::vector<std::uint32_t> face_ends(const NumberGroups& faces);
};

}  // namespace raytrace
