#include "raytrace/accel/direction_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace raytrace {

namespace {

/// Where more are listed, a tree is faster.
constexpr std::uint32_t most_candidates = 64;

/// Cells, on the average, that a grid has for each object on it, and the most along an edge.
constexpr double cells_an_object = 16;
constexpr double most_cells_an_edge = 512;

/// The work for an object is in proportion to the cells of the rectangle that it covers: how many, on the average, are
/// worth it.
constexpr double most_covered_cells = 128;

/// Rays from and to further away are Embree's, which cannot take all of them: those here need not be looked at again.
constexpr double most_distance = 1e16;

/// By what part of its length rounding may turn the way from a place to the vantage aside, and more.
constexpr double way_rounding = 0x1p-20;

/// More than the rounding of a quotient of floats up to 1.
constexpr double quotient_rounding = 1e-6;

/// What is seen from infinitely far is shown as a picture in the middle of the face z = 1, which is 2 wide and high.
constexpr int face_of_picture = 4;
constexpr double picture_size = 1;

struct Interval {
  double low, high;
};

/// An object as seen from the vantage.
struct View {
  const PlacedObject* object;
  std::array<Interval, 3> along;  ///< its box
  Vec3d center;                   ///< of a sphere around it
  double distance, angle;         ///< of that center; of the cone that the sphere is in, to its axis
  double nearest;                 ///< distance from the point, or Sight::depth
};

/// A rectangle of a face that an object is in, as seen from the point.
struct Rectangle {
  std::uint32_t number;  ///< of its view
  Interval across, up;
};

Vec3d center_of(const PlacedObject& object) { return (Vec3d(object.bounds.lower) + Vec3d(object.bounds.upper)) * 0.5; }

/// From a point: none from inside the sphere around it, or from so close that a cone says little. All sizes are `slack`
/// larger.
std::optional<View> view_of(const PlacedObject& object, const Vec3d& point, double slack) {
  const Vec3d lower(object.bounds.lower), upper(object.bounds.upper);
  View view;
  view.object = &object;
  for (int axis = 0; axis < 3; ++axis) {
    view.along[static_cast<std::size_t>(axis)] = {component(lower, axis) - component(point, axis) - slack,
                                                  component(upper, axis) - component(point, axis) + slack};
  }
  view.center = center_of(object) - point;
  view.distance = length(view.center);
  const double radius = object.radius + slack;
  if (radius > 0.9 * view.distance) return std::nullopt;
  view.angle = std::asin(radius / view.distance);
  const auto gap = [](const Interval& i) { return std::max({i.low, -i.high, 0.0}); };
  const Vec3d to_box{gap(view.along[0]), gap(view.along[1]), gap(view.along[2])};
  view.nearest = std::max(length(to_box), view.distance - radius);
  return view;
}

/// A picture of all objects, across parallel rays: a point's place on it is (across . point, up . point) - start.
struct Picture {
  Vec3d across, up, towards;  ///< towards: the vantage, of unit length
  Vec3d start{};              ///< start.z: of depths, start.z - towards . point

  Picture(const Vec3d& towards_vantage, const std::vector<PlacedObject>& objects, double slack)
      : towards(normalize(towards_vantage)) {
    const Vec3d aside = std::abs(towards.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    across = normalize(cross(aside, towards));
    up = cross(towards, across);
    std::array<Interval, 3> all{Interval{1e30, -1e30}, Interval{1e30, -1e30}, Interval{1e30, -1e30}};
    for (const PlacedObject& object : objects)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Interval i = extent(object, axis == 0 ? across : axis == 1 ? up : towards, slack);
        all[axis] = {std::min(all[axis].low, i.low), std::max(all[axis].high, i.high)};
      }
    const double scale = picture_size / std::max(all[0].high - all[0].low, all[1].high - all[1].low);
    across = Vec3d(Vec3f(across * scale));
    up = Vec3d(Vec3f(up * scale));
    const auto middle = [scale](const Interval& i) {
      return static_cast<double>(static_cast<float>((i.low + i.high) / 2 * scale));
    };
    start = {middle(all[0]), middle(all[1]), static_cast<double>(static_cast<float>(all[2].high + slack))};
  }

  /// In the direction of an axis.
  static Interval extent(const PlacedObject& object, const Vec3d& axis, double slack) {
    const Vec3d half = (Vec3d(object.bounds.upper) - Vec3d(object.bounds.lower)) * 0.5;
    const double box = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
    const double reach = std::min(box, object.radius * length(axis)) + slack * length(axis);
    const double middle = dot(axis, center_of(object));
    return {middle - reach, middle + reach};
  }

