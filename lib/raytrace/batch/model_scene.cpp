#include "raytrace/batch/model_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "raytrace/batch/fit_camera.h"
#include "raytrace/batch/model_extent.h"
#include "raytrace/batch/model_lights.h"
#include "raytrace/batch/model_smoke.h"
#include "raytrace/description/load_images.h"
#include "raytrace/import/read_mesh.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

constexpr std::array<double, 2> usual_view{30, 15};

/// points: all that is to be in view.
template <class Points>
void add_camera(SceneDescription& description, const Directions& to, const Extent& extent, const Points& points) {
  const double half_angle = std::tan(39.6 / 2 * degree);  // 50 mm on full frame
  const ViewPlane& picture = description.viewplane;
  const double longer = std::max(picture.hres, picture.vres);
  // The eye is as near as the way to each vertex is within the picture, which has the model in its middle.
  Reach across{half_angle * picture.hres / longer * part_in_view},
      upwards{half_angle * picture.vres / longer * part_in_view};
  points([&](const Vec3d& p) {
    across.add(dot(p, to.right), dot(p, to.back));
    upwards.add(dot(p, to.up), dot(p, to.back));
  });
  const double depth = extent.middle().z, least = extent.radius() > 0 ? extent.radius() * 1e-3 : 1;
  const double distance = std::max({across.distance() - depth, upwards.distance() - depth, least});
  PinholeCamera::Parameters camera;
  camera.lookat = to.right * across.middle() + to.up * upwards.middle() + to.back * depth;
  camera.eye = camera.lookat + to.back * distance;
  camera.up = to.up;
  camera.viewdistance = picture.pixelsize * longer / (2 * half_angle);
  description.camera = camera;
}

void animate(Mesh::Parameters& mesh, const ModelStage& stage, std::optional<int> frame) {
  constexpr double usual_frames_per_second = 24;
  const bool is_wanted = !stage.animation.empty() || (frame && (stage.turntable == 0 || stage.frames_per_second));
  if (!is_wanted) return;
  mesh.animation.name = stage.animation.empty() ? "0" : stage.animation;
  mesh.time = (frame.value_or(1) - 1) / stage.frames_per_second.value_or(usual_frames_per_second);
}

/// The model at some times of its animation, so that a camera that has them in view stands still; without any, if it is
/// at rest.
SceneDescription moving(const SceneDescription& description, int threads) {
  constexpr int moments = 5;
  SceneDescription result;
  const ObjectItem<Mesh>& mesh = std::get<ObjectItems<Mesh>>(description.objects).front();
  if (mesh.parameters.animation.name.empty()) return result;
  MeshReadSettings settings;
  settings.animation = mesh.parameters.animation.name;
  settings.threads = threads;
  for (int i = 0; i < moments; ++i) {
    settings.time = data_of(description).animation_end.value_or(0) * i / (moments - 1);
    Diagnostics known(description.file);  // by the time of this frame
    std::optional<MeshData> data = read_mesh(mesh.parameters.file.path, settings, known);
    if (!data) continue;
    ObjectItem<Mesh>& moment = std::get<ObjectItems<Mesh>>(result.objects).emplace_back(mesh);
    moment.data = std::make_shared<const MeshData>(std::move(*data));
  }
  return result;
}

/// The one that the stage wants; null if there is none to choose from, or if it has another view.
const FileCamera* choose_camera(const SceneDescription& description, const ModelStage& stage,
                                Diagnostics& diagnostics) {
  const std::vector<FileCamera>& cameras = data_of(description).cameras;
  if (stage.camera.empty()) {
    if (cameras.empty() || stage.view || stage.turntable > 0) return nullptr;
    if (cameras.size() > 1)
      diagnostics.warning({}, std::to_string(cameras.size()) + " cameras; looks by " +
                                  (cameras.front().name.empty() ? "the first" : in_quotes(cameras.front().name)) +
                                  "; --camera NAME chooses");
    return &cameras.front();
  }
  std::vector<std::string> names;
  for (const FileCamera& camera : cameras) {
    if (camera.name == stage.camera) return &camera;
    names.push_back(in_quotes(camera.name));
  }
  diagnostics.error({}, "has no camera " + in_quotes(stage.camera) +
                            (names.empty() ? ", nor any other" : "; there are " + joined(names, ", ")));
  return nullptr;
}

