#include "raytrace/description/cut_strands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "raytrace/memory/process_status.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

/// Of the radius, how far pieces may be from the curve; and by how much they may turn.
constexpr double most_deviation = 0.02, most_turn = 5 * 3.14159265358979323846 / 180;

/// Of coordinates and of radii: what reaches beyond 1e18, Embree leaves out.
constexpr double most_size = 5e17;

struct StrandPoint {
  Vec3d position{};
  double radius = 0;
  Vec3d color{};

  friend StrandPoint operator+(const StrandPoint& a, const StrandPoint& b) {
    return {a.position + b.position, a.radius + b.radius, a.color + b.color};
  }
  friend StrandPoint operator*(const StrandPoint& a, double factor) {
    return {a.position * factor, a.radius * factor, a.color * factor};
  }
};

/// A cubic between two points of a curve, as Bézier has it.
struct CubicSegment {
  std::array<StrandPoint, 4> points;

  StrandPoint at(double t) const {
    const double s = 1 - t;
    return points[0] * (s * s * s) + points[1] * (3 * s * s * t) + points[2] * (3 * s * t * t) +
           points[3] * (t * t * t);
  }

  std::size_t pieces() const {
    const Vec3d &a = points[0].position, &b = points[1].position, &c = points[2].position, &d = points[3].position;
    const double radius = std::max(points[0].radius, points[3].radius);
    const Vec3d legs[] = {b - a, c - b, d - c};
    const double bend = 6 * std::max(length(legs[1] - legs[0]), length(legs[2] - legs[1]));
    double turn = 0;
    for (int i = 0; i < 2; ++i) turn += std::atan2(length(cross(legs[i], legs[i + 1])), dot(legs[i], legs[i + 1]));
    // A chord of a curve whose second derivative is at most `bend` is off by at most an eighth of that.
    const double by_deviation = std::sqrt(bend / (8 * most_deviation * std::max(radius, 1e-300)));
    const double wanted = std::ceil(std::min(by_deviation, turn / most_turn) * (1 - 1e-9));
    return static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(most_pieces_of_segment)));
  }
};

class StrandCutter {
 public:
  StrandCutter(const Strands& strands, const Curve::Parameters& parameters)
      : strands_(strands), parameters_(parameters) {}

  /// The points of a strand's pieces; empty: it is left out.
  const std::vector<StrandPoint>& cut(std::size_t strand) {
    cut_.clear();
    const std::size_t first = strand == 0 ? 0 : strands_.ends[strand - 1];
    count_ = strands_.ends[strand] - first;
    const bool is_spline = parameters_.basis == CurveBasis::bspline;
    if (is_spline && count_ < 4) return cut_;
    points_.clear();
    for (std::size_t i = 0; i < count_; ++i) points_.push_back(point(first + i, i));
    const std::size_t segments = is_spline ? count_ - 3 : count_ - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      if (parameters_.basis == CurveBasis::linear) {
        add(points_[i]);
        continue;
      }
      const CubicSegment segment = is_spline ? spline_segment(i) : segment_through(i);
      const std::size_t pieces = segment.pieces();
      for (std::size_t k = 0; k < pieces; ++k) {
        const double t = static_cast<double>(k) / static_cast<double>(pieces);
        StrandPoint here = segment.at(t);
        if (!is_spline) {
          const StrandPoint even = points_[i] * (1 - t) + points_[i + 1] * t;
          here.radius = even.radius;
          here.color = even.color;
        }
        add(here);
      }
    }
    add(is_spline ? spline_segment(segments - 1).at(1) : points_.back());
    const bool has_radius = std::any_of(cut_.begin(), cut_.end(), [](const StrandPoint& p) { return p.radius > 0; });
    const bool fits = std::all_of(cut_.begin(), cut_.end(), [](const StrandPoint& p) {
      const Vec3d& at = p.position;
      return std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z), p.radius}) <= most_size;
    });
    if (cut_.size() < 2 || !has_radius || !fits) cut_.clear();
    return cut_;
  }

 private:
  StrandPoint point(std::size_t i, std::size_t in_strand) const {
    const float* const p = strands_.positions.data() + 3 * i;
    StrandPoint result{{p[0], p[1], p[2]}};
    const double radius = parameters_.radius > 0 ? parameters_.radius : static_cast<double>(strands_.radii[i]);
    const double along = static_cast<double>(in_strand) / static_cast<double>(count_ - 1);
    result.radius = radius * parameters_.radiusscale * (1 + (parameters_.tipscale - 1) * along);
    if (!strands_.colors.empty()) {
      const float* const c = strands_.colors.data() + 3 * i;
      result.color = {c[0], c[1], c[2]};
    }
    return result;
  }

  /// From point i to the next one, the first and the last of the strand counting twice. Radii and colours are evened
  /// out elsewhere.
  CubicSegment segment_through(std::size_t i) const {
    const StrandPoint &before = points_[i == 0 ? 0 : i - 1], &a = points_[i], &b = points_[i + 1],
                      &behind = points_[std::min(i + 2, count_ - 1)];
    return {{a, a + (b + before * -1) * (1.0 / 6), b + (behind + a * -1) * (-1.0 / 6), b}};
  }

  CubicSegment spline_segment(std::size_t i) const {
    const StrandPoint &a = points_[i], &b = points_[i + 1], &c = points_[i + 2], &d = points_[i + 3];
    return {
        {(a + b * 4 + c) * (1.0 / 6), (b * 2 + c) * (1.0 / 3), (b + c * 2) * (1.0 / 3), (b + c * 4 + d) * (1.0 / 6)}};
  }

  /// Rounded as it is kept, so that none lies where the one before does.
  void add(StrandPoint p) {
    p.position = Vec3d(Vec3f(p.position));
    if (!cut_.empty() && length(p.position - cut_.back().position) < smallest_size) return;
    cut_.push_back(p);
  }

  const Strands& strands_;
  const Curve::Parameters& parameters_;
  std::size_t count_ = 0;
  std::vector<StrandPoint> points_, cut_;
};

