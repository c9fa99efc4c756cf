// A diagnostic about the text of a file, before there is a tree.
#pragma once

#include <cstddef>
#include <string>

namespace raytrace {

/// What is wrong with the text, and at which of its bytes.
struct XmlDiagnostic {
  std::size_t offset;
  std::string message;
};

}  // namespace raytrace
