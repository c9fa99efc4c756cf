// Colours that say which share of light a surface sends back: above 1 it gives more than it gets, and light that goes
// to and fro between such surfaces has no end.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/srgb.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/text/message.h"

namespace raytrace {

/// A number that multiplies a colour, or none.
struct ReflectanceWeight {
  std::string_view field{};
  double value = 1;
};

/// Adds a warning if the colour of that field times the weight is above 1; what it says to write is not. Where one of
/// them has a texture, that says the rest, and there is none.
inline void warn_of_gain(std::vector<ParameterWarning>& warnings, const IsTextured& is_textured, std::string_view field,
                         const Rgb<double>& color, const ReflectanceWeight& weight = {}) {
  const double most = std::max({color.red, color.green, color.blue});
  constexpr double rounding = 1e-6;  // 0.7 times 1 / 0.7 is fine
  if (!(weight.value * most > 1 + rounding) || is_textured(field) || is_textured(weight.field)) return;
  const auto is_byte = [](double value) { return value >= 0 && value <= 255 && value == std::floor(value); };
  const bool are_bytes = most >= 10 && is_byte(color.red) && is_byte(color.green) && is_byte(color.blue);
  const auto share = [&](double value) {
    return formatted("%.4g", are_bytes ? linear_of_srgb(value / 255) : std::max(value, 0.0) / most);
  };
  std::string better;
  if (most > 1)
    better = "<" + std::string(field) + " red=\"" + share(color.red) + "\" green=\"" + share(color.green) +
             "\" blue=\"" + share(color.blue) + "\"/>";
  if (weight.value > 1) better += (most > 1 ? " and " : "") + tag(weight.field) + "1" + closing_tag(weight.field);
  warnings.push_back(
      {most > 1 ? field : weight.field, (weight.field.empty() ? std::string() : tag(weight.field) + " times ") +
                                            tag(field) + " is " + formatted("%.4g", weight.value * most) +
                                            ", above 1: light grows where it is reflected; write " + better +
                                            (are_bytes ? ", the linear values of that sRGB colour" : "")});
}

}  // namespace raytrace
