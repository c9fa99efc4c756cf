// Values that change from frame to frame:
//
//   <radius> <key frame="1" value="2"/> <key frame="24" value="5" interpolation="smooth"/> </radius>
//
// Before the first key and after the last one a value is held. Between two keys each component goes monotonically from
// the one's to the other's, so it never leaves the range of its keys. A linear key is a corner: what comes to it and
// what leaves it goes straight for it. A smooth key is passed without a corner; the first and the last key, if smooth,
// are left and reached with speed 0, as is a key whose neighbours are both above or both below it.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "raytrace/description/read_value.h"

namespace raytrace {

enum class Interpolation { linear, smooth };

template <>
struct Choices<Interpolation> {
  static constexpr std::array<std::string_view, 2> words = {"linear", "smooth"};
};

struct Key {
  double frame = 0;
  std::array<double, 4> components{};  ///< a number's is the first
  Interpolation interpolation = Interpolation::linear;
};

/// Keys nearer to each other than this are of the same frame.
inline constexpr double least_key_distance = 1e-6;

/// keys: at least one, ordered by their frames, which differ by least_key_distance or more.
///
/// Cubic Hermite interpolation. At a smooth key the slope is the weighted harmonic mean of those of the lines to its
/// neighbours, or 0 (Fritsch, Butland: A Method for Constructing Local Monotone Piecewise Cubic Interpolants, 1984); at
/// a linear key it is on each side that of the line.
std::array<double, 4> value_at(const std::vector<Key>& keys, double frame);

/// The attribute of a number's keys, where those of vectors have x, y and z.
inline constexpr std::string_view number_component = "value";

/// That of a colour, or of its keys, that is a black body's (math/blackbody.h), in place of red, green and blue.
inline constexpr std::string_view temperature_attribute = "kelvin";

/// Whether the element has keys among its children.
bool has_keys(Element element);

/// Reads an element that has. components: their attributes, at most 3; values: receive what they are at the frame of
/// the variables. False, with errors, if anything is wrong. texture: receives that of the element; null: textures are
/// refused.
bool read_keys(Element element, std::span<const std::string_view> components, std::span<double* const> values,
               Range range, const ReadContext& context, TextureAttributes* texture = nullptr);

}  // namespace raytrace
