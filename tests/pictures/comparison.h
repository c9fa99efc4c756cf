// Pictures of the library and of the reference, side by side.
#pragma once

#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "reference/scene.h"

namespace raytrace::test {

/// A picture of linear radiances, the top row first.
struct Picture {
  int width = 0, height = 0;
  std::vector<reference::Vector> pixels;
  reference::Vector at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Picture library_picture(const SceneDescription& description, const std::string& isa);

/// Gives a random scene a camera of another type than a pinhole, which looks the same way: by its number, a thin lens,
/// a fisheye or a spherical one.
void change_camera(reference::Scene& scene, unsigned seed);

/// Gives a scene in motion the moments that the library sends its rays at.
void set_time(reference::Scene& scene);

/// At one sample a pixel.
Picture reference_picture(const reference::Scene& scene);

/// The largest channel's difference, relative where the wanted value is above 1; infinity where something is not
/// finite.
double difference(const reference::Vector& wanted, const reference::Vector& got);

struct Comparison {
  int differing = 0;  ///< pixels that differ by more than the tolerance
  int worst_x = 0, worst_y = 0;
  double worst = 0;
};

Comparison compare(const Picture& wanted, const Picture& got, double tolerance);

/// Saves wanted, got and difference, each as EXR and PNG, in the folder "failed-pictures" of the working folder, and
/// says where they are, which pixel is worst, and what it holds.
std::string save_evidence(const std::string& name, const Picture& wanted, const Picture& got,
                          const Comparison& comparison);

}  // namespace raytrace::test
