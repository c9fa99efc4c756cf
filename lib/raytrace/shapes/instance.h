// A group of objects once more, somewhere else.
//
//   <instance> <group>tree</group> <transform> <translate x="5" y="0" z="2"/> </transform> </instance>
#pragma once

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Instance {
 public:
  struct Parameters {
    Reference group;  ///< the name of a <group>
  };
  static constexpr std::string_view group = "instances";
  static constexpr std::string_view element = "instance";
  static constexpr bool may_lack_material = true;  ///< then its objects have their own
  static Fields fields() { return {required("group", &Parameters::group)}; }
};

}  // namespace raytrace
