#include "raytrace/output/picture.h"

#include <algorithm>

namespace raytrace {

void PictureReader::set_layout(const PictureLayout& layout) {
  if (layout.width < 1 || layout.height < 1) throw PictureError("it is no picture with rows and columns");
  if (std::max(layout.width, layout.height) > largest_picture_edge ||
      std::int64_t{layout.width} * layout.height > most_picture_pixels)
    throw PictureError("it has " + std::to_string(layout.width) + " x " + std::to_string(layout.height) +
                       " pixels; a texture has 16384 x 16384 at most, or as many");
  layout_ = layout;
}

}  // namespace raytrace
