// Phong: Matte plus a highlight by a GlossySpecular BRDF (Suffern, chapter 15).
//
//   <phong>
//     <name>plastic</name> <ka>0.25</ka> <kd>0.6</kd> <ks>0.2</ks> <cd red="1" green="0" blue="0"/>
//     <cs red="1" green="1" blue="1"/> <exp>50</exp>
//   </phong>
#pragma once

#include "raytrace/brdfs/glossy_specular.h"
#include "raytrace/brdfs/lambertian.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Phong {
 public:
  struct Parameters {
    double ka = 0;     ///< ambient reflection coefficient
    double kd = 0;     ///< diffuse reflection coefficient
    double ks = 0;     ///< specular reflection coefficient
    Rgb<double> cd{};  ///< diffuse colour
    Rgb<double> cs{};  ///< specular colour
    double exp = 20;   ///< the larger, the smaller the highlight
  };
  static constexpr std::string_view group = "phongs";
  static constexpr std::string_view element = "phong";
  static Fields<Parameters> fields();

  template <class T>
  struct Brdfs {
    Lambertian<T> ambient, diffuse;
    GlossySpecular<T> specular;
  };
  static Brdfs<float> brdfs(const Parameters& parameters);

  template <class T>
  static Rgb<T> ambient(const Brdfs<T>& brdfs, const Rgb<T>& radiance) {
    return brdfs.ambient.rho() * radiance;
  }

  template <class T>
  static Rgb<T> albedo(const Brdfs<T>& brdfs) {
    return brdfs.diffuse.rho();
  }

  template <class T>
  static Rgb<T> reflect(const Brdfs<T>& brdfs, const Vec3<T>& wo, const Vec3<T>& wi, const Vec3<T>& normal) {
    return brdfs.diffuse.f() + brdfs.specular.f(wo, wi, normal);
  }
};

}  // namespace raytrace
