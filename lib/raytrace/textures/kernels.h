// The kernels of all textures.
//
// A texture's Kernel provides
//   Kernel(const Parameters&);                  of an Image: with its TexelImage, for colours or for numbers
//   UvSet uvset() const;                        if it looks up by texture coordinates: by which of the two sets
//   TextureSpace space() const;                 if it may look up by the place in space: in which
//   float largest() const;                      no channel is larger, by magnitude
//   Rgba<FloatN> at(const TexturePoint<FloatN>& point) const;
//       the mean, in linear light, of about what the point covers
#pragma once

#include "raytrace/textures/checker_kernel.h"
#include "raytrace/textures/image_kernel.h"
#include "raytrace/textures/noise_kernel.h"
#include "raytrace/textures/registry.h"
#include "raytrace/textures/vertex_color_kernel.h"
