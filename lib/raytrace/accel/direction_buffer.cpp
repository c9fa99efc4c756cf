#include "raytrace/accel/direction_buffer.h"

#include <utility>

#include "raytrace/accel/candidate_lists.h"

namespace raytrace {

std::optional<DirectionBuffer> DirectionBuffer::make(const BufferOrigin& origin, std::span<const BoundedObject> objects,
                                                     int threads) {
  if (objects.size() > Object::last_primitive) return std::nullopt;
  const CubeProjection projection(origin, objects, threads);
  if (!projection.is_within_floats()) return std::nullopt;
  DirectionBuffer buffer;
  buffer.point_ = origin.position;
  buffer.infinitely_far_ = projection.infinitely_far();
  buffer.surroundings_ = projection.surroundings();
  buffer.reach_ = static_cast<float>(projection.reach());
  buffer.across_ = Vec3f(projection.across());
  buffer.up_ = Vec3f(projection.up());
  buffer.start_ = Vec3f(projection.start());
  auto lists = make_candidate_lists(projection, objects, threads);
  if (!lists) return std::nullopt;
  buffer.lists_ = std::move(*lists);
  return buffer;
}

}  // namespace raytrace
