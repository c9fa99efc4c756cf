// How fibres of hair scatter light.
//
// In the local frame x is the fibre's axis, towards its tip, and z the normal where wo's ray meets it. So theta, the
// angle with the plane across, has the sine x, and phi, the angle around, is that of (y, z) with z; that of wo is also
// the angle of its ray with the normal in that plane, gamma_o, whose sine h says how far from the axis it passes.
//
//   S(wo, wi) = sum over p of M_p(theta_o, theta_i) A_p(wo) N_p(phi_i - phi_o)
//
// is the light that leaves for a radiance and a steradian of wi: its integral over all directions of wi, without any
// cosine, is the sum of the A_p, 1 where nothing is absorbed. p: how often light went through the inside: 0 (R), 1
// (TT), 2 (TRT), 3 (all others). The contract here has the cosine of wi and the surface's normal beside f, so
//
//   f(wo, wi) = S(wo, wi) / |wi.z|.
//
// Its pdf has the same M and N, and A_p's share of the light as a grey one.
//
// What comes from the normal's side counts as gloss, and what comes from behind as transmitted. The albedo, for
// denoisers, is the color of a thick head of it, whichever parameter says what is absorbed.
#pragma once

#include <array>
#include <cmath>

#include "raytrace/bsdfs/bsdf_sample.h"
#include "raytrace/bsdfs/fibre.h"
#include "raytrace/bsdfs/fresnel.h"
#include "raytrace/materials/hair.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/turns.h"

namespace raytrace {

template <>
class Kernel<Hair> {
 public:
  template <class T>
  struct Bsdf {
    Rgb<T> absorption;  ///< in a length of the fibre's radius
    Rgb<T> color;       ///< of a thick head of it
    T eta;
    T variance;                                        ///< of R, along the fibre
    T reflected_scale, through_scale, returned_scale;  ///< LongitudinalLobe's, of R, TT and TRT
    T spread, inverse_part;                            ///< AzimuthalLobe's
    T tilt_sine, tilt_cosine;                          ///< of the scales

    /// evaluate() is in the local frame, as all others are.
    static constexpr bool in_local_frame = true;
    static constexpr bool is_glossy = true;

    Rgb<T> ambient_radiance(const Rgb<T>&) const { return black(); }
    Rgb<T> albedo() const { return color; }
    /// Light leaves to all sides; highlights are narrow.
    Rgb<T> usual_f() const { return color * T(std::numbers::inv_pi_v<float>); }
    Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>&) const { return value(lobes(wo), wi).f; }
    T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const { return value(lobes(wo), wi).pdf; }

