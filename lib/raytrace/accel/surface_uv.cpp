#include "raytrace/accel/surface_uv.h"

#include <bit>
#include <type_traits>

#include "raytrace/math/doubles.h"
#include "raytrace/math/gather.h"

namespace raytrace {

namespace {

/// Sets those of the lanes of `here`, which hit one shape.
template <class Shape>
void set_uv(const ShapeTable<Shape>& table, const MaskN& here, const Hits& hits,
            const SurfaceInteraction<FloatN>& surface, SurfaceUv<FloatN>& result) {
  // The other lanes follow the first of these, so that they read a record that exists.
  const auto first = [&](const MaskN& lanes) {
    return hits.primitive.get(static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(lanes))));
  };
  if constexpr (SurfaceOfOne<Shape>) {
    for (MaskN left = here; any(left);) {
      const std::int32_t next = first(left);
      const MaskN same = left & float_mask<FloatN>(hits.primitive == IntN(next));
      const auto& record = table.records[static_cast<std::size_t>(next)];
      result = select<FloatN>(same, Kernel<Shape>::template uv<FloatN>(record, surface.p, surface.ng), result);
      left = left & !same;
    }
  } else {
    constexpr bool in_float =
        std::is_same_v<typename ShapeTable<Shape>::Record, typename Kernel<Shape>::template Record<float>>;
    using Wide = std::conditional_t<in_float, FloatN, Doubles<FloatN>>;
    const IntN primitive = select_lanes(here, hits.primitive, IntN(first(here)));
    const auto records = gather_records<Kernel<Shape>::template Record, Wide>(table.records.data(), primitive);
    if constexpr (EmbreeTriangle<Shape>) {
      const SurfaceUv<FloatN> own = Kernel<Shape>::template uv<FloatN>(records, hits.u, hits.v);
      result = select<FloatN>(here, own, result);
    } else {
      result = select<FloatN>(here, Kernel<Shape>::template uv<FloatN>(records, surface.p, surface.ng), result);
    }
  }
}

SurfaceUv<FloatN> surface_uv(const GeometryTable& world, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                             UvSet set) {
  const FloatN zero(0);
  SurfaceUv<FloatN> result{zero, zero, {zero, zero, zero}, {zero, zero, zero}};
  const MaskN in_instance = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
  const UintN instance = select_lanes(in_instance, hits.instance, UintN(0u));
  SurfaceInteraction<FloatN> local = surface;
  if (hits.in_instances) {
    const auto to_world = world.instances().world_from_object(instance, hits.time);
    const Vec3<FloatN>& n = surface.ng;
    const Vec3<FloatN> normal{dot(to_world.x, n), dot(to_world.y, n), dot(to_world.z, n)};
    local.p = select(in_instance, apply_point(world.instances().object_from_world(instance, hits.time), surface.p),
                     surface.p);
    local.ng = select(in_instance, normalize(normal), n);
  }
  world.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    if (const MeshTable* const mesh = table.geometry(geometry).mesh; mesh != nullptr) {
      const IntN other(hits.primitive.get(static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(here)))));
      const LaneTriangles triangles = mesh->triangles(select_lanes(here, hits.primitive, other), hits);
      result = select<FloatN>(here, mesh->uv(triangles, set), result);
      return;
    }
    with_type(Shapes{}, geometry, [&]<class Shape>(std::type_identity<Shape>) {
      set_uv<Shape>(table.table<Shape>(), here, hits, local, result);
    });
  });
  if (hits.in_instances) {
    const auto world_from_object = world.instances().world_from_object(instance, hits.time);
    result.dpdu = select(in_instance, apply_vector(world_from_object, result.dpdu), result.dpdu);
    result.dpdv = select(in_instance, apply_vector(world_from_object, result.dpdv), result.dpdv);
  }
  return result;
}

