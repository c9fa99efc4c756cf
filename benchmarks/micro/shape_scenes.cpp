#include "shape_scenes.h"

namespace raytrace::benchmark {

namespace {

template <class Shape>
ShapeScene scene_of(const typename Shape::Parameters& parameters) {
  ShapeScene scene{std::string(Shape::element), {}};
  std::get<ObjectItems<Shape>>(scene.description.objects).push_back({parameters, "", {}});
  return scene;
}

}  // namespace

std::vector<ShapeScene> shape_scenes() {
  return {
      scene_of<Sphere>({{0, 0, 0}, 1}),
      scene_of<Triangle>({{-1.2, -1, 0.2}, {1.2, -0.9, -0.3}, {0.1, 1.3, 0.1}}),
      scene_of<Cylinder>({{-0.6, -0.8, 0.3}, {0.6, 0.8, -0.3}, 0.6}),
      scene_of<Torus>({{0, 0, 0}, {0.3, 1, 0.8}, 0.8, 0.35}),
      scene_of<Disk>({{0, 0, 0}, {0.3, 0.4, 1}, 1.1}),
  };
}

}  // namespace raytrace::benchmark
