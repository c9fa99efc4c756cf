// The colours of black bodies, against a table of their chromaticities, and the white balance that makes them white.
#include "raytrace/math/blackbody.h"

#include "support/catch.h"

namespace raytrace::test {
namespace {

struct Chromaticity {
  double x, y;
};

/// By BT.709's primaries and white.
Chromaticity chromaticity(const Rgb<double>& color) {
  const double x = 0.4124 * color.red + 0.3576 * color.green + 0.1805 * color.blue;
  const double y = 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
  const double z = 0.0193 * color.red + 0.1192 * color.green + 0.9505 * color.blue;
  return {x / (x + y + z), y / (x + y + z)};
}

}  // namespace

TEST_CASE("black bodies have the chromaticities of Planck's law and a luminance of 1") {
  struct Row {
    double kelvin, x, y;  // Planck's law seen by the CIE's observer of 1931
  };
  for (const auto& [kelvin, x, y] :
       {Row{2000, 0.5267, 0.4133}, Row{2856, 0.4476, 0.4075}, Row{4000, 0.3805, 0.3768}, Row{5000, 0.3451, 0.3516},
        Row{6500, 0.3135, 0.3237}, Row{10000, 0.2807, 0.2884}}) {
    CAPTURE(kelvin);
    const Rgb<double> color = blackbody_color(kelvin);
    CHECK(chromaticity(color).x == Approx(x).margin(4e-4));
    CHECK(chromaticity(color).y == Approx(y).margin(4e-4));
    CHECK(0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue == Approx(1));
  }
}

TEST_CASE("embers are red and have nothing below 0") {
  const Rgb<double> ember = blackbody_color(1000);
  CHECK(ember.blue == 0);
  CHECK(ember.green > 0);
  CHECK(ember.red > 4);
  CHECK(0.2126 * ember.red + 0.7152 * ember.green == Approx(1));
}

TEST_CASE("the white balance makes a black body white, at the same luminance") {
  for (const double kelvin : {1900.0, 2700.0, 4000.0, 6504.0, 15000.0}) {
    CAPTURE(kelvin);
    const Rgb<double> white = product(white_balance(kelvin), blackbody_color(kelvin));
    CHECK(white.red == Approx(1).margin(2e-3));
    CHECK(white.green == Approx(1).margin(2e-3));
    CHECK(white.blue == Approx(1).margin(2e-3));
  }
}

}  // namespace raytrace::test
