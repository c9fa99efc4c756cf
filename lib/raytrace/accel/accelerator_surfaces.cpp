// What lies where rays hit: Accelerator's surfaces.

#include "raytrace/accel/accelerator.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"
#include "raytrace/scene/instance_maps.h"

namespace raytrace {

namespace {

/// Takes the point and its error from the ray, where that is more precise.
template <class F, class KernelType, class Record>
void refine_on_ray(const Record& records, const Ray<F>& rays, const Mask<F>& hit, SurfaceInteraction<F>& result) {
  // Next to a large object, what is precise for it is not for what stands on it, or for its shadow.
  const F threshold = rays.far * F(0x1p-16F);
  const Mask<F> coarse = result.error * result.error > threshold * threshold * dot(rays.direction, rays.direction);
  if (none(coarse & hit)) return;
  const auto on_ray = KernelType::template position_on_ray<F>(records, rays);
  const Mask<F> finer = coarse & (on_ray.error < result.error * F(0.5F));
  result.p = select(finer, on_ray.position, result.p);
  result.error = select(finer, on_ray.error, result.error);
}

/// Adding it changes no number, 0 of either sign included.
Vec3<FloatN> no_offset() { return Vec3<FloatN>(Vec3f(-0.0F, -0.0F, -0.0F)); }

/// The surfaces of one shape, under the wide type of its table's precision: sets p, error, and ng to either side.
template <class Shape>
void set_surface(const ShapeTable<Shape>& table, const LaneIndices& primitive, const Ray<FloatN>& rays,
                 const Hits& hits, SurfaceInteraction<FloatN>& result) {
  const auto set = [&](const SurfacePoint<FloatN>& points) RAYTRACE_INLINE_LAMBDA {
    result.p = points.position;
    result.ng = points.normal;
    result.error = points.error;
  };
  if constexpr (SurfaceOfOne<Shape>) {
    set(Kernel<Shape>::surface(table.records[primitive.first()], rays, rays.far));
    if (primitive.all_same()) return;
    const MaskN others = float_mask<FloatN>(primitive.lanes() != IntN(static_cast<std::int32_t>(primitive.first())));
    for_each_value(primitive.lanes(), others, [&](std::int32_t next, const MaskN& here) {
      const auto& record = table.records[static_cast<std::size_t>(next)];
      set(select(here, Kernel<Shape>::surface(record, rays, rays.far),
                 SurfacePoint<FloatN>{result.p, result.ng, result.error}));
    });
  } else {
    constexpr bool in_float =
        std::is_same_v<typename ShapeTable<Shape>::Record, typename Kernel<Shape>::template Record<float>>;
    using Wide = std::conditional_t<in_float, FloatN, Doubles<FloatN>>;
    const auto records = gather_records<Kernel<Shape>::template Record, Wide>(table.records.data(), primitive);
    if constexpr (EmbreeTriangle<Shape>) {
      set(Kernel<Shape>::template surface<FloatN>(records, hits.u, hits.v));
    } else {
      set(Kernel<Shape>::template surface<FloatN>(records, rays, rays.far));
    }
    if constexpr (requires { Kernel<Shape>::template position_on_ray<FloatN>(records, rays); }) {
      refine_on_ray<FloatN, Kernel<Shape>>(records, rays, hits.hit, result);
    }
  }
}

/// The same of a mesh's faces, and ns, to the side that fits ng when it is the viewer's.
void set_surface(const MeshTable& mesh, const IntN& faces, const Ray<FloatN>& rays, const Hits& hits,
                 SurfaceInteraction<FloatN>& result) {
  const LaneTriangles triangles = mesh.triangles(faces, hits);
  const auto records = mesh.records(triangles);
  const SurfacePoint<FloatN> points = Kernel<Triangle>::surface<FloatN>(records, triangles.u, triangles.v);
  result.p = points.position;
  result.ng = points.normal;
  result.error = points.error;
  refine_on_ray<FloatN, Kernel<Triangle>>(records, rays, hits.hit, result);
  result.front = dot(result.ng, rays.direction) < FloatN(0);
  result.ng = select(dot(result.ng, rays.direction) > FloatN(0), -result.ng, result.ng);
  if (!mesh.is_smooth()) return;

  struct Corner {
    Vec3<FloatN> normal;
    const Vec3<FloatN>& position;
    FloatN weight;
  };
  const Corner corners[] = {{mesh.normal(triangles.vertex1), records.vertex1, FloatN(1) - triangles.u - triangles.v},
                            {mesh.normal(triangles.vertex2), records.vertex2, triangles.u},
                            {mesh.normal(triangles.vertex3), records.vertex3, triangles.v}};
  Vec3<FloatN> normal = corners[0].normal * corners[0].weight + corners[1].normal * corners[1].weight +
                        corners[2].normal * corners[2].weight;
  const FloatN side = select(dot(normal, result.ng) < FloatN(0), FloatN(-1), FloatN(1));
  const FloatN squared_length = dot(normal, normal);
  const MaskN has_normal = squared_length > FloatN(1e-12F);
  result.ns = select(has_normal, normal * (side / sqrt(squared_length)), result.ng);
  result.is_smooth = true;
  Vec3<FloatN> below(Vec3f(0, 0, 0));
  for (const Corner& corner : corners) {
    const FloatN height = min(dot(result.p - corner.position, corner.normal) * side, FloatN(0));
    below += corner.normal * (corner.weight * height * side);
  }
  result.to_smooth_surface = select(has_normal, -below, no_offset());
}

}  // namespace

SurfaceInteraction<FloatN> Accelerator::surface(const Ray<FloatN>& rays, const Hits& hits) const {
  SurfaceInteraction<FloatN> result;  // set in all lanes, but for those without a hit
  const auto set = [&](const GeometryTable& table, std::uint32_t geometry, const LaneIndices& primitive,
                       const Ray<FloatN>& local_rays, const MaskN& lanes, SurfaceInteraction<FloatN>& surface) {
    if (const CurveTable* const curves = table.geometry(geometry).curves; curves != nullptr) {
      curves->set_surface(primitive.lanes(), local_rays, lanes, surface);
      surface.is_smooth = true;
      surface.to_smooth_surface = no_offset();
      return;
    }
    if (const MeshTable* const mesh = table.geometry(geometry).mesh; mesh != nullptr) {
      set_surface(*mesh, primitive.lanes(), local_rays, hits, surface);
      return;
    }
    with_type(Shapes{}, geometry, [&]<class Shape>(std::type_identity<Shape>) {
      set_surface<Shape>(table.table<Shape>(), primitive, local_rays, hits, surface);
    });
    surface.front = dot(surface.ng, local_rays.direction) < FloatN(0);
  };
  if (hits.one_primitive) {
    set(table_, hits.first_geometry, LaneIndices(hits.first_primitive), rays, hits.hit, result);
  } else {
    SurfaceInteraction<FloatN> other;
    result.p = result.ng = Vec3<FloatN>(Vec3f(0, 0, 0));
    result.error = FloatN(0);
    result.front = MaskN(false);
    Ray<FloatN> local_rays = rays;
    if (hits.in_instances) local_rays = in_instances(rays, hits);
    table_.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
      // The other lanes follow the first of these, so that they read a record that exists, and no further ones.
      const std::size_t first = first_lane(here);
      const IntN primitive = select_lanes(here, hits.primitive, IntN(hits.primitive.get(first)));
      other.is_smooth = false;
      set(table, geometry, primitive, local_rays, here, other);
      if (other.is_smooth) {
        if (!result.is_smooth) {
          result.ns = Vec3<FloatN>(Vec3f(0, 0, 0));  // 0: the lane has none
          result.to_smooth_surface = no_offset();
          result.is_smooth = true;
        }
        result.ns = select(here, other.ns, result.ns);
        result.to_smooth_surface = select(here, other.to_smooth_surface, result.to_smooth_surface);
      }
      result.p = select(here, other.p, result.p);
      result.ng = select(here, other.ng, result.ng);
      result.front = (other.front & here) | (result.front & !here);
      result.error = select(here, other.error, result.error);
    });
    if (hits.in_instances) to_world(hits, result);
  }
  result.ng = select(dot(result.ng, rays.direction) > FloatN(0), -result.ng, result.ng);
  if (result.is_smooth) {
    const MaskN has_normal = dot(result.ns, result.ns) > FloatN(0);
    result.ns = select(has_normal, result.ns, result.ng);
  } else {
    result.ns = result.ng;
  }
  result.wo = -rays.direction;
  return result;
}

