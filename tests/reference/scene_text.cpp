#include <cstdio>

#include "scene.h"

namespace reference {

namespace {

std::string number(Real value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value));
  return text;
}

std::string triple(const std::string& name, Vector v, const char* x, const char* y, const char* z) {
  return "<" + name + " " + x + "=\"" + number(v.x) + "\" " + y + "=\"" + number(v.y) + "\" " + z + "=\"" +
         number(v.z) + "\"/>";
}

std::string light_text(const Light& light) {
  const bool point = light.kind == Light::Kind::point;
  const std::string name = point ? "pointlight" : "directionallight";
  return "<" + name + "s><" + name + ">" + vector_element(point ? "location" : "direction", light.place) +
         number_element("scaleradiance", light.scale) + color_element("color", light.color) + "<shadows>" +
         (light.shadows ? "true" : "false") + "</shadows></" + name + "></" + name + "s>\n";
}

std::string material_text(const Material& material) {
  std::string text = "<name>" + material.name + "</name>" + number_element("ka", material.ka) +
                     number_element("kd", material.kd) + color_element("cd", material.cd);
  if (!material.phong) return "<mattes><matte>" + text + "</matte></mattes>\n";
  text +=
      number_element("ks", material.ks) + color_element("cs", material.cs) + number_element("exp", material.exponent);
  return "<phongs><phong>" + text + "</phong></phongs>\n";
}

std::string object_text(const Shape& shape, const std::string& material, bool visible = true) {
  return "<" + shape.group() + "><" + shape.element() + ">" + shape.parameters() + "<material>" + material +
         "</material>" + (visible ? "" : "<visible>false</visible>") + "</" + shape.element() + "></" + shape.group() +
         ">";
}

std::string camera_text(const Scene& scene) {
  using Projection = Scene::Projection;
  std::string text = scene.shutter + (scene.eye_keys.empty() ? vector_element("eye", scene.eye) : scene.eye_keys) +
                     vector_element("lookat", scene.look_at) + vector_element("up", scene.up);
  if (scene.projection == Projection::pinhole || scene.projection == Projection::thin_lens)
    text += number_element("viewdistance", scene.view_distance) + number_element("nearclip", scene.near_clip);
  const char* name = "camera";
  if (scene.projection == Projection::thin_lens) {
    name = "thinlenscamera";
    text += number_element("lensradius", scene.lens_radius) + number_element("focaldistance", scene.focal_distance) +
            "<blades>" + std::to_string(scene.blades) + "</blades>" +
            number_element("bladerotation", scene.blade_rotation);
  } else if (scene.projection == Projection::fisheye) {
    name = "fisheyecamera";
    text += number_element("angle", scene.angle);
  } else if (scene.projection == Projection::spherical) {
    name = "sphericalcamera";
  }
  return std::string("<") + name + ">" + text + "</" + name + ">";
}

}  // namespace

std::string vector_element(const std::string& name, Vector v) { return triple(name, v, "x", "y", "z"); }
std::string color_element(const std::string& name, Vector rgb) { return triple(name, rgb, "red", "green", "blue"); }
std::string number_element(const std::string& name, Real value) {
  return "<" + name + ">" + number(value) + "</" + name + ">";
}

std::string scene_text(const Scene& scene) {
  std::string text = "<raytracer>\n<viewplane>";
  text += "<hres>" + std::to_string(scene.hres) + "</hres><vres>" + std::to_string(scene.vres) + "</vres>";
  text += number_element("pixelsize", scene.pixel_size) + "<samples>" + std::to_string(scene.samples) + "</samples>";
  text += color_element("background", scene.background) + "</viewplane>\n" + camera_text(scene) + "\n<lights>\n";
  if (scene.has_ambient) {
    text += "<ambientlight>" + number_element("scaleradiance", scene.ambient_scale) +
            color_element("color", scene.ambient_color) + "</ambientlight>\n";
  }
  for (const Light& light : scene.lights) text += light_text(light);
  text += "</lights>\n<materials>\n";
  for (const Material& material : scene.materials) text += material_text(material);
  text += "</materials>\n<objects>\n";
  for (const Object& object : scene.objects)
    text += object_text(*object.shape, scene.materials[object.material].name, object.visible) + "\n";
  text += "</objects>\n<groups>\n";
  for (const Group& group : scene.groups)
    text += "<group><name>" + group.name + "</name><objects>" +
            object_text(*group.shape, scene.materials.front().name) + "</objects></group>\n";
  return text + "</groups>\n</raytracer>\n";
}

}  // namespace reference
