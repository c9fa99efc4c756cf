// The kernels of all lights.
//
// A light's Kernel provides:
//   explicit Kernel(const Parameters&);
//   static constexpr bool ambient;         true: light from everywhere, never shadowed
// and, if it is ambient:
//   Rgb<float> radiance() const;
// else:
//   bool shadows() const;
//   Rgb<float> largest_radiance() const;   no point gets more, by magnitude; of a light that falls off, at distance 1
//   template <class F> LightSample<F> sample(const Vec3<F>& p) const;
// and, if it can, and its Parameters have a `location`:
//   bool falls_off() const;    with the square of the distance from there
//   PointSource<float> source() const;    the same light as a record, if it falls off, but for its photometric_share()
//   const PhotometricShare& photometric_share() const;
// and, if it may be larger than a point:
//   bool takes_samples() const;    then sample(p, u1, u2), at any place of it, and none of the two below
//   template <class F> LightSample<F> sample(const Vec3<F>& p, const F& u1, const F& u2) const;   numbers in [0, 1)
// and, so that shadows are found sooner, one of these, where it holds:
//   Vec3f location() const;    to_light is location() - p, and t_max is 1
//   Vec3f direction() const;   to_light is direction(), of unit length, and t_max is infinity
#pragma once

#include "raytrace/lights/ambient_light_kernel.h"
#include "raytrace/lights/directional_light_kernel.h"
#include "raytrace/lights/point_light_kernel.h"
#include "raytrace/lights/registry.h"
#include "raytrace/lights/sky_light_kernel.h"
#include "raytrace/lights/spot_light_kernel.h"
