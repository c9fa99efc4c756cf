// Files of a run that are one file, and must not be.
#pragma once

#include "raytrace/output/used_files.h"

namespace raytrace {

/// Throws UsageError, which names both.
[[noreturn]] void refuse_clash(const UsedFile& file, const UsedFile& other);

/// Adds the file to those that the run uses. Throws UsageError if it clashes with one of them.
void add_file(UsedFiles& files, const UsedFile& file);

}  // namespace raytrace
