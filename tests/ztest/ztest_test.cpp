// Path-traced pictures against Mitsuba's of the same scenes.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/sanitized.h"
#include "z_test.h"

namespace raytrace::test {

namespace {

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(std::string(RAYTRACE_SOURCE_DIR) + "/tests/ztest/scenes"))
    if (file.path().extension() == ".xml") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

int render_count() { return std::getenv("RAYTRACE_LONG_TESTS") != nullptr && !is_sanitized ? 128 : 24; }

}  // namespace

TEST_CASE("pictures have the expectation of Mitsuba's, and with 2 % more light they have not") {
  const std::vector<std::string> names = scenes();
  CHECK(names.size() >= 20);
  for (const std::string& name : names) {
    const MomentPicture reference = mitsubas_picture(name);
    Renders renders(described_scene(name), render_count());
    const Judgement same = z_test(reference, renders);
    INFO(name << ".xml\n" << same.report);
    CHECK(same.equal);
    renders.scale(1.02);
    const Judgement brighter = z_test(reference, renders);
    INFO("2 % brighter:\n" << brighter.report);
    CHECK_FALSE(brighter.equal);
  }
}

TEST_CASE("scenes that are a little different have another expectation") {
  struct Change {
    std::string scene;
    Edit edit;
  };
  const std::vector<Change> changes{
      {"light-sphere", {"<radius>0.5</radius>", "<radius>0.506</radius>"}},
      {"light-many", {"<scaleradiance>40</scaleradiance>", "<scaleradiance>44</scaleradiance>"}},
      {"sun", {"<angle>10</angle>", "<angle>20</angle>"}},
      {"spot", {"<coneangle>70</coneangle>", "<coneangle>71</coneangle>"}},
      {"glass", {"<ior>1.5</ior>", "<ior>1.55</ior>"}},
      {"glass-thin", {"<thinwalled>true</thinwalled>", ""}},
      {"glass-rough", {"<roughness>0.17</roughness>", "<roughness>0.25</roughness>"}},
      {"glass-milky", {"_anisotropy>0.6<", "_anisotropy>0.5<"}},
      {"fog-balls", {"<anisotropy>0.7</anisotropy>", "<anisotropy>0.6</anisotropy>"}},
      {"fog-lights", {"<meanfreepath>1</meanfreepath>", "<meanfreepath>1.1</meanfreepath>"}},
      {"metal-brushed", {"<anisotropy>0.7</anisotropy>", "<anisotropy>0.65</anisotropy>"}},
      {"metal-edges", {"<edgecolor red=\"1\" green=\"1\" blue=\"1\"/>", ""}},
      {"lens", {"<lensradius>0.25</lensradius>", "<lensradius>0.4</lensradius>"}},
      {"light-rectangle", {"<maxdepth>6</maxdepth>", "<maxdepth>5</maxdepth>"}},
      {"mesh-smooth", {"<maxdepth>3</maxdepth>", "<maxdepth>2</maxdepth>"}}};
  for (const Change& change : changes) {
    const Judgement other =
        z_test(mitsubas_picture(change.scene), Renders(described_scene(change.scene, change.edit), render_count()));
    INFO(change.scene << ".xml with " << change.edit.to << " for " << change.edit.from << "\n" << other.report);
    CHECK_FALSE(other.equal);
  }
}

TEST_CASE("Student's t is turned into the normal deviate that is as rare") {
  // Two-sided 1 % of 4, 15 and 31 degrees of freedom, and 0.001 % of 31.
  CHECK(std::abs(normal_deviate(4.604, 4) - 2.576) < 0.02);
  CHECK(std::abs(normal_deviate(2.947, 15) - 2.576) < 0.01);
  CHECK(std::abs(normal_deviate(-2.744, 31) + 2.576) < 0.005);
  CHECK(std::abs(normal_deviate(5.26, 31) - 4.417) < 0.03);
}

}  // namespace raytrace::test
