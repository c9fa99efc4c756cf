#include "raytrace/accel/few_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "raytrace/accel/intersect_object.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"

namespace raytrace {

namespace {

/// Up to about so many, all tests take less time than Embree's queries.
constexpr std::size_t most_objects = 4 * packet_lanes;

/// How far the tests' roundings carry beyond a box, of the largest coordinate of either.
constexpr float box_margin = 0x1p-19F;

float largest_coordinate(const Bounds& box) {
  return std::max({std::abs(box.lower.x), std::abs(box.lower.y), std::abs(box.lower.z), std::abs(box.upper.x),
                   std::abs(box.upper.y), std::abs(box.upper.z)});
}

template <class Shape>
concept HasPairs = std::is_same_v<Shape, Sphere> || EmbreeTriangle<Shape>;

/// Which boxes the rays of a packet meet.
class BoxTest {
 public:
  explicit BoxTest(const Ray<FloatN>& rays) : near_(rays.near) {
    const FloatN margin = largest_component(rays.origin) * FloatN(box_margin);
    // No component is 0, so that no product is undefined.
    const auto inverse = [least = FloatN(1e-18F)](const FloatN& d) {
      return FloatN(1) / select(abs(d) < least, select(d < FloatN(0), -least, least), d);
    };
    inverse_ = {inverse(rays.direction.x), inverse(rays.direction.y), inverse(rays.direction.z)};
    const auto at_origin = [](const Vec3<FloatN>& o, const FloatN& moved, const Vec3<FloatN>& d) {
      return Vec3<FloatN>(-(o.x + moved) * d.x, -(o.y + moved) * d.y, -(o.z + moved) * d.z);
    };
    from_lower_ = at_origin(rays.origin, margin, inverse_);
    from_upper_ = at_origin(rays.origin, -margin, inverse_);
  }

  /// All that do before `far`, and perhaps some that pass it by.
  RAYTRACE_INLINE MaskN meets(const Bounds& box, const FloatN& far) const {
    const FloatN x0 = multiply_add(FloatN(box.lower.x), inverse_.x, from_lower_.x);
    const FloatN y0 = multiply_add(FloatN(box.lower.y), inverse_.y, from_lower_.y);
    const FloatN z0 = multiply_add(FloatN(box.lower.z), inverse_.z, from_lower_.z);
    const FloatN x1 = multiply_add(FloatN(box.upper.x), inverse_.x, from_upper_.x);
    const FloatN y1 = multiply_add(FloatN(box.upper.y), inverse_.y, from_upper_.y);
    const FloatN z1 = multiply_add(FloatN(box.upper.z), inverse_.z, from_upper_.z);
    const FloatN entry = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), near_));
    const FloatN exit = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), far));
    return entry <= exit * FloatN(1 + box_margin);
  }

 private:
  FloatN near_;
  Vec3<FloatN> inverse_;
  Vec3<FloatN> from_lower_, from_upper_;  ///< where planes through 0 are on the rays, moved outwards for either edge
};

template <class T>
struct RayRecord {
  Vec3<T> origin, direction;
  T near, far;
};

/// Rays of a packet and objects of one type, until there are enough for a packet of pairs.
class Pairs {
 public:
  explicit Pairs(const Ray<FloatN>& rays) {
    constexpr std::int32_t fields = sizeof(RayRecord<float>) / sizeof(float);
    const RayRecord<FloatN> records{rays.origin, rays.direction, rays.near, rays.far};
    alignas(64) std::array<std::int32_t, packet_lanes> offsets;
    (lane_numbers<IntN>() * IntN(fields)).store_aligned(offsets.data());
    scatter_fields(reinterpret_cast<const FloatN*>(&records), fields, reinterpret_cast<float*>(rays_.data()),
                   offsets.data());
  }

  /// As far as the ray of that lane is followed from now on.
  void set_far(std::size_t lane, float far) { rays_[lane].far = far; }

  /// Of pair i of those that are tested: the ray's lane, and the object's number.
  std::size_t lane(std::size_t i) const { return static_cast<std::size_t>(lanes_[i]); }
  std::size_t object(std::size_t i) const { return static_cast<std::size_t>(objects_[i]); }

