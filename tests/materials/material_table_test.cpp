// Packets whose lanes hit different materials, against the formulas of the scene format in double precision.
#include "raytrace/scene/material_table.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "raytrace/materials/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

constexpr int materials = 300;

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double unit() { return static_cast<double>(bits_()) / 4294967296.0; }
  Rgb<double> color() { return {unit(), unit(), unit()}; }
  Vec3d direction() {
    for (;;) {
      const Vec3d v{2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1};
      if (length(v) > 0.1 && length(v) < 1) return normalize(v);
    }
  }

 private:
  std::mt19937 bits_;
};

struct Light {
  Vec3d wi;
  Rgb<double> radiance;
};

/// A surface point of each lane, and the lights that reach it: wi away from the surface, some lanes in the shadow of
/// some lights.
struct Packet {
  std::array<std::size_t, lanes> material{};
  std::array<Vec3d, lanes> wo, normal;
  std::array<std::vector<Light>, lanes> lights;
  std::vector<IncidentLight> incident;
};

Packet random_packet(Random& random, bool one_material) {
  Packet packet;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    packet.material[lane] =
        one_material && lane > 0 ? packet.material[0] : static_cast<std::size_t>(random.unit() * materials);
    packet.normal[lane] = random.direction();
    packet.wo[lane] = random.direction();
    if (dot(packet.wo[lane], packet.normal[lane]) < 0) packet.wo[lane] = -packet.wo[lane];
  }
  for (int i = 0; i < 3; ++i) {
    const Rgb<float> radiance(random.color());
    std::array<Vec3d, lanes> wi;
    std::array<double, lanes> cosine;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3d& n = packet.normal[lane];
      wi[lane] = normalize(n * (2 * dot(n, packet.wo[lane])) - packet.wo[lane] + random.direction() * 0.5);
      cosine[lane] = random.unit() < 0.3 ? 0 : std::max(0.0, dot(n, wi[lane]));
      if (cosine[lane] > 0) packet.lights[lane].push_back({wi[lane], Rgb<double>(radiance)});
    }
    packet.incident.push_back({vectors_of([&](std::size_t lane) { return wi[lane]; }),
                               batch_of<FloatN>([&](std::size_t lane) { return cosine[lane]; }),
                               Rgb<FloatN>(radiance)});
  }
  return packet;
}

const Rgb<double> ambient{0.4, 0.3, 0.7};

/// La ka cd + sum of (kd cd / pi) Ls (n.wi)
Rgb<double> formula(const Matte::Parameters& m, const Vec3d&, const Vec3d& normal, const std::vector<Light>& lights) {
  Rgb<double> sum = m.cd * m.ka * ambient;
  for (const Light& light : lights) sum += m.cd * (m.kd / std::numbers::pi * dot(normal, light.wi)) * light.radiance;
  return sum;
}

/// The same plus ks cs (r.wo)^exp Ls (n.wi) where r.wo > 0
Rgb<double> formula(const Phong::Parameters& m, const Vec3d& wo, const Vec3d& normal,
                    const std::vector<Light>& lights) {
  Rgb<double> sum = formula(Matte::Parameters{m.ka, m.kd, m.cd}, wo, normal, lights);
  for (const Light& light : lights) {
    const Vec3d r = normal * (2 * dot(normal, light.wi)) - light.wi;
    if (dot(r, wo) > 0) sum += m.cs * (m.ks * std::pow(dot(r, wo), m.exp) * dot(normal, light.wi)) * light.radiance;
  }
  return sum;
}

template <class Material>
void check_table(const std::vector<typename Material::Parameters>& parameters, double tolerance) {
  std::vector<typename Kernel<Material>::template Bsdf<float>> bsdfs;
  for (const auto& p : parameters) bsdfs.push_back(Kernel<Material>::bsdf(p));
  const MaterialTableOf<Material> table(bsdfs);
  Random random(77);
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    const Packet packet = random_packet(random, i % 4 == 0);
    const Rgb<FloatN> shaded =
        table.shade(batch_of<IntN>([&](std::size_t lane) { return packet.material[lane]; }), MaskN(true), {},
                    vectors_of([&](std::size_t lane) { return packet.wo[lane]; }),
                    vectors_of([&](std::size_t lane) { return packet.normal[lane]; }), nullptr, Rgb<float>(ambient),
                    packet.incident, nullptr, nullptr);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Rgb<double> wanted =
          formula(parameters[packet.material[lane]], packet.wo[lane], packet.normal[lane], packet.lights[lane]);
      worst = std::max({worst, std::abs(static_cast<double>(shaded.red.get(lane)) - wanted.red),
                        std::abs(static_cast<double>(shaded.green.get(lane)) - wanted.green),
                        std::abs(static_cast<double>(shaded.blue.get(lane)) - wanted.blue)});
    }
  }
  CHECK(worst < tolerance);
}

}  // namespace

TEST_CASE("each lane of a packet has the radiance of its own matte") {
  Random random(1);
  std::vector<Matte::Parameters> parameters;
  for (int i = 0; i < materials; ++i) parameters.push_back({random.unit(), random.unit(), random.color()});
  check_table<Matte>(parameters, 2e-6);
}

TEST_CASE("each lane of a packet has the radiance of its own phong") {
  Random random(2);
  std::vector<Phong::Parameters> parameters;
  for (int i = 0; i < materials; ++i)
    parameters.push_back(
        {random.unit(), random.unit(), random.unit(), random.color(), random.color(), 100 * random.unit()});
  check_table<Phong>(parameters, 5e-5);  // an exponent of 100 multiplies the rounding of directions to float
}

TEST_CASE("without lights, materials reflect the ambient light alone") {
  const MaterialTableOf<Phong> table({Kernel<Phong>::bsdf({0.5, 1, 1, {0.2, 0.4, 0.6}, {1, 1, 1}, 20})});
  const Vec3<FloatN> up = spread({0, 0, 1});
  const Rgb<FloatN> shaded = table.shade(IntN(0), MaskN(true), {}, up, up, nullptr, {1, 1, 2}, {}, nullptr, nullptr);
  CHECK(all(shaded.red == FloatN(0.1f)));
  CHECK(all(shaded.green == FloatN(0.2f)));
  CHECK(static_cast<double>(shaded.blue.get(0)) == Approx(0.6).epsilon(1e-6));
}

}  // namespace raytrace::test
