// Sines and cosines of turns, against the standard's.
#include "raytrace/math/turns.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

TEST_CASE("sines and cosines of turns are as precise as floats are, and as doubles where those are asked for") {
  double worst_float = 0, worst_double = 0;
  for (int i = -4096; i < 4096; ++i) {
    const FloatN turns = batch_of<FloatN>([&](std::size_t lane) {
      return (static_cast<double>(i) + static_cast<double>(lane) / static_cast<double>(lanes)) / 1024;
    });
    const auto in_float = sin_cos_of_turns(turns);
    const auto in_double = sin_cos_of_turns(Doubles<FloatN>(turns));
    // Doubles are read as what is left of them without the floats next to them.
    const auto rest = [](const Doubles<FloatN>& value) {
      return (value - Doubles<FloatN>(value.to_float())).to_float();
    };
    const FloatN sine = in_double.sine.to_float(), sine_rest = rest(in_double.sine);
    const FloatN cosine = in_double.cosine.to_float(), cosine_rest = rest(in_double.cosine);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double angle = double{turns.get(lane)} * 2 * std::numbers::pi;
      worst_float = std::max({worst_float, std::abs(double{in_float.sine.get(lane)} - std::sin(angle)),
                              std::abs(double{in_float.cosine.get(lane)} - std::cos(angle))});
      const auto off = [&](const FloatN& value, const FloatN& more, double wanted) {
        return std::abs(double{value.get(lane)} + double{more.get(lane)} - wanted);
      };
      worst_double =
          std::max({worst_double, off(sine, sine_rest, std::sin(angle)), off(cosine, cosine_rest, std::cos(angle))});
    }
  }
  CHECK(worst_float < 1.5e-7);
  CHECK(worst_double < 1e-14);
}

TEST_CASE("quarters of turns are exact") {
  for (const double whole : {0.0, 1.0, -3.0}) {
    const auto at = [&](double turns) { return sin_cos_of_turns(FloatN(static_cast<float>(turns + whole))); };
    CHECK(at(0).sine.get(0) == 0);
    CHECK(at(0).cosine.get(0) == 1);
    CHECK(at(0.25).sine.get(0) == 1);
    CHECK(at(0.25).cosine.get(0) == 0);
    CHECK(at(-0.25).sine.get(0) == -1);
    CHECK(at(0.5).cosine.get(0) == -1);
  }
}

}  // namespace raytrace::test
