// A view that something else than this library defines.
#pragma once

namespace raytrace {

/// From linear colour to what a display takes.
class ColorTransform {
 public:
  ColorTransform() = default;
  virtual ~ColorTransform() = default;
  ColorTransform(const ColorTransform&) = delete;
  ColorTransform& operator=(const ColorTransform&) = delete;

  /// Of the first three of each pixel's values, in place. From any thread.
  virtual void apply(float* values, int pixels, int channels) const = 0;
};

}  // namespace raytrace
