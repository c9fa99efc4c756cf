#include "raytrace/import/subdivision_topology.h"

#include <algorithm>
#include <atomic>

#include "raytrace/import/unique_items.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

using Edge = SubdivisionTopology::Edge;

void set_edges(SubdivisionTopology& topology, int threads) {
  const auto key = [&](std::size_t corner) {
    const std::uint32_t a = topology.vertices[corner],
                        b = topology.vertices[topology.next(static_cast<std::uint32_t>(corner))];
    return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
  };
  const UniqueItems unique = unique_items(
      topology.corner_count, threads, [&](std::size_t i) { return mixed_bits(key(i)); },
      [&](std::size_t i, std::size_t j) { return key(i) == key(j); });
  topology.edge_count = unique.first.size();
  topology.edges = LargeArray<Edge>::unset(topology.edge_count);
  topology.corner_edges = LargeArray<std::uint32_t>::unset(topology.corner_count);
  for_each_item(topology.edge_count, threads, [&](std::size_t i) {
    const std::uint32_t corner = unique.first[i];
    topology.edges[i] = {{topology.vertices[corner], topology.vertices[topology.next(corner)]},
                         {corner, SubdivisionTopology::none}};
  });
  auto others = LargeArray<std::uint32_t>::zeros(topology.edge_count);
  for_each_item(topology.corner_count, threads, [&](std::size_t i) {
    const std::uint32_t edge = topology.corner_edges[i] = unique.number[i];
    if (unique.first[edge] == i) return;
    std::atomic_ref(others[edge]).fetch_add(1, std::memory_order_relaxed);
    std::atomic_ref(topology.edges[edge].corners[1]).store(static_cast<std::uint32_t>(i), std::memory_order_relaxed);
  });
  for_each_item(topology.edge_count, threads, [&](std::size_t i) {
    if (others[i] > 1) topology.edges[i].corners[1] = SubdivisionTopology::none;
  });
}

/// How many of the faces at a vertex, of which there are `most`, are reached from one of its corners across edges of
/// two faces.
std::uint32_t faces_around(const SubdivisionTopology& topology, std::uint32_t first, std::uint32_t most) {
  const std::uint32_t vertex = topology.vertices[first];
  std::uint32_t count = 1;
  for (const bool forward : {true, false}) {
    std::uint32_t corner = first;
    std::uint32_t across = topology.corner_edges[forward ? corner : topology.previous(corner)];
    while (count < most) {
      const Edge& edge = topology.edges[across];
      if (edge.is_sharp()) break;
      // The other face's corner at the vertex, and its other edge there: faces may run either way round.
      const bool is_first = edge.corners[0] == corner || edge.corners[0] == topology.previous(corner);
      const std::uint32_t other = edge.corners[is_first ? 1 : 0];
      corner = topology.vertices[other] == vertex ? other : topology.next(other);
      if (corner == first) return count;
      ++count;
      across = topology.corner_edges[corner == other ? topology.previous(corner) : corner];
    }
  }
  return count;
}

void set_kinds(SubdivisionTopology& topology, int threads) {
  struct Around {
    std::uint32_t faces, sharp_edges, corner;
  };
  auto around = LargeArray<Around>::zeros(topology.vertex_count);
  for_each_item(topology.corner_count, threads, [&](std::size_t i) {
    Around& at = around[topology.vertices[i]];
    std::atomic_ref(at.faces).fetch_add(1, std::memory_order_relaxed);
    // One of its corners, counted from 1: whichever it is, what is found is the same.
    std::atomic_ref(at.corner).store(static_cast<std::uint32_t>(i) + 1, std::memory_order_relaxed);
  });
  for_each_item(topology.edge_count, threads, [&](std::size_t i) {
    if (!topology.edges[i].is_sharp()) return;
    for (const std::uint32_t vertex : topology.edges[i].vertices)
      std::atomic_ref(around[vertex].sharp_edges).fetch_add(1, std::memory_order_relaxed);
  });
  topology.kinds = LargeArray<VertexKind>::unset(topology.vertex_count);
  for_each_item(topology.vertex_count, threads, [&](std::size_t i) {
    const Around& at = around[i];
    const bool is_whole = faces_around(topology, at.corner - 1, at.faces) == at.faces;
    topology.kinds[i] = !is_whole                             ? VertexKind::fixed
                        : at.sharp_edges == 0                 ? VertexKind::smooth
                        : at.sharp_edges == 2 && at.faces > 1 ? VertexKind::crease
                                                              : VertexKind::fixed;
  });
}

}  // namespace

