// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html, sections 3.7.2.2 (morph targets) and 3.7.3 (skins).
#include "raytrace/import/gltf_skin.h"

#include <algorithm>
#include <cstdint>

namespace raytrace::gltf {
namespace {

using Components = std::array<double, Elements::most_components>;

Vec3d vector_of(const Components& values) { return {values[0], values[1], values[2]}; }

Affine matrix_of(const std::array<double, Elements::of_matrix>& m) {
  const auto column = [&](std::size_t i) { return Vec3d{m[4 * i], m[4 * i + 1], m[4 * i + 2]}; };
  return {column(0), column(1), column(2), column(3)};
}

/// The mean of the joints' transforms, by their weights.
struct Blend {
  Affine sum{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  double weight = 0;

  void add(const Affine& a, double w) {
    sum = {sum.x + a.x * w, sum.y + a.y * w, sum.z + a.z * w, sum.origin + a.origin * w};
    weight += w;
  }
  /// otherwise: of what has no weight.
  Affine mean(const Affine& otherwise) const {
    if (weight == 1) return sum;
    if (!(weight > 0)) return otherwise;
    const double scale = 1 / weight;
    return {sum.x * scale, sum.y * scale, sum.z * scale, sum.origin * scale};
  }
};

void apply(const Primitive& primitive, const Skin& skin, int threads, Vertices& vertices) {
  const std::size_t count = vertices.positions.size();
  std::vector<Blend> blends(count);
  std::vector<std::array<std::uint32_t, 4>> joints(count);
  std::vector<std::uint32_t> first_joints;
  for (const JointSet& set : primitive.joint_sets) {
    for_each_element(set.joints, threads, [&](std::size_t i, const Components& values) {
      for (std::size_t k = 0; k < 4; ++k) joints[i][k] = static_cast<std::uint32_t>(values[k]);
    });
    for (const auto& of_vertex : joints)
      for (const std::uint32_t joint : of_vertex)
        if (joint >= skin.joints.size())
          throw Error(set.joints.place + ": has the joint " + std::to_string(joint) + ", and " + skin.place + " has " +
                      std::to_string(skin.joints.size()));
    if (first_joints.empty())
      for (const auto& of_vertex : joints) first_joints.push_back(of_vertex[0]);
    // A sparse accessor stores some elements twice: they are added when all are known.
    std::vector<std::array<double, 4>> weights(count);
    for_each_element(set.weights, threads, [&](std::size_t i, const Components& values) {
      weights[i] = {values[0], values[1], values[2], values[3]};
    });
    for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t k = 0; k < 4; ++k)
          if (weights[i][k] != 0) blends[i].add(skin.joints[joints[i][k]], weights[i][k]);
    });
  }
  for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Affine affine = blends[i].mean(skin.joints[first_joints[i]]);
      vertices.positions[i] = affine.point(vertices.positions[i]);
      if (!vertices.normals.empty()) vertices.normals[i] = affine.normal(vertices.normals[i]);
    }
  });
}

}  // namespace

Skin read_skin(Document& document, const Item& skin,
               const std::function<std::optional<Affine>(const Item& node)>& transform) {
  Skin result{skin.place(), {}};
  const Item joints = skin["joints"];
  if (joints.size() == 0) joints.fail("has no joints");
  std::optional<Accessor> inverses;
  if (const auto number = skin.find("inverseBindMatrices")) {
    inverses = document.accessor(*number);
    if (inverses->elements.components != 16 || inverses->elements.count < joints.size())
      number->fail(inverses->place + " has no MAT4 for each of the " + std::to_string(joints.size()) + " joints");
    document.spend(joints.size() * (1 + inverses->changed_indices.count), *number);
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Item joint = joints[i];
    document.listed("nodes", joint);
    const std::optional<Affine> into_scene = transform(joint);
    if (!into_scene) joint.fail("names nodes[" + std::to_string(joint.whole()) + "], which is not in the scene");
    result.joints.push_back(inverses ? *into_scene * matrix_of(element_at(*inverses, i)) : *into_scene);
  }
  return result;
}

Vertices deformed(const Primitive& primitive, const std::vector<double>& weights, const Skin* skin, int threads) {
  Vertices vertices;
  const std::size_t count = primitive.positions.elements.count;
  const auto read = [&](const Accessor& accessor, std::vector<Vec3d>& values) {
    values.resize(count);
    for_each_element(accessor, threads,
                     [&](std::size_t i, const Components& components) { values[i] = vector_of(components); });
  };
  read(primitive.positions, vertices.positions);
  if (primitive.normals) read(*primitive.normals, vertices.normals);
  std::vector<Vec3d> offsets;
  const auto add = [&](const std::optional<Accessor>& target, double weight, std::vector<Vec3d>& values) {
    if (!target || values.empty()) return;
    read(*target, offsets);
    for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) values[i] += offsets[i] * weight;
    });
  };
  for (std::size_t i = 0; i < primitive.targets.size() && i < weights.size(); ++i) {
    if (weights[i] == 0) continue;
    add(primitive.targets[i].positions, weights[i], vertices.positions);
    add(primitive.targets[i].normals, weights[i], vertices.normals);
  }
  if (skin != nullptr && !primitive.joint_sets.empty()) apply(primitive, *skin, threads, vertices);
  return vertices;
}

}  // namespace raytrace::gltf
