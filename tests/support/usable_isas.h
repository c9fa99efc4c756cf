// The instruction sets that tests can run here.
#pragma once

#include <string>
#include <vector>

#include "raytrace/render/renderer.h"

namespace raytrace::test {

/// All of isa_names() that this processor runs.
inline std::vector<std::string> usable_isas() {
  std::vector<std::string> usable;
  for (const std::string& name : isa_names()) {
    if (isa_supported(name)) usable.push_back(name);
  }
  return usable;
}

}  // namespace raytrace::test