Ray<FloatN> Accelerator::in_instances(const Ray<FloatN>& rays, const Hits& hits) const {
  const MaskN inside = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
  const auto affine = table_.instances().object_from_world(select_lanes(inside, hits.instance, UintN(0u)), hits.time);
  Ray<FloatN> local = rays;
  local.origin = select(inside, apply_point(affine, rays.origin), rays.origin);
  local.direction = select(inside, apply_vector(affine, rays.direction), rays.direction);
  return local;
}

void Accelerator::to_world(const Hits& hits, SurfaceInteraction<FloatN>& surface) const {
  const MaskN inside = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
  const UintN number = select_lanes(inside, hits.instance, UintN(0u));
  const InstanceMaps maps = maps_of(table_.instances(), number, hits.time);
  const Vec3<FloatN> p = apply_point(maps.world_from_object, surface.p);
  const FloatN error = maps.error(surface.p, surface.error, p);
  surface.ng = select(inside, maps.normal_to_world(surface.ng), surface.ng);
  if (surface.is_smooth) {
    surface.ns = select(inside, maps.normal_to_world(surface.ns), surface.ns);
    surface.to_smooth_surface =
        select(inside, apply_vector(maps.world_from_object, surface.to_smooth_surface), surface.to_smooth_surface);
  }
  surface.p = select(inside, p, surface.p);
  surface.error = select(inside, error, surface.error);
}

}  // namespace raytrace
