// What an environment light sends, and the directions that it draws.
#include "raytrace/scene/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

constexpr double pi = std::numbers::pi;

/// Of floats; at(column, row): the colour, rows from the top.
template <class At>
std::shared_ptr<const TexelImage> made_image(int width, int height, const At& at) {
  Picture picture{width, height, 4, TexelFormat::floats, {}};
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  picture.pixels = LargeArray<std::byte>::zeros(texels * 4 * sizeof(float));
  for (std::size_t i = 0; i < texels; ++i) {
    const Rgb<double> color = at(static_cast<int>(i) % width, static_cast<int>(i) / width);
    const std::array<float, 4> numbers{static_cast<float>(color.red), static_cast<float>(color.green),
                                       static_cast<float>(color.blue), 1};
    std::memcpy(picture.pixels.data() + i * sizeof numbers, numbers.data(), sizeof numbers);
  }
  return std::make_shared<const TexelImage>(picture, false, 1);
}

LightItem<EnvironmentLight> light_of(std::shared_ptr<const TexelImage> image, const Transform& transform = {}) {
  LightItem<EnvironmentLight> light{{}, 0, transform, {"made", std::move(image), nullptr}};
  light.parameters.file.path = "made";
  return light;
}

Rgb<double> color_at(const Environment& environment, const Vec3d& direction) {
  const Rgb<FloatN> color = environment.radiance(spread(direction));
  return {double{color.red.get(0)}, double{color.green.get(0)}, double{color.blue.get(0)}};
}

bool is_near(const Rgb<double>& a, const Rgb<double>& b) {
  return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)}) < 1e-4;
}

/// The direction of a place in the picture, in turns of longitude to the right of its middle and of latitude up.
Vec3d direction_of(double right, double up) {
  const double longitude = right * 2 * pi, latitude = up * 2 * pi;
  return {-std::sin(longitude) * std::cos(latitude), std::sin(latitude), std::cos(longitude) * std::cos(latitude)};
}

/// A dark sky with a small sun, a band, and black texels.
std::shared_ptr<const TexelImage> sunny(int width, int height) {
  return made_image(width, height, [=](int x, int y) -> Rgb<double> {
    if (x == width / 3 && y == height / 4) return {5000, 4000, 3000};
    if (y == 0 || y == height - 1) return {0.5, 0.1 * x, 0};
    if (x > width / 2 && y > height / 2) return {0, 0, 0};
    return {0.1, 0.2 + 0.01 * y, 0.02 * x};
  });
}

struct Numbers {
  std::mt19937 bits{99};
  double unit() { return static_cast<double>(bits() >> 8U) * 0x1p-24; }
  FloatN batch() {
    return batch_of<FloatN>([&](std::size_t) { return unit(); });
  }
};

}  // namespace

TEST_CASE("an environment's picture has +z in its middle, -x right of it and +y above") {
  // Patches of 2 x 2 texels whose common corner is in the middle of what is towards an axis; the poles' rows are whole.
  const Rgb<double> back{1, 0, 0}, right{0, 1, 0}, front{0, 0, 1}, left{1, 1, 0}, top{0, 1, 1}, bottom{1, 0, 1};
  const Environment environment(
      light_of(made_image(16, 8,
                          [&](int x, int y) -> Rgb<double> {
                            if (y == 0) return top;
                            if (y == 7) return bottom;
                            if (y != 3 && y != 4) return {0, 0, 0};
                            return std::array{back, left, front, right}[static_cast<std::size_t>((x + 1) % 16 / 4)];
                          })),
      1);
  CHECK(is_near(color_at(environment, {0, 0, 1}), front));
  CHECK(is_near(color_at(environment, {0, 0, -1}), back));
  CHECK(is_near(color_at(environment, {-1, 0, 0}), right));
  CHECK(is_near(color_at(environment, {1, 0, 0}), left));
  CHECK(is_near(color_at(environment, {0, 1, 0}), top));
  CHECK(is_near(color_at(environment, {0, -1, 0}), bottom));
  CHECK(is_near(color_at(environment, {0, 0, 7}), front));
}

TEST_CASE("an environment is turned and mirrored with its transform") {
  const auto image = sunny(32, 16);
  const Environment plain(light_of(image), 1);
  Transform transform;
  transform.steps.push_back({TransformStep::rotate, {1, 2, -1, 50}});
  transform.steps.push_back({TransformStep::scale, {1, -1, 1}});
  const Environment turned(light_of(image, transform), 1);
  for (const Vec3d& direction : {Vec3d{0.3, 0.5, 0.2}, {-0.7, 0.1, 0.4}, {0.1, -0.9, -0.3}}) {
    const Vec3d there = transform.affine().vector(direction);
    CHECK(is_near(color_at(turned, there), color_at(plain, direction)));
    CHECK(turned.at(spread(there)).pdf.get(0) == Approx(plain.at(spread(direction)).pdf.get(0)));
  }
}

