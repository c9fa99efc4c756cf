// Light from all around, of infinitely far: what an environment light sends, and directions drawn by it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/color.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/math/turns.h"
#include "raytrace/math/vec3.h"
#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/textures/kernels.h"

namespace raytrace {

/// A direction of unit length, in world space, the radiance that comes from there, and the density with which it is
/// drawn, per solid angle.
struct EnvironmentSample {
  Vec3<FloatN> wi;
  Rgb<FloatN> radiance;
  FloatN pdf;
};

/// Immutable. Directions need not have unit length, and point away from the scene.
///
/// Between the middles of texels, radiance is bilinear, across the seam at -z and the poles, too. Directions are drawn
/// in proportion to it: to what is bilinear between the largest channels of texels, in each cell between four of them.
/// So light from a picture alone has no noise but that of what it falls on.
class Environment {
 public:
  /// threads: so many at most share the work. Throws std::bad_alloc.
  Environment(const LightItem<EnvironmentLight>& light, int threads);

  /// Whether the camera's rays see it.
  bool visible() const { return visible_; }

  Rgb<FloatN> radiance(const Vec3<FloatN>& direction) const;

  /// u1, u2: from 0 up to 1, multiples of 2^-24, as get_2d() gives them.
  EnvironmentSample sample(const FloatN& u1, const FloatN& u2) const;

  /// The radiance from any direction, and the density at which sample() draws it.
  EnvironmentSample at(const Vec3<FloatN>& direction) const;

  // Magnitudes: the mean over all directions of the channels' sum; and what nothing exceeds.

  Rgb<float> mean_radiance() const { return mean_radiance_; }
  Rgb<float> largest_radiance() const { return largest_radiance_; }

 private:
  /// A place in the picture, and the cell that it is in: between the middles of four texels, the first of them its
  /// lower left one. Columns are counted from the picture's left, rows from its bottom, in texels; the first column and
  /// the first row may be -1, and the cells at the poles are cut by these.
  struct Place {
    IntN column, row;
    FloatN x, y;  ///< in the cell, from 0 to 1
  };
  /// Of a cell's corners.
  struct Corners {
    Rgb<FloatN> low_left, low_right, high_left, high_right;
    Rgb<FloatN> at(const FloatN& x, const FloatN& y) const {
      return mix(mix(low_left, low_right, x), mix(high_left, high_right, x), y);
    }
  };
  static constexpr float least_share = 0.0625F;  ///< of the weight that what is dim would have without compensation
  /// The same of what directions are drawn by. mean: over all of them.
  struct Weights {
    FloatN low_left, low_right, high_left, high_right;
    Weights(const Corners& corners, float mean)
        : low_left(weight(corners.low_left, mean)),
          low_right(weight(corners.low_right, mean)),
          high_left(weight(corners.high_left, mean)),
          high_right(weight(corners.high_right, mean)) {}
    FloatN at(const FloatN& x, const FloatN& y) const {
      return mix(mix(low_left, low_right, x), mix(high_left, high_right, x), y);
    }

   private:
    static FloatN weight(const Rgb<FloatN>& c, float mean) {
      const FloatN sum = abs(c.red) + abs(c.green) + abs(c.blue);
      return max(sum - FloatN(mean), sum * FloatN(least_share));
    }
  };
  /// What of a row's cells is in the picture.
  struct RowPart {
    FloatN low, high;
  };

  Place place_of(const Vec3<FloatN>& local) const;
  Corners corners(const Place& place) const;
  RowPart part_of(const IntN& row) const;
  /// Per solid angle, of what is drawn at a place. sine: of its angle with the poles.
  FloatN pdf(const Place& place, const Weights& weights, const FloatN& sine) const;
  /// The radiance from texels that may lie beyond the picture by one.
  Rgb<FloatN> texel(const IntN& column, const IntN& row) const;
  Vec3<FloatN> to_world(const Vec3<FloatN>& local) const;
  Vec3<FloatN> to_local(const Vec3<FloatN>& world) const;
  bool has_table() const { return row_shares_.data() != nullptr; }
  void make_table(int threads);

