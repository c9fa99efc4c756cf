// The C library's files, closed at the end of their scope, and what goes wrong with them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace raytrace {

/// A file that cannot be read, or is not what it should be; what() names it and says why.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that could not be written; what() names the file and the reason. The file of that name, if there was one,
/// is as it was.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A picture that cannot be in a file of its name: that says no format, or one that lacks what is asked for.
class FormatError : public OutputError {
 public:
  using OutputError::OutputError;
};

/// A picture that is too large, or too small, for the format that its file's name asks for.
class SizeError : public FormatError {
 public:
  using FormatError::FormatError;
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

/// A file in memory. Throws std::bad_alloc.
FileHandle open_memory_file();

/// Opens a regular file to read it. Throws InputError, for pipes, sockets and devices at once: they might never answer.
FileHandle open_regular_file(const std::string& file);

std::uint64_t file_size(std::FILE* file);

/// A file that remembers why it first failed, since libraries report no more than that it did. After that it is not
/// written to. The calls return whether none has failed so far.
class CheckedFile {
 public:
  /// file: open for writing; it stays open.
  explicit CheckedFile(std::FILE* file) : file_(file) {}

  bool write(const void* data, std::size_t size);
  bool seek(std::uint64_t position);
  /// Empties the file's buffer.
  bool flush();

  /// 0, or the error number of the first failure.
  int error() const { return error_; }

 private:
  std::FILE* file_;
  int error_ = 0;
};

}  // namespace raytrace
