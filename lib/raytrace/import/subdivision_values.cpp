#include "raytrace/import/subdivision_values.h"

#include <numeric>

namespace raytrace {

namespace {

/// How much each neighbour of a vertex counts in Loop's scheme, where all count 1.
double loop_weight(double valence) {
  const double part = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / valence);
  return (0.625 - part * part) / valence;
}

/// The same for the place where infinitely many steps would bring it.
double loop_limit_weight(double valence) { return 1 / (0.375 / loop_weight(valence) + valence); }

}  // namespace

SubdivisionStep::SubdivisionStep(const SubdivisionTopology& topology, const SubdivisionRules& rules,
                                 const double* values, const std::vector<int>& kinds, int threads)
    : topology_(topology),
      rules_(rules),
      values_(values),
      size_(std::accumulate(kinds.begin(), kinds.end(), 0)),
      threads_(threads) {
  if (!rules.triangles) {
    within_faces_ = LargeArray<double>::unset(static_cast<std::size_t>(size_) * topology.face_count);
    for_each_item(topology.face_count, threads, [&](std::size_t face) {
      const std::uint32_t first = topology.first_corner(face), count = topology.corners_of(face);
      Numbers mean{};
      for (std::uint32_t i = 0; i < count; ++i) add(mean, 1, at(topology.vertices[first + i]));
      for (int k = 0; k < size_; ++k)
        within_faces_[static_cast<std::size_t>(size_) * face + static_cast<std::size_t>(k)] =
            mean[static_cast<std::size_t>(k)] / count;
    });
  }
  if (rules.flat) return;
  add_up(kinds);
}

void SubdivisionStep::set_units(const std::vector<int>& kinds) {
  const std::size_t vertices = topology_.vertex_count, size = static_cast<std::size_t>(size_);
  // As fine as the largest sum leaves room for: of so many terms, and perhaps one more of a boundary.
  struct Largest {
    Numbers values{};
    std::uint32_t valence = 0;
  };
  std::vector<Largest> of_chunks(chunk_count(vertices));
  for_each_chunk(vertices, threads_, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Largest& largest = of_chunks[chunk];
    for (std::size_t i = first; i < last; ++i) {
      largest.valence = std::max(largest.valence, valences_[i]);
      for (std::size_t k = 0; k < size; ++k)
        largest.values[k] = std::max(largest.values[k], std::abs(values_[size * i + k]));
    }
  });
  Largest largest;
  for (const Largest& one : of_chunks) {
    largest.valence = std::max(largest.valence, one.valence);
    for (std::size_t k = 0; k < size; ++k) largest.values[k] = std::max(largest.values[k], one.values[k]);
  }
  auto first = largest.values.cbegin();
  for (auto unit = units_.begin(); const int numbers : kinds) {
    const double value = *std::max_element(first, first + numbers);
    const int bits = std::ilogb(std::max(value, 1e-300)) + 1 + std::bit_width(largest.valence + 2);
    unit = std::fill_n(unit, numbers, std::ldexp(1.0, 61 - bits));
    first += numbers;
  }
}

void SubdivisionStep::add_up(const std::vector<int>& kinds) {
  const std::size_t count = static_cast<std::size_t>(size_) * topology_.vertex_count;
  valences_ = LargeArray<std::uint32_t>::zeros(topology_.vertex_count);
  for_each_item(topology_.corner_count, threads_, [&](std::size_t i) {
    std::atomic_ref(valences_[topology_.vertices[i]]).fetch_add(1, std::memory_order_relaxed);
  });
  set_units(kinds);
  sums_of_edges_ = LargeArray<std::int64_t>::zeros(count);
  for_each_item(topology_.edge_count, threads_, [&](std::size_t i) {
    const SubdivisionTopology::Edge& edge = topology_.edges[i];
    const VertexKind kind = edge.is_sharp() ? VertexKind::crease : VertexKind::smooth;
    for (std::size_t half = 0; half < 2; ++half)
      if (topology_.kinds[edge.vertices[half]] == kind)
        add_to(sums_of_edges_, edge.vertices[half], at(edge.vertices[1 - half]));
  });
  if (rules_.triangles) return;
  sums_of_faces_ = LargeArray<std::int64_t>::zeros(count);
  for_each_item(topology_.face_count, threads_, [&](std::size_t face) {
    const std::uint32_t first = topology_.first_corner(face), corners = topology_.corners_of(face);
    for (std::uint32_t i = first; i < first + corners; ++i)
      if (topology_.kinds[topology_.vertices[i]] == VertexKind::smooth)
        add_to(sums_of_faces_, topology_.vertices[i], within_face(face));
  });
}

void SubdivisionStep::add_to(LargeArray<std::int64_t>& sums, std::size_t vertex, const Numbers& numbers) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(size_); ++k)
    std::atomic_ref(sums[static_cast<std::size_t>(size_) * vertex + k])
        .fetch_add(static_cast<std::int64_t>(std::llrint(numbers[k] * units_[k])), std::memory_order_relaxed);
}