void add_file_camera(SceneDescription& description, const FileCamera& camera) {
  const Affine affine = std::get<ObjectItems<Mesh>>(description.objects).front().transform.affine();
  const Vec3d eye = affine.point(camera.eye), up = affine.vector(camera.up);
  const Vec3d lookat = eye + affine.vector(camera.forward) * std::max(1.0, length(eye) * 1e-3);
  ViewPlane& picture = description.viewplane;
  if (camera.angle == 0) {
    picture.pixelsize = camera.height / picture.vres;
    description.camera = OrthographicCamera::Parameters{eye, lookat, up};
    return;
  }
  PinholeCamera::Parameters parameters;
  parameters.eye = eye;
  parameters.lookat = lookat;
  parameters.up = up;
  parameters.viewdistance = picture.pixelsize * picture.vres / (2 * std::tan(camera.angle / 2));
  description.camera = parameters;
}

/// The size of a picture of as many pixels as that, of the camera's shape. It is even, as video has it.
void set_shape(ViewPlane& picture, double aspect) {
  constexpr double most = 16;  // of one side by the other
  const double shape = std::clamp(aspect, 1 / most, most), pixels = double{1} * picture.hres * picture.vres;
  const auto even = [](double size) { return 2 * static_cast<int>(std::round(size / 2)); };
  picture.hres = even(std::sqrt(pixels * shape));
  picture.vres = even(std::sqrt(pixels / shape));
}

/// A matte grey. To be added before the model's materials, which come behind it where a printed scene is read, too: so
/// their names and numbers are the same there.
void add_floor_material(SceneDescription& description) {
  Matte::Parameters paint;
  paint.kd = 1;
  paint.cd = {0.5, 0.5, 0.5};
  std::get<MaterialItems<Matte>>(description.materials).push_back({paint, "floor"});
}

/// At the lowest vertex of what is shown. A transparent picture shows only the shadows on it.
void add_floor(SceneDescription& description, const SceneDescription& shown) {
  Extent extent;
  for_each_vertex(shown, [&](const Vec3d& p) { extent.add(p); });
  const MaterialReference material{static_cast<std::uint32_t>(index_of<Matte>(Materials{})), 0};
  const Vec3d middle = extent.middle();
  const double lowest = -reach_along(shown, {0, -1, 0});
  std::get<ObjectItems<Plane>>(description.objects)
      .push_back({{{middle.x, lowest, middle.z}, {0, 1, 0}}, "floor", material, 0, true});
}

/// f(point) of circles about the axis upwards through the middle of all vertices: the ways of each on a turntable.
template <class Function>
void for_each_turned_vertex(const SceneDescription& description, const Function& f) {
  constexpr int points = 16;
  Extent extent;
  for_each_vertex(description, [&](const Vec3d& p) { extent.add(p); });
  const Vec3d middle = extent.middle();
  // A circle is within the polygon.
  const double larger = 1 / std::cos(std::numbers::pi / points);
  for_each_vertex(description, [&](const Vec3d& p) {
    const double radius = larger * std::hypot(p.x - middle.x, p.z - middle.z);
    for (int i = 0; i < points; ++i) {
      const Vec3d around = towards(360.0 * i / points, 0) * radius;
      f(Vec3d{middle.x + around.x, p.y, middle.z + around.z});
    }
  });
}

