#include "raytrace/output/used_files.h"

namespace raytrace {

const UsedFile* UsedFiles::add(const UsedFile& file) {
  const auto identity = file_identity(file.file);
  if (!identity) return nullptr;
  const auto [place, is_first] = files_.try_emplace(*identity, file);
  const UsedFile& other = place->second;
  return !is_first && (file.writes || other.writes) ? &other : nullptr;
}

}  // namespace raytrace
