// Scenes with fog, and what the tests ask of their pictures.
#pragma once

#include <string>

#include "render/scenes.h"

namespace raytrace::test {

inline constexpr double mean_free_path = 2;

/// What is in the scene besides the camera at (0, 0, 5), which looks along -z through a pixel as good as none wide.
struct Fogged {
  std::string lights;
  std::string objects;
  std::string box = "<box><min x='-50' y='-50' z='-3'/><max x='50' y='50' z='2'/><material>fog</material></box>";
  std::string fog = "<color red='1' green='0.5' blue='0'/>";
  std::string path = "<maxdepth>1</maxdepth>";
  std::string materials;
  int samples = 256;
  std::string eye = "<eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/><fov>0.01</fov>";
  std::string free_path = std::to_string(mean_free_path);
  std::string background = "";
};

inline std::string text_of(const Fogged& scene) {
  return "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>" + std::to_string(scene.samples) +
         "</samples>" + scene.background + "</viewplane><camera>" + scene.eye + "</camera><integrator><path>" +
         scene.path + "</path></integrator><lights>" + scene.lights +
         "</lights><materials><mattes><matte><name>black</name><ka>0</ka><kd>0</kd><cd red='0' green='0' blue='0'/>"
         "</matte><matte><name>grey</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte></mattes>"
         "<emissives><emissive><name>lamp</name><ce red='3' green='3' blue='3'/></emissive></emissives>"
         "<fogs><fog><name>fog</name><meanfreepath>" +
         scene.free_path + "</meanfreepath>" + scene.fog + "</fog></fogs>" + scene.materials + "</materials><objects>" +
         scene.objects + "<boxes>" + scene.box + "</boxes></objects></raytracer>";
}

struct Mean {
  double red = 0, green = 0, blue = 0, alpha = 0;
};

inline Mean mean_of(const FloatPicture& picture) {
  Mean mean;
  const auto count = static_cast<double>(picture.pixels().size());
  for (const Pixel& pixel : picture.pixels()) {
    mean.red += double{pixel.red} / count;
    mean.green += double{pixel.green} / count;
    mean.blue += double{pixel.blue} / count;
    mean.alpha += double{pixel.alpha} / count;
  }
  return mean;
}
inline Mean mean_of(const Fogged& scene, const std::string& isa = {}) {
  return mean_of(rendered(parsed_scene(text_of(scene)), 2, isa));
}

}  // namespace raytrace::test
