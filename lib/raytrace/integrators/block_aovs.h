// What a block of pixels gathers for AOVs, lane by lane, before it goes to the film.
#pragma once

#include <array>
#include <cstdint>

#include "raytrace/aovs/registry.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/math/fixed_point_sums.h"
#include "raytrace/scene/aov_inputs.h"

namespace raytrace {

/// How many values all AOVs of a rule have together.
template <class... Types>
constexpr std::size_t all_values(AovRule rule, TypeList<Types...>) {
  const auto values = [rule]<class Aov>(std::type_identity<Aov>) -> std::size_t {
    if (Aov::rule != rule) return 0;
    if constexpr (requires { Aov::channels; }) return Aov::channels.size();
    return 1;
  };
  return (values(std::type_identity<Types>{}) + ...);
}

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

  /// Adds a sample of each lane of `wanted`. sample: its index, above those that the lane added before.
  void add(const AovInputs& seen, const MaskN& wanted, const UintN& sample);

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

  void prepare();
  void count(std::size_t coverage, const IntN& things);
  void end_run(std::size_t coverage, std::size_t lane);

  AovFilm& film_;
  std::array<int, packet_lanes> x_{}, y_{};  ///< each lane's pixel
  std::uint32_t lanes_ = 0;                  ///< those whose pixels are wanted, as bits
  FloatN depth_ = infinity<FloatN>();
  IntN sample_ = IntN(0);  ///< of the nearest surface
  std::array<FloatN, all_values(AovRule::nearest, Aovs{})> nearest_;
  std::array<Mean, all_values(AovRule::mean, Aovs{})> means_;
  std::array<Run, all_values(AovRule::coverage, Aovs{})> runs_;
};

}  // namespace raytrace
