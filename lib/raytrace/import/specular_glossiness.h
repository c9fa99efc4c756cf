// glTF's specular-glossiness model in the terms of metal and roughness (KHR_materials_pbrSpecularGlossiness).
#pragma once

#include <memory>
#include <string>

#include "raytrace/math/color.h"

namespace raytrace {

/// A surface's colours, or of one pixel: numbers from 0 to 1.
struct MetalShare {
  Rgb<double> base_color;
  double metalness;
  double specular_weight;  ///< less than 1 of what reflects less than a dielectric of index 1.5 does
};

/// Khronos' conversion: of a mirror's colour and a diffuse one, which lose nothing where it is a metal or a dielectric,
/// and between both have the same brightness straight on. diffuse, specular: linear light.
MetalShare metal_share(const Rgb<double>& diffuse, const Rgb<double>& specular);

/// What a picture for one of OpenPBR's parameters follows from: two others of the model's, and what multiplies them.
struct SpecularGlossiness {
  struct Source {
    std::string file;                            ///< as the program opens it; empty: white
    std::shared_ptr<const std::string> bytes{};  ///< as MeshTexture has it
  };
  Source diffuse, specular;  ///< sRGB; the second's alpha is the glossiness
  Rgb<double> diffuse_factor{1, 1, 1}, specular_factor{1, 1, 1};
  double glossiness_factor = 1;
  bool is_color = true;  ///< the base colour; else red is the specular weight, green the roughness, blue the metalness
};

}  // namespace raytrace