TEST_CASE("an environment is bilinear between the middles of texels, across the seam and the poles, too") {
  Numbers numbers;
  const auto value = [](int x, int y) {
    return Rgb<double>{(x * 7 + y * 3) % 11 * 0.1, (x * 5 + y) % 7 * 0.1, (x + y * y) % 5 * 0.1};
  };
  const int width = 12, height = 6;
  const Environment environment(light_of(made_image(width, height, value)), 1);
  const auto texel = [&](int x, int y) {
    if (y < 0 || y >= height) {
      y = y < 0 ? 0 : height - 1;
      x += width / 2;
    }
    return value((x + width) % width, y);
  };
  for (int i = 0; i < 500; ++i) {
    const double u = numbers.unit(), v = numbers.unit(), x = u * width - 0.5, y = v * height - 0.5;
    const int left = static_cast<int>(std::floor(x)), high = static_cast<int>(std::floor(y));
    Rgb<double> wanted{0, 0, 0};
    for (const int dy : {0, 1})
      for (const int dx : {0, 1})
        wanted = wanted + texel(left + dx, high + dy) *
                              ((dx == 0 ? 1 - (x - left) : x - left) * (dy == 0 ? 1 - (y - high) : y - high));
    INFO(u << ", " << v);
    CHECK(is_near(color_at(environment, direction_of(u - 0.5, (0.5 - v) / 2)), wanted));
  }
}

TEST_CASE("an environment draws directions with its density, which integrates to 1") {
  const bool turned = GENERATE(false, true);
  Transform transform;
  if (turned) transform.steps.push_back({TransformStep::rotate, {3, 1, -2, 70}});
  const Affine turn = transform.affine();
  for (const auto& [width, height] : {std::pair{24, 12}, {7, 5}, {1, 1}, {3, 2}}) {
    const Environment environment(light_of(sunny(width, height), transform), 1);
    // Cells of the picture's own, each within one texel.
    const int columns = width * (width < 10 ? 4 : 2), rows = height * (height < 10 ? 4 : 2);
    std::vector<double> expected(static_cast<std::size_t>(columns * rows)), observed(expected.size());
    constexpr int samples = 200000;
    double integral = 0;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        // A midpoint rule in longitude and latitude.
        constexpr int steps = 12;
        double share = 0;
        for (int step = 0; step < steps * steps; ++step) {
          const double x = (column + (step % steps + 0.5) / steps) / columns,
                       y = (row + (step / steps + 0.5) / steps) / rows;
          const Vec3d direction = direction_of(x - 0.5, (0.5 - y) / 2);
          share += double{environment.at(spread(turn.vector(direction))).pdf.get(0)} * std::sin(y * pi);
        }
        share *= 2 * pi / columns * pi / rows / (steps * steps);
        const int cell = row * columns + column;
        expected[static_cast<std::size_t>(cell)] = share * samples;
        integral += share;
      }
    INFO(width << " x " << height);
    CHECK(integral == Approx(1).epsilon(1e-4));
    Numbers numbers;
    double worst_length = 0;
    int wrong_pdfs = 0, wrong_radiances = 0;
    for (int i = 0; i < samples; i += packet_lanes) {
      const FloatN u1 = numbers.batch(), u2 = numbers.batch();
      const EnvironmentSample sample = environment.sample(u1, u2);
      const auto [wi, radiance, pdf] = environment.at(sample.wi);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Vec3d direction = lane_of(wi, lane), local = turn.inverse().vector(direction);
        worst_length = std::max(worst_length, std::abs(length(direction) - 1));
        wrong_pdfs += std::abs(pdf.get(lane) / sample.pdf.get(lane) - 1) > 1e-3F ? 1 : 0;
        // At the poles, where a picture has many radiances for one direction, roundings turn it.
        const double off = std::abs(double{radiance.red.get(lane) - sample.radiance.red.get(lane)});
        wrong_radiances += off > 1e-3 * double{environment.largest_radiance().red} ? 1 : 0;
        const double right = std::atan2(-local.x, local.z) / (2 * pi) + 0.5;
        const double down = std::acos(std::clamp(local.y, -1.0, 1.0)) / pi;
        const int column = std::min(static_cast<int>(right * columns), columns - 1);
        const int row = std::min(static_cast<int>(down * rows), rows - 1);
        const int cell = row * columns + column;
        ++observed[static_cast<std::size_t>(cell)];
      }
    }
    CHECK(chi_square_deviation(observed, expected) < 4);
    CHECK(worst_length < 1e-6);
    CHECK(wrong_pdfs < samples / 2000);
    CHECK(wrong_radiances < samples / 2000);
  }
}

