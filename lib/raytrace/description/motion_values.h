// How values of a scene differ from one moment to another. Inside of add_motion().
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <variant>

#include "raytrace/math/affine.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/parameters/transform.h"

namespace raytrace {

template <class Value>
bool is_same(const Value& a, const Value& b) {
  if constexpr (HasComponents<Value>)
    return std::all_of(Components<Value>::members.begin(), Components<Value>::members.end(),
                       [&](const auto member) { return a.*member == b.*member; });
  else
    return a == b;
}

/// Where the values are written does not count.
inline bool have_same_values(const Fields& fields, const void* a, const void* b) {
  return std::all_of(fields.begin(), fields.end(), [&](const Field& field) {
    const FieldValue of_a = field.value(const_cast<void*>(a)), of_b = field.value(const_cast<void*>(b));
    return std::visit(
        [&]<class Any>(const Any& value) {
          const Any& other = std::get<Any>(of_b);
          if constexpr (std::is_same_v<Any, ChoiceReference>)
            return value.index() == other.index();
          else
            return is_same(*value, *other);
        },
        of_a);
  });
}

/// By what all points of `to` lie beside those of `from`; nothing if not all do, or other values differ.
inline std::optional<Vec3d> shift_between(const Fields& fields, const void* from, const void* to) {
  std::optional<Vec3d> shift;
  double size = 0;
  for (const Field& field : fields) {
    if (!field.is_point) {
      if (!have_same_values({field}, from, to)) return std::nullopt;
      continue;
    }
    const Vec3d a = field.get<Vec3d>(const_cast<void*>(from)), b = field.get<Vec3d>(const_cast<void*>(to));
    size = std::max({size, length(a), length(b)});
    if (!shift) shift = b - a;
    // Keys round each point by itself.
    if (length(b - a - *shift) > 1e-12 * size) return std::nullopt;
  }
  return shift.value_or(Vec3d{0, 0, 0});
}

/// Whether what moves straight from one map to the next is flat or mirrored on its way, or nearly so.
inline bool collapses_between(const Affine& from, const Affine& to) {
  // As a turn by a little more than 90 degrees.
  const double least = 0.49 * std::min(std::abs(from.determinant()), std::abs(to.determinant()));
  constexpr int steps = 64;
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    const auto between = [&](Vec3d Affine::* column) { return from.*column * (1 - part) + to.*column * part; };
    const Affine map{between(&Affine::x), between(&Affine::y), between(&Affine::z), between(&Affine::origin)};
    const double determinant = from.determinant() < 0 ? -map.determinant() : map.determinant();
    if (!(determinant >= least)) return true;
  }
  return false;
}

/// The largest angle, in degrees, by which the rotations of the one differ from those of the other, whole turns
/// included, which leave no trace in the maps.
inline double largest_turn(const Transform& from, const Transform& to) {
  double turn = 0;
  for (std::size_t i = 0; i < std::min(from.steps.size(), to.steps.size()); ++i)
    if (from.steps[i].type == TransformStep::rotate && to.steps[i].type == TransformStep::rotate)
      turn = std::max(turn, std::abs(to.steps[i].values[3] - from.steps[i].values[3]));
  return std::round(turn * 1e6) / 1e6;  // keys round
}

}  // namespace raytrace
