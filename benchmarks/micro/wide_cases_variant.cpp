#include <memory>
#include <random>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/bsdfs/glossy_specular.h"
#include "raytrace/bsdfs/lambertian.h"
#include "raytrace/film/film.h"
#include "raytrace/sampling/pixel_sampler.h"
#include "raytrace/tracing/block_sums.h"
#include "raytrace/tracing/packet_block.h"
#include "wide_cases.h"

namespace raytrace::benchmark {

namespace {

// ---- Shapes: Embree's query on a scene of one object, so its callback and as little else as there can be.

// A field of one lane: Embree's packets hold arrays, its single rays plain numbers.
template <class T>
T& lane_of(T& field, std::size_t) {
  return field;
}
template <class T, std::size_t size>
T& lane_of(T (&fields)[size], std::size_t lane) {
  return fields[lane];
}

constexpr int picture_edge = 32;  ///< few enough rays to stay in the second level cache

/// Camera rays of a square picture from in front of the objects, so wide that about half of them hit. A packet is a
/// block of pixels as in the renderer.
template <int size>
class RayPackets {
 public:
  using RayHit = typename embree::Packet<size>::RayHit;

  explicit RayPackets(const Accelerator& accelerator) : scene_(accelerator.embree_scene()), query_(size > 1) {
    constexpr int block_width = size >= 8 ? 4 : size == 4 ? 2 : 1;
    constexpr int block_height = size / block_width;
    for (int top = 0; top < picture_edge; top += block_height)
      for (int left = 0; left < picture_edge; left += block_width) {
        RayHit& packet = packets_.emplace_back();
        for (int lane = 0; lane < size; ++lane)
          set_ray(packet, static_cast<std::size_t>(lane), left + lane % block_width, top + lane / block_width);
      }
    for (int& lane : valid_) lane = -1;
  }

  /// Returns how many rays hit.
  float intersect() {
    int hits = 0;  // not float, whose sums must be made one after the other
    for (RayHit& packet : packets_) {
      for (std::size_t lane = 0; lane < size; ++lane) {
        lane_of(packet.ray.tfar, lane) = std::numeric_limits<float>::infinity();
        lane_of(packet.hit.geomID, lane) = RTC_INVALID_GEOMETRY_ID;
        query_.start(static_cast<unsigned>(lane), std::numeric_limits<float>::infinity());
      }
      embree::Packet<size>::intersect(valid_, scene_, query_, packet);
      for (std::size_t lane = 0; lane < size; ++lane) hits += query_.geometry[lane] != embree::Query::none ? 1 : 0;
    }
    return static_cast<float>(hits);
  }

  /// Returns how many rays are stopped.
  float occluded() {
    int hits = 0;
    for (RayHit& packet : packets_) {
      for (std::size_t lane = 0; lane < size; ++lane) {
        lane_of(packet.ray.tfar, lane) = std::numeric_limits<float>::infinity();
        query_.start(static_cast<unsigned>(lane), std::numeric_limits<float>::infinity());
      }
      embree::Packet<size>::occluded(valid_, scene_, query_, packet.ray);
      for (std::size_t lane = 0; lane < size; ++lane) hits += lane_of(packet.ray.tfar, lane) < 0 ? 1 : 0;
    }
    return static_cast<float>(hits);
  }

 private:
  static void set_ray(RayHit& packet, std::size_t lane, int column, int row) {
    const auto offset = [](int pixel) { return 0.26F * ((static_cast<float>(pixel) + 0.5F) * 2 / picture_edge - 1); };
    const Vec3f eye{0, 0.5F, 5};
    const Vec3f direction = normalize(Vec3f{offset(column), offset(row) - 0.1F, -1});
    lane_of(packet.ray.org_x, lane) = eye.x;
    lane_of(packet.ray.org_y, lane) = eye.y;
    lane_of(packet.ray.org_z, lane) = eye.z;
    lane_of(packet.ray.dir_x, lane) = direction.x;
    lane_of(packet.ray.dir_y, lane) = direction.y;
    lane_of(packet.ray.dir_z, lane) = direction.z;
    lane_of(packet.ray.tnear, lane) = 0;
    lane_of(packet.ray.time, lane) = 0;
    lane_of(packet.ray.mask, lane) = 0xffffffffu;
    lane_of(packet.ray.id, lane) = static_cast<unsigned>(lane);
    lane_of(packet.ray.flags, lane) = 0;
    lane_of(packet.hit.instID[0], lane) = RTC_INVALID_GEOMETRY_ID;
  }

