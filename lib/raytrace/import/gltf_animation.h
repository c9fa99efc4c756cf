// Animations of a glTF file at a time. Inside of read_gltf().
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/import/gltf_document.h"

namespace raytrace::gltf {

/// What an animation sets in a node.
struct NodePose {
  std::optional<std::array<double, 3>> translation{}, scale{};
  std::optional<std::array<double, 4>> rotation{};
  std::optional<std::vector<double>> weights{};
};

struct Pose {
  std::map<std::uint64_t, NodePose> nodes{};  ///< by their numbers
  double end = 0;                             ///< the time of the last key
};

/// animation: its name or number, or "all" for all of them at once, where none has that name; of what several move, the
/// last one says how. Empty: none. Of one alone that leaves other nodes to others, it warns. Before the first key of a
/// channel and after its last, that key counts. "0" and "all" of a file without animations are none.
Pose read_pose(Document& document, const std::string& animation, double time);

/// From unit quaternion a to b, the short way. With the four operations alone, so that all machines have the same bits.
std::array<double, 4> slerp(const std::array<double, 4>& a, std::array<double, 4> b, double t);

}  // namespace raytrace::gltf
