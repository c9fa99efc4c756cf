// What went wrong with a file that is read.
#pragma once

#include <stdexcept>

namespace raytrace {

/// A file that cannot be read, or is not what it should be; what() names it and says why.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace raytrace