  Vec3f x_, y_, z_;  ///< where the picture's axes point to in the world
  Rgb<float> scale_;
  bool visible_;
  std::optional<Kernel<Image>> image_;  ///< none: the radiance is scale_
  std::int32_t width_ = 1, height_ = 1;
  Rgb<float> mean_radiance_, largest_radiance_;
  float mean_ = 0;  ///< over all directions, of the channels together

  // Of the table, which none has that is the same, or black, everywhere. Shares are cumulative: 0 before the first, 1
  // after the last, and multiples of 2^-24.
  LargeArray<float> row_shares_;                       ///< of the cells' rows, height + 1 of them, and one
  LargeArray<float> column_shares_;                    ///< of each row, width + 1
  LargeArray<std::int32_t> row_parts_, column_parts_;  ///< of them, detail::set_parts()
};

namespace detail {

inline constexpr float inverse_sphere = static_cast<float>(1 / (4 * std::numbers::pi));

/// Random numbers are multiples of it.
inline constexpr double quantum = 0x1p-24;

/// Sets count + 1 shares, 0 first and 1 last, by the weights, none of which is negative. Each that is not 0 gets a
/// quantum at least. The result: the sum of the weights.
inline double add_up(const float* weights, std::int32_t count, float* shares) {
  double sum = 0;
  std::int32_t positive = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    sum += static_cast<double>(weights[i]);
    positive += weights[i] > 0 ? 1 : 0;
  }
  const double rest = 1 / quantum - positive, scale = sum > 0 ? rest / sum : 0;
  double before = 0;
  std::int32_t quanta = 0;
  shares[0] = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    before += static_cast<double>(weights[i]);
    quanta += weights[i] > 0 ? 1 : 0;
    shares[i + 1] = static_cast<float>((std::floor(std::min(before * scale, rest)) + quanta) * quantum);
  }
  // What rounding left over goes to the last that may have it.
  const float last = shares[count];
  for (std::int32_t i = count; i > 0 && shares[i] == last; --i) shares[i] = 1;
  return sum;
}

/// So many equal parts of the numbers from 0 up to 1, each of which knows where in `count` shares its numbers are: a
/// power of 2, so that a number's part is exact.
inline std::int32_t part_count(std::int32_t count) {
  return static_cast<std::int32_t>(std::bit_floor(std::max(static_cast<std::uint32_t>(count) / 4, 1U)));
}

/// Of the beginning of each part, and of 1, the last of the shares that is not above it.
inline void set_parts(const float* shares, std::int32_t count, std::int32_t* parts) {
  const std::int32_t last = part_count(count);
  std::int32_t i = 0;
  for (std::int32_t part = 0; part <= last; ++part) {
    while (i + 1 < count && shares[i + 1] * static_cast<float>(last) <= static_cast<float>(part)) ++i;
    parts[part] = i;
  }
}

/// The last of `count` shares, from `first` on, that is not above u. first_part: where their parts begin.
inline IntN find_share(const float* shares, const IntN& first, std::int32_t count, const std::int32_t* parts,
                       const IntN& first_part, const FloatN& u) {
  const IntN part = first_part + to_int(u * FloatN(static_cast<float>(part_count(count))));
  IntN low = gather(parts, part), high = gather(parts, part + IntN(1));
  while (any(float_mask<FloatN>(low < high))) {
    const IntN middle = (low + high + IntN(1)) >> 1;
    const MaskN below = gather(shares, first + middle) <= u;
    low = select_lanes(below, middle, low);
    high = select_lanes(below, high, middle - IntN(1));
  }
  return low;
}

}  // namespace detail

