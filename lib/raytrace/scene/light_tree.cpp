#include "raytrace/scene/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "raytrace/math/gather.h"

namespace raytrace {

namespace {

/// Trails have so many bits.
constexpr int most_depth = 31;

Vec3f center(const Bounds& box) { return (box.lower + box.upper) * 0.5F; }

/// In double, and rounded after: other machines' functions may differ in a double's last digit.
double angle_of(float cosine) { return std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0)); }

/// The smallest cone around both (pbrt-v4, section 3.8.4).
void join_cones(LightEmission& a, const LightEmission& b) {
  constexpr double pi = std::numbers::pi;
  const double angle_a = angle_of(a.cosine), angle_b = angle_of(b.cosine), between = angle_of(dot(a.axis, b.axis));
  if (std::min(between + angle_b, pi) <= angle_a) return;
  if (std::min(between + angle_a, pi) <= angle_b) {
    a.axis = b.axis;
    a.cosine = b.cosine;
    return;
  }
  const double angle = (angle_a + between + angle_b) / 2;
  const Vec3d axis(a.axis), across = cross(axis, Vec3d(b.axis));
  if (angle >= pi || dot(across, across) == 0) {
    a.cosine = -1;
    return;
  }
  const Vec3d side = normalize(cross(normalize(across), axis));
  a.axis = Vec3f(normalize(axis * std::cos(angle - angle_a) + side * std::sin(angle - angle_a)));
  a.cosine = static_cast<float>(std::cos(angle));
}

// Cones in 32 bits: the axis on an octahedron, 12 bits for each of x and y (Meyer et al., "On Floating-Point Normal
// Vectors", 2010), and in the upper 8 the sine of half the angle between axis and edge, rounded up.

constexpr float octahedron_steps = 2047, cone_steps = 255;

struct DirectionCone {
  Vec3<FloatN> axis;
  FloatN cosine;
};

DirectionCone unpacked_cone(const FloatN& bits) {
  const IntN code = same_bits<IntN>(bits), step(4095);
  const auto number = [](const IntN& i) { return to_float(i) * FloatN(1 / octahedron_steps) - FloatN(1); };
  const FloatN x = number(code & step), y = number((code >> 12) & step), z = FloatN(1) - abs(x) - abs(y);
  const FloatN fold = max(-z, FloatN(0));
  const Vec3<FloatN> v(x - select(x < FloatN(0), -fold, fold), y - select(y < FloatN(0), -fold, fold), z);
  const FloatN sine = to_float((code >> 24) & IntN(255)) * FloatN(1 / cone_steps);
  return {v * (FloatN(1) / length(v)), FloatN(1) - FloatN(2) * sine * sine};
}

float packed_cone(const Vec3f& axis, float cosine) {
  constexpr double pi = std::numbers::pi;
  const Vec3d v(axis);
  const double inverse = 1 / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  const auto step = [&](double a, double b) {
    const double folded = v.z < 0 ? std::copysign(1 - std::abs(b) * inverse, a) : a * inverse;
    return static_cast<std::uint32_t>(std::lround((folded + 1) * double{octahedron_steps}));
  };
  const std::uint32_t code = step(v.x, v.y) | step(v.y, v.x) << 12U;
  // The cone around the stored axis has the cone around the true one in it.
  const Vec3<FloatN> stored = unpacked_cone(FloatN(std::bit_cast<float>(code))).axis;
  const Vec3d apart = Vec3d(Vec3f(stored.x.get(0), stored.y.get(0), stored.z.get(0))) - v;
  const double angle = angle_of(cosine) + (length(apart) > 1e-6 ? 1.1 * length(apart) : 0);
  const double sine = std::ceil(std::sin(std::min(angle, pi) / 2) * double{cone_steps});
  return std::bit_cast<float>(code | static_cast<std::uint32_t>(sine) << 24U);
}

/// How much a cluster costs: its power, over how large an area and how many directions it is spread. Kulla and Conty's
/// measure.
float cost(const LightEmission& lights, LightTree::Reach reach) {
  constexpr double pi = std::numbers::pi;
  const double angle = angle_of(lights.cosine);
  const double end = reach == LightTree::Reach::cone ? angle : std::min(angle + pi / 2, pi);
  const double directions =
      2 * pi * (1 - std::cos(angle)) +
      pi / 2 * (2 * end * std::sin(angle) - std::cos(angle - 2 * end) - 2 * angle * std::sin(angle) + std::cos(angle));
  const Vec3f size = lights.box.upper - lights.box.lower;
  return lights.power * static_cast<float>(directions) * (size.x * size.y + size.y * size.z + size.z * size.x);
}

/// Puts the lights of either half along the longest axis together; the first half's number.
std::size_t halve(const std::vector<LightEmission>& lights, std::span<std::uint32_t> order) {
  Bounds centers = empty_bounds;
  for (const std::uint32_t i : order) centers = join(centers, {center(lights[i].box), center(lights[i].box)});
  const Vec3f size = centers.upper - centers.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(component(center(lights[a].box), axis), a) < std::pair(component(center(lights[b].box), axis), b);
  });
  return order.size() / 2;
}

