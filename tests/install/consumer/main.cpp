// consumer SCENE.xml PICTURE: renders with the installed library.
#include <iostream>

#include "raytrace/description/scene_description.h"
#include "raytrace/output/image_file.h"
#include "raytrace/render/renderer.h"

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return 2;
  raytrace::Diagnostics diagnostics(arguments[1]);
  const auto description = raytrace::load_scene(arguments[1], diagnostics);
  diagnostics.print(std::cerr);
  if (!description) return 1;

  const auto scene = raytrace::build_scene(*description, {});
  raytrace::RenderSettings settings;
  settings.region = {0, 0, description->viewplane.hres, description->viewplane.vres};
  raytrace::RayCounts rays;
  const raytrace::Film film = raytrace::render(*scene, *description, settings, rays);
  raytrace::write_image(arguments[2], film, {}, {});
}
