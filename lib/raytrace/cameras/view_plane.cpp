#include "raytrace/cameras/view_plane.h"

#include <algorithm>
#include <cmath>

#include "raytrace/film/region.h"
#include "raytrace/math/blackbody.h"

namespace raytrace {

Fields ViewPlane::fields() {
  return {required("hres", &ViewPlane::hres, Range::positive),
          required("vres", &ViewPlane::vres, Range::positive),
          optional("pixelsize", &ViewPlane::pixelsize, Range::positive),
          optional("samples", &ViewPlane::samples, Range::positive),
          optional("background", &ViewPlane::background),
          optional("filter", &ViewPlane::filter),
          optional("filterwidth", &ViewPlane::filterwidth, Range::not_negative),
          optional("viewtransform", &ViewPlane::viewtransform),
          optional("exposure", &ViewPlane::exposure),
          optional("autoexposure", &ViewPlane::autoexposure),
          optional("whitebalance", &ViewPlane::whitebalance)};
}

std::optional<ParameterDiagnostic> ViewPlane::check(const ViewPlane& viewplane) {
  if (viewplane.filterwidth > 100)
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error, "a <filterwidth> is at most 100 pixels"};
  if (std::abs(viewplane.exposure) > largest_exposure)
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error, "an <exposure> is from -64 to 64 stops"};
  if (viewplane.whitebalance != 0 && !is_temperature(viewplane.whitebalance))
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                               "a <whitebalance> is 0, for none, or from 1000 to 15000 kelvin"};
  if (is_allowed_size(viewplane.hres, viewplane.vres)) return std::nullopt;
  return ParameterDiagnostic{
      ParameterDiagnostic::Effect::error,
      "a picture of " + std::to_string(viewplane.hres) + " x " + std::to_string(viewplane.vres) +
          " pixels is beyond the limit of 65536 pixels an edge and 268435456 (16384 x 16384) in all"};
}

double filter_width(const ViewPlane& viewplane) {
  if (viewplane.filterwidth > 0) return viewplane.filterwidth;
  return viewplane.filter == PixelFilter::box ? 1 : viewplane.filter == PixelFilter::triangle ? 2 : 3;
}

ViewPlane with_resolution(ViewPlane viewplane, int hres, int vres) {
  viewplane.pixelsize *= std::max(double(viewplane.hres) / hres, double(viewplane.vres) / vres);
  viewplane.hres = hres;
  viewplane.vres = vres;
  return viewplane;
}

}  // namespace raytrace
