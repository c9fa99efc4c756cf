// What a block of pixels gathers for AOVs, lane by lane, before it goes to the film.
#pragma once

#include <array>
#include <cstdint>

#include "raytrace/aovs/aov_table.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/math/fixed_point_sums.h"
#include "raytrace/scene/aov_inputs.h"
#include "raytrace/tracing/aov_values.h"

namespace raytrace {

/// What the lanes of a packet gather, some of which may be of one pixel. The wanted AOVs' values follow each other as
/// in AovSettings.
class BlockAovs {
 public:
  /// For the lanes of the PacketBlock whose pixels lie in the region, which is the film's or a part of it.
  template <class Block>
  BlockAovs(AovFilm& film, const Block& block, const Region& region) : film_(film) {
    block.for_each_lane(region, [&](int x, int y, std::size_t lane) {
      x_[lane] = x;
      y_[lane] = y;
      lanes_ |= std::uint32_t{1} << lane;
    });
    prepare();
  }

  /// Adds a sample of each lane of `wanted`. sample: its index, above those that the lane added before. followed_apart:
  /// AOVs that follow mirrors are left to add_followed().
  void add(const AovInputs& seen, const MaskN& wanted, const UintN& sample, bool followed_apart);

  /// Adds the AOVs that follow mirrors of a sample of each lane of `wanted`.
  void add_followed(const FollowedSurface& surface, const MaskN& wanted);

  /// After the last sample: the film has it all.
  void finish();

 private:
  /// The thing that each lane's latest samples met, and how many of them.
  struct Run {
    IntN thing = IntN(nothing);
    IntN samples = IntN(0);
  };
  static constexpr std::int32_t nothing = -1;

  struct Mean {
    double units = 1;  ///< one over the sum's unit
    FloatN largest = FloatN(0);
    FixedPointSums<FloatN> sum;
  };

  /// Of each rule: how many values the AOVs before have.
  struct NextValues {
    std::size_t nearest = 0, mean = 0, coverage = 0;
  };

  void prepare();
  /// Of aov_table[aov], which counts in `next` what it has of each rule.
  template <std::size_t aov>
  void add_values(const AovInputs& seen, const MaskN& hit, const MaskN& nearer, bool followed_apart, NextValues& next);
  void add_to_mean(std::size_t mean, const MaskN& lanes, const FloatN& value);
  void count(std::size_t coverage, const IntN& things);
  void end_run(std::size_t coverage, std::size_t lane);

  AovFilm& film_;
  std::array<int, packet_lanes> x_{}, y_{};  ///< each lane's pixel
  std::uint32_t lanes_ = 0;                  ///< those whose pixels are wanted, as bits
  FloatN depth_ = infinity<FloatN>();
  IntN sample_ = IntN(0);  ///< of the nearest surface
  std::array<FloatN, all_values(AovRule::nearest)> nearest_;
  std::array<Mean, all_values(AovRule::mean)> means_;
  std::array<Run, all_values(AovRule::coverage)> runs_;
};

}  // namespace raytrace
