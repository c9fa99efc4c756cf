// IES files, and what lights send with them.
#include "raytrace/lights/photometry.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "raytrace/lights/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

const std::string head = "IESNA:LM-63-2002\n[TEST] made\nTILT=NONE\n";
/// Of 3 by 3 angles.
const std::string numbers = "1 1000 1 3 3 1 2 0.1 0.1 0\n1 1 50\n";
const std::string quarter = head + numbers + "0 45 90\n0 45 90\n100 80 0\n100 60 0\n100 40 0\n";

float share(const Photometry& photometry, double vertical, double horizontal) {
  const int column = photometry.columns == 1 ? 0 : static_cast<int>(horizontal * 2);
  return photometry.shares.at(static_cast<std::size_t>(static_cast<int>(vertical * 2) * photometry.columns + column));
}

std::string refusal(const std::string& text) {
  try {
    read_photometry(text);
  } catch (const PhotometryError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("an IES file's intensities are shares of the largest, bilinear between its angles") {
  const Photometry photometry = read_photometry(quarter);
  CHECK(share(photometry, 0, 0) == 1);
  CHECK(share(photometry, 45, 45) == Approx(0.6));
  CHECK(share(photometry, 22.5, 45) == Approx(0.8));
  CHECK(share(photometry, 45, 22.5) == Approx(0.7));
  CHECK(share(photometry, 22.5, 22.5) == Approx(0.85));
  CHECK(share(photometry, 90, 0) == 0);
  CHECK(share(photometry, 120, 0) == 0);
}

TEST_CASE("what an IES file leaves out is symmetric") {
  const Photometry one_quarter = read_photometry(quarter);
  for (const double same : {30.0, 150.0, 210.0, 330.0})
    CHECK(share(one_quarter, 45, same) == Approx(share(one_quarter, 45, 30)));
  const Photometry half = read_photometry(head + numbers + "0 45 90\n0 60 180\n9 9 9\n9 6 9\n9 3 9\n");
  CHECK(share(half, 45, 300) == Approx(6.0 / 9));
  CHECK(share(half, 45, 60) == Approx(6.0 / 9));
  CHECK(share(half, 45, 180) == Approx(3.0 / 9));
  const Photometry round = read_photometry(head + "1 1000 1 3 1 1 2 0 0 0\n1 1 50\n0 90 180\n0\n2 4 1\n");
  CHECK(round.columns == 1);
  CHECK(share(round, 45, 123) == Approx(0.75));
}

TEST_CASE("an IES file may have commas, tilt angles and Windows' line ends, and no header") {
  std::string text = quarter.substr(head.size());
  for (char& c : text)
    if (c == ' ') c = ',';
  const Photometry photometry = read_photometry("A lamp\r\nTILT=INCLUDE\r\n1\r\n2\r\n0 90\r\n1 0.9\r\n" + text);
  CHECK(share(photometry, 45, 45) == Approx(0.6));
}

TEST_CASE("what is no IES file is refused, with the line and column") {
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = quarter;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  CHECK(refusal("") == "line 1, column 1: this is no IES file: it has no line that begins with TILT=");
  CHECK(refusal(quarter.substr(0, quarter.size() - 3)) == "line 10, column 7: the file ends before the intensities");
  CHECK(changed("100 60 0", "100 6o 0") == "line 9, column 5: no number for the intensities");
  CHECK(changed("100 60 0", "100 -6 0") == "line 9, column 5: an intensity is negative");
  CHECK(changed("100 60 0", "100 nan 0") == "line 9, column 5: no number for the intensities");
  CHECK(changed("0 45 90\n0", "0 45 45\n0") == "line 6, column 6: the vertical angles do not increase");
  CHECK(changed("0 45 90\n0", "0 45 181\n0") == "line 6, column 6: a vertical angle is not within 0 to 180 degrees");
  CHECK(changed("\n0 45 90\n100", "\n0 45 95\n100") ==
        "line 7, column 6: the horizontal angles do not go from 0 to 0, 90, 180 or 360 degrees");
  CHECK(changed("3 3 1 2", "3 3 2 2") == "line 4, column 14: the photometry is not of type C, which is 1");
  CHECK(changed("3 3 1 2", "3 1e9 1 2") ==
        "line 4, column 12: the number of horizontal angles is not a whole number from 1 to 10000");
  CHECK(changed("3 3 1 2", "9999 9999 1 2") == "line 4, column 15: there are more than 4000000 intensities");
  CHECK(changed("1000 1 3", "1000 0 3") == "line 10, column 8: the lamp sends out no light");
}

TEST_CASE("lights with an IES file send their shares, about the axis of a spotlight and downwards from a point light") {
  const LoadedPhotometry loaded{"made", std::make_shared<const Photometry>(read_photometry(
                                            head + numbers + "0 45 90\n0 90 360\n100 80 0\n100 60 0\n100 80 0\n"))};
  // A direction of 45 degrees from the axis, by its angle about it.
  const auto below = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vec3d(std::cos(angle), -1, -std::sin(angle));
  };
  const Kernel<PointLight> point({.location = {1, 2, 3}, .scaleradiance = 10}, loaded);
  const auto radiance = [](const auto& light, const Vec3d& at) {
    return double{light.template sample<FloatN>(spread(at)).radiance.green.get(0)};
  };
  const Vec3d location(1, 2, 3);
  CHECK(radiance(point, location + Vec3d(0, -5, 0)) == Approx(10));
  CHECK(radiance(point, location + below(0)) == Approx(8));
  CHECK(radiance(point, location + below(90)) == Approx(6));
  CHECK(radiance(point, location + below(45)) == Approx(7));
  CHECK(radiance(point, location + below(225)) == Approx(7));
  CHECK(radiance(point, location + Vec3d(1, 1, 0)) == 0);
  const Kernel<SpotLight> spot({.location = {1, 2, 3}, .lookat = {1, 2, 0}, .coneangle = 170, .scaleradiance = 10},
                               loaded);
  CHECK(radiance(spot, location + Vec3d(0, 0, -2)) == Approx(10));
  CHECK(radiance(spot, location + Vec3d(1, 0, -1)) == Approx(8));
  CHECK(radiance(spot, location + Vec3d(0, 1, -1)) + radiance(spot, location + Vec3d(0, -1, -1)) > 12.5);
  const Kernel<PointLight> plain({.location = {1, 2, 3}, .scaleradiance = 10});
  CHECK(radiance(plain, location + below(33)) == 10);
}

}  // namespace raytrace::test