/// Cuts the lights in two where the halves' cost is least, and puts each half's together; the first half's number.
std::size_t cut(const std::vector<LightEmission>& lights, LightTree::Reach reach, std::span<std::uint32_t> order) {
  constexpr int buckets = 12;
  Bounds centers = empty_bounds;
  for (const std::uint32_t i : order) centers = join(centers, {center(lights[i].box), center(lights[i].box)});
  const Vec3f size = centers.upper - centers.lower;
  const float longest = std::max({size.x, size.y, size.z});
  const auto bucket_of = [&](std::uint32_t i, int axis) {
    const float share =
        (component(center(lights[i].box), axis) - component(centers.lower, axis)) / component(size, axis);
    return std::min(static_cast<int>(share * buckets), buckets - 1);
  };
  float least = std::numeric_limits<float>::infinity();
  int best_axis = -1, best_bucket = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(component(size, axis) > longest * 1e-6F)) continue;
    std::array<LightEmission, buckets> parts;
    for (const std::uint32_t i : order) {
      LightEmission& part = parts[static_cast<std::size_t>(bucket_of(i, axis))];
      part = join(part, lights[i]);
    }
    std::array<LightEmission, buckets> above;  // from a bucket on
    above.back() = parts.back();
    for (std::size_t i = buckets - 1; i-- > 0;) above[i] = join(parts[i], above[i + 1]);
    LightEmission below;
    for (std::size_t i = 0; i + 1 < buckets; ++i) {
      below = join(below, parts[i]);
      if (below.box.lower.x > below.box.upper.x || above[i + 1].box.lower.x > above[i + 1].box.upper.x) continue;
      const float both = (cost(below, reach) + cost(above[i + 1], reach)) * (longest / component(size, axis));
      if (both >= least) continue;
      least = both;
      best_axis = axis;
      best_bucket = static_cast<int>(i);
    }
  }
  if (best_axis < 0) return halve(lights, order);
  const auto middle = std::stable_partition(order.begin(), order.end(),
                                            [&](std::uint32_t i) { return bucket_of(i, best_axis) <= best_bucket; });
  return static_cast<std::size_t>(middle - order.begin());
}

/// cos(max(a - b, 0)) and sin(max(a - b, 0)) of two angles.
struct Angle {
  FloatN cosine, sine;
};
Angle less(const Angle& a, const Angle& b) {
  const MaskN none_left = a.cosine >= b.cosine;
  return {select(none_left, FloatN(1), a.cosine * b.cosine + a.sine * b.sine),
          select(none_left, FloatN(0), a.sine * b.cosine - a.cosine * b.sine)};
}
FloatN sine_of(const FloatN& cosine) { return sqrt(max(FloatN(1) - cosine * cosine, FloatN(0))); }

}  // namespace

LightEmission join(const LightEmission& a, const LightEmission& b) {
  if (a.box.lower.x > a.box.upper.x) return b;
  if (b.box.lower.x > b.box.upper.x) return a;
  LightEmission both = a;
  join_cones(both, b);
  both.box = join(a.box, b.box);
  both.power += b.power;
  return both;
}

LightTree::LightTree(const std::vector<LightEmission>& lights, LightSampling sampling, Reach reach,
                     std::size_t leaf_size)
    : sampling_(sampling), reach_(reach), leaf_size_(leaf_size) {
  if (lights.empty()) return;
  std::vector<std::uint32_t> order(lights.size());
  double total = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = static_cast<std::uint32_t>(i);
    total += static_cast<double>(lights[i].power);
  }
  inverse_power_ = static_cast<float>(1 / total);
  trails_.resize(lights.size());
  nodes_.reserve(2 * lights.size() - 1);
  nodes_.resize(1);
  build(lights, order, 0, 0, 0);
}

void LightTree::build(const std::vector<LightEmission>& lights, std::span<std::uint32_t> order, std::size_t node,
                      std::uint32_t trail, int depth) {
  LightEmission all;
  for (const std::uint32_t i : order) all = join(all, lights[i]);
  const float power =
      sampling_ == LightSampling::uniform ? static_cast<float>(order.size()) : all.power * inverse_power_;
  nodes_[node] = {all.box.lower, all.box.upper, packed_cone(all.axis, all.cosine), power, 0};
  if (order.size() <= leaf_size_) {
    nodes_[node].child = std::bit_cast<float>(~leaf_of(order));
    for (const std::uint32_t i : order) trails_[i] = static_cast<std::int32_t>(trail);
    return;
  }
  const bool has_room = depth + static_cast<int>(std::bit_width(order.size())) < most_depth;
  const std::size_t middle = has_room ? cut(lights, reach_, order) : halve(lights, order);
  const std::size_t children = nodes_.size();
  nodes_[node].child = std::bit_cast<float>(static_cast<std::int32_t>(children));
  nodes_.resize(children + 2);
  build(lights, order.first(middle), children, trail, depth + 1);
  build(lights, order.subspan(middle), children + 1, trail | 1U << static_cast<unsigned>(depth), depth + 1);
}

