// AOVs against the reference: random scenes, one sample a pixel.
#include <algorithm>
#include <cmath>
#include <map>

#include "pictures/comparison.h"
#include "raytrace/aovs/aov_selection.h"
#include "raytrace/aovs/aov_table.h"
#include "reference/renderer.h"
#include "reference/scene.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using reference::Real;
using reference::Vector;

/// A picture's AOVs by channel.
class Aovs {
 public:
  Aovs(const SceneDescription& description, const std::string& isa) {
    RenderSettings settings;
    settings.threads = 1;
    settings.region = {0, 0, description.viewplane.hres, description.viewplane.vres};
    settings.aovs = aov_set(aov_names());
    RayCounts rays;
    band_.region = settings.region;
    fill_aovs(band_, 0, render(*build_scene(description, {1, isa}), description, settings, rays));
    for (const Channel& channel : aov_channels(settings.aovs)) names_.push_back(channel.name);
  }

  template <class Value = float>
  Value at(const std::string& name, int x, int y) const {
    const auto plane = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
    return std::get<std::vector<Value>>(
        band_.planes.at(plane))[static_cast<std::size_t>(y) * static_cast<std::size_t>(band_.region.width()) +
                                static_cast<std::size_t>(x)];
  }
  Vector vector_at(const std::string& layer, const std::string& components, int x, int y) const {
    const auto component = [&](std::size_t i) { return Real(at(layer + "." + components[i], x, y)); };
    return {component(0), component(1), component(2)};
  }

 private:
  ImageBand band_;
  std::vector<std::string> names_;
};

/// What the reference's objects are called as unnamed objects of the library.
std::vector<std::string> names_of(const reference::Scene& scene) {
  std::map<std::string, int> places;
  std::vector<std::string> names;
  for (const reference::Object& object : scene.objects)
    names.push_back(object.shape->element() + "#" + std::to_string(++places[object.shape->element()]));
  return names;
}

/// Whether all AOVs of the pixel are those of the reference's hit; `scale`: of the scene's coordinates.
bool agrees(const Aovs& got, const reference::Scene& scene, const SceneDescription& description, int x, int y) {
  const reference::Ray ray = reference::camera_ray(scene, x, scene.vres - 1 - y, 0.5L, 0.5L);
  const auto hit = reference::nearest_hit(scene, ray);
  const auto id = got.at<std::uint32_t>("id.object", x, y);
  if (!hit || !reference::has_ray(scene, x, scene.vres - 1 - y, 0.5L, 0.5L))
    return id == 0 && got.at("Z", x, y) == 1e30F;
  const reference::Object& object = scene.objects[hit->object];
  const reference::Material& material = scene.materials[object.material];
  if (id == 0 || object_names(description).at(id - 1) != names_of(scene)[hit->object]) return false;
  const auto material_id = got.at<std::uint32_t>("id.material", x, y);
  if (material_id == 0 || material_names(description).at(material_id - 1) != material.name) return false;

  constexpr Real tolerance = 1e-4L;
  const Vector point = ray.at(hit->distance);
  const Vector view = unit(scene.look_at - scene.eye);
  const Real distance = length(point - scene.eye);
  using Projection = reference::Scene::Projection;
  const bool has_view_plane = scene.projection == Projection::pinhole || scene.projection == Projection::thin_lens;
  const Real depth = has_view_plane ? dot(point - scene.eye, view) : distance;
  if (std::fabs(Real(got.at("Z", x, y)) - depth) > tolerance * distance) return false;
  if (length(got.vector_at("P", "XYZ", x, y) - point) > tolerance * distance) return false;
  Vector normal = object.shape->normal(point);
  if (dot(normal, ray.direction) > 0) normal = -normal;
  if (length(got.vector_at("N", "XYZ", x, y) - normal) > 1e-3L) return false;
  return length(got.vector_at("albedo", "RGB", x, y) - material.kd * material.cd) < 1e-6L;
}

template <class ChangeScene>
void check_aovs(unsigned first, unsigned last, const ChangeScene& change_scene) {
  for (unsigned seed = first; seed < last; ++seed) {
    reference::Scene scene = reference::random_scene(seed);
    change_scene(scene, seed);
    const SceneDescription description = parsed_scene(reference::scene_text(scene));
    for (const std::string& isa : usable_isas()) {
      const Aovs got(description, isa);
      int wrong = 0, last_x = 0, last_y = 0;
      for (int y = 0; y < scene.vres; ++y)
        for (int x = 0; x < scene.hres; ++x)
          if (!agrees(got, scene, description, x, y)) {
            ++wrong;
            last_x = x;
            last_y = y;
          }
      INFO("random scene " << seed << ", " << isa << ": the last of " << wrong << " pixels: " << last_x << ","
                           << last_y);
      CHECK(wrong <= 0.002 * scene.hres * scene.vres);  // silhouettes may fall to either side
    }
  }
}

void check_aovs(unsigned first, unsigned last) {
  check_aovs(first, last, [](reference::Scene&, unsigned) {});
}

}  // namespace

TEST_CASE("AOVs of random scenes 0 to 5 equal the reference's") { check_aovs(0, 6); }
TEST_CASE("AOVs of random scenes 6 to 11 equal the reference's") { check_aovs(6, 12); }
TEST_CASE("AOVs of random scenes through other cameras equal the reference's") { check_aovs(0, 6, change_camera); }

}  // namespace raytrace::test