inline Environment::Environment(const LightItem<EnvironmentLight>& light, int threads)
    : scale_(light.parameters.color * light.parameters.scaleradiance),
      visible_(light.parameters.visible),
      mean_radiance_(abs(scale_)),
      largest_radiance_(abs(scale_)) {
  const Affine turn = light.transform.affine();
  const Vec3d x = normalize(turn.x), y = normalize(turn.y - x * dot(x, turn.y));
  x_ = Vec3f(x);
  y_ = Vec3f(y);
  z_ = Vec3f(turn.determinant() < 0 ? -cross(x, y) : cross(x, y));
  if (light.parameters.file.path.empty()) return;
  image_.emplace(Image::Parameters{}, light.image.color);
  width_ = image_->width();
  height_ = image_->height();
  largest_radiance_ = largest_radiance_ * image_->largest();
  make_table(threads);
}

inline void Environment::make_table(int threads) {
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  // Of edges of rows, in texels from either pole.
  const auto height_of = [&](double edge) {
    return std::cos(std::clamp(edge, 0.0, static_cast<double>(height_)) * std::numbers::pi / height_);
  };
  // The sum of each texel's channels, with the row's first after its last.
  const std::size_t stride = width + 1;
  auto sums = LargeArray<float>::unset(stride * height);
  std::vector<double> row_means(height);
  for_each_index(height_, threads, [&](int row) {
    float* const line = sums.data() + static_cast<std::size_t>(row) * stride;
    alignas(64) std::array<float, packet_lanes> values;
    double sum = 0;
    for (std::int32_t first = 0; first < width_; first += packet_lanes) {
      const IntN column = min(lane_numbers<IntN>() + IntN(first), IntN(width_ - 1));
      const Rgb<FloatN> color = image_->texel(column, IntN(row)) * Rgb<FloatN>(scale_);
      FloatN(abs(color.red) + abs(color.green) + abs(color.blue)).store_aligned(values.data());
      std::copy_n(values.data(), std::min(packet_lanes, width_ - first), line + first);
    }
    for (std::size_t x = 0; x < width; ++x) sum += double{line[x]};
    row_means[static_cast<std::size_t>(row)] = sum / width_ * (height_of(row) - height_of(row + 1)) / 2;
  });
  double mean = 0;
  for (const double row_mean : row_means) mean += row_mean;
  mean_ = static_cast<float>(mean);
  mean_radiance_ = Rgb<float>(1, 1, 1) * mean_;
  if (!(mean > 0)) return;
  for_each_index(height_, threads, [&](int row) {
    float* const line = sums.data() + static_cast<std::size_t>(row) * stride;
    for (std::size_t x = 0; x < width; ++x) line[x] = std::max(line[x] - mean_, line[x] * least_share);
    line[width] = line[0];
  });

  const std::size_t rows = height + 1;
  row_shares_ = LargeArray<float>::unset(rows + 1);
  column_shares_ = LargeArray<float>::unset((width + 1) * rows);
  const auto parts = static_cast<std::size_t>(detail::part_count(width_)) + 1;
  column_parts_ = LargeArray<std::int32_t>::unset(parts * rows);
  row_parts_ = LargeArray<std::int32_t>::unset(static_cast<std::size_t>(detail::part_count(height_ + 1)) + 1);
  std::vector<float> row_weights(rows);
  for_each_index(height_ + 1, threads, [&](int number) {
    const auto row = static_cast<std::size_t>(number);
    // The mean of what is bilinear is in the middle. Beyond a pole, a row goes on half way around.
    const auto between = [&](const float* line, std::size_t x) { return 0.5F * (line[x] + line[x + 1]); };
    const auto opposite = [&](std::size_t x) { return (x + width / 2) % width; };
    const float* const low = sums.data() + (row > 0 ? row - 1 : 0) * stride;
    const float* const high = sums.data() + std::min(row, height - 1) * stride;
    const float middle = row == 0 ? 0.75F : row == height ? 0.25F : 0.5F;
    std::vector<float> weights(width);
    for (std::size_t x = 0; x < width; ++x) {
      const float below = between(low, row == 0 ? opposite(x) : x),
                  above = between(high, row == height ? opposite(x) : x);
      weights[x] = below + (above - below) * middle;
    }
    const double sum = detail::add_up(weights.data(), width_, column_shares_.data() + row * (width + 1));
    detail::set_parts(column_shares_.data() + row * (width + 1), width_, column_parts_.data() + row * parts);
    row_weights[row] = static_cast<float>(sum / width_ * (height_of(number - 0.5) - height_of(number + 0.5)) / 2);
  });
  detail::add_up(row_weights.data(), height_ + 1, row_shares_.data());
  detail::set_parts(row_shares_.data(), height_ + 1, row_parts_.data());
}

