// A picture's colours without noise, which its files get in the place of those that were rendered.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "raytrace/output/denoiser.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// The AOVs that denoising looks at, as --aov spells them.
inline constexpr const char* denoiser_aovs[] = {"denoise_albedo", "denoise_normal"};

/// "noisy.R", "noisy.G" and "noisy.B": the colours as they were rendered, which files keep beside the others.
std::vector<Channel> noisy_channels(bool full_float);

class DenoisedPicture {
 public:
  /// region: of the picture. channels: of its bands, colour first; denoiser_aovs among them. Throws std::bad_alloc.
  DenoisedPicture(const Region& region, const std::vector<Channel>& channels);

  /// Rows of the picture; all are to be added before it is denoised.
  void add(const ImageBand& band);

  /// False if it was stopped. Throws as denoised() does.
  bool denoise(int threads, const std::function<bool()>& stop);

  /// Appends planes of noisy_channels() to rows of the picture, and replaces their colours.
  void put_into(ImageBand& band) const;

 private:
  /// Copies three planes' rows of the band to the picture's.
  void copy(const ImageBand& band, std::size_t first_plane, std::vector<float>& pixels) const;

  Region region_;
  std::size_t albedo_ = 0, normal_ = 0;  ///< their first planes
  NoisyPicture picture_;
};

}  // namespace raytrace
