// What of a picture's view is chosen apart from its scene.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "raytrace/cameras/view_plane.h"

namespace raytrace {

/// An OpenColorIO configuration that takes the view transform's place.
struct OcioSettings {
  std::string config;         ///< its file; empty: none
  std::string display, view;  ///< empty: the configuration's defaults
  std::string colorspace;     ///< of the picture's linear colour; empty: the configuration's linear Rec. 709

  bool empty() const { return config.empty(); }
  friend bool operator==(const OcioSettings&, const OcioSettings&) = default;
};

/// As ViewPlane's.
struct ViewSettings {
  ViewTransform transform = ViewTransform::srgb;
  double exposure = 0;
  bool auto_exposure = false;
  double white_balance = 0;

  friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

inline ViewSettings view_settings(const ViewPlane& viewplane) {
  return {viewplane.viewtransform, viewplane.exposure, viewplane.autoexposure, viewplane.whitebalance};
}

/// In place of the scene's, where they are given. An exposure is all of it: neither the scene's nor what the picture
/// asks for itself is added, unless auto_exposure says so.
struct ViewOptions {
  std::optional<ViewTransform> transform;
  std::optional<double> exposure;
  bool auto_exposure = false;
  std::optional<double> white_balance;
  bool dither = false;  ///< ImageFileSettings::dither
  OcioSettings ocio;

  /// The option of the command line that is given, or the first of several; empty: none.
  std::string first_given() const {
    if (exposure) return "--exposure";
    if (auto_exposure) return "--auto-exposure";
    if (white_balance) return "--white-balance";
    if (transform) return "--view-transform";
    if (dither) return "--dither";
    return ocio.empty() ? "" : "--ocio";
  }

  ViewSettings over(const ViewSettings& scene) const {
    return {transform.value_or(scene.transform), exposure.value_or(scene.exposure),
            auto_exposure || (scene.auto_exposure && !exposure), white_balance.value_or(scene.white_balance)};
  }
};

/// "khronos-neutral"
inline std::string name_of(ViewTransform transform) {
  return std::string(Choices<ViewTransform>::words[static_cast<std::size_t>(transform)]);
}

}  // namespace raytrace