    /// What all directions of light have in common for one wo, in the local frame.
    struct Lobes {
      T outside, inside;                         ///< gamma_o and gamma_t, in turns
      std::array<LongitudinalLobe<T>, 4> along;  ///< M_p
      std::array<Rgb<T>, 4> part;                ///< A_p
      std::array<T, 4> choice;                   ///< how often sample() takes each
    };
    struct Value {
      Rgb<T> f;
      T pdf;
    };
    Lobes lobes(const Vec3<T>& wo) const {
      Lobes lobes;
      const T sine = min(max(wo.x, T(-1)), T(1)), cosine2 = T(1) - sine * sine, cosine = sqrt(cosine2);
      const T up = max(wo.z, T(1e-6F)), across = sqrt(wo.y * wo.y + up * up);
      const T h = wo.y / across, cosine_outside = up / across;
      const T eta_across = sqrt(eta * eta - sine * sine + T(1e-12F));
      const T sine_inside = min(max(h * cosine / eta_across, T(-1)), T(1));
      const T cosine_inside = sqrt(T(1) - sine_inside * sine_inside);
      lobes.outside = turns(wo.y, up);
      lobes.inside = turns(sine_inside, cosine_inside);

      // A chord of the circle, and longer as far as it runs along the fibre: eta_across / eta is cos(theta_t).
      const T way = T(2) * cosine_inside * eta / eta_across;
      const T reflectance = fresnel_reflection(cosine * cosine_outside, eta).reflectance, enters = T(1) - reflectance;
      const auto channel = [&](auto c) {
        const T left = exp(-(absorption.*c) * way), inside = left * reflectance;
        lobes.part[0].*c = reflectance;
        lobes.part[1].*c = enters * enters * left;
        lobes.part[2].*c = lobes.part[1].*c * inside;
        lobes.part[3].*c = lobes.part[2].*c * inside / max(T(1) - inside, T(1e-6F));
      };
      channel(&Rgb<T>::red);
      channel(&Rgb<T>::green);
      channel(&Rgb<T>::blue);
      T sum(0);
      for (std::size_t p = 0; p < 4; ++p) {
        const Rgb<T>& part = lobes.part[p];
        lobes.choice[p] = max(part.red + part.green + part.blue, T(p == 0 ? 1e-6F : 0));
        sum = sum + lobes.choice[p];
      }
      for (T& choice : lobes.choice) choice = choice / sum;

      // Scales turn R by twice their tilt away from the mirrored direction, TT by once and TRT by four times to the
      // other side.
      const T sine2 = T(2) * tilt_sine * tilt_cosine, cosine_of_2 = T(1) - T(2) * tilt_sine * tilt_sine;
      const T sine4 = T(2) * sine2 * cosine_of_2, cosine_of_4 = T(1) - T(2) * sine2 * sine2;
      const auto turned = [&](const T& s, const T& c, const T& v, const T& scale) {
        return LongitudinalLobe<T>{sine * c + cosine * s, abs(cosine * c - sine * s), v, scale};
      };
      lobes.along[0] = turned(-sine2, cosine_of_2, variance, reflected_scale);
      lobes.along[1] = turned(tilt_sine, tilt_cosine, variance * T(0.25F), through_scale);
      lobes.along[2] = turned(sine4, cosine_of_4, variance * T(4), returned_scale);
      lobes.along[3] = {sine, cosine, variance * T(4), returned_scale};
      return lobes;
    }
    BsdfSample<T> sample(const Lobes& lobes, const T& u, const T& u1, const T& u2) const {
      // What is left of u, once it has chosen, is even again.
      LongitudinalLobe<T> along = lobes.along[0];
      T below(0), choice = lobes.choice[0], middle = -lobes.outside - lobes.outside;
      Mask<T> is_even(false);
      T end = choice;
      for (std::size_t p = 1; p < 4; ++p) {
        const Mask<T> here = (u >= end) & (lobes.choice[p] > T(0));
        const LongitudinalLobe<T>& other = lobes.along[p];
        along = {select(here, other.sine, along.sine), select(here, other.cosine, along.cosine),
                 select(here, other.variance, along.variance), along.scale};
        below = select(here, end, below);
        choice = select(here, lobes.choice[p], choice);
        middle = select(here, middle_of(lobes, p), middle);
        if (p == 3) is_even = here;
        end = end + lobes.choice[p];
      }
      const T rest = min(max((u - below) / choice, T(0)), T(0x1.fffffep-1F));
      const T sine = along.sample(u1, sin_cos_of_turns(rest).cosine);
      const T away = select(is_even, u2, around().sample(u2));
      const auto [y, z] = sin_cos_of_turns(lobes.outside + middle + away);
      const T cosine = sqrt(max(T(1) - sine * sine, T(0)));
      const Vec3<T> wi{sine, cosine * y, cosine * z};
      const Value value = this->value(lobes, wi);
      return {wi, value.f, value.pdf};
    }
    BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const {
      return sample(lobes(wo), u, u1, u2);
    }
    Value value(const Lobes& lobes, const Vec3<T>& wi) const {
      const T sine = min(max(wi.x, T(-1)), T(1)), cosine = sqrt(T(1) - sine * sine);
      const T turn = turns(wi.y, wi.z) - lobes.outside;
      Value result{black(), T(0)};
      for (std::size_t p = 0; p < 4; ++p) {
        T density = lobes.along[p].density(sine, cosine);
        if (p == 3) {
          density = density * T(0.5F * std::numbers::inv_pi_v<float>);
        } else {
          const T away = turn - middle_of(lobes, p);
          density = density * around().density(away - floor(away + T(0.5F)));
        }
        result.f += lobes.part[p] * density;
        result.pdf = result.pdf + lobes.choice[p] * density;
      }
      // Where wi is along the surface, f has no bound, but its product with the cosine has: what the bound takes is
      // beyond the precision of directions.
      result.f = result.f * (T(1) / max(abs(wi.z), T(1e-5F)));
      return result;
    }

