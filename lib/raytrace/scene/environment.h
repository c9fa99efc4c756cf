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
/// with the same density everywhere in a texel's rectangle of longitudes and latitudes, about in proportion to what the
/// largest channel's mean in it is above that of all directions, and never 0 where there is radiance: what is dim is
/// left to the directions in which surfaces scatter (Karlik et al., "MIS Compensation", 2019).
class Environment {
 public:
  /// threads: so many at most share the work. Throws std::bad_alloc.
  Environment(const LightItem<EnvironmentLight>& light, int threads);

  /// Whether the camera's rays see it.
  bool visible() const { return visible_; }

  Rgb<FloatN> radiance(const Vec3<FloatN>& direction) const;

  /// u1, u2: from 0 up to 1, multiples of 2^-24, as get_2d() gives them. The shares of samples and pdf() agree then
  /// exactly.
  EnvironmentSample sample(const FloatN& u1, const FloatN& u2) const;

  /// sample()'s, in any direction. Per solid angle.
  FloatN pdf(const Vec3<FloatN>& direction) const;

  // Magnitudes: of the largest channel's mean over all directions, times the light's colour; and what nothing exceeds.

  Rgb<float> mean_radiance() const { return mean_radiance_; }
  Rgb<float> largest_radiance() const { return largest_radiance_; }

 private:
  /// A place in the picture: columns from its left, rows from its bottom, in texels.
  struct Place {
    FloatN column, row;
  };

  Place place_of(const Vec3<FloatN>& direction) const;
  /// Of texels that may lie beyond the picture by one.
  Rgb<FloatN> texel(const IntN& column, const IntN& row) const;
  Vec3<FloatN> to_world(const Vec3<FloatN>& local) const;
  FloatN texel_pdf(const IntN& column, const IntN& row) const;
  bool has_table() const { return row_shares_.data() != nullptr; }
  void make_table(int threads);

  Vec3f x_, y_, z_;  ///< where the picture's axes point to in the world
  Rgb<float> scale_;
  bool visible_;
  std::optional<Kernel<Image>> image_;  ///< none: the radiance is scale_
  std::int32_t width_ = 1, height_ = 1;
  Rgb<float> mean_radiance_, largest_radiance_;

  // Of the table, which none has that is the same, or black, everywhere. Shares are cumulative: 0 before the first, 1
  // after the last, and multiples of 2^-24.
  LargeArray<float> row_shares_;                       ///< height + 1
  LargeArray<float> column_shares_;                    ///< of each row, width + 1
  LargeArray<std::int32_t> row_parts_, column_parts_;  ///< of them, detail::set_parts()
  LargeArray<float> polar_caps_;            ///< 1 - cos of the angle between a pole and the k-th row's edge; height + 1
  LargeArray<float> inverse_solid_angles_;  ///< of each row: one over that of a texel
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
  // The largest channel of each texel, with the row's end before its first and its first after its last.
  const std::size_t stride = width + 2;
  auto largest = LargeArray<float>::unset(stride * height);
  for_each_index(height_, threads, [&](int row) {
    float* const line = largest.data() + static_cast<std::size_t>(row) * stride;
    alignas(64) std::array<float, packet_lanes> values;
    for (std::int32_t first = 0; first < width_; first += packet_lanes) {
      const IntN column = min(lane_numbers<IntN>() + IntN(first), IntN(width_ - 1));
      const Rgb<FloatN> color = image_->texel(column, IntN(row));
      max(max(abs(color.red), abs(color.green)), abs(color.blue)).store_aligned(values.data());
      std::copy_n(values.data(), std::min(packet_lanes, width_ - first), line + 1 + first);
    }
    line[0] = line[width];
    line[width + 1] = line[1];
  });

