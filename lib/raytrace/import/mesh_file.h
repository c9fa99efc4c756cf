// The bytes of a mesh file, decompressed if its name ends in .gz.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "raytrace/memory/large_array.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// By its name, in lower case: ".ply" of "a/b.PLY.gz".
std::string mesh_type(const std::string& file);

class MeshFile {
 public:
  /// Memory that bytes() may need, of one thread.
  class Scratch {
   public:
    char* room_for(std::size_t count) {
      if (count > room_) {
        bytes_ = std::make_unique_for_overwrite<char[]>(count);
        room_ = count;
      }
      return bytes_.get();
    }

   private:
    std::unique_ptr<char[]> bytes_;
    std::size_t room_ = 0;
  };

  /// No value, and an error, if it is missing, no regular file (a pipe might never answer), or its compressed data is
  /// damaged or too much.
  static std::optional<MeshFile> open(const std::string& file, Diagnostics& diagnostics);

  std::size_t size() const { return size_; }

  /// Some of its bytes, which must be within size(), until the next call with this scratch. Null if they cannot be
  /// read, since the file became shorter or its disk failed. Threads may call this at the same time.
  const char* bytes(std::size_t offset, std::size_t count, Scratch& scratch) const;

  /// Replaces its bytes, those of the file of that name, by what convert_model() makes of them. False, and an error, if
  /// that cannot be done.
  bool convert(const std::string& name, Diagnostics& diagnostics);

  /// Reads all of it into memory, if it is not yet there. False, and an error, if it cannot be read.
  bool load(int threads, Diagnostics& diagnostics);

  /// All, after load(). Old Macintosh line ends, carriage returns alone, have become line feeds if `as_lines`.
  std::string_view text(bool as_lines);

  /// The error where bytes() is null.
  static void report_changed(Diagnostics& diagnostics);

 private:
  struct Close {
    void operator()(const int* file) const;
  };

  bool decompress(Diagnostics& diagnostics);

  std::unique_ptr<int, Close> file_;
  std::size_t size_ = 0;
  LargeArray<char> memory_;
};

}  // namespace raytrace