/// The file's lights, where the stage has others in their place.
void warn_of_unused_lights(const SceneDescription& description, const ModelStage& stage, Diagnostics& diagnostics) {
  const std::size_t lights = data_of(description).lights.size();
  const bool counts = !stage.sun && (stage.environment.empty() || stage.environment == no_environment);
  if (lights == 0 || counts) return;
  diagnostics.warning({}, (lights == 1 ? "its light is" : "its " + std::to_string(lights) + " lights are") +
                              " left out: " + (stage.environment.empty() ? "--sun" : "--environment") +
                              " lights it instead; a scene with a <model> has both");
}

}  // namespace

bool is_model(const std::string& file) { return is_mesh_file(file) || is_smoke(file); }

std::optional<SceneDescription> load_model(const std::string& file, const ModelStage& stage, std::optional<int> frame,
                                           std::optional<std::array<int, 2>> size, Diagnostics& diagnostics,
                                           int threads, const TextureSettings& textures) {
  constexpr std::array usual_size{1280, 720};
  SceneDescription description;
  description.file = file;
  description.viewplane.hres = size.value_or(usual_size)[0];
  description.viewplane.vres = size.value_or(usual_size)[1];
  description.viewplane.samples = 128;
  description.viewplane.viewtransform = ViewTransform::khronos_neutral;
  description.integrator = Path::Parameters{};
  if (stage.floor) add_floor_material(description);
  if (is_smoke(file)) {
    if (!add_smoke(description, file, stage, diagnostics, threads, textures)) return std::nullopt;
  } else {
    ObjectItem<Mesh> mesh;
    mesh.parameters.file.path = file;
    mesh.parameters.variant.name = stage.variant;
    animate(mesh.parameters, stage, frame);
    if (stage.z_is_up) mesh.transform.steps.push_back({TransformStep::rotate, {1, 0, 0, -90}});
    std::get<ObjectItems<Mesh>>(description.objects).push_back(mesh);
    if (!load_meshes(description, diagnostics, threads, textures)) return std::nullopt;
  }
  if (!data_of(description).animation_end) {
    // So that a printed scene does not ask for what is not there.
    auto& parameters = std::get<ObjectItems<Mesh>>(description.objects).front().parameters;
    parameters.animation = {};
    parameters.time = 0;
  }
  const std::size_t errors_before = diagnostics.error_count();
  const FileCamera* const camera = choose_camera(description, stage, diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  if (!size && camera != nullptr && camera->aspect > 0) set_shape(description.viewplane, camera->aspect);
  const double turned = stage.turntable > 0 ? 360.0 * (frame.value_or(1) - 1) / stage.turntable : 0;
  auto [azimuth, elevation] = stage.view.value_or(usual_view);
  if (camera != nullptr) {
    // The studio stands about it as about any other.
    const Affine affine = std::get<ObjectItems<Mesh>>(description.objects).front().transform.affine();
    const Vec3d back = -affine.vector(camera->forward);
    azimuth = std::atan2(back.x, back.z) / degree;
    elevation = std::asin(std::clamp(back.y, -1.0, 1.0)) / degree;
  }
  const SceneDescription moments = moving(description, threads);
  const SceneDescription& shown = std::get<ObjectItems<Mesh>>(moments.objects).empty() ? description : moments;
  const Directions to(azimuth + turned, elevation);
  Extent extent;
  const auto show = [&](const auto& points) {
    points([&](const Vec3d& p) { extent.add(to.of(p)); });
    add_camera(description, to, extent, points);
  };
  if (stage.turntable > 0) {
    // As near in all frames.
    show([&](const auto& f) { for_each_turned_vertex(shown, f); });
  } else {
    show([&](const auto& f) { for_each_vertex(shown, f); });
  }
  if (camera != nullptr) {
    add_file_camera(description, *camera);
    if (stage.fit) fit_camera(shown, description);
  }
  if (stage.floor) add_floor(description, shown);
  add_model_lights(description, shown, stage, to, camera == nullptr ? std::optional(extent) : std::nullopt);
  warn_of_unused_lights(description, stage, diagnostics);
  if (!stage.environment.empty() && !load_images(description, diagnostics, threads, textures)) return std::nullopt;
  return description;
}

}  // namespace raytrace