  View view(const PlacedObject& object, double slack) const {
    const Interval x = extent(object, across, slack), y = extent(object, up, slack);
    View view;
    view.object = &object;
    view.along = {Interval{x.low - start.x, x.high - start.x}, Interval{y.low - start.y, y.high - start.y},
                  Interval{1, 1}};
    view.center = {0, 0, 1};
    view.distance = 1;
    view.angle = std::numbers::pi;  // the box says it all
    view.nearest = std::max(0.0, start.z - extent(object, towards, slack).high);
    return view;
  }
};

/// Of a face, across or up.
constexpr Interval whole_face = {-1 - quotient_rounding, 1 + quotient_rounding};

/// Of all b / w for b in `b` and w in `w`, which is positive: what lies on the face.
Interval on_face(const Interval& b, const Interval& w) {
  return {std::max(b.low / (b.low < 0 ? w.low : w.high) - quotient_rounding, whole_face.low),
          std::min(b.high / (b.high > 0 ? w.low : w.high) + quotient_rounding, whole_face.high)};
}

std::optional<Rectangle> rectangle_on(int face, const View& view, std::uint32_t number) {
  constexpr double corner_angle = 0.9554;  // of the face to its normal: acos(1 / sqrt(3)), and more
  const int axis = face / 2;
  const bool negative = face % 2 != 0;
  const double along_normal = (negative ? -1 : 1) * component(view.center, axis);
  if (std::acos(std::clamp(along_normal / view.distance, -1.0, 1.0)) > view.angle + corner_angle) return std::nullopt;
  const auto along = [&](int which) { return view.along[static_cast<std::size_t>(which % 3)]; };
  const Interval depth = negative ? Interval{-along(axis).high, -along(axis).low} : along(axis);
  if (depth.low <= 0) return Rectangle{number, whole_face, whole_face};
  const Rectangle rectangle{number, on_face(along(axis + 1), depth), on_face(along(axis + 2), depth)};
  if (rectangle.across.low > rectangle.across.high || rectangle.up.low > rectangle.up.high) return std::nullopt;
  return rectangle;
}

/// Of the rectangles, and with cells that are about square.
DirectionBuffer::Grid grid_around(const std::vector<Rectangle>& rectangles) {
  Interval across{2, -2}, up{2, -2};
  for (const Rectangle& rectangle : rectangles) {
    across = {std::min(across.low, rectangle.across.low), std::max(across.high, rectangle.across.high)};
    up = {std::min(up.low, rectangle.up.low), std::max(up.high, rectangle.up.high)};
  }
  const double width = across.high - across.low, height = up.high - up.low;
  const double edge = std::sqrt(width * height / (cells_an_object * static_cast<double>(rectangles.size())));
  const auto cells = [edge](double size) {
    return static_cast<int>(std::clamp(std::ceil(size / edge), 1.0, most_cells_an_edge));
  };
  DirectionBuffer::Grid grid;
  grid.columns = cells(width);
  grid.rows = cells(height);
  grid.left = static_cast<float>(across.low);
  grid.bottom = static_cast<float>(up.low);
  grid.columns_per_unit = static_cast<float>(grid.columns / width);
  grid.rows_per_unit = static_cast<float>(grid.rows / height);
  return grid;
}

/// Which of `count` cells in a row, the first of which begins at `start`, an interval reaches.
struct CellRange {
  int low, high;
  CellRange(const Interval& i, float start, float per_unit, int count)
      : low(place(i.low, start, per_unit, count, -rounding)), high(place(i.high, start, per_unit, count, rounding)) {}
  int count() const { return high - low + 1; }

 private:
  static constexpr double rounding = 1e-3;  ///< of cells per unit in float, for at most 512 cells; and more
  static int place(double value, float start, float per_unit, int count, double more) {
    return static_cast<int>(std::clamp(std::floor((value - start) * per_unit + more), 0.0, count - 1.0));
  }
};

/// Calls f(cell) for each cell of the rectangle that reaches into the cone around the object, counted from the grid's
/// first.
template <class Function>
void for_each_covered(const DirectionBuffer::Grid& grid, int face, const Rectangle& rectangle, const View& view,
                      const Function& f) {
  const CellRange columns(rectangle.across, grid.left, grid.columns_per_unit, grid.columns);
  const CellRange rows(rectangle.up, grid.bottom, grid.rows_per_unit, grid.rows);
  const double width = 1.0 / grid.columns_per_unit, height = 1.0 / grid.rows_per_unit;
  // Seen from the point, a cell's center and its corners are no further apart than they are on the face, whose
  // distance is 1.
  const double angle = view.angle + std::hypot(width, height) / 2 + 1e-6;
  const double least = angle < std::numbers::pi ? std::cos(angle) * view.distance : -view.distance;
  const int axis = face / 2;
  const double normal = (face % 2 != 0 ? -1 : 1) * component(view.center, axis);
  const double across_axis = component(view.center, (axis + 1) % 3), up_axis = component(view.center, (axis + 2) % 3);
  for (int row = rows.low; row <= rows.high; ++row) {
    const double up = grid.bottom + (row + 0.5) * height;
    for (int column = columns.low; column <= columns.high; ++column) {
      const double across = grid.left + (column + 0.5) * width;
      const double towards = normal + across * across_axis + up * up_axis;
      if (towards >= least * std::sqrt(1 + across * across + up * up))
        f(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column));
    }
  }
}

}  // namespace