/// From `first` on.
void put(std::span<const StrandPoint> strand, std::size_t first, CurveData& data) {
  double whole = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) whole += length(strand[i].position - strand[i - 1].position);
  double so_far = 0;
  for (std::size_t i = 0; i < strand.size(); ++i) {
    const StrandPoint& p = strand[i];
    const float values[] = {static_cast<float>(p.position.x), static_cast<float>(p.position.y),
                            static_cast<float>(p.position.z), static_cast<float>(p.radius)};
    std::copy_n(values, 4, &data.points[4 * (first + i)]);
    if (i > 0) so_far += length(p.position - strand[i - 1].position);
    data.along[first + i] = i == 0 ? 0.0F : std::max(static_cast<float>(so_far / whole), 1e-30F);
    if (data.colors.empty()) continue;
    const float rgb[] = {static_cast<float>(p.color.x), static_cast<float>(p.color.y), static_cast<float>(p.color.z)};
    std::copy_n(rgb, 3, &data.colors[3 * (first + i)]);
  }
  data.along[first + strand.size() - 1] = 1;
}

}  // namespace

CutStrands cut_strands(const Strands& strands, const Curve::Parameters& parameters, int threads) {
  CutStrands result;
  const std::size_t count = strands.ends.size();
  struct Counts {
    std::size_t points = 0, left_out = 0;
  };
  std::vector<Counts> chunks(chunk_count(count));
  for_each_chunk(count, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    StrandCutter cutter(strands, parameters);
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t points = cutter.cut(i).size();
      chunks[chunk].points += points;
      chunks[chunk].left_out += points == 0 ? 1 : 0;
    }
  });
  std::vector<std::size_t> starts;
  std::size_t all = 0;
  for (const Counts& chunk : chunks) {
    starts.push_back(all);
    all += chunk.points;
    result.left_out += chunk.left_out;
  }
  // So that Embree and we can number them; and each takes about so many bytes, with what Embree keeps of it.
  constexpr std::size_t most = std::size_t{1} << 28U, bytes_each = 128;
  if (all > most || all * bytes_each > available_memory() / 2) {
    result.fault = "would be cut into " + std::to_string(all) +
                   " pieces, more than fit into half of the memory that is "
                   "free, or than the " +
                   std::to_string(most) + " that are possible";
    return result;
  }
  CurveData& data = result.data;
  data.origin = strands.origin;
  data.points = MeshBuffer<float>(4 * all);
  data.along = MeshBuffer<float>(all);
  if (!strands.colors.empty()) data.colors = MeshBuffer<float>(3 * all);
  data.is_smooth = parameters.basis != CurveBasis::linear;
  for_each_chunk(count, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    StrandCutter cutter(strands, parameters);
    std::size_t start = starts[chunk];
    for (std::size_t i = first; i < last; ++i) {
      const std::vector<StrandPoint>& strand = cutter.cut(i);
      if (!strand.empty()) put(strand, start, data);
      start += strand.size();
    }
  });
  return result;
}

}  // namespace raytrace
