#include "raytrace/tracing/photon_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "raytrace/math/lanes.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parallel/radix_sort.h"
#include "raytrace/sampling/hash.h"

namespace raytrace {

namespace {

/// A cell as wide as what is looked up, so that this reaches into two along each axis.
std::int32_t cell_at(float x, float cells_per_unit) {
  constexpr double most = 1 << 30;
  return static_cast<std::int32_t>(
      std::clamp(std::floor(static_cast<double>(x) * static_cast<double>(cells_per_unit)), -most, most));
}

float power_of(const Rgb<float>& flux) {
  return std::max({std::abs(flux.red), std::abs(flux.green), std::abs(flux.blue)});
}

/// Of the photons of a row of buckets, that a point looks at.
constexpr std::uint32_t most_packets = 1024 / packet_lanes;

float square_of(float x) { return x * x; }

}  // namespace

/// One of a stream of photons, each drawn in proportion to its weight: Chao's reservoir of one.
struct PhotonMap::Choice {
  float u;
  float sum = 0;  ///< of the weights
  std::uint32_t photon = 0;

  void add(std::uint32_t number, float weight) {
    sum += weight;
    const float share = weight / sum;
    if (u < share) {
      photon = number;
      u /= share;
    } else {
      u = (u - share) / (1 - share);
    }
  }
};

PhotonMap::PhotonMap(const std::vector<Photon>& photons, float radius, int threads)
    : radius_(radius), cells_per_unit_(0.5F / radius) {
  struct Item {
    std::uint32_t key, photon;
  };
  bucket_mask_ = std::bit_ceil(static_cast<std::uint32_t>(photons.size()) + 1) - 1;
  std::vector<Item> items(photons.size());
  for_each_chunk(photons.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3f& p = photons[i].p;
      items[i] = {
          bucket_of(cell_at(p.x, cells_per_unit_), cell_at(p.y, cells_per_unit_), cell_at(p.z, cells_per_unit_)),
          static_cast<std::uint32_t>(i)};
    }
  });
  radix_sort(items, threads);
  starts_.assign(std::size_t{bucket_mask_} + 2, 0);
  for (const Item& item : items) ++starts_[item.key + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  const std::size_t room = photons.size() + packet_lanes;  // a packet is read at once
  for (std::vector<float>* const numbers :
       {&places_.x, &places_.y, &places_.z, &places_.normal_x, &places_.normal_y, &places_.normal_z, &places_.power})
    numbers->resize(room);
  places_.points.resize(room);
  photons_.resize(photons.size());
  for_each_chunk(items.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Photon& photon = photons_[i] = photons[items[i].photon];
      places_.x[i] = photon.p.x;
      places_.y[i] = photon.p.y;
      places_.z[i] = photon.p.z;
      places_.normal_x[i] = photon.normal.x;
      places_.normal_y[i] = photon.normal.y;
      places_.normal_z[i] = photon.normal.z;
      places_.power[i] = power_of(photon.flux);
      places_.points[i] = photon.points;
    }
  });
}

std::uint32_t PhotonMap::bucket_of(std::int32_t x, std::int32_t y, std::int32_t z) const {
  // Cells in a row along x are in buckets in a row.
  return (hash(static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z), 0U, 0U) + static_cast<std::uint32_t>(x)) &
         bucket_mask_;
}

void PhotonMap::choose_from(std::uint32_t first, std::uint32_t last, const Vec3f& p, const Vec3f& normal,
                            int most_points, Choice& choice) const {
  if (first == last) return;
  const FloatN radius2(square_of(radius_));
  // Where light comes together in a point, one packet of so many stands for all.
  const std::uint32_t packets = (last - first - 1) / packet_lanes + 1, step = (packets - 1) / most_packets + 1;
  std::uint32_t skipped = 0;
  if (step > 1) {
    const float place = choice.u * static_cast<float>(step);
    skipped = std::min(static_cast<std::uint32_t>(place), step - 1);
    choice.u = place - static_cast<float>(skipped);
  }
  for (std::uint32_t i = first + skipped * packet_lanes; i < last; i += step * packet_lanes) {
    const auto load = [&](const std::vector<float>& numbers) { return FloatN::load_unaligned(numbers.data() + i); };
    const FloatN x = load(places_.x) - FloatN(p.x), y = load(places_.y) - FloatN(p.y),
                 z = load(places_.z) - FloatN(p.z);
    const FloatN above = x * FloatN(normal.x) + y * FloatN(normal.y) + z * FloatN(normal.z);
    // What is beside the surface's plane counts as if it were twice as far from it: as that of a sheet above another.
    const FloatN distance2 = x * x + y * y + z * z + FloatN(3) * above * above;
    MaskN counts = first_lanes<FloatN>(static_cast<int>(std::min<std::uint32_t>(last - i, packet_lanes))) &
                   (distance2 < radius2) &
                   float_mask<FloatN>(IntN::load_unaligned(places_.points.data() + i) <= IntN(most_points));
    if (none(counts)) continue;
    const FloatN alike = load(places_.normal_x) * FloatN(normal.x) + load(places_.normal_y) * FloatN(normal.y) +
                         load(places_.normal_z) * FloatN(normal.z);
    counts = counts & (alike > FloatN(0.7F));
    if (none(counts)) continue;
    const FloatN weight = load(places_.power) * (FloatN(1) - distance2 / radius2) * FloatN(static_cast<float>(step));
    counts = counts & (weight > FloatN(0));
    for (const std::size_t lane : SetLanes(counts)) choice.add(i + static_cast<std::uint32_t>(lane), weight.get(lane));
  }
}

