// Which file a name leads to, however it is spelled, by symbolic links or not.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
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

/// "." for a name without one.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// Where writing to `file` ends up: the links of all folders and of the file itself followed; what does not exist stays
/// as it is spelled. Throws OutputError: links in a circle, or one that somebody else may have put there as a trap: in
/// a folder that everyone can write to but where nobody can remove what is another's (sticky, as /tmp is), a link that
/// belongs neither to this process's user nor to the folder's owner. Linux refuses those, too, where
/// fs.protected_symlinks is set.
std::filesystem::path link_target(const std::string& file);

/// The same by the file's own links alone, and anybody's. Throws nothing: what leads nowhere stays as it is.
std::filesystem::path last_link_target(const std::string& file);

}  // namespace raytrace

template <>
struct std::hash<raytrace::FileIdentity> {
  std::size_t operator()(const raytrace::FileIdentity& identity) const noexcept {
    // Inodes count up, and files of one folder differ in their names.
    return std::hash<std::string>()(identity.name) ^ (std::hash<ino_t>()(identity.inode) * 31 + identity.device);
  }
};
