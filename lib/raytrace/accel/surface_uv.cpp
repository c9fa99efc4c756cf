#include "raytrace/accel/surface_uv.h"

#include <type_traits>

#include "raytrace/math/doubles.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"

namespace raytrace {

namespace {

/// A point of a surface, before a map to the world.
struct LocalPoint {
  Vec3<FloatN> p, ng;
};

LocalPoint local_point(const AffineRecord<FloatN>& world_from_object, const AffineRecord<FloatN>& object_from_world,
                       const LocalPoint& point) {
  const Vec3<FloatN>& n = point.ng;
  return {
      apply_point(object_from_world, point.p),
      normalize(Vec3<FloatN>(dot(world_from_object.x, n), dot(world_from_object.y, n), dot(world_from_object.z, n)))};
}

void move_derivatives(const AffineRecord<FloatN>& world_from_object, const MaskN& here, SurfaceUv<FloatN>& uv) {
  uv.dpdu = select(here, apply_vector(world_from_object, uv.dpdu), uv.dpdu);
  uv.dpdv = select(here, apply_vector(world_from_object, uv.dpdv), uv.dpdv);
}

/// index, in the lanes of `here`; the others have that of the first of these, so that they read a record that exists.
IntN follow_first(const MaskN& here, const IntN& index) {
  return select_lanes(here, index, IntN(index.get(first_lane(here))));
}

/// Sets those of the lanes of `here`, which hit records of one shape.
template <class Shape, class Record>
void set_uv(const std::vector<Record>& all, const IntN& index, const MaskN& here, const Hits& hits,
            const LocalPoint& point, SurfaceUv<FloatN>& result) {
  if constexpr (SurfaceOfOne<Shape>) {
    for (MaskN left = here; any(left);) {
      const std::int32_t next = follow_first(left, index).get(0);
      const MaskN same = left & float_mask<FloatN>(index == IntN(next));
      const auto& record = all[static_cast<std::size_t>(next)];
      result = select<FloatN>(same, Kernel<Shape>::template uv<FloatN>(record, point.p, point.ng), result);
      left = left & !same;
    }
  } else {
    constexpr bool in_float = std::is_same_v<Record, typename Kernel<Shape>::template Record<float>>;
    using Wide = std::conditional_t<in_float, FloatN, Doubles<FloatN>>;
    const auto records = gather_records<Kernel<Shape>::template Record, Wide>(all.data(), follow_first(here, index));
    if constexpr (EmbreeTriangle<Shape>) {
      result = select<FloatN>(here, Kernel<Shape>::template uv<FloatN>(records, hits.u, hits.v), result);
    } else {
      result = select<FloatN>(here, Kernel<Shape>::template uv<FloatN>(records, point.p, point.ng), result);
    }
  }
}

/// The same of objects, some of which may have had a transform.
template <class Shape>
void set_uv(const ShapeTable<Shape>& table, const MaskN& here, const Hits& hits, const LocalPoint& point,
            SurfaceUv<FloatN>& result) {
  const auto& frames = table.uv_frames;
  MaskN moved(false);
  if (!frames.empty()) {
    const IntN frame = gather(frames.of_object.data(), follow_first(here, hits.primitive));
    moved = here & float_mask<FloatN>(frame >= IntN(0));
    if (any(moved)) {
      const LaneIndices index(follow_first(moved, frame));
      const auto to_world = gather_records<AffineRecord, FloatN>(frames.world_from_object.data(), index);
      const auto to_object = gather_records<AffineRecord, FloatN>(frames.object_from_world.data(), index);
      Hits before = hits;
      if constexpr (EmbreeTriangle<Shape>) {  // corners of mirrored ones have changed places
        const MaskN mirrored = dot(to_world.x, cross(to_world.y, to_world.z)) < FloatN(0);
        before.u = select(mirrored, hits.v, hits.u);
        before.v = select(mirrored, hits.u, hits.v);
      }
      set_uv<Shape>(frames.records, frame, moved, before, local_point(to_world, to_object, point), result);
      move_derivatives(to_world, moved, result);
    }
  }
  if (const MaskN rest = here & !moved; any(rest))
    set_uv<Shape>(table.records, hits.primitive, rest, hits, point, result);
}

SurfaceUv<FloatN> surface_uv(const GeometryTable& world, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                             UvSet set) {
  const FloatN zero(0);
  SurfaceUv<FloatN> result{zero, zero, {zero, zero, zero}, {zero, zero, zero}};
  const MaskN in_instance = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
  const UintN instance = select_lanes(in_instance, hits.instance, UintN(0u));
  LocalPoint point{surface.p, surface.ng};
  if (hits.in_instances) {
    const LocalPoint in_object = local_point(world.instances().world_from_object(instance, hits.time),
                                             world.instances().object_from_world(instance, hits.time), point);
    point = {select(in_instance, in_object.p, point.p), select(in_instance, in_object.ng, point.ng)};
  }
  world.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    if (const MeshTable* const mesh = table.geometry(geometry).mesh; mesh != nullptr) {
      const LaneTriangles triangles = mesh->triangles(follow_first(here, hits.primitive), hits);
      result = select<FloatN>(here, mesh->uv(triangles, set), result);
      return;
    }
    if (const CurveTable* const curves = table.geometry(geometry).curves; curves != nullptr) {
      result = select<FloatN>(here, curves->uv(hits.primitive, point.p, here), result);
      return;
    }
    with_type(Shapes{}, geometry, [&]<class Shape>(std::type_identity<Shape>) {
      set_uv<Shape>(table.table<Shape>(), here, hits, point, result);
    });
  });
  if (hits.in_instances)
    move_derivatives(world.instances().world_from_object(instance, hits.time), in_instance, result);
  return result;
}

