// A file's objects with its materials, textures and lights: a <mesh>, and lights. load_meshes() makes these of it.
//
//   <model> <file>lamp.glb</file> <transform> <translate x="0" y="1" z="0"/> </transform> </model>
#pragma once

#include "raytrace/parameters/fields.h"
#include "raytrace/shapes/subdivision.h"

namespace raytrace {

class Model {
 public:
  struct Parameters {
    FileName file;  ///< as a mesh's
    // As a mesh's; the first three of a glTF file.
    Reference animation;
    double time = 0;
    Reference variant;
    bool overridematerials = false;
    int subdivision = 0;
    SubdivisionScheme subdivisionscheme = SubdivisionScheme::smooth;
    double displacement = 1, midlevel = 0;
  };
  static constexpr std::string_view group = "models";
  static constexpr std::string_view element = "model";
  static constexpr bool may_lack_material = true;  ///< then it has those of its file
  static Fields fields() {
    return with_subdivision<Parameters>({required("file", &Parameters::file),
                                         optional("animation", &Parameters::animation),
                                         constant("time", &Parameters::time), optional("variant", &Parameters::variant),
                                         optional("overridematerials", &Parameters::overridematerials)});
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    return check_subdivision(parameters);
  }
  static std::vector<ParameterWarning> warnings(const Parameters& parameters, const IsTextured& is_textured) {
    return subdivision_warnings(parameters, is_textured);
  }
};

}  // namespace raytrace
