#include "raytrace/batch/settings_error.h"

namespace raytrace {

const UsedFile* UsedFiles::add(const UsedFile& file) {
  const auto identity = file_identity(file.file);
  if (!identity) return nullptr;
  const auto [entry, is_first] = files_.try_emplace(*identity, file);
  const UsedFile& other = entry->second;
  return !is_first && (file.writes || other.writes) ? &other : nullptr;
}

void UsedFiles::add_or_refuse(const UsedFile& file) {
  if (const UsedFile* const other = add(file)) throw ClashError(file, *other);
}

ClashError::ClashError(const UsedFile& file, const UsedFile& other)
    : SettingsError(file.role + " " + file.file + " is the same file as " + other.role + " " + other.file +
                    ", and would be overwritten; give another name"),
      roles_{file.role, other.role} {}

}  // namespace raytrace
