// Several paths that go on from a camera ray's first point: <indirectsamples>.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "raytrace/sampling/ray_ids.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

std::string with_path(std::string text, const std::string& settings) {
  const std::string root = "<raytracer>";
  return text.insert(text.find(root) + root.size(), "<integrator><path>" + settings + "</path></integrator>");
}

/// The inside of a sphere that reflects half of what a light in its middle sends.
std::string lit_sphere(int maxdepth, int branches) {
  return with_path(
      "<raytracer><viewplane><hres>8</hres><vres>8</vres><samples>4</samples></viewplane>"
      "<camera><eye x='0' y='0.2' z='0.5'/><lookat x='0.1' y='0' z='0'/><fov>50</fov></camera>"
      "<lights><pointlights><pointlight><location x='0' y='0' z='0'/><scaleradiance>3.14159265358979</scaleradiance>"
      "<color red='1' green='1' blue='1'/><falloff>inversesquare</falloff></pointlight></pointlights></lights>"
      "<materials><mattes><matte><name>m</name><ka>0</ka><kd>0.5</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
      "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material>"
      "</sphere></spheres></objects></raytracer>",
      "<maxdepth>" + std::to_string(maxdepth) + "</maxdepth><roulettedepth>9</roulettedepth><indirectsamples>" +
          std::to_string(branches) + "</indirectsamples>");
}

/// A matte room, without a front, and the lamp in its ceiling. more: settings of the paths.
std::string room(int samples, const std::string& more) {
  const auto wall = [](const std::string& corner, const std::string& edge1, const std::string& edge2,
                       const std::string& material) {
    return "<rectangle><corner " + corner + "/><edge1 " + edge1 + "/><edge2 " + edge2 + "/><material>" + material +
           "</material></rectangle>";
  };
  return with_path(
      "<raytracer><viewplane><hres>24</hres><vres>24</vres><samples>" + std::to_string(samples) +
          "</samples></viewplane><camera><eye x='0' y='0' z='3.9'/><lookat x='0' y='0' z='0'/><fov>39</fov></camera>"
          "<lights></lights><materials><mattes><matte><name>white</name><ka>0</ka><kd>0.7</kd>"
          "<cd red='1' green='1' blue='1'/></matte><matte><name>red</name><ka>0</ka><kd>0.6</kd>"
          "<cd red='1' green='0.1' blue='0.1'/></matte></mattes><emissives><emissive><name>lamp</name>"
          "<ce red='17' green='12' blue='4'/><group>lamps</group></emissive></emissives></materials>"
          "<objects><rectangles>" +
          wall("x='-1' y='-1' z='1'", "x='2' y='0' z='0'", "x='0' y='0' z='-2'", "white") +
          wall("x='-1' y='1' z='-1'", "x='2' y='0' z='0'", "x='0' y='0' z='2'", "white") +
          wall("x='-1' y='-1' z='-1'", "x='2' y='0' z='0'", "x='0' y='2' z='0'", "white") +
          wall("x='-1' y='-1' z='1'", "x='0' y='0' z='-2'", "x='0' y='2' z='0'", "red") +
          wall("x='1' y='-1' z='-1'", "x='0' y='0' z='2'", "x='0' y='2' z='0'", "white") +
          wall("x='-0.25' y='0.99' z='-0.25'", "x='0.5' y='0' z='0'", "x='0' y='0' z='0.5'", "lamp") +
          "</rectangles><spheres><sphere><center x='0' y='-0.6' z='0'/><radius>0.4</radius><material>red</material>"
          "</sphere></spheres></objects></raytracer>",
      "<maxdepth>6</maxdepth>" + more);
}

std::string branches(int number) { return "<indirectsamples>" + std::to_string(number) + "</indirectsamples>"; }

struct Statistics {
  double mean = 0, variance = 0;  ///< of all channels; the latter of a picture's, between pictures
};