SubdivisionStep::Numbers SubdivisionStep::sum_at(const LargeArray<std::int64_t>& sums, std::size_t vertex) const {
  Numbers numbers{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(size_); ++k)
    numbers[k] = static_cast<double>(sums[static_cast<std::size_t>(size_) * vertex + k]) / units_[k];
  return numbers;
}

SubdivisionStep::Numbers SubdivisionStep::moved_vertex(std::size_t vertex) const {
  const Numbers own = at(vertex);
  const VertexKind kind = topology_.kinds[vertex];
  if (rules_.flat || kind == VertexKind::fixed) return own;
  const Numbers neighbours = sum_at(sums_of_edges_, vertex);
  const double n = valences_[vertex];
  Numbers moved{};
  if (kind == VertexKind::crease) {
    add(moved, 0.75, own);
    add(moved, 0.125, neighbours);
  } else if (rules_.triangles) {
    const double weight = loop_weight(n);
    add(moved, 1 - n * weight, own);
    add(moved, weight, neighbours);
  } else {
    // (n - 3) / n of itself, 1 / n of the faces' mean and 2 / n of that of its edges' middles.
    add(moved, (n - 2) / n, own);
    add(moved, 1 / (n * n), neighbours);
    add(moved, 1 / (n * n), sum_at(sums_of_faces_, vertex));
  }
  return moved;
}

SubdivisionStep::Numbers SubdivisionStep::on_edge(std::uint32_t number) const {
  const SubdivisionTopology::Edge& edge = topology_.edges[number];
  const bool is_linear = rules_.flat || edge.is_sharp();
  const double of_ends = is_linear ? 0.5 : rules_.triangles ? 0.375 : 0.25;
  Numbers numbers{};
  for (const std::uint32_t vertex : edge.vertices) add(numbers, of_ends, at(vertex));
  if (is_linear) return numbers;
  for (const std::uint32_t corner : edge.corners)
    if (rules_.triangles)
      add(numbers, 0.125, at(topology_.vertices[topology_.previous(corner)]));
    else
      add(numbers, 0.25, within_face(topology_.face_of(corner)));
  return numbers;
}

SubdivisionStep::Numbers SubdivisionStep::limit_of_vertex(std::size_t vertex) const {
  const Numbers own = at(vertex);
  const VertexKind kind = topology_.kinds[vertex];
  if (kind == VertexKind::fixed) return own;
  const Numbers neighbours = sum_at(sums_of_edges_, vertex);
  const double n = valences_[vertex];
  Numbers limit{};
  if (kind == VertexKind::crease) {
    add(limit, 4.0 / 6, own);
    add(limit, 1.0 / 6, neighbours);
  } else if (rules_.triangles) {
    const double weight = loop_limit_weight(n);
    add(limit, 1 - n * weight, own);
    add(limit, weight, neighbours);
  } else {
    // After the step n^2 of itself, 4 of each neighbour and 1 of each one across a quad, over n (n + 5).
    add(limit, (n - 1) / (n + 5), own);
    add(limit, 2 / (n * (n + 5)), neighbours);
    add(limit, 4 / (n * (n + 5)), sum_at(sums_of_faces_, vertex));
  }
  return limit;
}

SubdivisionStep::Numbers SubdivisionStep::limit_within_face(std::size_t face) const {
  const std::uint32_t first = topology_.first_corner(face), count = topology_.corners_of(face);
  const double n = count, all = n * (n + 5);
  Numbers limit{};
  add(limit, n * n / all, within_face(face));
  for (std::uint32_t i = first; i < first + count; ++i) {
    add(limit, 4 / all, on_edge(topology_.corner_edges[i]));
    add(limit, 1 / all, moved_vertex(topology_.vertices[i]));
  }
  return limit;
}

SubdivisionStep::Numbers SubdivisionStep::limit_on_edge(std::uint32_t number) const {
  const SubdivisionTopology::Edge& edge = topology_.edges[number];
  const Numbers own = on_edge(number);
  if (edge.is_sharp() && rules_.linear_edges) return own;
  Numbers limit{};
  if (edge.is_sharp()) {
    add(limit, 4.0 / 6, own);
    for (const std::uint32_t vertex : edge.vertices) add(limit, 1.0 / 6, moved_vertex(vertex));
    return limit;
  }
  const double of_own = rules_.triangles ? 0.5 : 16.0 / 36, of_near = rules_.triangles ? 1.0 / 12 : 4.0 / 36,
               of_far = rules_.triangles ? 1.0 / 12 : 1.0 / 36;
  add(limit, of_own, own);
  for (const std::uint32_t vertex : edge.vertices) add(limit, of_near, moved_vertex(vertex));
  for (const std::uint32_t corner : edge.corners) {
    if (!rules_.triangles) add(limit, of_near, within_face(topology_.face_of(corner)));
    for (const std::uint32_t beside : {topology_.next(corner), topology_.previous(corner)})
      add(limit, of_far, on_edge(topology_.corner_edges[beside]));
  }
  return limit;
}

}  // namespace raytrace
