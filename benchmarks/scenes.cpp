#include "scenes.h"

#include <cmath>
#include <random>

namespace raytrace::benchmark {

namespace {

constexpr std::uint32_t materials = 8;  ///< of each kind

/// The standard's distributions may give other numbers with another library; its generator may not.
class Random {
 public:
  /// In [0, 1).
  double operator()() { return static_cast<double>(generator_()) / 4294967296.0; }

  Vec3d place() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {16 * x - 8, 10 * y - 3, 16 * z - 8};
  }
  Vec3d direction() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return normalize(Vec3d{x - 0.5, y - 0.5, z - 0.5});
  }
  MaterialReference material() {
    const auto kind = static_cast<std::uint32_t>(generator_() % 2);
    return {kind, static_cast<std::uint32_t>(generator_() % materials)};
  }
  Rgb<double> color() {
    const double red = (*this)(), green = (*this)(), blue = (*this)();
    return {red, green, blue};
  }

 private:
  std::mt19937 generator_{1};
};

template <class Shape>
void add(SceneDescription& scene, const typename Shape::Parameters& parameters, MaterialReference material) {
  std::get<ObjectItems<Shape>>(scene.objects).push_back({parameters, "", material});
}

/// All but the objects above the plane.
SceneDescription empty_scene(const char* name, int resolution, int samples, Random& random) {
  SceneDescription scene;
  scene.file = name;
  scene.viewplane.hres = scene.viewplane.vres = resolution;
  scene.viewplane.pixelsize = 1024.0 / resolution;
  scene.viewplane.samples = samples;
  scene.camera = PinholeCamera::Parameters{{0, 8, 30}, {0, 0, 0}, {0, 1, 0}, 1500};
  std::get<LightItems<AmbientLight>>(scene.lights).push_back({});
  PointLight::Parameters light;
  light.location = {20, 40, 30};
  light.scaleradiance = 3;
  std::get<LightItems<PointLight>>(scene.lights).push_back({light});
  for (std::uint32_t i = 0; i < materials; ++i) {
    const std::string number = std::to_string(i);
    std::get<MaterialItems<Matte>>(scene.materials).push_back({{0.2, 0.7, random.color()}, "matte " + number});
    std::get<MaterialItems<Phong>>(scene.materials)
        .push_back({{0.2, 0.5, 0.3, random.color(), {1, 1, 1}, 40}, "phong " + number});
  }
  add<Plane>(scene, {{0, -4, 0}, {0, 1, 0}}, {});
  return scene;
}

/// How far an object reaches, at most.
double object_size(int count) { return 4 / std::cbrt(count); }

}  // namespace

SceneDescription random_spheres(int count, int resolution, int samples) {
  Random random;
  SceneDescription scene = empty_scene("random spheres", resolution, samples, random);
  for (int i = 0; i < count; ++i) {
    const Vec3d center = random.place();
    const double radius = object_size(count) * (0.3 + 0.7 * random());
    add<Sphere>(scene, {center, radius}, random.material());
  }
  return scene;
}

SceneDescription random_mix(int count, int resolution, int samples) {
  Random random;
  SceneDescription scene = empty_scene("random objects", resolution, samples, random);
  for (int i = 0; i < count - 1; ++i) {
    const Vec3d center = random.place();
    const double size = object_size(count) * (0.3 + 0.7 * random());
    const Vec3d axis = random.direction();
    const MaterialReference material = random.material();
    switch (i % 4) {
      case 0:
        add<Sphere>(scene, {center, size}, material);
        break;
      case 1: {
        const Vec3d second = random.direction(), third = random.direction();
        add<Triangle>(scene, {center + size * axis, center + size * second, center + size * third}, material);
        break;
      }
      case 2:
        add<Cylinder>(scene, {center - 0.8 * size * axis, center + 0.8 * size * axis, 0.5 * size}, material);
        break;
      default:
        add<Torus>(scene, {center, axis, 0.7 * size, 0.3 * size}, material);
    }
  }
  return scene;
}

}  // namespace raytrace::benchmark