  polar_caps_ = LargeArray<float>::unset(height + 1);
  inverse_solid_angles_ = LargeArray<float>::unset(height);
  const auto cap = [&](double k) {
    const double sine = std::sin(k * std::numbers::pi / (2 * height_));
    return 2 * sine * sine;
  };
  for (std::size_t k = 0; k <= height; ++k) polar_caps_[k] = static_cast<float>(cap(static_cast<double>(k)));
  row_shares_ = LargeArray<float>::unset(height + 1);
  column_shares_ = LargeArray<float>::unset((width + 1) * height);
  const auto parts = static_cast<std::size_t>(detail::part_count(width_)) + 1;
  column_parts_ = LargeArray<std::int32_t>::unset(parts * height);
  row_parts_ = LargeArray<std::int32_t>::unset(static_cast<std::size_t>(detail::part_count(height_)) + 1);
  constexpr float least_share = 0.0625F;  // of the density that dim directions would have without compensation
  auto weights = LargeArray<float>::unset(width * height);
  std::vector<float> row_weights(height);
  std::vector<double> row_means(height);
  // Of a whole row, over that of all directions.
  const auto share_of_sphere = [&](int row) { return (cap(row + 1) - cap(row)) / 2; };
  for_each_index(height_, threads, [&](int number) {
    const auto row = static_cast<std::size_t>(number);
    // The mean of what is bilinear, in the texel's rectangle. Beyond a pole, a row goes on half way around.
    const float* const here = largest.data() + row * stride + 1;
    const auto weight_of = [&](const float* line, std::size_t x) {
      return 0.125F * line[static_cast<std::ptrdiff_t>(x) - 1] + 0.75F * line[x] + 0.125F * line[x + 1];
    };
    const auto opposite = [&](std::size_t x) { return (x + width / 2) % width; };
    double sum = 0;
    for (std::size_t x = 0; x < width; ++x) {
      const float below = row > 0 ? weight_of(here - stride, x) : weight_of(here, opposite(x));
      const float above = row + 1 < height ? weight_of(here + stride, x) : weight_of(here, opposite(x));
      const float weight = 0.125F * below + 0.75F * weight_of(here, x) + 0.125F * above;
      weights[row * width + x] = weight;
      sum += static_cast<double>(weight);
    }
    row_means[row] = sum / width_ * share_of_sphere(number);
  });
  double mean = 0;
  for (const double row_mean : row_means) mean += row_mean;
  mean_radiance_ = mean_radiance_ * static_cast<float>(mean);
  for_each_index(height_, threads, [&](int number) {
    const auto row = static_cast<std::size_t>(number);
    float* const here = weights.data() + row * width;
    for (std::size_t x = 0; x < width; ++x)
      here[x] = std::max(here[x] - static_cast<float>(mean), here[x] * least_share);
    const double sum = detail::add_up(here, width_, column_shares_.data() + row * (width + 1));
    detail::set_parts(column_shares_.data() + row * (width + 1), width_, column_parts_.data() + row * parts);
    inverse_solid_angles_[row] = static_cast<float>(width_ / (4 * std::numbers::pi * share_of_sphere(number)));
    row_weights[row] = static_cast<float>(sum / width_ * share_of_sphere(number));
  });
  detail::add_up(row_weights.data(), height_, row_shares_.data());
  detail::set_parts(row_shares_.data(), height_, row_parts_.data());
  if (!(mean > 0)) row_shares_ = {};
}

inline Vec3<FloatN> Environment::to_world(const Vec3<FloatN>& local) const {
  return Vec3<FloatN>(x_) * local.x + Vec3<FloatN>(y_) * local.y + Vec3<FloatN>(z_) * local.z;
}

inline Environment::Place Environment::place_of(const Vec3<FloatN>& direction) const {
  const FloatN x = dot(Vec3<FloatN>(x_), direction), y = dot(Vec3<FloatN>(y_), direction),
               z = dot(Vec3<FloatN>(z_), direction);
  const FloatN longitude = turns(x, z), from_south = turns(sqrt(x * x + z * z), -y);
  return {(FloatN(0.5F) - longitude) * FloatN(static_cast<float>(width_)),
          from_south * FloatN(2 * static_cast<float>(height_))};
}

