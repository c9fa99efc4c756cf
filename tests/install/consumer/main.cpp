// example PICTURE: a red sphere on a floor, made, rendered and written by the library.
#include <exception>
#include <iostream>

#include "raytrace/raytrace.h"

namespace {

using namespace raytrace;

SceneDescription sphere_on_floor() {
  SceneDescription scene;
  scene.viewplane.hres = 320;
  scene.viewplane.vres = 200;
  scene.viewplane.samples = 16;
  scene.viewplane.background = {0.02, 0.03, 0.06};

  PinholeCamera::Parameters camera;
  camera.eye = {0, 2, 8};
  camera.lookat = {0, 0.8, 0};
  camera.viewdistance = 500;
  scene.camera = camera;

  PointLight::Parameters lamp;
  lamp.location = {-4, 6, 5};
  lamp.scaleradiance = 3;
  std::get<LightItems<PointLight>>(scene.lights).push_back({lamp});

  // A material by its kind and its index among those of its kind.
  auto& mattes = std::get<MaterialItems<Matte>>(scene.materials);
  mattes.push_back({{0.1, 0.8, {0.3, 0.5, 0.6}}, "floor"});
  mattes.push_back({{0.1, 0.8, {0.9, 0.1, 0.1}}, "red"});
  constexpr auto matte = static_cast<std::uint32_t>(index_of<Matte>(Materials{}));
  const MaterialReference floor{matte, 0}, red{matte, 1};

  std::get<ObjectItems<Plane>>(scene.objects).push_back({{{0, 0, 0}, {0, 1, 0}}, "", floor});
  std::get<ObjectItems<Sphere>>(scene.objects).push_back({{{0, 1, 0}, 1}, "ball", red});
  return scene;
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  try {
    const SceneDescription description = sphere_on_floor();
    const auto scene = build_scene(description, {});  // throws SceneError, with all that is wrong with it
    RayCounts rays;
    const Film film = render(*scene, description, {}, rays);
    ImageMetadata metadata;
    metadata.samples = description.viewplane.samples;
    metadata.camera = camera_matrices(description);
    write_image(arguments[1], film, metadata, {});
    std::cout << rays.camera + rays.shadow << " rays\n";
  } catch (const std::exception& error) {
    std::cerr << "example: " << error.what() << '\n';
    return 1;
  }
}
