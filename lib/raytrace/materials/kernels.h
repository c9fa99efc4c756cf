// The kernels of all materials.
//
// A material's Kernel provides:
//   template <class T> struct Bsdf { ... };   what the tracer keeps of a material: members of type T only
//   template <class T, class Value> static Bsdf<T> bsdf_of(const Values<Value>&);   the Parameters are Values<double>,
//                                             or derive from them: what bsdf_of() needs of the rest, the material's own
//                                             `static Values<double> values(const Parameters&)` puts there
//   static Bsdf<float> bsdf(const Parameters&);
// and of Bsdf<T>, where T is a batch:
//   Rgb<T> ambient_radiance(const Rgb<T>& radiance) const;   what leaves under ambient light of that radiance
//   Rgb<T> albedo() const;       the share of light from all sides that it scatters evenly to all sides, without
//                                highlights; of mirrors, metals and glass what they reflect, as denoisers want it
//   Rgb<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) const;
//                                f in 1/steradian, without the cosine; world space, unit vectors away from the surface
//   BsdfSample<T> sample(const Vec3<T>& wo, const T& u, const T& u1, const T& u2) const;
//                                draws wi in the local frame (bsdfs/bsdf_sample.h) out of numbers in [0, 1): u chooses
//                                a lobe, u1 and u2 a direction in it
//   T pdf(const Vec3<T>& wo, const Vec3<T>& wi) const;
//                                the density at which sample() draws wi, per solid angle, in the local frame
// evaluate() and pdf() are of what is not smooth. wo is on the normal's side; wi may be below the surface: there they
// are 0, or of what comes through, if the material says by scatters_through() that it knows that. And, if it
//   shines by itself:
//     Rgb<T> emitted() const;                    radiance, the same in all directions
//   has two sides:
//     void set_side(const Mask<T>& front, const Refraction<T>& media);
//                                                whether wo is on the surface's front, and the indices of refraction
//                                                on both sides (materials/medium.h): called before all others
//   reflects some of the light in highlights:
//     Rgb<T> gloss(const Vec3<T>& wo, const Vec3<T>& wi) const;   that part of evaluate(), in the local frame
//   or all that it reflects:
//     static constexpr bool is_glossy = true;
//   has highlights far brighter than most of what it reflects:
//     Rgb<T> usual_f() const;                    in place of evaluate() straight back, for the film's unit
//   has evaluate() in the local frame, as all others are:
//     static constexpr bool in_local_frame = true;   false: there only where some material of the scene is anisotropic
//   does much for wo alone:
//     lobes(wo);                                 the result of it, from which follow, in the local frame,
//     sample(lobes, u, u1, u2); value(lobes, wi);   the same as sample(wo, ...); evaluate() and pdf(), as f and pdf
//     lobes(wo, const LayerFrames<T>*);          likewise, of layers with normals of their own (bsdfs/layer_normals.h)
//     gloss(lobes, wi, Gloss which);             with them: as gloss(wo, wi)
//   lets light in that comes out elsewhere, as sample() says by `enters`:
//     Subsurface<T> subsurface_inside() const;   what it is scattered by (materials/subsurface.h)
//   sends light through:
//     Rgb<T> transmittance(const T& distance) const;   the share that is left of light that went so far behind it
//   and Kernel's
//     static std::optional<Medium> medium(const Parameters&, const Bsdf<float>&);   what is inside
//
// A material that sends what it gets from one direction into one or a few, as mirrors, metals and clear glass do, may
// say so of its Parameters:
//   static bool focuses(const Parameters&, is_textured);   is_textured(name): whether that field of it has a texture
// Then light paths carry the light that it sends on (integrators/path.h, Caustics): evaluate() must know all that
// sample() draws and is not `specular`.
//
// One that lets light through rough facets, and whose evaluate(), pdf() and value() know what comes from behind, may
// say so in the same way by scatters_through(). Then light is drawn for it from behind as well.
//
// One of fibres, in which one scattering stands for all that happens in them, has
//   static constexpr bool is_fibre = true;
// It is of curves alone, which rays then hit from outside alone. The tangent, x of the local frame, is the fibre's
// axis.
//
// One that lets light straight through, as thin panes do, may say so in the same way by is_pane(). Then shadow rays
// pass it, and its Bsdf has
//   Rgb<T> straight(const Vec3<T>& wo) const;    the share of light that comes through, in the local frame
#pragma once

#include "raytrace/materials/conductor_kernel.h"
#include "raytrace/materials/dielectric_kernel.h"
#include "raytrace/materials/emissive_kernel.h"
#include "raytrace/materials/fog_kernel.h"
#include "raytrace/materials/hair_kernel.h"
#include "raytrace/materials/matte_kernel.h"
#include "raytrace/materials/mirror_kernel.h"
#include "raytrace/materials/openpbr_kernel.h"
#include "raytrace/materials/phong_kernel.h"
#include "raytrace/materials/registry.h"
