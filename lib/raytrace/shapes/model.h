// A file's objects with its materials, textures and lights: a <mesh>, and lights. load_meshes() makes these of it.
//
//   <model> <file>lamp.glb</file> <transform> <translate x="0" y="1" z="0"/> </transform> </model>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Model {
 public:
  struct Parameters {
    FileName file;  ///< as a mesh's
    // As a mesh's; but for the last, of a glTF file.
    Reference animation;
    double time = 0;
    Reference variant;
    bool overridematerials = false;
  };
  static constexpr std::string_view group = "models";
  static constexpr std::string_view element = "model";
  static constexpr bool may_lack_material = true;  ///< then it has those of its file
  static Fields fields() {
    return {required("file", &Parameters::file), optional("animation", &Parameters::animation),
            optional("time", &Parameters::time), optional("variant", &Parameters::variant),
            optional("overridematerials", &Parameters::overridematerials)};
  }
};

}  // namespace raytrace