inline Rgb<FloatN> Environment::texel(const IntN& column, const IntN& row) const {
  const IntN width(width_), last_row(height_ - 1);
  const MaskN beyond = float_mask<FloatN>(row < IntN(0)) | float_mask<FloatN>(row > last_row);
  IntN x = select_lanes(beyond, column + IntN(width_ / 2), column);
  x = select_lanes(float_mask<FloatN>(x < IntN(0)), x + width, x);
  x = select_lanes(float_mask<FloatN>(x >= width), x - width, x);
  const auto clamped = [](const IntN& i, const IntN& last) { return min(max(i, IntN(0)), last); };
  return image_->texel(clamped(x, width - IntN(1)), clamped(row, last_row));
}

inline Rgb<FloatN> Environment::radiance(const Vec3<FloatN>& direction) const {
  if (!image_) return Rgb<FloatN>(scale_);
  const Place place = place_of(direction);
  const FloatN x = place.column - FloatN(0.5F), y = place.row - FloatN(0.5F), left = floor(x), low = floor(y);
  const IntN column = to_int(left), row = to_int(low);
  const auto line = [&](const IntN& at) {
    return mix(texel(column, at), texel(column + IntN(1), at), FloatN(x - left));
  };
  return mix(line(row), line(row + IntN(1)), FloatN(y - low)) * Rgb<FloatN>(scale_);
}

inline FloatN Environment::texel_pdf(const IntN& column, const IntN& row) const {
  const IntN at = row * IntN(width_ + 1) + column;
  const FloatN of_row = gather(row_shares_.data(), row + IntN(1)) - gather(row_shares_.data(), row);
  const FloatN of_column = gather(column_shares_.data(), at + IntN(1)) - gather(column_shares_.data(), at);
  return of_row * of_column * gather(inverse_solid_angles_.data(), row);
}

inline FloatN Environment::pdf(const Vec3<FloatN>& direction) const {
  if (!has_table()) return FloatN(detail::inverse_sphere);
  const Place place = place_of(direction);
  const auto number = [](const FloatN& x, std::int32_t count) {
    return min(max(to_int(floor(x)), IntN(0)), IntN(count - 1));
  };
  return texel_pdf(number(place.column, width_), number(place.row, height_));
}

inline EnvironmentSample Environment::sample(const FloatN& u1, const FloatN& u2) const {
  EnvironmentSample result;
  FloatN cap = u2 * FloatN(2), longitude = u1, side(1);  // from the south pole
  if (has_table()) {
    const IntN row = detail::find_share(row_shares_.data(), IntN(0), height_, row_parts_.data(), IntN(0), u2);
    const IntN first = row * IntN(width_ + 1);
    const IntN column = detail::find_share(column_shares_.data(), first, width_, column_parts_.data(),
                                           row * IntN(detail::part_count(width_) + 1), u1);
    // Numbers stand for their quanta's middles.
    const auto fraction = [](const LargeArray<float>& shares, const IntN& at, const FloatN& u) {
      const FloatN begin = gather(shares.data(), at), end = gather(shares.data(), at + IntN(1));
      return (u - begin + FloatN(static_cast<float>(detail::quantum / 2))) / (end - begin);
    };
    result.pdf = texel_pdf(column, row);
    longitude = FloatN(0.5F) - (to_float(column) + fraction(column_shares_, first + column, u1)) *
                                   FloatN(1 / static_cast<float>(width_));
    // From the nearer pole, where floats are precise.
    const MaskN south = float_mask<FloatN>(row + row < IntN(height_));
    const IntN from_pole = select_lanes(south, row, IntN(height_ - 1) - row);
    const FloatN upwards = fraction(row_shares_, row, u2);
    cap = mix(gather(polar_caps_.data(), from_pole), gather(polar_caps_.data(), from_pole + IntN(1)),
              select(south, upwards, FloatN(1) - upwards));
    side = select(south, FloatN(1), FloatN(-1));
  } else {
    result.pdf = FloatN(detail::inverse_sphere);
  }
  const FloatN radius = sqrt(max(cap * (FloatN(2) - cap), FloatN(0)));
  const auto around = sin_cos_of_turns(longitude);
  result.wi = to_world({radius * around.sine, (cap - FloatN(1)) * side, radius * around.cosine});
  result.radiance = radiance(result.wi);
  return result;
}

}  // namespace raytrace
