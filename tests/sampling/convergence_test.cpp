// How fast renders approach the picture as their samples grow, against pictures that are known exactly.
//
// Theory, for a (0,2)-sequence with a random digit shift a pixel: an edge crosses O(sqrt N) of the N boxes that hold a
// point each, so the error falls as N^-3/4 (random samples: N^-1/2); a smooth picture's falls as N^-1.
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "raytrace/render/renderer.h"
#include "support/catch.h"
#include "support/parsed_scene.h"

namespace raytrace::test {

namespace {

constexpr int edge = 64;       // of the picture, in pixels; a pixel is a unit of the plane z = 0
constexpr int largest = 1024;  // samples

std::string scene_text(const std::string& lights_materials_and_objects) {
  return "<raytracer><viewplane><hres>64</hres><vres>64</vres></viewplane>"
         "<camera><eye x='0' y='0' z='100'/><lookat x='0' y='0' z='0'/><viewdistance>100</viewdistance></camera>" +
         lights_materials_and_objects + "</raytracer>";
}

struct Point {
  double x, y;
};

/// The pixel's lower left corner on the plane z = 0.
Point corner_of(int column, int row) { return {column - edge / 2.0, edge / 2.0 - 1 - row}; }

using Picture = std::vector<double>;  // row by row, a number a pixel

template <class Function>
Picture exact_picture(Function value) {
  Picture result;
  for (int row = 0; row < edge; ++row)
    for (int column = 0; column < edge; ++column) result.push_back(value(corner_of(column, row)));
  return result;
}

/// The root of the mean squared error of the pixels for which `judged` holds, by number of samples.
template <class Predicate>
std::map<int, double> errors(const std::string& text, const Picture& exact, Predicate judged,
                             const std::vector<int>& sample_counts) {
  SceneDescription description = parsed_scene(text);
  const auto scene_with = [&](int samples) {
    description.viewplane.samples = samples;
    return build_scene(description, {});
  };
  std::map<int, double> result;
  for (const int samples : sample_counts) {
    const auto scene = scene_with(samples);
    double sum = 0, count = 0;
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      RayCounts rays;
      const std::vector<Pixel> pixels = render(*scene, description, {0, seed, {0, 0, edge, edge}, {}}, rays).pixels();
      for (std::size_t i = 0; i < exact.size(); ++i) {
        if (!judged(exact[i])) continue;
        const double error = static_cast<double>(pixels[i].red) - exact[i];
        sum += error * error;
        ++count;
      }
    }
    result[samples] = std::sqrt(sum / count);
  }
  return result;
}

/// Of log(error) over log(samples), fitted to all powers of two.
double slope(const std::map<int, double>& error) {
  double n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (int samples = 2; samples <= largest; samples *= 2) {
    const double x = std::log(samples), y = std::log(error.at(samples));
    ++n;
    x_sum += x;
    y_sum += y;
    xx_sum += x * x;
    xy_sum += x * y;
  }
  return (n * xy_sum - x_sum * y_sum) / (n * xx_sum - x_sum * x_sum);
}

const std::vector<int> powers_and_others{2,  3,   4,   5,   6,   7,   8,   9,   10,  11,   12,  13,
                                         14, 15,  16,  17,  23,  24,  31,  32,  48,  50,   63,  64,
                                         96, 100, 127, 128, 192, 255, 256, 257, 512, 1000, 1024};

void check_convergence(const std::map<int, double>& error, double wanted_slope, double most_growth) {
  INFO("slope " << slope(error));
  CHECK(slope(error) <= wanted_slope);
  for (const auto& [samples, value] : error) {
    int power = 2;
    while (2 * power <= samples) power *= 2;
    INFO(samples << " samples: error " << value << ", with " << power << ": " << error.at(power));
    CHECK(value <= most_growth * error.at(power));
  }
}

/// The area that a convex polygon, corners counter-clockwise, covers of the unit square at `corner`.
double covered_area(const std::vector<Point>& polygon, Point corner) {
  std::vector<Point> rest{corner, {corner.x + 1, corner.y}, {corner.x + 1, corner.y + 1}, {corner.x, corner.y + 1}};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const auto side = [&](Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
    std::vector<Point> kept;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const Point p = rest[k], q = rest[(k + 1) % rest.size()];
      const double s = side(p), t = side(q);
      if (s >= 0) kept.push_back(p);
      if ((s < 0) != (t < 0)) kept.push_back({p.x + (q.x - p.x) * s / (s - t), p.y + (q.y - p.y) * s / (s - t)});
    }
    rest = kept;
  }
  double doubled = 0;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const Point p = rest[k], q = rest[(k + 1) % rest.size()];
    doubled += p.x * q.y - p.y * q.x;
  }
  return doubled / 2;
}

}  // namespace

TEST_CASE("the error at edges falls at least as fast as samples^-0.7, and no count of samples is a bad one") {
  const std::vector<Point> triangle{{-29.3, -25.1}, {30.2, -11.7}, {-8.6, 28.9}};
  const std::string text = scene_text(
      "<lights><ambientlight/></lights>"
      "<materials><mattes><matte><name>m</name><ka>1</ka><kd>0</kd><cd red='1' green='1' "
      "blue='1'/></matte></mattes></materials>"
      "<objects><triangles><triangle><vertexposition1 x='-29.3' y='-25.1' z='0'/><vertexposition2 x='30.2' y='-11.7' "
      "z='0'/>"
      "<vertexposition3 x='-8.6' y='28.9' z='0'/><material>m</material></triangle></triangles></objects>");
  const Picture exact = exact_picture([&](Point corner) { return covered_area(triangle, corner); });
  const auto crossed = [](double coverage) { return coverage > 0 && coverage < 1; };
  check_convergence(errors(text, exact, crossed, powers_and_others), -0.7, 1.1);
}

TEST_CASE("the error of smooth shading falls at least as fast as samples^-0.95, and no count of samples is a bad one") {
  const std::string text = scene_text(
      "<lights><pointlights><pointlight><location x='1.3' y='-2.4' "
      "z='8'/><scaleradiance>3.14159265358979</scaleradiance>"
      "</pointlight></pointlights></lights>"
      "<materials><mattes><matte><name>m</name><ka>0</ka><kd>1</kd><cd red='1' green='1' "
      "blue='1'/></matte></mattes></materials>"
      "<objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' "
      "z='1'/><material>m</material></plane></planes></objects>");
  // The mean of the light's cosine over a pixel, by Gauss and Legendre's three points in each direction.
  constexpr std::array<double, 3> nodes{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  const Picture exact = exact_picture([&](Point corner) {
    double mean = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double x = corner.x + nodes[i] - 1.3, y = corner.y + nodes[j] + 2.4;
        mean += weights[i] * weights[j] * 8 / std::sqrt(x * x + y * y + 64);
      }
    return mean;
  });
  check_convergence(errors(text, exact, [](double) { return true; }, powers_and_others), -0.95, 1.5);
}

}  // namespace raytrace::test