Rgb<FloatN> vertex_color(const GeometryTable& world, const Hits& hits) {
  Rgb<FloatN> result(Rgb<float>(1, 1, 1));
  if (world.has_shapes_only() && !world.has_clouds()) return result;
  world.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    if (geometry == index_of<Sphere>(Shapes{})) {
      table.for_each_cloud(hits.primitive, here, [&](const CloudSpheres& cloud, const MaskN& lanes) {
        const float* const colors = cloud.data->colors.data();
        if (colors == nullptr) return;
        const IntN red = select_lanes(lanes, hits.primitive - IntN(cloud.first), IntN(0)) * IntN(3);
        result = select(lanes, {gather(colors, red), gather(colors + 1, red), gather(colors + 2, red)}, result);
      });
      return;
    }
    const MeshTable* const mesh = table.geometry(geometry).mesh;
    if (mesh == nullptr || !mesh->has_colors()) return;
    const IntN other(hits.primitive.get(static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(here)))));
    const LaneTriangles triangles = mesh->triangles(select_lanes(here, hits.primitive, other), hits);
    result = select(here, mesh->color(triangles), result);
  });
  return result;
}

/// What u and v change by along a way on the surface; 1, more than there is, where they say nothing, as at a pole.
Vec2<FloatN> uv_along(const SurfaceUv<FloatN>& uv, const Vec3<FloatN>& way) {
  // By unit vectors, so that no product of large objects' overflows.
  const FloatN u_scale = FloatN(1) / length(uv.dpdu), v_scale = FloatN(1) / length(uv.dpdv);
  const Vec3<FloatN> u = uv.dpdu * u_scale, v = uv.dpdv * v_scale, normal = cross(u, v);
  const FloatN area = dot(normal, normal);
  const MaskN fine = area > FloatN(0);
  const FloatN scale = FloatN(1) / area;
  return {select(fine, dot(cross(way, v), normal) * scale * u_scale, FloatN(1)),
          select(fine, dot(cross(u, way), normal) * scale * v_scale, FloatN(1))};
}

}  // namespace

TexturePoint<FloatN> texture_point(const SceneTables& scene, const FloatN& radius, const Hits& hits,
                                   const SurfaceInteraction<FloatN>& surface) {
  // Stretched on the surface along the view, but not without end.
  const FloatN cosine = dot(surface.ng, surface.wo);
  const Vec3<FloatN> view = surface.wo - surface.ng * cosine;
  const FloatN sine = length(view);
  const MaskN slanted = sine > FloatN(1e-4F);
  const MaskN upright = abs(surface.ng.z) > FloatN(0.5F);
  const Vec3<FloatN> x(Vec3f(1, 0, 0)), z(Vec3f(0, 0, 1));
  const Vec3<FloatN> along =
      normalize(select(slanted, view * (FloatN(1) / sine), cross(surface.ng, select(upright, x, z))));
  TexturePoint<FloatN> point;
  point.p = surface.p;
  const Vec3d& origin = scene.origin();
  if (origin.x != 0 || origin.y != 0 || origin.z != 0) {
    using D = Doubles<FloatN>;
    point.p = to_float(Vec3<D>(surface.p) + Vec3<D>(origin));
  }
  point.p_across = cross(surface.ng, along) * radius;
  point.p_along = along * (radius / max(cosine, FloatN(1e-3F)));
  const auto on_surface = [&](UvSet set) -> UvPoint<FloatN> {
    const SurfaceUv<FloatN> uv = surface_uv(scene.geometry(), hits, surface, set);
    return {{uv.u, uv.v}, uv_along(uv, point.p_across), uv_along(uv, point.p_along), uv.dpdu, uv.dpdv};
  };
  point.by(UvSet::first) = on_surface(UvSet::first);
  if (scene.has_second_uvset()) [[unlikely]]
    point.second = on_surface(UvSet::second);
  point.vertex_color = vertex_color(scene.geometry(), hits);
  return point;
}

}  // namespace raytrace
