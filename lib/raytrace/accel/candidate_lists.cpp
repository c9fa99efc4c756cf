#include "raytrace/accel/candidate_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "raytrace/accel/cell_entry.h"
#include "raytrace/accel/cell_grid.h"
#include "raytrace/math/lanes.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parallel/radix_sort.h"

namespace raytrace {

namespace {

/// Where more are listed, a tree is faster. But to build it for few cells takes longer than to test more in them.
constexpr std::uint32_t most_candidates = 64, most_candidates_in_few = 256;

/// The part of the cells that are few.
constexpr std::size_t cells_for_each_of_few = 1000;

/// The work for an object is in proportion to the cells of the rectangle that it covers: how many, on the average, are
/// worth it.
constexpr double most_covered_cells = 64;

/// What a thread fills at a time: so few that they stay in its cache.
constexpr int rows_a_band = CellEntry::last_row + 1;

/// Nearest first, they lie all over memory: by how many it is asked for earlier.
constexpr std::size_t objects_ahead = 16, corners_ahead = 8;

/// Of a float's distance, to be on the safe side of its rounding.
constexpr double a_little_less = 1 - 1e-6;

constexpr int faces = 6;

/// The face of the picture that is seen from infinitely far.
constexpr int face_of_picture = 4;

/// Calls f(face, rectangle) for each face that the object is behind.
template <class Function>
void for_each_rectangle(const CubeProjection& projection, const ProjectedBounds& view, const Function& f) {
  const int first = projection.infinitely_far() ? face_of_picture : 0;
  const int end = projection.infinitely_far() ? face_of_picture + 1 : faces;
  for (int face = first; face < end; ++face)
    if (const auto rectangle = face_rectangle(face, view)) f(face, *rectangle);
}

using Coverages = std::array<Coverage, faces>;

struct ObjectDepth {
  std::uint32_t key;  ///< the bits of Object::nearest: as numbers, they have the order of floats that are not negative
  std::uint32_t object;
};

/// Some rows of a face's grid, which one thread fills.
struct Band {
  int face, first_row;
  std::size_t first_cell, cell_count;
  // Of its cells, and those with more than most_candidates.
  std::size_t used_cells = 0, crowded_cells = 0;
  std::size_t listed = 0, listed_by_crowded = 0;  ///< by the others, and by those
  std::uint32_t most_listed = 0;
  std::size_t first_candidate = 0;
  /// Of each entry's cells in turn, as for_each_reached() finds them, those that list.
  std::vector<std::uint8_t> seen = {};
};

/// Fills lists, in the order of its functions. All loops are cut into pieces that do not depend on the number of
/// threads, and what a piece adds to comes in one order.
class ListsMaker {
 public:
  using Lists = DirectionBuffer::Lists;
  using Grid = DirectionBuffer::Grid;

  ListsMaker(Lists& lists, const CubeProjection& projection, std::span<const BoundedObject> objects, int threads)
      : lists_(lists), perspective_(projection), objects_(objects), threads_(threads) {}

  /// Sets what the faces' grids are to cover and the order of the objects. False if there is one that the projection
  /// has no view of.
  bool survey() {
    struct Surveyed {
      Coverages covered;
      bool all_seen = true;
    };
    order_.resize(objects_.size());
    std::vector<Surveyed> chunks(chunk_count(objects_.size()));
    for_each_chunk(objects_.size(), threads_, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      Surveyed here;
      for (std::size_t i = first; i < last && here.all_seen; ++i) {
        const std::optional<ProjectedBounds> view = perspective_.view(objects_[i]);
        here.all_seen = view.has_value();
        if (!view) continue;
        order_[i] = {std::bit_cast<std::uint32_t>(static_cast<float>(view->nearest * a_little_less)),
                     static_cast<std::uint32_t>(i)};
        for_each_rectangle(perspective_, *view, [&](int face, const FaceRectangle& rectangle) {
          here.covered[static_cast<std::size_t>(face)].add(rectangle);
        });
      }
      chunks[chunk] = here;
    });
    for (const Surveyed& chunk : chunks) {
      if (!chunk.all_seen) return false;
      for (std::size_t face = 0; face < faces; ++face) covered_[face].add(chunk.covered[face]);
    }
    radix_sort(order_, threads_);
    return true;
  }

