// Whether two renderers' pictures have the same expectation: a Z-test of each pixel, as Mitsuba's own tests have it,
// and of blocks of pixels, whose means are known so much better that a few per cent too much light are found in any
// scene.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"

namespace raytrace::test {

/// In the CIE's XYZ, the space of Mitsuba's moments.
using Xyz = std::array<double, 3>;

/// Pixels row by row, the top row first.
struct MomentPicture {
  int width = 0, height = 0;
  std::vector<Xyz> mean;
  std::vector<Xyz> error;  ///< standard deviation of the mean
  int renders = 0;         ///< from whose differences the error is known
};

/// What tests/ztest/make_references wrote: Mitsuba's picture.
MomentPicture mitsubas_picture(const std::string& scene);

/// The scene's file in tests/ztest/scenes, read, or with a text in it replaced by another.
struct Edit {
  std::string from, to;
};
SceneDescription described_scene(const std::string& scene, const Edit& edit = {});

/// Independent renders of the scene, each with a seed of its own.
class Renders {
 public:
  Renders(const SceneDescription& description, int count);
  /// Of blocks of edge x edge pixels, as if they were pixels: all that a render has in one count together, so samples
  /// of neighbours need not be independent.
  MomentPicture blocks(int edge) const;
  void scale(double factor);

 private:
  int width_, height_;
  std::vector<std::vector<Xyz>> pictures_;
};

/// Blocks of pixels whose samples are independent.
MomentPicture blocks_of(const MomentPicture& pixels, int edge);

struct Judgement {
  /// 99.75 % of the pixels, all blocks of 6 x 6 pixels, and the mean of the whole picture.
  bool equal = false;
  /// How many of each are not, and of which z is the largest.
  std::string report;
};

Judgement z_test(const MomentPicture& reference, const Renders& renders);

/// The deviate of the normal distribution that is as rare as t of Student's with so many degrees of freedom (Wallace's
/// approximation, 1959).
double normal_deviate(double t, double freedom);

}  // namespace raytrace::test
