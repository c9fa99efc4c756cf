// An output file that appears whole or not at all, whatever happens while it is written.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "raytrace/output/file_handle.h"
#include "raytrace/output/file_identity.h"

namespace raytrace {

/// A temporary file beside `file`, which commit() flushes to disk and renames to it. Destroyed without a commit, it
/// is removed and `file` is as it was.
///
/// Where `file` is a symbolic link, what it points to is replaced and the link stays, unless it may be a trap
/// (link_target()). A file without any write permission is refused even to root, who could replace it: somebody wanted
/// it kept. A file that is replaced keeps its permissions, and its owner and group where the process may give files
/// away; the permissions of a new one are what the umask leaves of 0666.
class AtomicFile {
 public:
  /// Throws OutputError for all that is known to fail in the end: no such folder, read-only, not a regular file, a file
  /// that only its owner may replace...
  explicit AtomicFile(const std::string& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The temporary file, open for writing. It stays open: nobody opens it by its name, which another process might have
  /// given to something else meanwhile.
  std::FILE* stream() const { return stream_.get(); }

  /// Of the temporary file, and of `file` after the commit.
  FileIdentity identity() const { return file_identity(fileno(stream_.get())); }

  /// Throws OutputError if the disk does not take it.
  void commit();

  /// Throws the OutputError of a call about the temporary file that failed with this `errno`.
  [[noreturn]] void fail(int error_number) const;

 private:
  std::string file_;  ///< as the caller named it, for messages
  std::filesystem::path target_;
  std::string temporary_;  ///< empty once it is renamed
  FileHandle stream_;
};

}  // namespace raytrace