  RTCScene scene_;
  embree::Query query_;
  std::vector<RayHit> packets_;
  alignas(64) int valid_[size];
};

template <int size>
void add_shape_cases(const std::string& shape, const std::shared_ptr<const TracedScene>& scene,
                     std::vector<MicroCase>& cases) {
  const std::string what = shape + "/" + std::to_string(size) + "/" RAYTRACE_ISA;
  const auto packets = std::make_shared<RayPackets<size>>(scene->accelerator());
  constexpr int rays = picture_edge * picture_edge;
  cases.push_back({"intersect/" + what, rays, 0, [packets, scene] { return packets->intersect(); }});
  cases.push_back({"occluded/" + what, rays, 0, [packets, scene] { return packets->occluded(); }});
}

// ---- The others: functions of one packet, called for these many.

constexpr std::size_t packet_count = 64;

/// `packet_work(i)` does packet i's work and returns something of it.
template <class PacketWork>
void add_packet_case(const std::string& name, int items_a_lane, const PacketWork& packet_work,
                     std::vector<MicroCase>& cases) {
  cases.push_back({name + "/" RAYTRACE_ISA, static_cast<std::int64_t>(packet_count) * packet_lanes * items_a_lane, 0,
                   [packet_work] {
                     FloatN sum(0);
                     for (std::size_t i = 0; i < packet_count; ++i) sum = sum + packet_work(i);
                     return sum.get(0);
                   }});
}

FloatN sum_of(const Vec3<FloatN>& v) { return v.x + v.y + v.z; }
FloatN sum_of(const Rgb<FloatN>& color) { return color.red + color.green + color.blue; }

class RandomLanes {
 public:
  /// In [0, 1).
  FloatN number() {
    alignas(64) float lanes[packet_lanes];
    for (float& lane : lanes) lane = static_cast<float>(generator_() >> 8) * 0x1p-24F;
    return FloatN::load_aligned(lanes);
  }
  /// Of unit length, above the plane z = 0.
  Vec3<FloatN> direction() {
    return normalize(Vec3<FloatN>{number() - FloatN(0.5F), number() - FloatN(0.5F), number() + FloatN(0.1F)});
  }