  void lay_grids() {
    std::size_t cells = 0;
    for (int face = 0; face < faces; ++face) {
      first_band_[face] = bands_.size();
      const Coverage& covered = covered_[static_cast<std::size_t>(face)];
      if (covered.objects == 0) continue;
      Grid& grid = lists_.grids[face] = grid_on(covered);
      grid.first_cell = static_cast<std::uint32_t>(cells);
      // Seen from the point, a cell's center and its corners are no further apart than they are on the face, whose
      // distance is 1. The rest is for a CellEntry's rounding.
      const double half_cell = std::hypot(1.0 / grid.columns_per_unit, 1.0 / grid.rows_per_unit) / 2 + 2e-6;
      half_cell_[face] = {std::cos(half_cell), std::sin(half_cell)};
      for (int row = 0; row < grid.rows; row += rows_a_band) {
        const auto count =
            static_cast<std::size_t>(std::min(rows_a_band, grid.rows - row)) * static_cast<std::size_t>(grid.columns);
        bands_.push_back({face, row, cells, count});
        cells += count;
      }
    }
    lists_.cells = LargeArray<std::uint32_t>::unset(cells + 1);
  }

  /// Which objects may be in which cells. False if they are so many that it would not pay.
  bool collect() {
    listings_.resize(chunk_count(objects_.size()));
    std::vector<double> covered_cells(chunk_count(objects_.size()));
    for_each_chunk(objects_.size(), threads_, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      listings_[chunk].resize(bands_.size());
      for (auto& l : listings_[chunk]) l.all.reserve((last - first) * 5 / 4 / bands_.size());
      double cells = 0;
      for (std::size_t i = first; i < last; ++i) {
        if (i + objects_ahead < last) {
          const BoundedObject& ahead = objects_[order_[i + objects_ahead].object];
          __builtin_prefetch(&ahead);
          __builtin_prefetch(&ahead.radius);
        }
        if (i + corners_ahead < last) __builtin_prefetch(objects_[order_[i + corners_ahead].object].corners);
        const BoundedObject& object = objects_[order_[i].object];
        const float nearest = std::bit_cast<float>(order_[i].key);
        const ProjectedBounds view = *perspective_.view(object);
        for_each_rectangle(perspective_, view, [&](int face, const FaceRectangle& rectangle) {
          cells += list(object, nearest, view, face, rectangle, listings_[chunk]);
        });
      }
      covered_cells[chunk] = cells;
    });
    double all = 0;
    for (const double cells : covered_cells) all += cells;
    return all <= most_covered_cells * static_cast<double>(objects_.size());
  }

