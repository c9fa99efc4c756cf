#include "raytrace/accel/direction_buffer.h"

#include <utility>

#include "raytrace/accel/candidate_lists.h"

namespace raytrace {

std::optional<DirectionBuffer> DirectionBuffer::make(const Vantage& vantage, std::span<const PlacedObject> objects,
                                                     int threads) {
  if (objects.size() > Object::last_primitive) return std::nullopt;
  const Perspective perspective(vantage, objects, threads);
  if (!perspective.is_within_floats()) return std::nullopt;
  DirectionBuffer buffer;
  buffer.point_ = vantage.place;
  buffer.infinitely_far_ = perspective.infinitely_far();
  buffer.surroundings_ = perspective.surroundings();
  buffer.reach_ = static_cast<float>(perspective.reach());
  buffer.across_ = Vec3f(perspective.across());
  buffer.up_ = Vec3f(perspective.up());
  buffer.start_ = Vec3f(perspective.start());
  auto lists = make_candidate_lists(perspective, objects, threads);
  if (!lists) return std::nullopt;
  buffer.lists_ = std::move(*lists);
  return buffer;
}

}  // namespace raytrace
