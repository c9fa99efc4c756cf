#include "file_clash.h"

#include "option_values.h"

namespace raytrace {

void refuse_clash(const UsedFile& file, const UsedFile& other) {
  throw UsageError(file.role + " " + file.file + " is the same file as " + other.role + " " + other.file +
                   ", and would be overwritten; give another name");
}

void add_file(UsedFiles& files, const UsedFile& file) {
  if (const UsedFile* const other = files.add(file)) refuse_clash(file, *other);
}

}  // namespace raytrace