  /// Calls test(rays, objects, valid) for packets of pairs, of each object and the rays that meets(its number) says.
  template <template <class> class Record, class Meets, class Test>
  void for_each_packet(const std::vector<Record<float>>& objects, const Meets& meets, const Test& test) {
    const auto test_first = [&](std::size_t pairs) {
      // Lanes beyond the last pair follow the first one.
      std::fill(lanes_.begin() + pairs, lanes_.begin() + packet_lanes, lanes_[0]);
      std::fill(objects_.begin() + pairs, objects_.begin() + packet_lanes, objects_[0]);
      const auto rays = gather_records<RayRecord, FloatN>(rays_.data(), LaneIndices(IntN::load_aligned(lanes_.data())));
      test(Ray<FloatN>{rays.origin, rays.direction, rays.near, rays.far},
           gather_records<Record, FloatN>(objects.data(), LaneIndices(IntN::load_aligned(objects_.data()))),
           first_lanes<FloatN>(static_cast<int>(pairs)));
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      for (const std::size_t lane : SetLanes(meets(i))) {
        lanes_[count] = static_cast<std::int32_t>(lane);
        objects_[count++] = static_cast<std::int32_t>(i);
      }
      if (count < packet_lanes) continue;
      test_first(packet_lanes);
      count -= packet_lanes;
      std::copy_n(lanes_.begin() + packet_lanes, count, lanes_.begin());
      std::copy_n(objects_.begin() + packet_lanes, count, objects_.begin());
    }
    if (count > 0) test_first(count);
  }

 private:
  alignas(64) std::array<RayRecord<float>, packet_lanes> rays_;
  alignas(64) std::array<std::int32_t, 2 * packet_lanes> lanes_, objects_;
};

}  // namespace

FewObjects::FewObjects(const GeometryTable& table) : table_(table) {
  if (!table.instances().empty() || table.has_curves() || table.primitive_count() > most_objects) return;
  add_shapes<Sphere>();
  spheres_ = table.table<Sphere>().records;
  add_shapes<Triangle>();
  triangles_ = table.table<Triangle>().records;
  for (std::uint32_t i = Shapes::size; i < table.geometries().size(); ++i) add_mesh(i);
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    if constexpr (!UnboundedShape<Shape> && !HasPairs<Shape>) add_shapes<Shape>();
  });
  // Embree leaves out what is larger, or has no numbers.
  const auto fits = [](const Bounds& box) { return largest_coordinate(box) < 1.8e18F; };
  if (boxes_.size() > most_objects || !std::all_of(boxes_.begin(), boxes_.end(), fits)) boxes_.clear();
}

template <class Shape>
void FewObjects::add_shapes() {
  const auto& records = table_.table<Shape>().records;
  for (std::size_t i = 0; i < records.size(); ++i)
    add(Kernel<Shape>::bounds(records[i]), static_cast<std::uint32_t>(index_of<Shape>(Shapes{})), i);
}

void FewObjects::add_mesh(std::uint32_t geometry) {
  const MeshTable& mesh = *table_.geometry(geometry).mesh;
  for (std::size_t face = 0; face < mesh.face_count(); ++face)
    for (int i = 0; i < mesh.corners() - 2; ++i) {
      triangles_.push_back(mesh.triangle(face, i == 1));
      add(Kernel<Triangle>::bounds(triangles_.back()), geometry, face, i == 1);
    }
}

void FewObjects::add(const Bounds& box, std::uint32_t geometry, std::size_t primitive, bool second_triangle) {
  const float margin = largest_coordinate(box) * box_margin;
  const Vec3f margins(margin, margin, margin);
  boxes_.push_back({box.lower - margins, box.upper + margins});
  ids_.push_back({geometry, static_cast<std::uint32_t>(primitive), second_triangle});
}

template <class Meets, class Function>
bool FewObjects::for_each_other(const Meets& meets, const Function& f) const {
  for (std::size_t i = spheres_.size() + triangles_.size(); i < boxes_.size(); ++i) {
    const MaskN lanes = meets(i);
    if (none(lanes)) continue;
    const Id& id = ids_[i];
    bool goes_on = true;
    with_type(Shapes{}, id.geometry, [&]<class Shape>(std::type_identity<Shape> type) {
      if constexpr (!UnboundedShape<Shape> && !HasPairs<Shape>)
        goes_on = f(type, table_.table<Shape>().records[id.primitive], id.primitive, lanes);
    });
    if (!goes_on) return false;
  }
  return true;
}

/// The nearest hits so far, in memory.
struct FewObjects::NearestOfLanes {
  alignas(64) std::array<float, packet_lanes> distance, u, v;
  alignas(64) std::array<std::uint32_t, packet_lanes> geometry;
  alignas(64) std::array<std::int32_t, packet_lanes> primitive;
  std::uint32_t hit;

  NearestOfLanes(const FloatN& nearest, const Hits& hits) : hit(bits_of<FloatN>(hits.hit)) {
    nearest.store_aligned(distance.data());
    hits.u.store_aligned(u.data());
    hits.v.store_aligned(v.data());
    hits.geometry.store_aligned(geometry.data());
    hits.primitive.store_aligned(primitive.data());
  }

