// A picture's colours without noise, which its files get in the place of those that were rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "raytrace/output/denoiser.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// The AOVs that denoising looks at, as --aov spells them.
inline constexpr const char* denoiser_aovs[] = {"denoise_albedo", "denoise_normal"};

/// "noisy.R", "noisy.G" and "noisy.B": the colours as they were rendered, which files keep beside the others; of
/// transparent pictures "noisy.A", too; then those of passes and light groups, such as "noisy.light_key.R". channels:
/// the picture's, colour first.
std::vector<Channel> noisy_channels(const std::vector<Channel>& channels, bool transparent);

class DenoisedPicture {
 public:
  /// region: of the picture. channels: of its bands, colour first; denoiser_aovs among them. transparent: its alpha is
  /// denoised, too, since shadows on what is not in the picture have noise there; but where it is 0 or 1 all around.
  /// Passes and light groups among the channels are denoised like the picture; where those of a kind add up to it, they
  /// still do, for each channel of a pixel is scaled to that. If some take light away, all stay as they are.
  /// Throws std::bad_alloc.
  DenoisedPicture(const Region& region, const std::vector<Channel>& channels, bool transparent);

  /// Rows of the picture; all are to be added before it is denoised.
  void add(const ImageBand& band);

  /// False if it was stopped. Throws as denoised() does.
  bool denoise(int threads, const std::function<bool()>& stop);

  /// Appends planes of noisy_channels() to rows of the picture, and replaces their colours, and those of passes and
  /// light groups.
  void put_into(ImageBand& band) const;

 private:
  /// Copies a plane's rows of the band to a channel of the picture's.
  void copy(const ImageBand& band, std::size_t plane, std::size_t channel, std::vector<float>& pixels) const;
  std::vector<std::uint8_t> even_alpha() const;
  /// Whether the parts of the light can be denoised.
  bool layers_are_light() const;
  /// The numbers of the light groups' among them, or of the passes'.
  std::vector<std::size_t> layers_of(bool of_groups) const;
  float sum_of(const std::vector<std::size_t>& layers, std::size_t number) const;
  /// Whether they add up to the picture.
  bool add_up(const std::vector<std::size_t>& layers) const;
  /// Makes them add up to it.
  void scale(const std::vector<std::size_t>& layers);
  /// The number of the band's first pixel.
  std::size_t begin_of(const ImageBand& band) const;

  Region region_;
  std::size_t albedo_ = 0, normal_ = 0;  ///< their first planes
  std::vector<std::size_t> layers_;      ///< the same of passes and light groups
  std::vector<bool> are_groups_;         ///< of each: which of the two
  DenoiserPicture picture_;              ///< in the end colour, and alpha once a pixel
};

}  // namespace raytrace
