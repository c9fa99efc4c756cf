// Which file a name leads to, however it is spelled.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace raytrace {

/// Two names of which this is equal are names of one file: hard links, symbolic links, "./a.exr" and "a.exr".
struct FileIdentity {
  dev_t device = 0;  ///< of the file; of its folder, where it does not exist yet
  ino_t inode = 0;
  std::string name;  ///< in that folder; empty where the file exists

  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

/// Of the file that is there under that name, or that writing to it would make. None for what is no regular file, which
/// any number of names may share (a terminal, /dev/null), and for an empty name.
std::optional<FileIdentity> file_identity(const std::string& file);

/// Of an open file.
FileIdentity file_identity(int descriptor);

/// Removes the file - of a symbolic link what it points to - if it is still this very one. False if there is another
/// under that name, or if it cannot be removed; true also if there is none.
bool remove_file(const std::string& file, const FileIdentity& identity);

}  // namespace raytrace

template <>
struct std::hash<raytrace::FileIdentity> {
  std::size_t operator()(const raytrace::FileIdentity& identity) const noexcept {
    // Inodes count up, and files of one folder differ in their names.
    return std::hash<std::string>()(identity.name) ^ (std::hash<ino_t>()(identity.inode) * 31 + identity.device);
  }
};