std::uint32_t SubdivisionTopology::face_of(std::uint32_t corner) const {
  if (face_corners != 0) return corner / face_corners;
  const std::uint32_t* const after = std::upper_bound(begins.data(), begins.data() + face_count, corner);
  return static_cast<std::uint32_t>(after - begins.data()) - 1;
}

std::uint32_t SubdivisionTopology::next(std::uint32_t corner) const {
  const std::uint32_t face = face_of(corner), first = first_corner(face);
  return corner + 1 == first + corners_of(face) ? first : corner + 1;
}

std::uint32_t SubdivisionTopology::previous(std::uint32_t corner) const {
  const std::uint32_t face = face_of(corner), first = first_corner(face);
  return corner == first ? first + corners_of(face) - 1 : corner - 1;
}

SubdivisionTopology topology_of(const MeshPolygons& polygons, const std::uint32_t* numbers, std::size_t vertex_count,
                                int threads) {
  SubdivisionTopology topology;
  topology.vertex_count = vertex_count;
  topology.face_count = polygons.count();
  topology.corner_count = polygons.vertices.size();
  for (const std::uint32_t corners : {3U, 4U})
    if (std::size_t i = 0; topology.corner_count == corners * topology.face_count) {
      while (i < topology.face_count && polygons.begins[i] == corners * i) ++i;
      if (i == topology.face_count) topology.face_corners = corners;
    }
  if (topology.face_corners == 0) {
    topology.begins = LargeArray<std::uint32_t>::unset(polygons.begins.size());
    std::copy(polygons.begins.begin(), polygons.begins.end(), topology.begins.data());
  }
  topology.vertices = LargeArray<std::uint32_t>::unset(topology.corner_count);
  std::copy(numbers, numbers + topology.corner_count, topology.vertices.data());
  set_edges(topology, threads);
  set_kinds(topology, threads);
  return topology;
}

void fix_sharp_vertices(SubdivisionTopology& topology, const SubdivisionTopology& positions, int threads) {
  auto fixed = LargeArray<std::uint8_t>::zeros(topology.vertex_count);
  const auto fix = [&](std::uint32_t vertex) { std::atomic_ref(fixed[vertex]).store(1, std::memory_order_relaxed); };
  for_each_item(topology.edge_count, threads, [&](std::size_t i) {
    if (!topology.edges[i].is_sharp()) return;
    for (const std::uint32_t vertex : topology.edges[i].vertices) fix(vertex);
  });
  for_each_item(topology.corner_count, threads, [&](std::size_t i) {
    if (positions.kinds[positions.vertices[i]] == VertexKind::fixed) fix(topology.vertices[i]);
  });
  for_each_item(topology.vertex_count, threads,
                [&](std::size_t i) { topology.kinds[i] = fixed[i] != 0 ? VertexKind::fixed : VertexKind::smooth; });
}

SubdivisionCounts counts_after_step(const SubdivisionTopology& topology, bool triangles) {
  if (triangles)
    return {4 * topology.face_count, topology.vertex_count + topology.edge_count, 12 * topology.face_count};
  return {topology.corner_count, topology.vertex_count + topology.face_count + topology.edge_count,
          4 * topology.corner_count};
}

void write_next_faces(const SubdivisionTopology& topology, bool triangles, std::uint32_t* out, int threads) {
  const auto on_edge = [&](std::uint32_t corner) {
    return vertex_on_edge(topology, triangles, topology.corner_edges[corner]);
  };
  for_each_item(topology.face_count, threads, [&](std::size_t face) {
    const std::uint32_t first = topology.first_corner(face), count = topology.corners_of(face);
    if (triangles) {
      // One at each corner, and one between them.
      std::uint32_t* at = out + 12 * face;
      for (std::uint32_t i = 0; i < 3; ++i) {
        *at++ = topology.vertices[first + i];
        *at++ = on_edge(first + i);
        *at++ = on_edge(first + (i + 2) % 3);
      }
      for (std::uint32_t i = 0; i < 3; ++i) *at++ = on_edge(first + i);
      return;
    }
    const auto within = static_cast<std::uint32_t>(topology.vertex_count + face);
    std::uint32_t* at = out + std::size_t{4} * first;
    for (std::uint32_t i = 0; i < count; ++i) {
      *at++ = topology.vertices[first + i];
      *at++ = on_edge(first + i);
      *at++ = within;
      *at++ = on_edge(first + (i + count - 1) % count);
    }
  });
}

