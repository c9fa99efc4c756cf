// The photons of a pass, which its samples look up: what a film keeps of them from one call of render() to the next.
#pragma once

#include <cmath>
#include <cstdint>

namespace raytrace {

/// Which samples share photons, and of how many light paths these are. It follows from the size of the whole picture,
/// so that all parts of a picture agree.
struct PhotonPasses {
  PhotonPasses(int full_width, int full_height) {
    const std::uint64_t samples = std::uint64_t{samples_per_pass} * static_cast<std::uint64_t>(full_width) *
                                  static_cast<std::uint64_t>(full_height);
    while (paths < most_paths && paths < samples / 4) paths *= 2;
  }

  static constexpr std::uint32_t samples_per_pass = 8, most_paths = 1U << 20U;

  std::uint32_t paths = 1U << 12U;  ///< a pass, a power of 2
  static std::uint32_t pass_of(std::uint32_t sample) { return sample / samples_per_pass; }
  /// The sample after its last.
  static std::uint32_t end_of(std::uint32_t pass) { return (pass + 1) * samples_per_pass; }

  /// The radius of a pass, of that of the first, 0: its square is a product of (i + 2/3) / (i + 1) (Knaus and Zwicker
  /// 2011).
  static double radius_share(std::uint32_t pass) {
    double share = 1;
    for (std::uint32_t i = 1; i <= pass && i < 1U << 16U; ++i) share *= (i + 2.0 / 3) / (i + 1.0);
    return std::sqrt(share);
  }
};

/// Of one pass. The wide code knows what is in it (tracing/photon_map.h).
class Photons {
 public:
  virtual ~Photons() = default;

  std::uint32_t pass = 0;
  /// Within which those of the first pass are looked up, in the scene's units.
  float first_radius = 0;
};

}  // namespace raytrace
