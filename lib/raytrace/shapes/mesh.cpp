#include "raytrace/shapes/mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace raytrace {

namespace {

ParameterDiagnostic refused(std::string message) { return {ParameterDiagnostic::Effect::error, std::move(message)}; }

}  // namespace

std::optional<ParameterDiagnostic> Mesh::check(const Parameters& parameters) {
  const auto& [file, positions, faces, normals, uvs, uvs2, animation, time, variant, overridematerials, subdivision,
               subdivisionscheme, displacement, midlevel] = parameters;
  if (auto refusal = check_subdivision(parameters)) return refusal;
  const bool has_values =
      !positions.empty() || !faces.empty() || !normals.groups.empty() || !uvs.empty() || !uvs2.empty();
  if (!file.path.empty() && has_values)
    return refused("a mesh with <file> has its positions, faces, normals and uvs there; remove them here");
  if (!file.path.empty()) return std::nullopt;
  if (!animation.name.empty() || time != 0 || !variant.name.empty() || overridematerials)
    return refused("<animation>, <time>, <variant> and <overridematerials> are of a <file>, and the mesh has none");
  if (positions.empty() || faces.empty()) return refused("a mesh needs <file>, or <positions> and <faces>");

  const std::size_t vertices = positions.numbers.size() / 3;
  const auto has_others = [&](const NumberGroups& values, std::size_t each) {
    return !values.empty() && values.numbers.size() != each * vertices;
  };
  const auto count_of = [&](const NumberGroups& values) { return std::to_string(values.numbers.size()) + " numbers"; };
  if (has_others(positions, 3)) return refused("<positions> has " + count_of(positions) + "; each vertex takes 3");
  for (const auto& [name, values, each] :
       {std::tuple("<normals>", &normals.groups, std::size_t{3}), std::tuple("<uvs>", &uvs, std::size_t{2}),
        std::tuple("<uvs2>", &uvs2, std::size_t{2})}) {
    if (has_others(*values, each))
      return refused(std::string(name) + " has " + count_of(*values) + "; " + std::to_string(vertices) +
                     " vertices take " + std::to_string(each * vertices));
  }
  const auto bad = std::find_if(faces.numbers.begin(), faces.numbers.end(), [&](double corner) {
    return corner < 0 || corner >= static_cast<double>(vertices) || corner != std::floor(corner);
  });
  if (bad != faces.numbers.end())
    return refused("<faces> has a corner that is no vertex, number " + std::to_string(bad - faces.numbers.begin() + 1) +
                   " of its numbers; vertices are counted from 0, and there are " + std::to_string(vertices));
  std::uint32_t first = 0;
  for (const std::uint32_t end : face_ends(faces)) {
    if (end - first < 3) return refused("<faces> has a face of " + std::to_string(end - first) + " corners");
    first = end;
  }
  return std::nullopt;
}

std::vector<std::uint32_t> Mesh::face_ends(const NumberGroups& faces) {
  if (faces.ends.size() != 1 || faces.numbers.size() % 3 != 0) return faces.ends;
  std::vector<std::uint32_t> ends;
  for (std::size_t end = 3; end <= faces.numbers.size(); end += 3) ends.push_back(static_cast<std::uint32_t>(end));
  return ends;
}

}  // namespace raytrace