SubdivisionTopology next_topology(const SubdivisionTopology& topology, bool triangles, bool linear_edges, int threads) {
  const SubdivisionCounts counts = counts_after_step(topology, triangles);
  SubdivisionTopology next;
  next.vertex_count = counts.vertices;
  next.face_count = counts.faces;
  next.corner_count = counts.corners;
  next.edge_count = 2 * topology.edge_count + topology.corner_count;
  next.face_corners = triangles ? 3 : 4;
  next.vertices = LargeArray<std::uint32_t>::unset(next.corner_count);
  write_next_faces(topology, triangles, next.vertices.data(), threads);

  // Edges: first both halves of each, then one for each corner: from the vertex on its edge into the face, or, in a
  // triangle, the one that cuts the corner off.
  const auto inner = [&](std::uint32_t corner) { return static_cast<std::uint32_t>(2 * topology.edge_count) + corner; };
  const auto half_at = [&](std::uint32_t edge, std::uint32_t vertex) {
    return 2 * edge + topology.edges[edge].half_at(vertex);
  };
  const auto next_of = [](std::uint32_t first, std::uint32_t count, std::uint32_t i) {
    return first + (i + 1) % count;
  };
  next.corner_edges = LargeArray<std::uint32_t>::unset(next.corner_count);
  next.edges = LargeArray<Edge>::unset(next.edge_count);
  for_each_item(topology.face_count, threads, [&](std::size_t face) {
    const std::uint32_t first = topology.first_corner(face), count = topology.corners_of(face);
    const auto inner_face = static_cast<std::uint32_t>(4 * face);  // of a triangle's four, the first
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t corner = first + i, before = first + (i + count - 1) % count;
      const std::uint32_t edge = topology.corner_edges[corner], edge_before = topology.corner_edges[before];
      const std::uint32_t vertex = topology.vertices[corner];
      const std::uint32_t on_edge = vertex_on_edge(topology, triangles, edge);
      if (triangles) {
        const std::uint32_t at = 3 * (inner_face + i), between = 3 * (inner_face + 3);
        next.corner_edges[at] = half_at(edge, vertex);
        next.corner_edges[at + 1] = inner(corner);
        next.corner_edges[at + 2] = half_at(edge_before, vertex);
        next.corner_edges[between + i] = inner(next_of(first, 3, i));
        next.edges[inner(corner)] = {{on_edge, vertex_on_edge(topology, triangles, edge_before)},
                                     {at + 1, between + (i + 2) % 3}};
      } else {
        const std::uint32_t at = 4 * corner;
        next.corner_edges[at] = half_at(edge, vertex);
        next.corner_edges[at + 1] = inner(corner);
        next.corner_edges[at + 2] = inner(before);
        next.corner_edges[at + 3] = half_at(edge_before, vertex);
        next.edges[inner(corner)] = {{on_edge, static_cast<std::uint32_t>(topology.vertex_count + face)},
                                     {at + 1, 4 * next_of(first, count, i) + 2}};
      }
    }
  });
  // Where the corner after a step is that has the half of a corner's edge at a vertex.
  const auto corner_of_half = [&](std::uint32_t corner, std::uint32_t vertex) {
    const bool starts_there = topology.vertices[corner] == vertex;
    if (!starts_there) corner = topology.next(corner);
    if (!triangles) return 4 * corner + (starts_there ? 0U : 3U);
    return 3 * (4 * (corner / 3) + corner % 3) + (starts_there ? 0U : 2U);
  };
  for_each_item(topology.edge_count, threads, [&](std::size_t i) {
    const Edge& edge = topology.edges[i];
    const std::uint32_t on_edge = vertex_on_edge(topology, triangles, static_cast<std::uint32_t>(i));
    for (std::size_t half = 0; half < 2; ++half) {
      const std::uint32_t vertex = edge.vertices[half];
      Edge& made = next.edges[2 * i + half];
      made = {{vertex, on_edge}, {corner_of_half(edge.corners[0], vertex), SubdivisionTopology::none}};
      if (!edge.is_sharp()) made.corners[1] = corner_of_half(edge.corners[1], vertex);
    }
  });

  next.kinds = LargeArray<VertexKind>::unset(next.vertex_count);
  const VertexKind on_sharp = linear_edges ? VertexKind::fixed : VertexKind::crease;
  for_each_item(next.vertex_count, threads, [&](std::size_t i) {
    const std::size_t first_on_edge = vertex_on_edge(topology, triangles, 0);
    next.kinds[i] = i < topology.vertex_count                                            ? topology.kinds[i]
                    : i >= first_on_edge && topology.edges[i - first_on_edge].is_sharp() ? on_sharp
                                                                                         : VertexKind::smooth;
  });
  return next;
}

}  // namespace raytrace
