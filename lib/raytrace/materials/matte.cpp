#include "raytrace/materials/matte.h"

namespace raytrace {

Fields<Matte::Parameters> Matte::fields() {
  return {required("ka", &Parameters::ka, Range::not_negative), required("kd", &Parameters::kd, Range::not_negative),
          required("cd", &Parameters::cd)};
}

Matte::Brdfs<float> Matte::brdfs(const Parameters& parameters) {
  return {{Rgb<float>(parameters.cd * parameters.ka)}, {Rgb<float>(parameters.cd * parameters.kd)}};
}

}  // namespace raytrace
