// Values of textures one by one, for what is made of them before rays are traced. They are those of the kernels
// (kernels.h), but for rounding.
#pragma once

#include <array>
#include <optional>

#include "raytrace/math/color.h"
#include "raytrace/math/vec2.h"
#include "raytrace/math/vec3.h"
#include "raytrace/textures/checker.h"
#include "raytrace/textures/image.h"
#include "raytrace/textures/noise.h"
#include "raytrace/textures/texel_image.h"
#include "raytrace/textures/vertex_color.h"

namespace raytrace {

/// A place on a surface, and how much of the texture around it counts, as far as the axes of a TexturePoint reach.
struct TexturePlace {
  struct OnSurface {
    Vec2d uv{0, 0};
    Vec2d width{0, 0};  ///< along u and along v
  };
  std::array<OnSurface, 2> sets;  ///< by UvSet
  Vec3d point{0, 0, 0};           ///< in space, whichever of its texture's
  double width = 0;               ///< around it
  Rgb<double> vertex_color{1, 1, 1};
  double vertex_alpha = 1;

  const OnSurface& by(UvSet set) const { return sets[static_cast<std::size_t>(set)]; }
};

/// Red, green, blue and alpha, in linear light.
using TextureValue = std::array<double, 4>;

/// texels: as a number or as a colour; null of an image that has not been loaded, which is magenta.
TextureValue texture_value(const Image::Parameters& image, const TexelImage* texels, const TexturePlace& place);
/// The same for heights: none where an image with tiles has no tile. A place on the far edge of a tile is of that one,
/// if there is none beyond.
std::optional<TextureValue> height_value(const Image::Parameters& image, const TexelImage& texels,
                                         const TexturePlace& place);
TextureValue texture_value(const Checker::Parameters& checker, const TexturePlace& place);
TextureValue texture_value(const Noise::Parameters& noise, const TexturePlace& place);
TextureValue texture_value(const VertexColor::Parameters& vertices, const TexturePlace& place);

}  // namespace raytrace
