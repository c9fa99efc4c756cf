// Settings of a render or a merge that cannot be meant, such as one file for two uses.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "raytrace/output/file_identity.h"

namespace raytrace {

/// Settings that contradict each other, the scene, or the files that there are. what() calls a setting what the command
/// calls its option, and says what would be right.
class SettingsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file and what it is to the run.
struct UsedFile {
  std::string role;  ///< "--output", "the scene"
  std::string file;  ///< as it was given
  bool writes = false;
};

/// That a file would have two uses, of which one writes it.
class ClashError : public SettingsError {
 public:
  ClashError(const UsedFile& file, const UsedFile& other);
  /// Whether it is about a file of that role.
  bool is_about(const std::string& role) const { return role == roles_[0] || role == roles_[1]; }

 private:
  std::array<std::string, 2> roles_;
};

/// All files that a run reads and writes, so that none of them destroys another.
class UsedFiles {
 public:
  /// Adds a file. Returns the one that it clashes with, or null: the same file, however it was spelled, of which one
  /// use or the other writes. Changes nothing on the disk.
  const UsedFile* add(const UsedFile& file);

  /// The same, but throws ClashError.
  void add_or_refuse(const UsedFile& file);

 private:
  std::unordered_map<FileIdentity, UsedFile> files_;
};

}  // namespace raytrace