std::int32_t LightTree::leaf_of(std::span<const std::uint32_t> lights) {
  if (leaf_size_ == 1) return static_cast<std::int32_t>(lights[0]);
  const std::size_t number = leaves_.size() / leaf_size_;
  leaves_.insert(leaves_.end(), lights.begin(), lights.end());
  leaves_.resize((number + 1) * leaf_size_, none);
  return static_cast<std::int32_t>(number);
}

FloatN LightTree::importance(const Node<FloatN>& node, const Vec3<FloatN>& p, const Vec3<FloatN>& normal) const {
  if (sampling_ != LightSampling::tree) return node.power;
  const FloatN least(1e-30F);
  const Vec3<FloatN> to_center = (node.lower + node.upper) * FloatN(0.5F) - p;
  const Vec3<FloatN> half = (node.upper - node.lower) * FloatN(0.5F);
  const FloatN squared = max(dot(to_center, to_center), least), radius2 = dot(half, half);
  const Vec3<FloatN> w = to_center * (FloatN(1) / sqrt(squared));
  // What the box covers, and how far at least the surfaces and the point are turned away from each other.
  const FloatN box_sine2 = radius2 / squared;
  const MaskN outside = box_sine2 < FloatN(1);
  const Angle box{select(outside, sqrt(max(FloatN(1) - box_sine2, FloatN(0))), FloatN(-1)),
                  select(outside, sqrt(box_sine2), FloatN(0))};
  const DirectionCone cone = unpacked_cone(node.directions);
  const FloatN leaving = -dot(cone.axis, w), arriving = dot(normal, w);
  const Angle emission = less(less({leaving, sine_of(leaving)}, {cone.cosine, sine_of(cone.cosine)}), box);
  const Angle incidence = less({arriving, sine_of(arriving)}, box);
  const FloatN facing = select(dot(normal, normal) > FloatN(0), max(incidence.cosine, FloatN(0)), FloatN(1));
  FloatN shining = max(emission.cosine, FloatN(0));
  if (reach_ == Reach::cone) {
    // What is on no surface may stand for other points near it.
    const FloatN elsewhere = select(dot(normal, normal) > FloatN(0), FloatN(0), FloatN(0.1F));
    shining = select(emission.cosine >= FloatN(1), FloatN(1), elsewhere);
  }
  return node.power * shining * facing / max(max(squared, radius2), least);
}

LightTree::Pair LightTree::pair(const IntN& children, const Vec3<FloatN>& p, const Vec3<FloatN>& normal,
                                MaskN& reached) const {
  const auto one = gather_records<Node, FloatN>(nodes_.data(), LaneIndices(children));
  const auto two = gather_records<Node, FloatN>(nodes_.data(), LaneIndices(children + IntN(1)));
  const FloatN first = importance(one, p, normal), second = importance(two, p, normal);
  reached = reached & (first + second > FloatN(0));
  return {first / max(first + second, FloatN(1e-38F)), same_bits<IntN>(one.child), same_bits<IntN>(two.child)};
}

LightTree::Choice LightTree::sample(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, FloatN u) const {
  IntN child(std::bit_cast<std::int32_t>(nodes_[0].child));
  FloatN probability(1);
  MaskN reached(true);
  for (MaskN inner = float_mask<FloatN>(child >= IntN(0)); any(inner); inner = float_mask<FloatN>(child >= IntN(0))) {
    MaskN reaches = reached;
    const Pair both = pair(select_lanes(inner, child, IntN(1)), p, normal, reaches);
    reached = reaches | (reached & !inner);
    const MaskN first = u < both.first_share;
    const FloatN taken = select(first, both.first_share, FloatN(1) - both.first_share);
    const FloatN rest = select(first, u, u - both.first_share) / taken;
    u = select(inner, min(rest, FloatN(0x1.fffffep-1F)), u);
    probability = select(inner, probability * taken, probability);
    child = select_lanes(inner, select_lanes(first, both.first_child, both.second_child), child);
  }
  return {IntN(-1) - child, select(reached, probability, FloatN(0)), u};
}

FloatN LightTree::probability(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const IntN& light) const {
  IntN child(std::bit_cast<std::int32_t>(nodes_[0].child)), trail = gather(trails_.data(), light);
  FloatN probability(1);
  MaskN reached(true);
  for (MaskN inner = float_mask<FloatN>(child >= IntN(0)); any(inner); inner = float_mask<FloatN>(child >= IntN(0))) {
    MaskN reaches = reached;
    const Pair both = pair(select_lanes(inner, child, IntN(1)), p, normal, reaches);
    reached = reaches | (reached & !inner);
    const MaskN second = float_mask<FloatN>((trail & IntN(1)) != IntN(0));
    const FloatN taken = select(second, FloatN(1) - both.first_share, both.first_share);
    probability = select(inner, probability * taken, probability);
    child = select_lanes(inner, select_lanes(second, both.second_child, both.first_child), child);
    trail = trail >> 1;
  }
  return select(reached, probability, FloatN(0));
}

}  // namespace raytrace