std::optional<DirectionBuffer> DirectionBuffer::make(const Vantage& vantage, const std::vector<PlacedObject>& objects) {
  DirectionBuffer buffer;
  buffer.infinitely_far_ = vantage.infinitely_far;
  const Vec3d from = vantage.infinitely_far ? Vec3d(0, 0, 0) : Vec3d(vantage.place);
  double farthest = 0;
  for (const PlacedObject& object : objects)
    farthest = std::max(farthest, length(center_of(object) - from) + object.radius);
  if (!(length(from) + farthest < most_distance)) return std::nullopt;
  // As far again as the objects reach, and more: floors are wider than what stands on them.
  buffer.reach_ = static_cast<float>(8 * farthest);
  const double slack = way_rounding * buffer.reach_;

  std::vector<View> views;
  views.reserve(objects.size());
  if (vantage.infinitely_far) {
    const Picture picture(Vec3d(vantage.place), objects, slack);
    buffer.across_ = Vec3f(picture.across);
    buffer.up_ = Vec3f(picture.up);
    buffer.start_ = Vec3f(picture.start);
    for (const PlacedObject& object : objects) views.push_back(picture.view(object, slack));
  } else {
    for (const PlacedObject& object : objects) {
      const std::optional<View> view = view_of(object, from, slack);
      if (!view) return std::nullopt;
      views.push_back(*view);
    }
  }
  std::sort(views.begin(), views.end(), [](const View& a, const View& b) { return a.nearest < b.nearest; });

  std::array<std::vector<Rectangle>, 6> rectangles;
  double covered_cells = 0;
  for (int face = 0; face < 6; ++face) {
    if (vantage.infinitely_far && face != face_of_picture) continue;
    std::vector<Rectangle>& here = rectangles[static_cast<std::size_t>(face)];
    for (std::size_t i = 0; i < views.size(); ++i)
      if (const auto rectangle = rectangle_on(face, views[i], static_cast<std::uint32_t>(i)))
        here.push_back(*rectangle);
    if (here.empty()) continue;
    Grid& grid = buffer.grids_[face] = grid_around(here);
    grid.first_cell = static_cast<std::uint32_t>(buffer.cells_.size());
    buffer.cells_.resize(buffer.cells_.size() +
                         static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    for (const Rectangle& rectangle : here) {
      covered_cells += 1.0 * CellRange(rectangle.across, grid.left, grid.columns_per_unit, grid.columns).count() *
                       CellRange(rectangle.up, grid.bottom, grid.rows_per_unit, grid.rows).count();
    }
  }
  if (covered_cells > most_covered_cells * static_cast<double>(objects.size())) return std::nullopt;

  // Twice the same: first to count, then to list.
  const auto for_each_listing = [&](const auto& f) {
    for (int face = 0; face < 6; ++face) {
      const Grid& grid = buffer.grids_[face];
      for (const Rectangle& rectangle : rectangles[static_cast<std::size_t>(face)])
        for_each_covered(grid, face, rectangle, views[rectangle.number],
                         [&](std::size_t cell) { f(buffer.cells_[grid.first_cell + cell], rectangle.number); });
    }
  };
  for_each_listing([](Cell& cell, std::uint32_t) { ++cell.count; });
  std::uint32_t listed = 0;
  std::size_t used = 0, crowded_cells = 0;
  for (Cell& cell : buffer.cells_) {
    if (cell.count == 0) continue;
    ++used;
    if (cell.count > most_candidates) {
      cell.count = crowded;
      ++crowded_cells;
    } else {
      cell.first = listed;
      listed += cell.count;
      cell.count = 0;  // until they are listed
    }
  }
  if (crowded_cells * 4 > used) return std::nullopt;
  buffer.candidates_.resize(listed);
  for_each_listing([&](Cell& cell, std::uint32_t number) {
    if (cell.count != crowded) buffer.candidates_[cell.first + cell.count++] = number;
  });

  buffer.objects_.reserve(views.size());
  for (const View& view : views) {
    const double depth = vantage.infinitely_far ? view.nearest : view.nearest * view.nearest;
    buffer.objects_.push_back({view.object->kind, view.object->primitive, static_cast<float>(depth * (1 - 1e-6))});
  }
  return buffer;
}

}  // namespace raytrace
