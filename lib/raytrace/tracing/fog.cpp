#include "raytrace/tracing/fog.h"

namespace raytrace {

Rgb<FloatN> fog_transmittance(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& lanes, const RayIds& ids,
                              MediumStack& media) {
  const FloatN unit = length(rays.direction);
  Rgb<FloatN> left(Rgb<float>(1, 1, 1));
  for_each_part_in_fog(scene, rays, lanes, ids, media,
                       [&](const MaskN& in_fog, const IntN& fog, int, const FloatN& begin, const FloatN& end) {
                         const Rgb<FloatN> here = scene.tables().media().transmittance(fog, (end - begin) * unit);
                         left = select(in_fog, left * here, left);
                         return in_fog;
                       });
  return left;
}

}  // namespace raytrace
