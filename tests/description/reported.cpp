#include "reported.h"

#include <sstream>
#include <stdexcept>

namespace raytrace::test {

std::string reported(const std::string& text) {
  Diagnostics diagnostics("s");
  const bool accepted = parse_scene(text, diagnostics).has_value();
  if (accepted == diagnostics.has_errors()) throw std::logic_error("a scene with errors, or none without");
  std::ostringstream out;
  diagnostics.print(out);
  return out.str();
}

SceneDescription accepted(const std::string& text) {
  Diagnostics diagnostics("s");
  auto scene = parse_scene(text, diagnostics);
  if (!scene) throw std::runtime_error(reported(text));
  return *scene;
}

std::string scene_with(std::string_view more) {
  return R"(<raytracer><viewplane><hres>4</hres><vres>3</vres></viewplane><camera><eye x="0" y="0" z="9"/>)"
         R"(<lookat x="0" y="0" z="0"/><viewdistance>4</viewdistance></camera><materials><mattes><matte><name>clay</name>)"
         R"(<ka>0</ka><kd>1</kd><cd red="1" green="1" blue="1"/></matte></mattes><phongs><phong><name>steel</name>)"
         R"(<ka>0</ka><kd>1</kd><ks>1</ks><cd red="1" green="1" blue="1"/><cs red="1" green="1" blue="1"/></phong></phongs>)"
         "</materials>\n" +
         std::string(more) + "\n</raytracer>\n";
}

std::string scene_with_sphere(std::string_view children) {
  const std::string text = scene_with("@");
  const std::size_t at = text.find("\n@");
  return text.substr(0, at) + "<objects><spheres><sphere>\n" + std::string(children) +
         "\n</sphere></spheres></objects></raytracer>\n";
}

}  // namespace raytrace::test
