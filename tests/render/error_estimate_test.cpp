// The error that a render estimates of itself, beside the one it has.
//
// Not with sanitizers: statistics of code that cuts_test runs.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "raytrace/batch/passes.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// A grey corner, a ball and a lamp.
SceneDescription lit_corner(const std::string& integrator, int samples) {
  return parsed_scene(
      "<raytracer><viewplane><hres>24</hres><vres>24</vres><samples>" + std::to_string(samples) +
      "</samples></viewplane><camera><eye x='0' y='1' z='4'/><lookat x='0' y='-0.2' z='0'/><fov>60</fov></camera>"
      "<integrator>" +
      integrator +
      "</integrator><materials><mattes><matte><name>grey</name><ka>0</ka><kd>0.6</kd>"
      "<cd red='1' green='0.8' blue='0.6'/></matte></mattes><emissives><emissive><name>lamp</name>"
      "<ce red='2' green='2' blue='2'/></emissive></emissives></materials><objects><planes><plane>"
      "<point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/><material>grey</material></plane><plane>"
      "<point x='0' y='0' z='-1.5'/><normal x='0' y='0' z='1'/><material>grey</material></plane></planes><spheres>"
      "<sphere><center x='0' y='-0.4' z='0'/><radius>0.6</radius><material>grey</material></sphere><sphere>"
      "<center x='1' y='1.2' z='0.5'/><radius>0.3</radius><material>lamp</material></sphere></spheres></objects>"
      "</raytracer>");
}

/// The root of the mean over pixels of variance / (mean^2 + 0.01), over renders with so many seeds; and of the renders'
/// own estimates.
struct Errors {
  double true_error = 0, estimated = 0;
};

Errors errors_of(const SceneDescription& description, int seeds) {
  const auto scene = build_scene(description, {2, {}});
  std::vector<double> sums, squares;
  double variance = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    RenderSettings settings;
    settings.seed = static_cast<std::uint64_t>(seed);
    Film film(film_settings(*scene, description, settings));
    variance += render(*scene, film, film.settings().samples.count, 2).error.relative_variance() / seeds;
    const std::vector<Pixel> pixels = film.pixels();
    sums.resize(pixels.size());
    squares.resize(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double value = (double{pixels[i].red} + double{pixels[i].green} + double{pixels[i].blue}) / 3;
      sums[i] += value;
      squares[i] += value * value;
    }
  }
  double terms = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mean = sums[i] / seeds;
    terms += (squares[i] - seeds * mean * mean) / (seeds - 1) / (mean * mean + 0.01);
  }
  return {std::sqrt(terms / static_cast<double>(sums.size())), std::sqrt(variance)};
}

}  // namespace

TEST_CASE("a render estimates its error within a third of the one that other seeds show") {
  for (const std::string& integrator : std::vector<std::string>{
           "<path><maxdepth>4</maxdepth></path>", "<ambientocclusion><distance>4</distance></ambientocclusion>"})
    for (const int samples : {4, 7, 16, 64}) {
      const Errors errors = errors_of(lit_corner(integrator, samples), 24);
      INFO(integrator << ", " << samples << " samples: " << errors.estimated << ", truly " << errors.true_error);
      CHECK(errors.true_error > 0.005);
      CHECK(errors.estimated > errors.true_error / 1.33);
      CHECK(errors.estimated < errors.true_error * 1.33);
    }
}

TEST_CASE("the estimated error does not depend on threads, and is not of one sample") {
  const SceneDescription description = lit_corner("<path/>", 16);
  std::vector<double> variances;
  for (const int threads : {1, 2, 7}) {
    const auto scene = build_scene(description, {threads, {}});
    Film film(film_settings(*scene, description, {}));
    variances.push_back(render(*scene, film, 1, threads).error.relative_variance());
    CHECK(variances.back() == 0);
    variances.back() = render(*scene, film, 16, threads).error.relative_variance();
  }
  CHECK(variances[0] > 0);
  CHECK(variances[1] == variances[0]);
  CHECK(variances[2] == variances[0]);
}

TEST_CASE("ray casting estimates no error") {
  const SceneDescription description = lit_corner("<raycast/>", 16);
  const auto scene = build_scene(description, {2, {}});
  Film film(film_settings(*scene, description, {}));
  CHECK(render(*scene, film, 16, 2).error.empty());
}

TEST_CASE("well distributed samples have less error than halves of them differ by") {
  ErrorEstimate estimate;
  estimate.add(std::sqrt(0.99), 0.02, 0.08);  // each doubling quarters the variance
  CHECK(std::abs(estimate.relative_variance() - 0.01) < 1e-6);
  ErrorEstimate lucky;
  lucky.add(std::sqrt(0.99), 0.02, 0.02);  // never more than of independent ones
  CHECK(std::abs(lucky.relative_variance() - 0.02) < 1e-6);
}

TEST_CASE("passes put the error of their picture together from their own") {
  ErrorOfPasses errors;
  CHECK(!errors.estimate());
  ErrorEstimate bright;  // a variance of 0.04 of a mean square that is 1
  bright.add(std::sqrt(0.99), 0.04, 0.08);
  CHECK(std::abs(*errors.estimate(bright) - 0.2) < 1e-6);
  errors.add(bright);
  errors.end_pass(4);
  errors.add(bright);
  CHECK(std::abs(*errors.estimate() - 0.2) < 1e-6);  // of the first one alone
  errors.end_pass(4);
  CHECK(std::abs(*errors.estimate() - 0.2 / std::sqrt(2.0)) < 1e-6);
  // Twice the samples, so half the variance.
  ErrorEstimate more;
  more.add(std::sqrt(0.99), 0.02, 0.04);
  errors.add(more);
  errors.end_pass(8);
  CHECK(std::abs(*errors.estimate() - 0.1) < 1e-6);
}

TEST_CASE("passes that fit into the time that is left are whole, and the last is as large as fits") {
  CHECK(samples_in_time(32, 100, 1) == 32);
  CHECK(samples_in_time(32, 31.9, 1) == 28);
  CHECK(samples_in_time(8, 4.5, 1) == 4);
  CHECK(samples_in_time(8, 3.9, 1) == 2);  // of fewer than 4, each costs half as much again
  CHECK(samples_in_time(8, 1.4, 1) == 0);
  CHECK(samples_in_time(3, 3.1, 1) == 3);
  CHECK(samples_in_time(8, -1, 1) == 0);
  CHECK(samples_in_time(8, 1, 0) == 4);  // what a sample costs is not known yet
  CHECK(samples_in_time(8, 0, 0) == 0);
}

}  // namespace raytrace::test
