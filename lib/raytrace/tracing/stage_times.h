// Where the time of path tracing goes, stage by stage.
//
// A clock that is read for every packet and stage would cost more than some stages do. So one packet of 61 is timed, at
// all of its stages; as all packets do the same, the shares of those are the shares of all, but for chance. The number
// is prime, so that it falls into step with no number of packets of a pixel.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace raytrace {

enum class Stage : std::uint8_t {
  camera,   ///< samples of pixels, and their rays
  trace,    ///< all rays of paths through the BVH, shadow rays as well
  surface,  ///< points, normals, coordinates where rays hit; sorting of paths
  texture,  ///< footprints and relief; absorption. Parameters of materials look up theirs while they shade
  lights,   ///< choosing lights and points on them, and what shines by itself
  shade,    ///< materials, with the textures of their parameters, and the next direction
  film,     ///< sums of samples and AOVs
  light_paths,
};

/// Of the packets that were timed.
class StageTimes {
 public:
  static constexpr std::array<const char*, 8> names = {"camera", "trace", "surface", "texture",
                                                       "lights", "shade", "film",    "light_paths"};

  void add(Stage stage, std::chrono::nanoseconds time) {
    times_[static_cast<std::size_t>(stage)] += static_cast<std::uint64_t>(time.count());
  }
  StageTimes& operator+=(const StageTimes& other) {
    for (std::size_t stage = 0; stage < times_.size(); ++stage) times_[stage] += other.times_[stage];
    return *this;
  }

  /// Whether any was timed.
  bool empty() const { return sum() == 0; }
  /// Of all that was timed; not if it is empty.
  double share(Stage stage) const {
    return static_cast<double>(times_[static_cast<std::size_t>(stage)]) / static_cast<double>(sum());
  }

 private:
  std::uint64_t sum() const { return std::accumulate(times_.begin(), times_.end(), std::uint64_t{0}); }

  std::array<std::uint64_t, names.size()> times_{};  ///< in nanoseconds
};

/// A thread's.
class StageClock {
 public:
  const StageTimes& times() const { return times_; }

  /// A packet, whose first stage begins.
  void begin_packet() {
    is_timed_ = ++packets_ % 61 == 0;
    if (is_timed_) [[unlikely]]
      last_ = Clock::now();
  }
  /// Its stage since the last call ends.
  void end(Stage stage) {
    if (is_timed_) [[unlikely]]
      note(stage);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[gnu::noinline]] void note(Stage stage) {
    const Clock::time_point now = Clock::now();
    times_.add(stage, now - std::exchange(last_, now));
  }

  StageTimes times_;
  std::uint64_t packets_ = 0;
  bool is_timed_ = false;
  Clock::time_point last_;
};

}  // namespace raytrace
