#include "raytrace/batch/model_smoke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "raytrace/description/load_grids.h"
#include "raytrace/description/load_images.h"
#include "raytrace/math/bounds.h"
#include "raytrace/text/extension.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Anticlockwise from outside; corner i has the upper x, y and z by its bits.
constexpr std::array<std::array<int, 4>, 6> faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

void add_group(NumberGroups& groups, std::initializer_list<double> numbers) {
  groups.numbers.insert(groups.numbers.end(), numbers);
  groups.ends.push_back(static_cast<std::uint32_t>(groups.numbers.size()));
}

void set_box(Mesh::Parameters& mesh, const Bounds& bounds) {
  for (int corner = 0; corner < 8; ++corner) {
    const auto along = [&](int bit, float lower, float upper) { return double{(corner & bit) != 0 ? upper : lower}; };
    add_group(mesh.positions, {along(1, bounds.lower.x, bounds.upper.x), along(2, bounds.lower.y, bounds.upper.y),
                               along(4, bounds.lower.z, bounds.upper.z)});
  }
  for (const auto& [a, b, c, d] : faces) add_group(mesh.faces, {double(a), double(b), double(c), double(d)});
}

/// So that a scene that is printed can be read.
double with_two_digits(double value) { return std::stod(formatted("%.2g", value)); }

}  // namespace

bool is_smoke(const std::string& file) { return has_extension(file, ".vdb") || has_extension(file, ".vol"); }

bool add_smoke(SceneDescription& description, const std::string& file, const ModelStage& stage,
               Diagnostics& diagnostics, int threads, const TextureSettings& textures) {
  for (const auto& [asked, what] : {std::pair(stage.animation, "animation"), std::pair(stage.variant, "variant")})
    if (!asked.empty()) diagnostics.error({}, std::string("a file of densities has no ") + what);
  if (diagnostics.has_errors()) return false;
  auto& fogs = std::get<MaterialItems<Fog>>(description.materials);
  const MaterialReference material{static_cast<std::uint32_t>(index_of<Fog>(Materials{})),
                                   static_cast<std::uint32_t>(fogs.size())};
  MaterialItem<Fog>& fog = fogs.emplace_back();
  fog.name = "smoke";
  fog.parameters.densityfile.path = file;
  fog.parameters.meanfreepath = 1;
  if (!load_images(description, diagnostics, threads, textures)) return false;
  const float largest = fog.grid.grid->largest();
  if (!(largest > 0)) {
    diagnostics.error({}, "has no density anywhere");
    return false;
  }
  const Bounds bounds = grid_bounds(fog);
  const Vec3d size = Vec3d(bounds.upper) - Vec3d(bounds.lower);
  constexpr double free_paths_across = 50;
  const double free_path = with_two_digits(length(size) / free_paths_across * double{largest});
  if (!(free_path >= smallest_size && free_path <= largest_number)) {
    diagnostics.error({}, formatted("has densities of up to %g in a box of %g, which are not those of smoke",
                                    double{largest}, length(size)));
    return false;
  }
  fog.parameters.meanfreepath = free_path;
  ObjectItem<Mesh> mesh;
  set_box(mesh.parameters, bounds);
  mesh.material = material;
  if (stage.z_is_up) fog.transform.steps.push_back({TransformStep::rotate, {1, 0, 0, -90}});
  mesh.transform = fog.transform;
  std::get<ObjectItems<Mesh>>(description.objects).push_back(mesh);
  Path::Parameters path;
  path.maxdepth = 128;
  description.integrator = path;
  return load_meshes(description, diagnostics, threads, textures);
}

}  // namespace raytrace
