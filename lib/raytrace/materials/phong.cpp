#include "raytrace/materials/phong.h"

namespace raytrace {

Fields<Phong::Parameters> Phong::fields() {
  return {required("ka", &Parameters::ka, Range::not_negative),
          required("kd", &Parameters::kd, Range::not_negative),
          required("ks", &Parameters::ks, Range::not_negative),
          required("cd", &Parameters::cd),
          required("cs", &Parameters::cs),
          optional("exp", &Parameters::exp, Range::not_negative)};
}

Phong::Brdfs<float> Phong::brdfs(const Parameters& parameters) {
  return {{Rgb<float>(parameters.cd * parameters.ka)},
          {Rgb<float>(parameters.cd * parameters.kd)},
          {Rgb<float>(parameters.cs * parameters.ks), static_cast<float>(parameters.exp)}};
}

}  // namespace raytrace
