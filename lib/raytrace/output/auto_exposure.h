// The exposure that a picture's own brightness asks for.
#pragma once

#include <cstdint>

#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// Brings the logarithmic mean of all luminances to 0.18 (Reinhard et al. 2002, Photographic Tone Reproduction for
/// Digital Images). A pixel counts by its alpha, with the colour of its covered part; one that is black, or not finite,
/// does not count. Sums are of whole numbers: the order in which pixels come makes no difference.
class AutoExposure {
 public:
  void add(const Pixel& pixel);
  void add(const ImageBand& band);

  /// In stops, rounded to hundredths; 0 if no pixel counts.
  double stops() const;

 private:
  std::int64_t logarithms_ = 0;  ///< to base 2, of luminance over 0.18, by their weights
  std::int64_t weights_ = 0;
};

/// Of all its pixels.
double automatic_exposure(const Film& film);

}  // namespace raytrace
