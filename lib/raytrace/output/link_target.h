// Symbolic links on the way to a file that is to be written or removed.
#pragma once

#include <filesystem>
#include <string>

namespace raytrace {

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