/// Sets them where meshes have them at vertices.
void set_vertex_tangents(const GeometryTable& world, const Hits& hits, UvSet set, UvPoint<FloatN>& point) {
  const Vec3<FloatN> zero(Vec3f(0, 0, 0));
  MeshTable::Tangents tangents{zero, zero};
  world.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    const MeshTable* const mesh = table.geometry(geometry).mesh;
    if (mesh == nullptr || !mesh->has_tangents(set)) return;
    const auto [u, v] = mesh->tangents(mesh->triangles(follow_first(here, hits.primitive), hits), set);
    tangents = {select(here, u, tangents.u), select(here, v, tangents.v)};
  });
  const MaskN found = dot(tangents.u, tangents.u) > FloatN(0);
  if (!any(found)) return;
  if (hits.in_instances) {
    const MaskN in_instance = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
    const auto map =
        world.instances().world_from_object(select_lanes(in_instance, hits.instance, UintN(0u)), hits.time);
    tangents = {select(in_instance, apply_vector(map, tangents.u), tangents.u),
                select(in_instance, apply_vector(map, tangents.v), tangents.v)};
  }
  point.tangent = select(found, tangents.u, point.tangent);
  point.bitangent = select(found, tangents.v, point.bitangent);
}

SpacePoint<FloatN> mapped(const AffineRecord<FloatN>& map, const SpacePoint<FloatN>& point) {
  return {apply_point(map, point.p), apply_vector(map, point.p_across), apply_vector(map, point.p_along)};
}

void set(SpacePoint<FloatN>& point, const MaskN& here, const SpacePoint<FloatN>& value) {
  point = {select(here, value.p, point.p), select(here, value.p_across, point.p_across),
           select(here, value.p_along, point.p_along)};
}

