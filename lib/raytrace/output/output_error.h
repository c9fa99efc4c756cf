// What went wrong with an output file.
#pragma once

#include <stdexcept>

namespace raytrace {

/// A file that could not be written; what() names the file and the reason. The file of that name, if there was one,
/// is as it was.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace raytrace