inline Vec3<FloatN> Environment::to_world(const Vec3<FloatN>& local) const {
  return Vec3<FloatN>(x_) * local.x + Vec3<FloatN>(y_) * local.y + Vec3<FloatN>(z_) * local.z;
}

inline Vec3<FloatN> Environment::to_local(const Vec3<FloatN>& world) const {
  return {dot(Vec3<FloatN>(x_), world), dot(Vec3<FloatN>(y_), world), dot(Vec3<FloatN>(z_), world)};
}

inline Environment::Place Environment::place_of(const Vec3<FloatN>& local) const {
  const FloatN longitude = turns(local.x, local.z);
  const FloatN from_south = turns(sqrt(local.x * local.x + local.z * local.z), -local.y);
  const FloatN x = (FloatN(0.5F) - longitude) * FloatN(static_cast<float>(width_)) - FloatN(0.5F);
  const FloatN y = from_south * FloatN(2 * static_cast<float>(height_)) - FloatN(0.5F);
  const FloatN left = min(max(floor(x), FloatN(-1)), FloatN(static_cast<float>(width_ - 1)));
  const FloatN low = min(max(floor(y), FloatN(-1)), FloatN(static_cast<float>(height_ - 1)));
  return {to_int(left), to_int(low), x - left, y - low};
}

inline Rgb<FloatN> Environment::texel(const IntN& column, const IntN& row) const {
  const IntN width(width_), last_row(height_ - 1);
  const MaskN beyond = float_mask<FloatN>(row < IntN(0)) | float_mask<FloatN>(row > last_row);
  IntN x = select_lanes(beyond, column + IntN(width_ / 2), column);
  x = select_lanes(float_mask<FloatN>(x < IntN(0)), x + width, x);
  x = select_lanes(float_mask<FloatN>(x >= width), x - width, x);
  const auto clamped = [](const IntN& i, const IntN& last) { return min(max(i, IntN(0)), last); };
  return image_->texel(clamped(x, width - IntN(1)), clamped(row, last_row)) * Rgb<FloatN>(scale_);
}

inline Environment::Corners Environment::corners(const Place& place) const {
  const IntN right = place.column + IntN(1), high = place.row + IntN(1);
  return {texel(place.column, place.row), texel(right, place.row), texel(place.column, high), texel(right, high)};
}

inline Environment::RowPart Environment::part_of(const IntN& row) const {
  return {select(float_mask<FloatN>(row < IntN(0)), FloatN(0.5F), FloatN(0)),
          select(float_mask<FloatN>(row == IntN(height_ - 1)), FloatN(0.5F), FloatN(1))};
}

inline Rgb<FloatN> Environment::radiance(const Vec3<FloatN>& direction) const {
  if (!image_) return Rgb<FloatN>(scale_);
  const Place place = place_of(to_local(direction));
  return corners(place).at(place.x, place.y);
}

inline FloatN Environment::pdf(const Place& place, const Weights& weights, const FloatN& sine) const {
  // Cells in column -1 are those in the last.
  const IntN column = select_lanes(float_mask<FloatN>(place.column < IntN(0)), IntN(width_ - 1), place.column);
  const IntN row = place.row + IntN(1), at = row * IntN(width_ + 1) + column;
  const FloatN of_row = gather(row_shares_.data(), row + IntN(1)) - gather(row_shares_.data(), row);
  const FloatN of_column = gather(column_shares_.data(), at + IntN(1)) - gather(column_shares_.data(), at);
  const RowPart part = part_of(place.row);
  const FloatN mean = weights.at(FloatN(0.5F), (part.low + part.high) * FloatN(0.5F));
  const auto texels = static_cast<float>(width_ * (height_ / (2 * std::numbers::pi * std::numbers::pi)));
  const FloatN density = weights.at(place.x, place.y) * FloatN(texels) / (mean * (part.high - part.low));
  return select(mean > FloatN(0), of_row * of_column * density / max(sine, FloatN(1e-7F)), FloatN(0));
}

