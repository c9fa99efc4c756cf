// Takes the noise out of a picture by Intel's Open Image Denoise (https://www.openimagedenoise.org), version 2: a
// trained filter, which looks at a picture's colours, albedos and normals.
//
// No Debian has it, and its libraries are large: they are loaded when a picture asks for them, from the folder
// $RAYTRACE_DENOISER; without it from ../lib beside the program's folder, from where cmake/denoiser puts them, or from
// wherever the system looks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace raytrace {

/// Rows from the top, without gaps, three numbers a pixel.
struct DenoiserPicture {
  int width = 0, height = 0;
  std::vector<float> color;                ///< linear radiance; what is below 0 becomes 0
  std::vector<std::vector<float>> layers;  ///< the same, of parts of the light
  std::vector<float> alpha;                ///< from 0 to 1, three times the same; empty: the picture has none
  std::vector<float> albedo;               ///< from 0 to 1; may have noise, as the next
  std::vector<float> normal;               ///< of length 1 at most, in any space
};

/// "Open Image Denoise 2.5.1". Throws OutputError, with what to do, if there is none.
std::string denoiser_name();

/// The picture without noise. none: `stop`, which is asked now and then, said so. threads: 0: all processors; the
/// result does not depend on it, but may on the kind of processor. Throws OutputError if there is no denoiser, or if it
/// fails; std::bad_alloc.
std::optional<DenoiserPicture> denoised(DenoiserPicture picture, int threads, const std::function<bool()>& stop);

}  // namespace raytrace
