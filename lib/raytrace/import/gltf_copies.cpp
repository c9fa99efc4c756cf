#include "raytrace/import/gltf_copies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace raytrace::gltf {
namespace {

// Fewer, or smaller ones, are as small and faster as faces of one mesh: a face takes some 130 bytes with its vertices
// and Embree's boxes.
constexpr std::size_t fewest_copies = 17, fewest_faces = 64, fewest_faces_in_all = std::size_t{1} << 19U;

std::size_t face_count(const std::vector<Primitive>& mesh) {
  std::size_t faces = 0;
  for (const Primitive& primitive : mesh) faces += primitive.faces();
  return faces;
}

bool is_deformed(const Instance& instance) {
  return std::any_of(instance.mesh->begin(), instance.mesh->end(),
                     [&](const Primitive& primitive) { return is_deformed(primitive, instance); });
}

/// Whether rays can be turned back, in floats: as transforms in scenes can.
bool is_invertible(const Affine& affine) {
  constexpr double largest = 1e12, smallest = 1e-12;
  const double x = length(affine.x), y = length(affine.y), z = length(affine.z), at = length(affine.origin);
  // What is not a number is none.
  return std::max({x, y, z}) < largest && at < largest && std::min({x, y, z}) > smallest &&
         std::abs(affine.determinant()) > 1e-9 * x * y * z;
}

/// What has gone to a line or a point, as instances with a scale of 0 do, which programs hide in that way.
bool has_no_area(const Affine& affine) {
  return length(cross(affine.x, affine.y)) == 0 && length(cross(affine.y, affine.z)) == 0 &&
         length(cross(affine.z, affine.x)) == 0;
}

}  // namespace

CopyPlan plan_copies(const Model& model, bool all_joined) {
  struct Use {
    std::size_t copies = 0;
    std::uint32_t number = CopyPlan::joined;
  };
  std::map<const std::vector<Primitive>*, Use> uses;
  CopyPlan plan;
  plan.of_instances.assign(model.instances.size(), CopyPlan::joined);
  if (all_joined) return plan;
  for (const Instance& instance : model.instances)
    if (!is_deformed(instance) && is_invertible(instance.transform)) ++uses[instance.mesh].copies;
  for (std::size_t i = 0; i < model.instances.size(); ++i) {
    const Instance& instance = model.instances[i];
    const auto found = uses.find(instance.mesh);
    if (found == uses.end() || is_deformed(instance)) continue;
    Use& use = found->second;
    const std::size_t faces = face_count(*instance.mesh);
    if (use.copies < fewest_copies || faces < fewest_faces || faces * use.copies < fewest_faces_in_all) continue;
    if (is_invertible(instance.transform)) {
      if (use.number == CopyPlan::joined) use.number = plan.meshes++;
      plan.of_instances[i] = use.number;
    } else if (has_no_area(instance.transform)) {
      plan.of_instances[i] = CopyPlan::unseen;
    }
  }
  return plan;
}

}  // namespace raytrace::gltf