   private:
    static Rgb<T> black() { return Rgb<T>(T(0), T(0), T(0)); }
    /// The angle of (y, z) with z; of a direction along the axis, which has none, 0.
    static T turns(const T& y, const T& z) {
      const T size = abs(y) + abs(z);
      return atan2(y, select(size > T(0), z, T(1))) * T(0.5F * std::numbers::inv_pi_v<float>);
    }
    AzimuthalLobe<T> around() const { return {spread, inverse_part}; }
    /// phi_i - phi_o of light that goes through the inside p times, as geometrical optics have it, in turns.
    static T middle_of(const Lobes& lobes, std::size_t p) {
      const auto count = static_cast<float>(p);
      return lobes.inside * T(2 * count) - lobes.outside * T(2) + T(0.5F * count);
    }
  };

  template <class T, class Value>
  static Bsdf<T> bsdf_of(const Hair::Values<Value>& hair) {
    using std::exp;
    using std::log;
    using std::max;
    using std::min;
    using std::sqrt;
    const auto clamped = [](const Value& x, float least, float most) { return min(max(x, Value(least)), Value(most)); };
    const auto number = [](const Value& value) { return static_cast<T>(value); };
    const Value along = clamped(hair.roughness, least_roughness, 1),
                around = clamped(hair.radialroughness, least_roughness, 1);
    const auto power16 = [](const Value& x) {
      const Value x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
      return x8 * x8;
    };
    const Value along2 = along * along, around2 = around * around;
    // Chiang et al., equations 7 and 8.
    const Value deviation =
        Value(0.726F) * along + Value(0.812F) * along2 + Value(3.7F) * power16(along) * along2 * along2;
    const Value v = deviation * deviation;
    const Value spread = Value(0.62665707F) * (Value(0.265F) * around + Value(1.194F) * around2 +
                                               Value(5.372F) * power16(around) * around2 * around2 * around2);
    // Equation 9, of the color, and the other way round.
    const Value fit =
        ((((Value(0.245F) * around + Value(5.574F)) * around - Value(10.73F)) * around + Value(2.532F)) * around -
         Value(0.215F)) *
            around +
        Value(5.969F);
    const Value pigment = -log(max(Value(1) - hair.melanin, Value(1e-4F)));
    const Value red_pigment = pigment * clamped(hair.melaninredness, 0, 1), brown_pigment = pigment - red_pigment;
    Bsdf<T> bsdf;
    const auto channel = [&](auto c, auto to, float eumelanin, float pheomelanin) {
      const Value root = log(clamped(hair.color.*c, 1e-6F, 1)) / fit;
      const Value absorption = max(hair.absorption.*c, Value(0)) + brown_pigment * Value(eumelanin) +
                               red_pigment * Value(pheomelanin) + hair.by_color * root * root;
      bsdf.absorption.*to = number(absorption);
      bsdf.color.*to = number(exp(-sqrt(absorption) * fit));
    };
    channel(&Rgb<Value>::red, &Rgb<T>::red, 0.506F, 0.343F);
    channel(&Rgb<Value>::green, &Rgb<T>::green, 0.841F, 0.733F);
    channel(&Rgb<Value>::blue, &Rgb<T>::blue, 1.653F, 1.924F);
    bsdf.eta = number(clamped(hair.ior, 1, 3));
    bsdf.variance = number(v);
    bsdf.reflected_scale = number(LongitudinalLobe<Value>::scale_of(v));
    bsdf.through_scale = number(LongitudinalLobe<Value>::scale_of(Value(v * Value(0.25F))));
    bsdf.returned_scale = number(LongitudinalLobe<Value>::scale_of(Value(v * Value(4.0F))));
    bsdf.spread = number(spread);
    bsdf.inverse_part = number(AzimuthalLobe<Value>::inverse_part_of(spread));
    // The sine's series is exact to floats up to most_tilt.
    constexpr auto most = static_cast<float>(Hair::most_tilt);
    const Value tilt = clamped(hair.scaletilt, -most, most) * Value(std::numbers::pi_v<float> / 180);
    const Value tilt2 = tilt * tilt;
    const Value sine = tilt * (Value(1) - tilt2 * (Value(1) - tilt2 * Value(0.05F)) * Value(1.0F / 6));
    bsdf.tilt_sine = number(sine);
    bsdf.tilt_cosine = number(sqrt(Value(1) - sine * sine));
    return bsdf;
  }
  static Bsdf<float> bsdf(const Hair::Parameters& parameters) {
    return bsdf_of<float, double>(Hair::values(parameters));
  }

 private:
  /// Below, highlights would be narrower than floats and samples are for.
  static constexpr float least_roughness = 0.02F;
};

}  // namespace raytrace
