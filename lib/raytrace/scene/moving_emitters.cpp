// Light drawn from surfaces that move: EmitterTable's patches that are kept in the space of their objects.
#include "raytrace/math/gather.h"
#include "raytrace/scene/emitter_table.h"
#include "raytrace/scene/patch_emission.h"
#include "raytrace/scene/patch_geometry.h"

namespace raytrace {

LightPatch EmitterTable::light_patch(std::size_t number) const {
  const PatchRecord<float>& patch = patches_[number];
  return {PatchCode::shape_of(patch.code), Vec3d(patch.origin), Vec3d(patch.a), Vec3d(patch.b)};
}

Affine EmitterTable::world_from_patch(std::size_t number) const {
  const auto moments = instances_->moments(InstanceTable::index_of(static_cast<std::uint32_t>(movers_[number])));
  return moments[moments.size() / 2];
}

double EmitterTable::area(std::size_t number) const {
  const LightPatch patch = light_patch(number);
  return has_motion() && movers_[number] != 0 ? area_under(patch, world_from_patch(number)) : area_of(patch);
}

Vec3d EmitterTable::location(std::size_t number) const {
  const Vec3d origin(patches_[number].origin);
  return has_motion() && movers_[number] != 0 ? world_from_patch(number).point(origin) : origin;
}

EmitterTable::Places EmitterTable::places_of(const IntN& patch, const FloatN& time) const {
  const IntN number = gather(movers_.data(), patch);
  return {!float_mask<FloatN>(number == IntN(0)), maps_of(*instances_, same_bits<UintN>(number), time)};
}

Vec3<FloatN> EmitterTable::to_world(const IntN& patch, const FloatN& time, const Vec3<FloatN>& p) const {
  if (!has_motion()) return p;
  const auto [moves, maps] = places_of(patch, time);
  return select(moves, apply_point(maps.world_from_object, p), p);
}

PatchSample EmitterTable::sample_moving(const PatchRecord<FloatN>& record, const PatchTextures& textures,
                                        const Vec3<FloatN>& from, const FloatN& time, const FloatN& u1,
                                        const FloatN& u2) const {
  const auto [moves, maps] = places_of(textures.patch, time);
  const Vec3<FloatN> from_there = select(moves, apply_point(maps.object_from_world, from), from);
  PatchSample result = sample_patch(record, from_there, u1, u2, if_any(textures));
  const Vec3<FloatN> way = apply_vector(maps.world_from_object, result.way),
                     p = apply_point(maps.world_from_object, result.p);
  result.pdf = select(moves, maps.density_to_world(result.pdf, result.way, way), result.pdf);
  result.error = select(moves, maps.error(result.p, result.error, p), result.error);
  result.normal = select(moves, maps.normal_to_world(result.normal), result.normal);
  result.way = select(moves, way, result.way);
  result.p = select(moves, p, result.p);
  return result;
}

FloatN EmitterTable::pdf_of_moving(const PatchRecord<FloatN>& record, const PatchTextures& textures,
                                   const Vec3<FloatN>& from, const FloatN& time, const Vec3<FloatN>& p,
                                   const Vec3<FloatN>& normal) const {
  const auto [moves, maps] = places_of(textures.patch, time);
  const Vec3<FloatN> from_there = select(moves, apply_point(maps.object_from_world, from), from);
  const Vec3<FloatN> way = p - from, way_there = apply_vector(maps.object_from_world, way);
  const FloatN pdf = patch_pdf(record, from_there, select(moves, apply_point(maps.object_from_world, p), p),
                               select(moves, maps.normal_to_object(normal), normal), if_any(textures));
  return select(moves, maps.density_to_world(pdf, way_there, way), pdf);
}

}  // namespace raytrace