  /// How many objects each cell lists. False if too many cells would list too many.
  bool count() {
    for_each_band([&](Band& band, std::span<std::uint32_t> cells) {
      // The last cells are tested together with some that there are not.
      const std::size_t places = cells.size() + CellFloats::size;
      std::vector<std::int32_t> counts(places);
      std::vector<float> depths(places, infinity<float>());  // nothing that is as deep as that is seen through a cell
      const auto add = [&](const CellEntry& entry, std::size_t first, const CellMask& reached,
                           const CellMask& covered) RAYTRACE_INLINE_LAMBDA {
        using Counts = Ints<CellFloats>;
        const CellFloats depth = CellFloats::load_unaligned(&depths[first]);
        const CellMask seen = reached & (CellFloats(entry.object.nearest) < depth);
        const auto more = same_bits<Counts>(select(seen, same_bits<CellFloats>(Counts(1)), CellFloats(0)));
        (Counts::load_unaligned(&counts[first]) + more).store_unaligned(&counts[first]);
        min(depth, select(covered, CellFloats(entry.behind), infinity<CellFloats>())).store_unaligned(&depths[first]);
        band.seen.push_back(static_cast<std::uint8_t>(bits_of<CellFloats>(seen)));
      };
      for_each_listing(band, [&](const CellEntry& entry, const EdgePlanes* edge_planes) {
        const auto add_listing = [&](std::size_t first, const CellMask& reached, const CellMask& covered)
                                     RAYTRACE_INLINE_LAMBDA { add(entry, first, reached, covered); };
        const Grid& grid = lists_.grids[band.face];
        if (edge_planes != nullptr)
          for_each_reached(grid, band.first_row, entry, band.face, *edge_planes, add_listing);
        else
          for_each_reached(grid, band.first_row, entry, add_listing);
      });
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t count = cells[i] = static_cast<std::uint32_t>(counts[i]);
        if (count == 0) continue;
        ++band.used_cells;
        band.most_listed = std::max(band.most_listed, count);
        if (count > most_candidates) {
          ++band.crowded_cells;
          band.listed_by_crowded += count;
        } else {
          band.listed += count;
        }
      }
    });
    std::size_t used = 0, crowded = 0;
    std::uint32_t most_listed = 0;
    for (const Band& band : bands_) {
      used += band.used_cells;
      crowded += band.crowded_cells;
      most_listed = std::max(most_listed, band.most_listed);
    }
    if (most_listed <= most_candidates_in_few && crowded * cells_for_each_of_few <= used)
      limit_ = most_candidates_in_few;
    return crowded * 4 <= used;
  }

  void fill() {
    std::size_t listed = 0;
    for (Band& band : bands_) {
      band.first_candidate = listed;
      listed += band.listed + (limit_ > most_candidates ? band.listed_by_crowded : 0);
    }
    lists_.candidates = LargeArray<DirectionBuffer::Object>::unset(listed);
    lists_.cells[bands_.empty() ? 0 : bands_.back().first_cell + bands_.back().cell_count] =
        static_cast<std::uint32_t>(listed);
    DirectionBuffer::Object* const candidates = lists_.candidates.data();
    for_each_band([&](const Band& band, std::span<std::uint32_t> cells) {
      std::vector<std::uint32_t> next(cells.size());  // each cell's next place among the candidates
      std::size_t first = band.first_candidate;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t count = cells[i];
        next[i] = static_cast<std::uint32_t>(first);
        cells[i] = next[i] | (count > limit_ ? DirectionBuffer::crowded : 0);
        first += count > limit_ ? 0 : count;
      }
      auto seen = band.seen.begin();
      const auto columns = static_cast<std::size_t>(lists_.grids[band.face].columns);
      for_each_listing(band, [&](const CellEntry& entry, const EdgePlanes*) {
        for (std::size_t row = entry.bottom; row <= entry.top; ++row)
          for (std::size_t column = entry.left; column <= entry.right; column += CellFloats::size)
            for (const std::size_t lane : SetLanes(*seen++)) {
              const std::size_t cell = row * columns + column + lane;
              if ((cells[cell] & DirectionBuffer::crowded) == 0) candidates[next[cell]++] = entry.object;
            }
      });
    });
  }

 private:
  template <class Function>
  void for_each_band(const Function& f) {
    const int threads = chunk_count(objects_.size()) > 1 ? threads_ : 1;
    for_each_index(static_cast<int>(bands_.size()), threads, [&](int index) {
      Band& band = bands_[static_cast<std::size_t>(index)];
      f(band, std::span(lists_.cells.data() + band.first_cell, band.cell_count));
    });
  }

  /// Calls f(entry, edge_planes) for all of the band, that of the nearest object first; edge_planes: null if it has
  /// none.
  template <class Function>
  void for_each_listing(const Band& band, const Function& f) const {
    for (const auto& chunk : listings_) {
      const CellEntries& entries = chunk[static_cast<std::size_t>(&band - bands_.data())];
      auto edge_planes = entries.edge_planes.begin();
      for (const CellEntry& entry : entries.all) f(entry, entry.has_edge_planes ? &*edge_planes++ : nullptr);
    }
  }

  /// Adds the object to all bands that the rectangle is in; the result: how many cells it covers.
  double list(const BoundedObject& object, float nearest, const ProjectedBounds& view, int face,
              const FaceRectangle& rectangle, std::vector<CellEntries>& bands) const {
    const Grid& grid = lists_.grids[face];
    const CellRange columns(rectangle.across, grid.left, grid.columns_per_unit, grid.columns);
    const CellRange rows(rectangle.up, grid.bottom, grid.rows_per_unit, grid.rows);
    std::optional<EdgePlanes> edge_planes;
    if (object.corners != nullptr) edge_planes = perspective_.edge_planes(object);
    CellEntry entry{};
    entry.object = {static_cast<std::uint8_t>(object.shape_type),
                    object.primitive & DirectionBuffer::Object::last_primitive, nearest};
    entry.has_edge_planes = edge_planes.has_value();
    entry.left = static_cast<std::uint32_t>(columns.low) & CellEntry::last_column;
    entry.right = static_cast<std::uint32_t>(columns.high) & CellEntry::last_column;
    const int axis = face / 2;
    const Vec3f center(view.center * (1 / view.distance));
    entry.across = component(center, (axis + 1) % 3);
    entry.up = component(center, (axis + 2) % 3);
    entry.normal = face % 2 != 0 ? -component(center, axis) : component(center, axis);
    const auto& [cosine, sine] = half_cell_[face];
    // Next to the differences between such cosines, the rounding of the axis' length is large.
    const double squared_length = dot(Vec3d(center), Vec3d(center));
    const double least = view.cosine * cosine - view.sine * sine;
    entry.least = view.in_cone ? least * std::abs(least) * squared_length : -1e300;
    entry.inner = infinity<float>();
    if (view.inner_sine > sine) {
      const double inner = view.inner_cosine * cosine + view.inner_sine * sine;
      // Rounded up, as this is to be on the safe side.
      entry.inner = static_cast<float>((inner * inner * squared_length - entry.least) * (1 + 1e-6));
      // As far as rays are followed that hit it there: what may lie at the same distance is listed, too.
      entry.behind = static_cast<float>(view.behind * (1 + 0x1p-13));
    }
    for (int first = rows.low / rows_a_band * rows_a_band; first <= rows.high; first += rows_a_band) {
      entry.bottom = static_cast<std::uint32_t>(std::max(rows.low - first, 0)) & CellEntry::last_row;
      entry.top = static_cast<std::uint32_t>(std::min(rows.high - first, rows_a_band - 1)) & CellEntry::last_row;
      CellEntries& band = bands[first_band_[face] + static_cast<std::size_t>(first / rows_a_band)];
      band.all.push_back(entry);
      if (edge_planes) band.edge_planes.push_back(*edge_planes);
    }
    return 1.0 * columns.count() * rows.count();
  }

  Lists& lists_;
  const CubeProjection& perspective_;
  std::span<const BoundedObject> objects_;
  int threads_;
  std::vector<ObjectDepth> order_;
  Coverages covered_;
  std::size_t first_band_[faces] = {};
  std::pair<double, double> half_cell_[faces];  ///< cosine and sine of the angle by which cones are to be wider
  std::vector<Band> bands_;
  std::uint32_t limit_ = most_candidates;           ///< of cells that list more, none is listed
  std::vector<std::vector<CellEntries>> listings_;  ///< of each chunk, on each band
};

}  // namespace

std::optional<DirectionBuffer::Lists> make_candidate_lists(const CubeProjection& projection,
                                                           std::span<const BoundedObject> objects, int threads) {
  DirectionBuffer::Lists lists;
  ListsMaker maker(lists, projection, objects, threads);
  if (!maker.survey()) return std::nullopt;
  maker.lay_grids();
  if (!maker.collect() || !maker.count()) return std::nullopt;
  maker.fill();
  return lists;
}

}  // namespace raytrace