void PhotonMap::choose_around(const Vec3f& p, const Vec3f& normal, int most_points, Choice& choice) const {
  const auto low = [&](float x) { return cell_at(x - radius_, cells_per_unit_); };
  const std::int32_t x = low(p.x), y = low(p.y), z = low(p.z);
  // Of the eight cells around, two each are in buckets in a row, unless some share one.
  std::array<std::uint32_t, 4> rows;
  bool apart = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = bucket_of(x, y + static_cast<std::int32_t>(i & 1), z + static_cast<std::int32_t>(i >> 1));
    apart = apart && rows[i] != bucket_mask_;
    for (std::size_t j = 0; j < i; ++j) apart = apart && rows[i] - rows[j] + 1 > 2;
  }
  if (apart) [[likely]] {
    for (const std::uint32_t row : rows) choose_from(starts_[row], starts_[row + 2], p, normal, most_points, choice);
    return;
  }
  std::array<std::uint32_t, 8> buckets;
  for (std::size_t i = 0; i < buckets.size(); ++i)
    buckets[i] = (rows[i / 2] + static_cast<std::uint32_t>(i & 1)) & bucket_mask_;
  std::sort(buckets.begin(), buckets.end());
  const auto end = std::unique(buckets.begin(), buckets.end());
  for (auto bucket = buckets.begin(); bucket != end; ++bucket)
    choose_from(starts_[*bucket], starts_[*bucket + 1], p, normal, most_points, choice);
}

PhotonMap::Light PhotonMap::choose(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const MaskN& lanes,
                                   const FloatN& u, int most_points) const {
  alignas(64) std::array<std::array<float, packet_lanes>, 6> numbers{};
  alignas(64) std::array<std::int32_t, packet_lanes> groups{};
  alignas(64) std::array<std::uint32_t, packet_lanes> found{}, met{};
  // Of Epanechnikov's kernel, 1 - (distance / radius)^2.
  const auto per_area = static_cast<float>(2 / (std::numbers::pi * double{radius_} * double{radius_}));
  for (const std::size_t lane : SetLanes(lanes)) {
    Choice choice{u.get(lane)};
    choose_around(in_lane(p, lane), in_lane(normal, lane), most_points, choice);
    if (!(choice.sum > 0)) continue;
    const Photon& photon = photons_[choice.photon];
    const float share = choice.sum / places_.power[choice.photon] * per_area;
    numbers[0][lane] = photon.wi.x;
    numbers[1][lane] = photon.wi.y;
    numbers[2][lane] = photon.wi.z;
    numbers[3][lane] = photon.flux.red * share;
    numbers[4][lane] = photon.flux.green * share;
    numbers[5][lane] = photon.flux.blue * share;
    groups[lane] = photon.group;
    met[lane] = photon.is_met ? 1 : 0;
    found[lane] = 1;
  }
  const auto load = [&](std::size_t i) { return FloatN::load_aligned(numbers[i].data()); };
  return {float_mask<FloatN>(UintN::load_aligned(found.data()) != UintN(0u)),
          {load(0), load(1), load(2)},
          {load(3), load(4), load(5)},
          IntN::load_aligned(groups.data()),
          float_mask<FloatN>(UintN::load_aligned(met.data()) != UintN(0u))};
}

float radius_for(const std::vector<Photon>& photons, std::size_t neighbours, int threads) {
  if (photons.size() <= neighbours) return 0;
  constexpr std::size_t most = 64;
  const std::size_t tried = std::min(most, photons.size());
  std::array<float, most> distances2;
  for_each_index(static_cast<int>(tried), threads, [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    const Vec3f& p = photons[i * photons.size() / tried].p;
    std::vector<float> all(photons.size());
    std::transform(photons.begin(), photons.end(), all.begin(), [&](const Photon& photon) {
      const Vec3f way = photon.p - p;
      return dot(way, way);
    });
    const auto nth = all.begin() + static_cast<std::ptrdiff_t>(neighbours);
    std::nth_element(all.begin(), nth, all.end());
    distances2[i] = *nth;
  });
  const auto middle = distances2.begin() + static_cast<std::ptrdiff_t>(tried / 2);
  std::nth_element(distances2.begin(), middle, distances2.begin() + static_cast<std::ptrdiff_t>(tried));
  return std::sqrt(*middle);
}

}  // namespace raytrace
