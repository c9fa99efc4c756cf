// The view plane: image size, sampling and background.
//
//   <viewplane>
//     <hres>400</hres> <vres>400</vres> <pixelsize>1</pixelsize> <samples>16</samples>
//     <background red="0" green="0" blue="0"/>
//     <filter>gaussian</filter> <filterwidth>3</filterwidth>
//     <viewtransform>agx</viewtransform> <exposure>-0.5</exposure> <autoexposure>true</autoexposure>
//     <whitebalance>3200</whitebalance>
//   </viewplane>
#pragma once

#include <array>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// How much the points around a pixel's centre count in it.
enum class PixelFilter { box, triangle, gaussian, blackman_harris };

template <>
struct Choices<PixelFilter> {
  static constexpr std::array<std::string_view, 4> words = {"box", "triangle", "gaussian", "blackmanharris"};
};

/// How files for display show linear colour. (output/view_transform.h)
enum class ViewTransform { srgb, agx, khronos_neutral };

template <>
struct Choices<ViewTransform> {
  static constexpr std::array<std::string_view, 3> words = {"srgb", "agx", "khronos-neutral"};
};

/// In stops, to either side: beyond it, all that is not black is white.
inline constexpr double largest_exposure = 64;

struct ViewPlane {
  int hres = 0;                     ///< pixels across
  int vres = 0;                     ///< pixels down
  double pixelsize = 1;             ///< edge of a pixel in world units, on the view plane at the camera's viewdistance
  int samples = 1;                  ///< samples per pixel
  Rgb<double> background{0, 0, 0};  ///< radiance where nothing is hit
  PixelFilter filter = PixelFilter::box;
  double filterwidth = 0;  ///< from edge to edge, in pixels; 0: the filter's own (filter_width())

  // Of files for display alone: no radiance depends on them.
  ViewTransform viewtransform = ViewTransform::srgb;
  double exposure = 0;        ///< in stops: the colour is multiplied by 2^exposure
  bool autoexposure = false;  ///< first, as the picture's own brightness asks for (output/auto_exposure.h)
  double whitebalance = 0;    ///< in kelvin: of the light that is shown as white (math/blackbody.h); 0: none

  using Parameters = ViewPlane;
  static constexpr std::string_view element = "viewplane";
  static Fields fields();
  static std::optional<ParameterDiagnostic> check(const ViewPlane& viewplane);
};

/// From edge to edge, in pixels: where none is given, 1 of a box, 2 of a triangle, 3 of the others.
double filter_width(const ViewPlane& viewplane);

/// The same framing at another resolution: the pixel size is scaled so that the whole of the former picture stays in
/// view, and fits the new one's tighter edge.
ViewPlane with_resolution(ViewPlane viewplane, int hres, int vres);

}  // namespace raytrace