 private:
  std::mt19937 generator_{1};
};

/// What a BRDF is asked in one packet.
struct BrdfInput {
  Vec3<FloatN> wo, wi, normal;
  FloatN u1, u2;
};

template <class Brdf, class MakeBrdf>
void add_brdf_cases(const std::string& name, MakeBrdf make_brdf, std::vector<MicroCase>& cases) {
  RandomLanes random;
  std::vector<Brdf> brdfs;
  std::vector<BrdfInput> inputs;
  for (std::size_t i = 0; i < packet_count; ++i) {
    brdfs.push_back(make_brdf(random));
    inputs.push_back({random.direction(), random.direction(), random.direction(), random.number(), random.number()});
  }
  add_packet_case(
      "brdf/" + name + "/f", 1,
      [brdfs, inputs](std::size_t i) {
        const BrdfInput& in = inputs[i];
        if constexpr (requires { brdfs[i].f(in.wo, in.wi, in.normal); }) {
          return sum_of(brdfs[i].f(in.wo, in.wi, in.normal));
        } else {
          return sum_of(brdfs[i].f());
        }
      },
      cases);
  add_packet_case(
      "brdf/" + name + "/sample", 1,
      [brdfs, inputs](std::size_t i) {
        return sum_of(brdfs[i].sample(inputs[i].wo, inputs[i].normal, inputs[i].u1, inputs[i].u2));
      },
      cases);
  add_packet_case(
      "brdf/" + name + "/pdf", 1,
      [brdfs, inputs](std::size_t i) { return brdfs[i].pdf(inputs[i].wo, inputs[i].wi, inputs[i].normal); }, cases);
}

Rgb<FloatN> random_color(RandomLanes& random) { return {random.number(), random.number(), random.number()}; }

/// The shape that Embree knows nothing of.
void add_plane_case(std::vector<MicroCase>& cases) {
  RandomLanes random;
  std::vector<Ray<FloatN>> rays;
  for (std::size_t i = 0; i < packet_count; ++i)
    rays.push_back({random.direction(), random.direction(), FloatN(0), infinity<FloatN>()});
  const auto plane = Kernel<Plane>::record({{0, 0, 1}, {0.3, 0.4, 1}});
  add_packet_case(
      "intersect/plane", 1,
      [plane, rays](std::size_t i) {
        const FloatN t = Kernel<Plane>::intersect(plane, rays[i], MaskN(true));
        return select(t < infinity<FloatN>(), t, FloatN(0));
      },
      cases);
}

void add_camera_case(std::vector<MicroCase>& cases) {
  RandomLanes random;
  std::vector<FloatN> points;
  for (std::size_t i = 0; i < packet_count; ++i) points.push_back(random.number() * FloatN(512));
  const Kernel<PinholeCamera> pinhole({{0, 8, 30}, {0, 0, 0}, {0, 1, 0}, 1500}, ViewPlane{});
  add_packet_case(
      "camera/pinhole", 1,
      [pinhole, points](std::size_t i) {
        return sum_of(pinhole.generate<FloatN>(points[i], points[packet_count - 1 - i]).direction);
      },
      cases);
}

/// Each packet of pixels with all its samples, the setting up included.
void add_sampler_case(std::vector<MicroCase>& cases) {
  constexpr int samples = 16;
  add_packet_case(
      "sampler/pixel", samples,
      [](std::size_t i) {
        const UintN column(static_cast<std::uint32_t>(i)), row(7);
        PixelSampler sampler(PixelScramble(column, row, 1), SampleGroup(UintN(0u), 1), 0, false);
        FloatN sum(0);
        for (int sample = 0; sample < samples; ++sample) {
          const PixelSampler::Point point = sampler.next();
          sum = sum + point.x + point.y;
        }
        return sum;
      },
      cases);
}

// ---- Sums: from the radiances of a block's packets to the film, exactly as the renderer does it, and in floats.

/// A block of pixels with 16 samples each, and so many packets.
constexpr PacketShape sampled_shape = shape_of_samples(packet_lanes);
using SampledBlock = PacketBlock<sampled_shape>;
constexpr std::size_t packets_a_block = 16 / sampled_shape.samples;
/// The pixels of packet_count blocks, side by side.
constexpr Region sums_region = {0, 0, static_cast<int>(packet_count) * sampled_shape.width, sampled_shape.height};

class ExactFilm {
 public:
  using Sums = BlockSums<SampledBlock>;

  Sums no_sums() const { return Sums(scale_); }
  void add(const Sums& sums, const SampledBlock& block) { sums.add_to(film_, block, sums_region); }
  float red(int x) const { return static_cast<float>(film_.sum(x, 0).red); }

 private:
  static constexpr int unit_exponent = -44;
  SumScale scale_{unit_exponent};
  Film film_{FilmSettings{{sums_region.x1, sums_region.y1, sums_region}, {}, 0, unit_exponent, {}}};
};

/// Like BlockSums, but for the sums.
struct FloatBlockSums {
  Rgb<FloatN> radiance{FloatN(0), FloatN(0), FloatN(0)};
  IntN hits = IntN(0), samples = IntN(0);

  MaskN add(const RayResult& seen, const MaskN& wanted) {
    const MaskN fine = wanted & (seen.radiance.red + seen.radiance.green + seen.radiance.blue <= FloatN(1e30F));
    radiance = radiance + select(fine, seen.radiance, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
    hits = hits + select_lanes(seen.hit & wanted, IntN(1), IntN(0));
    samples = samples + select_lanes(wanted, IntN(1), IntN(0));
    return wanted & !fine;
  }
};

class FloatFilm {
 public:
  using Sums = FloatBlockSums;