TEST_CASE("an environment may draw every direction that something comes from") {
  // One texel alone, also at a pole: its light reaches into those around it, which are drawn, too.
  for (const int bright_row : {0, 3}) {
    const Environment environment(light_of(made_image(8, 6,
                                                      [&](int x, int y) -> Rgb<double> {
                                                        return x == 0 && y == bright_row ? Rgb<double>{0, 0, 1e-3}
                                                                                         : Rgb<double>{0, 0, 0};
                                                      })),
                                  1);
    Numbers numbers;
    int missed = 0, lit = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3d direction = direction_of(numbers.unit(), std::asin(2 * numbers.unit() - 1) / (2 * pi));
      const bool is_lit = color_at(environment, direction).blue > 1e-9;
      lit += is_lit;
      missed += is_lit && !(environment.at(spread(direction)).pdf.get(0) > 0);
    }
    CHECK(lit > 50);
    CHECK(missed == 0);
  }
}

TEST_CASE("the mean of radiance over density is the integral of the radiance, near the poles of large pictures, too") {
  // Bright in a cap of half a degree about the upper pole alone, two rows of 720.
  const Environment environment(
      light_of(made_image(1440, 720, [](int, int y) { return Rgb<double>{y < 2 ? 100.0 : 0.0, 0, 0}; })), 1);
  Numbers numbers;
  double sum = 0;
  constexpr int samples = 100000;
  for (int i = 0; i < samples; i += packet_lanes) {
    const FloatN u1 = numbers.batch(), u2 = numbers.batch();
    const EnvironmentSample sample = environment.sample(u1, u2);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      sum += double{sample.radiance.red.get(lane)} / double{sample.pdf.get(lane)} / samples;
  }
  // 100 to a quarter of a row below the middle of the second row, then less until the third row's middle.
  const auto cap = [](double rows) { return 2 * pi * (1 - std::cos(rows * pi / 720)); };
  double wanted = 100 * cap(1.5);
  for (int i = 0; i < 1000; ++i)
    wanted += 100 * (1 - (i + 0.5) / 1000) * (cap(1.5 + (i + 1) / 1000.0) - cap(1.5 + i / 1000.0));
  CHECK(sum == Approx(wanted).epsilon(0.01));
  CHECK(environment.mean_radiance().red == Approx(wanted / (4 * pi)).epsilon(0.3));
}

TEST_CASE("without a picture an environment is the same from everywhere, and draws all directions alike") {
  LightItem<EnvironmentLight> light;
  light.parameters.scaleradiance = 2;
  light.parameters.color = {1, 0.5, 0.25};
  const Environment environment(light, 1);
  CHECK(is_near(color_at(environment, {0.3, -0.4, 0.5}), {2, 1, 0.5}));
  Numbers numbers;
  std::vector<double> observed(64);
  for (int i = 0; i < 64000; i += packet_lanes) {
    const FloatN u1 = numbers.batch(), u2 = numbers.batch();
    const EnvironmentSample sample = environment.sample(u1, u2);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3d wi = lane_of(sample.wi, lane);
      const auto cell = [](double x, double cells) { return static_cast<std::size_t>(std::min(x, 0.999999) * cells); };
      ++observed[cell((wi.y + 1) / 2, 8) * 8 + cell(std::atan2(wi.x, wi.z) / (2 * pi) + 0.5, 8)];
    }
    CHECK(sample.pdf.get(0) == Approx(1 / (4 * pi)));
  }
  CHECK(chi_square_deviation(observed) < 4);
}

TEST_CASE("a black picture draws all directions alike") {
  const Environment environment(light_of(made_image(4, 2, [](int, int) { return Rgb<double>{0, 0, 0}; })), 1);
  const EnvironmentSample sample = environment.sample(FloatN(0.3F), FloatN(0.6F));
  CHECK(sample.pdf.get(0) == Approx(1 / (4 * pi)));
  CHECK(sample.radiance.red.get(0) == 0);
}

TEST_CASE("an environment's table does not depend on the threads") {
  const auto image = sunny(64, 32);
  const Environment one(light_of(image), 1), three(light_of(image), 3);
  Numbers numbers;
  for (int i = 0; i < 50; ++i) {
    const FloatN u1 = numbers.batch(), u2 = numbers.batch();
    const EnvironmentSample a = one.sample(u1, u2), b = three.sample(u1, u2);
    CHECK((all(a.wi.x == b.wi.x) && all(a.pdf == b.pdf)));
  }
}

}  // namespace raytrace::test