  /// Keeps the hit if it comes first, as comes_first() has it, and says so.
  bool keep(std::size_t lane, float t, float u_there, float v_there, const Id& id) {
    if (t > distance[lane]) return false;
    if (t == distance[lane]) {
      const auto nearest = static_cast<std::uint32_t>(primitive[lane]);
      if ((hit >> lane & 1) == 0 || id.geometry > geometry[lane]) return false;
      if (id.geometry == geometry[lane] && id.primitive >= nearest) return false;
    }
    hit |= std::uint32_t{1} << lane;
    distance[lane] = t;
    geometry[lane] = id.geometry;
    primitive[lane] = static_cast<std::int32_t>(id.primitive);
    u[lane] = id.second_triangle ? 1 - u_there : u_there;
    v[lane] = id.second_triangle ? 1 - v_there : v_there;
    return true;
  }

  void put_back(FloatN& nearest, Hits& hits) const {
    nearest = FloatN::load_aligned(distance.data());
    hits.u = FloatN::load_aligned(u.data());
    hits.v = FloatN::load_aligned(v.data());
    hits.geometry = UintN::load_aligned(geometry.data());
    hits.primitive = IntN::load_aligned(primitive.data());
    hits.hit = float_mask<FloatN>(hits.geometry != UintN(RTC_INVALID_GEOMETRY_ID));
  }
};

void FewObjects::intersect(Ray<FloatN>& rays, const MaskN& active, FloatN& distance, Hits& hits) const {
  const BoxTest test(rays);
  const auto meets = [&](std::size_t box) RAYTRACE_INLINE_LAMBDA { return active & test.meets(boxes_[box], rays.far); };
  for_each_other(meets, [&]<class Shape>(std::type_identity<Shape>, const auto& record, std::uint32_t primitive,
                                         const MaskN& lanes) {
    intersect_object<Shape>(record, primitive, rays, lanes, {hits, distance, rays.far});
    return true;
  });
  if (spheres_.empty() && triangles_.empty()) return;
  Pairs pairs(rays);
  NearestOfLanes nearest(distance, hits);
  const auto keep = [&](const FloatN& t, const FloatN& u, const FloatN& v, std::size_t first_id) {
    const MaskN hit = t < infinity<FloatN>();
    if (none(hit)) return;
    alignas(64) std::array<float, packet_lanes> ts, us, vs;
    t.store_aligned(ts.data());
    u.store_aligned(us.data());
    v.store_aligned(vs.data());
    for (const std::size_t i : SetLanes(hit))
      if (nearest.keep(pairs.lane(i), ts[i], us[i], vs[i], ids_[first_id + pairs.object(i)]))
        pairs.set_far(pairs.lane(i), behind(ts[i]));
  };
  pairs.for_each_packet(spheres_, meets, [&](const Ray<FloatN>& some, const auto& spheres, const MaskN& valid) {
    keep(Kernel<Sphere>::intersect<FloatN>(spheres, some, valid), FloatN(0), FloatN(0), 0);
  });
  const std::size_t first = spheres_.size();
  pairs.for_each_packet(
      triangles_, [&](std::size_t i) RAYTRACE_INLINE_LAMBDA { return meets(first + i); },
      [&](const Ray<FloatN>& some, const auto& triangles, const MaskN& valid) {
        FloatN u(0), v(0);
        const FloatN t = Kernel<Triangle>::intersect<FloatN>(triangles, some, valid, u, v);
        keep(t, u, v, first);
      });
  nearest.put_back(distance, hits);
}

MaskN FewObjects::occluded(const Ray<FloatN>& rays, const MaskN& active) const {
  const Ray<FloatN> followed{rays.origin, rays.direction, max(rays.near, FloatN(0)), rays.far};
  const BoxTest test(followed);
  MaskN open = active;
  const auto meets = [&](std::size_t box) RAYTRACE_INLINE_LAMBDA { return open & test.meets(boxes_[box], rays.far); };
  if (!for_each_other(
          meets, [&]<class Shape>(std::type_identity<Shape>, const auto& record, std::uint32_t, const MaskN& lanes) {
            open = open & !occludes<Shape>(record, followed, lanes);
            return any(open);
          }))
    return active;
  if (spheres_.empty() && triangles_.empty()) return active & !open;
  Pairs pairs(followed);
  alignas(64) std::array<std::uint32_t, packet_lanes> hidden{};
  const auto hide = [&](const MaskN& hit) {
    for (const std::size_t i : SetLanes(hit)) hidden[pairs.lane(i)] = 1;
    open = open & float_mask<FloatN>(UintN::load_aligned(hidden.data()) == UintN(0u));
  };
  pairs.for_each_packet(spheres_, meets, [&](const Ray<FloatN>& some, const auto& spheres, const MaskN& valid) {
    hide(occludes<Sphere>(spheres, some, valid));
  });
  const std::size_t first = spheres_.size();
  pairs.for_each_packet(
      triangles_, [&](std::size_t i) RAYTRACE_INLINE_LAMBDA { return meets(first + i); },
      [&](const Ray<FloatN>& some, const auto& triangles, const MaskN& valid) {
        hide(occludes<Triangle>(triangles, some, valid));
      });
  return active & !open;
}

}  // namespace raytrace
