// example FRAMES WHOLE, such as: example ball.####.exr whole.jpg
// Makes a scene, renders it frame by frame, and then one picture in two parts, which it merges.
#include <csignal>
#include <exception>
#include <iostream>
#include <string>

#include "raytrace/raytrace.h"

namespace {

using namespace raytrace;

/// A red ball that falls to the floor.
SceneDescription ball_at(double height) {
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

  // A material by its type and its index among those of its type.
  auto& mattes = std::get<MaterialItems<Matte>>(scene.materials);
  mattes.push_back({{0.1, 0.8, {0.3, 0.5, 0.6}}, "floor"});
  mattes.push_back({{0.1, 0.8, {0.9, 0.1, 0.1}}, "red"});
  constexpr auto matte = static_cast<std::uint32_t>(index_of<Matte>(Materials{}));
  const MaterialReference floor{matte, 0}, red{matte, 1};

  std::get<ObjectItems<Plane>>(scene.objects).push_back({{{0, 0, 0}, {0, 1, 0}}, "", floor});
  std::get<ObjectItems<Sphere>>(scene.objects).push_back({{{0, height, 0}, 1}, "ball", red});
  return scene;
}

/// Prints what a render says.
class Printer : public RenderObserver {
  void on_message(MessageLevel level, const std::string& text) override {
    (level == MessageLevel::step ? std::cout : std::cerr) << text << '\n';
  }
};

RenderControl control;

bool render_all(const std::string& frames, const std::string& whole) {
  Printer printer;

  // An animation: three frames, each in passes, with a checkpoint once a minute from which the next run goes on.
  RenderJob job;
  job.outputs = {frames};
  job.checkpoint = frames + ".checkpoint.exr";
  job.resume = true;
  job.skip_existing = true;
  job.time_limit = 600;
  const RenderBatch batch({"ball"}, frame_numbers("1-3"), job);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const RenderResult result = render_picture(batch[i], ball_at(4.0 - batch[i].frame), printer, control);
    if (result.outcome != RenderOutcome::written && result.outcome != RenderOutcome::skipped) return false;
  }

  // One picture in two parts, as two machines would render them.
  MergeSettings merge;
  for (int index = 0; index < 2; ++index) {
    RenderJob part;
    part.tile = Tile{index, 2};
    part.outputs = {whole + ".tile" + std::to_string(index) + ".exr"};
    if (render_picture(part, ball_at(1), printer, control).outcome != RenderOutcome::written) return false;
    merge.pieces.push_back(part.outputs.front());
  }
  merge.outputs = {whole};
  merge_pieces(merge, [] { return control.is_stopped(); });
  return !control.is_stopped();
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return 2;
  std::signal(SIGINT, [](int) { control.stop(); });  // the checkpoint and the picture so far are written
  try {
    return render_all(arguments[1], arguments[2]) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "example: " << error.what() << '\n';
    return 1;
  }
}
