// The date that a picture carries.
#pragma once

#include <ctime>
#include <string>

#include "raytrace/output/file_handle.h"

namespace raytrace {

struct PictureDate {
  std::string text;  ///< UTC, in the form of EXR's capDate and of TIFF's DateTime: "2026:01:31 23:59:59"
  std::tm utc;       ///< the same
  bool fixed;        ///< by the environment's SOURCE_DATE_EPOCH: the same picture is to give the same bytes
};

/// Now, or what SOURCE_DATE_EPOCH says (https://reproducible-builds.org/specs/source-date-epoch). Throws OutputError if
/// that is not a time.
PictureDate picture_date();

}  // namespace raytrace
