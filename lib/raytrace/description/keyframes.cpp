#include "raytrace/description/keyframes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace raytrace {
namespace {

/// A component of the keys as a function of the frame.
class Curve {
 public:
  Curve(const std::vector<Key>& keys, std::size_t component) : keys_(keys), component_(component) {}

  /// At a frame between keys[i] and keys[i + 1].
  double at(std::size_t i, double frame) const {
    const double start = value(i);
    const double end = value(i + 1);
    const double s = (frame - keys_[i].frame) / length(i);
    if (!is_smooth(i) && !is_smooth(i + 1)) return std::lerp(start, end, s);
    const double start_slope = is_smooth(i) ? smooth_slope(i) : slope(i);
    const double end_slope = is_smooth(i + 1) ? smooth_slope(i + 1) : slope(i);
    const double r = 1 - s;
    const double hermite = start * (1 + 2 * s) * r * r + end * s * s * (3 - 2 * s) +
                           length(i) * (start_slope * s * r * r - end_slope * s * s * r);
    return std::clamp(hermite, std::min(start, end), std::max(start, end));  // against rounding
  }

 private:
  double value(std::size_t i) const { return keys_[i].components[component_]; }
  double length(std::size_t i) const { return keys_[i + 1].frame - keys_[i].frame; }
  double slope(std::size_t i) const { return (value(i + 1) - value(i)) / length(i); }
  bool is_smooth(std::size_t i) const { return keys_[i].interpolation == Interpolation::smooth; }

  double smooth_slope(std::size_t i) const {
    if (i == 0 || i + 1 == keys_.size()) return 0;
    const double before = slope(i - 1);
    const double after = slope(i);
    if (before * after <= 0) return 0;
    const double before_weight = length(i - 1) + 2 * length(i);
    const double after_weight = 2 * length(i - 1) + length(i);
    return (before_weight + after_weight) / (before_weight / before + after_weight / after);
  }

  const std::vector<Key>& keys_;
  std::size_t component_;
};

}  // namespace

DiagnosticText parse_interpolation(std::string_view text, Interpolation& interpolation) {
  if (text != "linear" && text != "smooth") return "is neither linear nor smooth; write one of them";
  interpolation = text == "smooth" ? Interpolation::smooth : Interpolation::linear;
  return std::nullopt;
}

std::array<double, 3> value_at(const std::vector<Key>& keys, double frame) {
  const auto next = std::upper_bound(keys.begin(), keys.end(), frame,
                                     [](double wanted, const Key& key) { return wanted < key.frame; });
  if (next == keys.begin()) return keys.front().components;
  if (next == keys.end()) return keys.back().components;
  const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
  std::array<double, 3> components{};
  for (std::size_t component = 0; component < 3; ++component)
    components[component] = Curve(keys, component).at(i, frame);
  return components;
}

}  // namespace raytrace
