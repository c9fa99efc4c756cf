// What the vertices of a mesh that is subdivided have: positions, texture coordinates, colours. Inside of subdivided().
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "raytrace/import/subdivision_topology.h"
#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

struct SubdivisionRules {
  bool triangles = false;     ///< Loop's, of a mesh of triangles; else Catmull and Clark's
  bool flat = false;          ///< new vertices are in the middle, and old ones stay
  bool linear_edges = false;  ///< sharp edges stay straight, as fix_sharp_vertices() has their vertices
};

/// One step for values of one kind or several.
class SubdivisionStep {
 public:
  static constexpr int most_numbers = 12;
  using Numbers = std::array<double, most_numbers>;

  /// kinds: how many numbers each has. values: of each vertex, one after the other; they must stay where they are. What
  /// one kind has is of no account to another.
  SubdivisionStep(const SubdivisionTopology& topology, const SubdivisionRules& rules, const double* values,
                  const std::vector<int>& kinds, int threads);

  /// Calls write(vertex, numbers) for each vertex after the step. limit: as after infinitely many more.
  template <class Write>
  void run(bool limit, const Write& write) const {
    const std::size_t within = topology_.vertex_count, on_edges = vertex_on_edge(topology_, rules_.triangles, 0);
    for_each_item(topology_.vertex_count, threads_,
                  [&](std::size_t i) { write(i, limit ? limit_of_vertex(i) : moved_vertex(i)); });
    for_each_item(on_edges - within, threads_,
                  [&](std::size_t i) { write(within + i, limit ? limit_within_face(i) : within_face(i)); });
    for_each_item(topology_.edge_count, threads_, [&](std::size_t i) {
      const auto edge = static_cast<std::uint32_t>(i);
      write(on_edges + i, limit ? limit_on_edge(edge) : on_edge(edge));
    });
  }

 private:
  void add_up(const std::vector<int>& kinds);
  void set_units(const std::vector<int>& kinds);
  Numbers at(std::size_t vertex) const { return numbers_at(values_, vertex); }
  Numbers numbers_at(const double* values, std::size_t i) const {
    Numbers numbers{};
    std::copy_n(values + static_cast<std::size_t>(size_) * i, size_, numbers.data());
    return numbers;
  }
  Numbers sum_at(const LargeArray<std::int64_t>& sums, std::size_t vertex) const;
  /// factor x b is added to a.
  void add(Numbers& a, double factor, const Numbers& b) const {
    for (int k = 0; k < size_; ++k) a[static_cast<std::size_t>(k)] += factor * b[static_cast<std::size_t>(k)];
  }
  void add_to(LargeArray<std::int64_t>& sums, std::size_t vertex, const Numbers& numbers);

  Numbers moved_vertex(std::size_t vertex) const;
  Numbers within_face(std::size_t face) const { return numbers_at(within_faces_.data(), face); }
  Numbers on_edge(std::uint32_t edge) const;
  Numbers limit_of_vertex(std::size_t vertex) const;
  Numbers limit_within_face(std::size_t face) const;
  Numbers limit_on_edge(std::uint32_t edge) const;

  const SubdivisionTopology& topology_;
  SubdivisionRules rules_;
  const double* values_;
  int size_, threads_;
  LargeArray<double> within_faces_;  ///< of each polygon, the mean of its corners
  // Of each vertex. Sums are whole numbers, so that they do not depend on the order of their terms.
  LargeArray<std::uint32_t> valences_;
  LargeArray<std::int64_t> sums_of_faces_;  ///< of within_faces_
  LargeArray<std::int64_t> sums_of_edges_;  ///< of the other ends of its edges; of a crease, of the sharp ones
  Numbers units_{};                         ///< of the sums of each number, in 1; alike within a kind
};

}  // namespace raytrace
