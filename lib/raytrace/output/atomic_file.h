// An output file that appears whole or not at all, whatever happens while it is written.
#pragma once

#include <filesystem>
#include <string>

#include "raytrace/output/output_error.h"

namespace raytrace {

/// A temporary file beside `file`, which commit() flushes to disk and renames to it. Destroyed without a commit, it
/// is removed and `file` is as it was.
///
/// Where `file` is a symbolic link, what it points to is replaced and the link stays. A file without any write
/// permission is refused even to root, who could replace it: somebody wanted it kept.
class AtomicFile {
 public:
  /// Throws OutputError: no such folder, read-only, not a regular file, no space...
  explicit AtomicFile(const std::string& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Exists, is empty, and has `file`'s extension; whoever fills it must close it before commit().
  const std::string& temporary_name() const { return temporary_; }

  /// Throws OutputError if the disk does not take it.
  void commit();

  /// Throws the OutputError of a call about the temporary file that failed with this `errno`.
  [[noreturn]] void fail(int error_number) const;

 private:
  std::string file_;  ///< as the caller named it, for messages
  std::filesystem::path target_;
  std::string temporary_;  ///< empty once it is renamed
};

}  // namespace raytrace