/// Before all transforms. point: in the space of the tables, which begins at the scene's origin.
SpacePoint<FloatN> in_object(const GeometryTable& world, const Hits& hits, SpacePoint<FloatN> point) {
  const MaskN in_instance = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u));
  if (hits.in_instances)
    set(point, in_instance,
        mapped(world.instances().object_from_world(select_lanes(in_instance, hits.instance, UintN(0u)), hits.time),
               point));
  const auto map_of_all = [](const AffineRecord<float>& map) {
    return gather_records<AffineRecord, FloatN>(&map, LaneIndices(0));
  };
  world.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    if (const MeshTable* const mesh = table.geometry(geometry).mesh; mesh != nullptr) {
      set(point, here, mapped(map_of_all(mesh->object_from_world()), point));
      return;
    }
    if (const CurveTable* const curves = table.geometry(geometry).curves; curves != nullptr) {
      set(point, here, mapped(map_of_all(curves->object_from_world()), point));
      return;
    }
    with_type(Shapes{}, geometry, [&]<class Shape>(std::type_identity<Shape>) {
      const auto& frames = table.table<Shape>().uv_frames;
      if (frames.empty()) return;
      const IntN frame = gather(frames.of_object.data(), follow_first(here, hits.primitive));
      const MaskN framed = here & float_mask<FloatN>(frame >= IntN(0));
      if (none(framed)) return;
      const LaneIndices index(follow_first(framed, frame));
      SpacePoint<FloatN> before =
          mapped(gather_records<AffineRecord, FloatN>(frames.object_from_world.data(), index), point);
      before.p += gather_records<Vec3, FloatN>(frames.origins.data(), index);
      set(point, framed, before);
    });
    if (geometry == index_of<Sphere>(Shapes{}))
      table.for_each_cloud(hits.primitive, here, [&](const CloudSpheres& cloud, const MaskN& lanes) {
        set(point, lanes, mapped(map_of_all(cloud.object_from_world), point));
      });
  });
  if (hits.in_instances && world.instances().has_places_in_files())
    set(point, in_instance,
        mapped(world.instances().file_from_object(select_lanes(in_instance, hits.instance, UintN(0u))), point));
  return point;
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
    if (const CurveTable* const curves = table.geometry(geometry).curves; curves != nullptr && curves->has_colors()) {
      result = select(here, curves->color(hits.primitive, hits.u, here), result);
      return;
    }
    const MeshTable* const mesh = table.geometry(geometry).mesh;
    if (mesh == nullptr || !mesh->has_colors()) return;
    const LaneTriangles triangles = mesh->triangles(follow_first(here, hits.primitive), hits);
    result = select(here, mesh->color(triangles), result);
  });
  return result;
}

FloatN vertex_alpha(const GeometryTable& world, const Hits& hits) {
  FloatN result(1);
  if (world.has_shapes_only()) return result;
  world.for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    const MeshTable* const mesh = table.geometry(geometry).mesh;
    if (mesh == nullptr || !mesh->has_alphas()) return;
    result = select(here, mesh->alpha(mesh->triangles(follow_first(here, hits.primitive), hits)), result);
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
  point.world = {surface.p, cross(surface.ng, along) * radius, along * (radius / max(cosine, FloatN(1e-3F)))};
  if (scene.has_object_space()) [[unlikely]]
    point.object = in_object(scene.geometry(), hits, point.world);
  const Vec3d& origin = scene.origin();
  if (origin.x != 0 || origin.y != 0 || origin.z != 0) {
    using D = Doubles<FloatN>;
    point.world.p = to_float(Vec3<D>(surface.p) + Vec3<D>(origin));
  }
  const auto on_surface = [&](UvSet set) -> UvPoint<FloatN> {
    const SurfaceUv<FloatN> uv = surface_uv(scene.geometry(), hits, surface, set);
    UvPoint<FloatN> result{
        {uv.u, uv.v}, uv_along(uv, point.world.p_across), uv_along(uv, point.world.p_along), uv.dpdu, uv.dpdv};
    if (scene.has_vertex_tangents()) set_vertex_tangents(scene.geometry(), hits, set, result);
    return result;
  };
  point.by(UvSet::first) = on_surface(UvSet::first);
  if (scene.has_second_uvset()) [[unlikely]]
    point.second = on_surface(UvSet::second);
  point.vertex_color = vertex_color(scene.geometry(), hits);
  point.vertex_alpha = scene.has_vertex_alphas() ? vertex_alpha(scene.geometry(), hits) : FloatN(1);
  return point;
}

std::optional<TexturePoint<FloatN>> texture_point_of_coordinates(const SceneTables& scene, const Hits& hits,
                                                                 UvSet set) {
  std::optional<TexturePoint<FloatN>> result;
  scene.geometry().for_each_geometry(hits, [&](const GeometryTable& table, std::uint32_t geometry, const MaskN& here) {
    const MeshTable* const mesh = table.geometry(geometry).mesh;
    if (mesh == nullptr || !mesh->has_coordinates(set)) return;
    const Vec2<FloatN> nothing{FloatN(0), FloatN(0)};
    TexturePoint<FloatN>& all = result.emplace();
    UvPoint<FloatN>& point = all.by(set);
    point.uv_across = point.uv_along = nothing;
    const LaneTriangles triangles = mesh->triangles(follow_first(here, hits.primitive), hits);
    point.uv = mesh->coordinates(triangles, set);
    all.vertex_alpha = mesh->has_alphas() ? mesh->alpha(triangles) : FloatN(1);
  });
  return result;
}

}  // namespace raytrace
