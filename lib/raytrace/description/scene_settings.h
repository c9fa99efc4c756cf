// What the values of a scene may depend on: the frame, and the variables that stand in its text as $name.
#pragma once

#include <map>
#include <string>

namespace raytrace {

struct SceneSettings {
  int frame = 1;                                 ///< the value of $frame, and the moment at which keys are evaluated
  std::map<std::string, std::string> variables;  ///< name -> value; none is called "frame" (see is_variable_name)
};

}  // namespace raytrace