/// Of pictures of nothing but wall, so that no edges are in them.
Statistics statistics(int samples, int number, int pictures) {
  std::string text = room(samples, branches(number));
  const std::string camera = "y='0' z='3.9'/><lookat x='0' y='0' z='0'/><fov>39";
  text.replace(text.find(camera), camera.size(), "y='0.35' z='3.9'/><lookat x='0' y='0.35' z='0'/><fov>10");
  const SceneDescription description = parsed_scene(text);
  std::vector<double> sum, squares;
  for (int i = 0; i < pictures; ++i) {
    const FloatPicture picture = rendered(description, 1, {}, static_cast<std::uint64_t>(i));
    sum.resize(picture.pixels().size());
    squares.resize(picture.pixels().size());
    for (std::size_t pixel = 0; pixel < sum.size(); ++pixel) {
      const double value = double{picture.pixels()[pixel].red};
      sum[pixel] += value;
      squares[pixel] += value * value;
    }
  }
  Statistics result;
  for (std::size_t pixel = 0; pixel < sum.size(); ++pixel) {
    const double mean = sum[pixel] / pictures, share = 1 / static_cast<double>(sum.size());
    result.mean += mean * share;
    result.variance += (squares[pixel] / pictures - mean * mean) * pictures / (pictures - 1) * share;
  }
  return result;
}

}  // namespace

TEST_CASE("branches bring what each scattering adds, once") {
  double wanted = 0;
  for (int depth = 1; depth <= 3; ++depth) {
    wanted += std::pow(0.5, depth);
    const FloatPicture picture = rendered(lit_sphere(depth, GENERATE(2, 5, 16)));
    double worst = 0;
    for (const Pixel& pixel : picture.pixels()) worst = std::max(worst, std::abs(double{pixel.red} - wanted));
    CHECK(worst < 1e-4);
  }
}

TEST_CASE("one branch is what there is without the element, to the last bit") {
  CHECK(identical(rendered(room(4, "")), rendered(room(4, branches(1)))));
}

TEST_CASE("a branch has numbers of its own, and the time of its sample") {
  const UintN pixel(7U), sample = lane_numbers<UintN>() * UintN(1001U);
  for (const std::uint32_t number : {2U, 5U, 16U}) {
    UintN last(~0U);
    for (std::uint32_t branch = 0; branch < number; ++branch) {
      const UintN of_branch = sample_of_branch(sample, branch, number);
      CHECK(all(sample_of_pixel(of_branch) == sample));
      CHECK(all(RayIds{pixel, of_branch, 0}.times() == RayIds{pixel, sample, 0}.times()));
      CHECK(none(float_mask<FloatN>((of_branch == last) | (of_branch == sample))));
      last = of_branch;
    }
  }
  CHECK(all(sample_of_pixel(sample) == sample));
}

TEST_CASE("four branches have the mean of one, and less than half of its variance") {
  const Statistics one = statistics(16, 1, 12), four = statistics(16, 4, 12);
  INFO(one.mean << ' ' << four.mean << ' ' << one.variance << ' ' << four.variance);
  CHECK(std::abs(four.mean / one.mean - 1) < 0.004);
  CHECK(four.variance < 0.5 * one.variance);
  // As stratified as four samples: no more than theirs, but for what is seen and lit directly.
  CHECK(four.variance < 1.5 * statistics(64, 1, 12).variance);
}

TEST_CASE("the bits of branches do not depend on how the work is cut") {
  const std::string more = GENERATE("", "<clampindirect>0.2</clampindirect>", "<caustics>light</caustics>");
  SECTION("in a room") { check_same_bits(parsed_scene(room(8, branches(3) + more))); }
  SECTION("among a thousand spheres, many of which rays pass") {
    std::string text = with_path(busy_scene(41, 37, 8), "<maxdepth>4</maxdepth>" + branches(2) + more);
    text.insert(text.find("</matte>"), "<opacity>0.6</opacity>");
    check_same_bits(parsed_scene(text));
  }
}

}  // namespace raytrace::test
