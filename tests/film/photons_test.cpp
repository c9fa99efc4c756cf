// Which samples share photons, and within which radius they are looked up.
#include "raytrace/film/photons.h"

#include <cmath>

#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("the radius of photons shrinks as the scene format says") {
  CHECK(PhotonPasses::radius_share(0) == 1);
  CHECK(std::abs(PhotonPasses::radius_share(1) - std::sqrt(5.0 / 6)) < 1e-12);
  CHECK(std::abs(PhotonPasses::radius_share(2) - std::sqrt(5.0 / 6 * 8 / 9)) < 1e-12);
  // Noise and bias both vanish: the area falls with the cube root of the passes.
  const double area = std::pow(PhotonPasses::radius_share(8000) / PhotonPasses::radius_share(1000), 2);
  CHECK(std::abs(area - 0.5) < 1e-3);
}

TEST_CASE("passes of photons follow from the sample and the size of the picture alone") {
  CHECK(PhotonPasses::pass_of(0) == 0);
  CHECK(PhotonPasses::pass_of(7) == 0);
  CHECK(PhotonPasses::pass_of(8) == 1);
  CHECK(PhotonPasses::end_of(1) == 16);
  CHECK(PhotonPasses(8, 8).paths == 4096);
  CHECK(PhotonPasses(320, 240).paths == 262144);  // the next power of 2 from 153,600 on
  CHECK(PhotonPasses(3840, 2160).paths == PhotonPasses::most_paths);
}

}  // namespace raytrace::test