  Sums no_sums() const { return {}; }
  void add(const Sums& sums, const SampledBlock& block) {
    const auto by_pixel = []<class Batch>(const Batch& batch) {
      alignas(64) std::array<typename Batch::value_type, packet_lanes> lanes;
      batch.store_aligned(lanes.data());
      std::array<typename Batch::value_type, SampledBlock::pixels> totals{};
      for (std::size_t lane = 0; lane < packet_lanes; ++lane) totals[lane % totals.size()] += lanes[lane];
      return totals;
    };
    const auto red = by_pixel(sums.radiance.red), green = by_pixel(sums.radiance.green),
               blue = by_pixel(sums.radiance.blue);
    const auto hits = by_pixel(sums.hits), samples = by_pixel(sums.samples);
    block.for_each_pixel(sums_region, [&](int x, int y, std::size_t pixel) {
      constexpr auto width = static_cast<std::size_t>(sums_region.x1);
      PixelSum& sum = film_[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
      sum.red += red[pixel];
      sum.green += green[pixel];
      sum.blue += blue[pixel];
      sum.hits += hits[pixel];
      sum.samples += samples[pixel];
    });
  }
  float red(int x) const { return film_[static_cast<std::size_t>(x)].red; }

 private:
  struct PixelSum {
    float red, green, blue;
    std::int32_t hits, samples;
  };
  std::vector<PixelSum> film_ = std::vector<PixelSum>(static_cast<std::size_t>(sums_region.x1 * sums_region.y1));
};

template <class AnyFilm>
void add_sums_case(const std::string& name, std::vector<MicroCase>& cases) {
  RandomLanes random;
  std::vector<RayResult> seen;
  for (std::size_t i = 0; i < packet_count + packets_a_block; ++i)
    seen.push_back({random_color(random), random.number() < FloatN(0.9F)});
  add_packet_case(
      "sums/" + name, static_cast<int>(packets_a_block),
      [film = std::make_shared<AnyFilm>(), seen](std::size_t i) {
        auto sums = film->no_sums();
        MaskN bad(false);
        for (std::size_t packet = 0; packet < packets_a_block; ++packet)
          bad = bad | sums.add(seen[i + packet], MaskN(true));
        const int left = static_cast<int>(i) * sampled_shape.width;
        film->add(sums, {left, 0});
        return FloatN(film->red(left)) + select(bad, FloatN(1), FloatN(0));
      },
      cases);
}

}  // namespace

}  // namespace raytrace::benchmark

#define RAYTRACE_JOIN_NAMES(a, b) a##b
#define RAYTRACE_JOIN(a, b) RAYTRACE_JOIN_NAMES(a, b)

extern "C" void RAYTRACE_JOIN(raytrace_micro_,
                              RAYTRACE_VARIANT)(std::span<const raytrace::benchmark::ShapeScene> shapes,
                                                std::vector<raytrace::benchmark::MicroCase>& cases) {
  using namespace raytrace;
  using namespace raytrace::benchmark;
  constexpr const char* embree_isa = register_lanes == 16 ? "avx512" : register_lanes == 8 ? "avx2" : "sse4.2";
  for (const ShapeScene& scene : shapes) {
    const auto traced = std::make_shared<const TracedScene>(scene.description, 1, RAYTRACE_ISA, embree_isa);
    add_shape_cases<1>(scene.shape, traced, cases);
    add_shape_cases<4>(scene.shape, traced, cases);
    add_shape_cases<8>(scene.shape, traced, cases);
    add_shape_cases<16>(scene.shape, traced, cases);
  }
  add_brdf_cases<Lambertian<FloatN>>(
      "lambertian", [](RandomLanes& random) { return Lambertian<FloatN>{random_color(random)}; }, cases);
  add_brdf_cases<GlossySpecular<FloatN>>(
      "glossy_specular",
      [](RandomLanes& random) {
        return GlossySpecular<FloatN>{random_color(random), FloatN(1) + random.number() * FloatN(100)};
      },
      cases);
  add_plane_case(cases);
  add_camera_case(cases);
  add_sampler_case(cases);
  add_sums_case<ExactFilm>("exact", cases);
  add_sums_case<FloatFilm>("float", cases);
}
