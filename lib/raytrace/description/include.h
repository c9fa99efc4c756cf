// Another file's sections, at the root of a scene.
//
//   <include> <file>materials.xml</file> </include>
#pragma once

#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Include {
 public:
  struct Parameters {
    FileName file;
  };
  static constexpr std::string_view element = "include";
  static Fields fields() { return {required("file", &Parameters::file)}; }
};

}  // namespace raytrace
