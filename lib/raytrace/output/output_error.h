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

/// A picture that is too large, or too small, for the format that its file's name asks for.
class SizeError : public OutputError {
 public:
  using OutputError::OutputError;
};

}  // namespace raytrace
