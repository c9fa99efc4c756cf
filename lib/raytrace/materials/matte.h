// Matte: ambient and diffuse reflection by two Lambertian BRDFs (Suffern, chapter 14).
//
//   <matte> <name>clay</name> <ka>0.25</ka> <kd>0.75</kd> <cd red="1" green="1" blue="0"/> </matte>
#pragma once

#include "raytrace/brdfs/lambertian.h"
#include "raytrace/math/vec3.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class Matte {
 public:
  struct Parameters {
    double ka = 0;     ///< ambient reflection coefficient
    double kd = 0;     ///< diffuse reflection coefficient
    Rgb<double> cd{};  ///< diffuse colour
  };
  static constexpr std::string_view group = "mattes";
  static constexpr std::string_view element = "matte";
  static Fields<Parameters> fields();

  template <class T>
  struct Brdfs {
    Lambertian<T> ambient, diffuse;
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
  static Rgb<T> reflect(const Brdfs<T>& brdfs, const Vec3<T>&, const Vec3<T>&, const Vec3<T>&) {
    return brdfs.diffuse.f();
  }
};

}  // namespace raytrace
