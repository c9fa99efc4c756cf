// Hair, fur, grass, ropes, wires: one object of one or many strands, which are round, from a file or from the scene.
//
//   <curve> <file>wig.hair</file> <radiusscale>0.5</radiusscale> <material>brown</material> </curve>
//
//   <curve>
//     <points>0 0 0  0 1 0.1  0 2 0.4, 1 0 0  1 1 0.2  1 2 0.5</points> <radius>0.02</radius> <tipscale>0</tipscale>
//     <material>grass</material>
//   </curve>
//
// A strand is cut into straight pieces whose radius changes evenly (description/cut_strands.h), each the hull of two
// spheres; neighbours share one. It is shaded with the normals of the curve that they stand for.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

struct CurveData;

/// How points make a curve.
enum class CurveBasis {
  catmullrom,  ///< it passes through all; the first and the last count twice
  linear,      ///< straight from one to the next, with corners
  bspline,  ///< a uniform cubic that they draw near: with n of them it has n - 3 segments, and ends beside the second
            ///< and the last but one
};
template <>
struct Choices<CurveBasis> {
  static constexpr std::array<std::string_view, 3> words = {"catmullrom", "linear", "bspline"};
};

class Curve {
 public:
  struct Parameters {
    FileName file;           ///< .hair, or text of x y z radius (import/read_strands.h), perhaps with .gz behind; or:
    NumberGroups points;     ///< x y z of each point, a group for each strand
    double radius = 0;       ///< of all points, in place of the file's; 0: it has radii
    double radiusscale = 1;  ///< of the radii, wherever they are from
    double tipscale = 1;     ///< of that at the tip alone; towards the root it grows evenly to 1, along the points
    CurveBasis basis = CurveBasis::catmullrom;
  };
  using Data = CurveData;  ///< of the file, or of the points
  static constexpr std::string_view group = "curves";
  static constexpr std::string_view element = "curve";
  static constexpr bool may_lack_material = true;  ///< then it has the colours of its file
  static Fields fields() {
    return {optional("file", &Parameters::file),
            optional("points", &Parameters::points),
            optional("radius", &Parameters::radius, Range::not_negative),
            optional("radiusscale", &Parameters::radiusscale, Range::positive),
            optional("tipscale", &Parameters::tipscale, Range::not_negative),
            optional("basis", &Parameters::basis)};
  }

  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto& [file, points, radius, radiusscale, tipscale, basis] = parameters;
    const auto refused = [](std::string message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, std::move(message)};
    };
    if (!file.path.empty())
      return points.empty() ? std::nullopt
                            : std::optional(refused("a curve with <file> has its points there; remove <points>"));
    if (points.empty()) return refused("a curve needs <file> or <points>");
    if (radius < smallest_size) return refused("a curve of <points> needs a <radius>");
    std::size_t first = 0;
    for (const std::uint32_t end : points.ends) {
      const std::size_t count = end - first;
      if (count % 3 != 0 || count < 6)
        return refused("<points> has a strand of " + std::to_string(count) +
                       " numbers; each point takes 3, and a strand at least two points. Commas are between strands");
      first = end;
    }
    return std::nullopt;
  }
};

}  // namespace raytrace