inline EnvironmentSample Environment::at(const Vec3<FloatN>& direction) const {
  if (!image_) return {direction, Rgb<FloatN>(scale_), FloatN(detail::inverse_sphere)};
  const Vec3<FloatN> local = to_local(direction);
  const Place place = place_of(local);
  const Corners cell = corners(place);
  const Rgb<FloatN> radiance = cell.at(place.x, place.y);
  if (!has_table()) return {direction, radiance, FloatN(detail::inverse_sphere)};
  const FloatN across = local.x * local.x + local.z * local.z;
  return {direction, radiance, pdf(place, Weights(cell, mean_), sqrt(across / (across + local.y * local.y)))};
}

namespace detail {

/// The x in [0, 1] up to which a share u is of what goes evenly from a at 0 to b at 1; none is negative, one is not 0.
inline FloatN linear_share(const FloatN& a, const FloatN& b, const FloatN& u) {
  const FloatN scale = FloatN(1) / max(a + b, FloatN(1e-37F)), begin = a * scale, end = b * scale;
  const FloatN root = sqrt(mix(FloatN(begin * begin), FloatN(end * end), u));
  return min(u / max(begin + root, FloatN(1e-12F)), FloatN(1));
}

}  // namespace detail

inline EnvironmentSample Environment::sample(const FloatN& u1, const FloatN& u2) const {
  if (!has_table()) {
    const FloatN y = u2 * FloatN(2) - FloatN(1), radius = FloatN(2) * sqrt(max(u2 * (FloatN(1) - u2), FloatN(0)));
    const auto around = sin_cos_of_turns(u1);
    const Vec3<FloatN> wi = to_world({radius * around.sine, y, radius * around.cosine});
    return {wi, radiance(wi), FloatN(detail::inverse_sphere)};
  }
  const IntN row = detail::find_share(row_shares_.data(), IntN(0), height_ + 1, row_parts_.data(), IntN(0), u2);
  const IntN first = row * IntN(width_ + 1);
  const IntN column = detail::find_share(column_shares_.data(), first, width_, column_parts_.data(),
                                         row * IntN(detail::part_count(width_) + 1), u1);
  // Numbers stand for their quanta's middles.
  const auto fraction = [](const LargeArray<float>& shares, const IntN& at, const FloatN& u) {
    const FloatN begin = gather(shares.data(), at), end = gather(shares.data(), at + IntN(1));
    return (u - begin + FloatN(static_cast<float>(detail::quantum / 2))) / (end - begin);
  };
  Place place{column, row - IntN(1), FloatN(0), FloatN(0)};
  const Corners cell = corners(place);
  const Weights weights(cell, mean_);
  const RowPart part = part_of(place.row);
  const auto middle = [&](const FloatN& y) { return weights.at(FloatN(0.5F), y); };
  place.y = mix(part.low, part.high,
                detail::linear_share(middle(part.low), middle(part.high), fraction(row_shares_, row, u2)));
  place.x = detail::linear_share(weights.at(FloatN(0), place.y), weights.at(FloatN(1), place.y),
                                 fraction(column_shares_, first + column, u1));
  const FloatN x = to_float(place.column) + place.x + FloatN(0.5F), y = to_float(place.row) + place.y + FloatN(0.5F);
  const auto around = sin_cos_of_turns(FloatN(0.5F) - x * FloatN(1 / static_cast<float>(width_)));
  const auto upwards = sin_cos_of_turns(y * FloatN(0.5F / static_cast<float>(height_)));  // from the south pole
  const FloatN sine = abs(upwards.sine);
  return {to_world({sine * around.sine, -upwards.cosine, sine * around.cosine}), cell.at(place.x, place.y),
          pdf(place, weights, sine)};
}

}  // namespace raytrace
