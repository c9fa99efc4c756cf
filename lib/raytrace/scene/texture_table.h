// All textures of a scene, and what materials make of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/rgba.h"
#include "raytrace/textures/kernels.h"

namespace raytrace {

/// A texture that multiplies a parameter of a material.
struct TextureFactor {
  std::size_t texture;    ///< its number in the TextureTable
  std::size_t parameter;  ///< the first number that it multiplies, among all of the material's parameters
  bool is_color;          ///< it multiplies three of them
  TextureChannel channel;
};

/// Immutable.
class TextureTable {
 public:
  explicit TextureTable(const SceneDescription& description) {
    for_each_type(Textures{}, [&]<class T>(std::type_identity<T>) {
      first_.push_back(textures_.size());
      for (const auto& item : std::get<TextureItems<T>>(description.textures)) add<T>(item);
    });
  }

  /// By which set of texture coordinates a texture looks up that a field which is a number names.
  UvSet uvset(const TextureUse& use) const { return uvset_of(textures_[number(use.texture, false)]); }
  /// Whether any does by the second.
  bool has_second_uvset() const {
    return std::any_of(textures_.begin(), textures_.end(),
                       [](const AnyTexture& texture) { return uvset_of(texture) == UvSet::second; });
  }

  /// Whether a texture that a field which is a number names is looked up by texture coordinates alone.
  bool is_image(const TextureUse& use) const { return use.texture.type == index_of<Image>(Textures{}); }

  /// Whether any is fixed to objects.
  bool has_object_space() const {
    return std::any_of(textures_.begin(), textures_.end(), [](const AnyTexture& any) {
      return std::visit(
          [](const auto& texture) {
            if constexpr (requires { texture.space(); })
              return texture.space() == TextureSpace::object;
            else
              return false;
          },
          any);
    });
  }

  /// uses: those of a material of this type.
  template <class Material>
  std::vector<TextureFactor> factors(std::span<const TextureUse> uses) const {
    using Parameters = typename Material::Parameters;
    static_assert(std::is_base_of_v<typename Material::template Values<double>, Parameters> ||
                  std::is_same_v<typename Material::template Values<double>, Parameters>);
    std::vector<TextureFactor> factors;
    for (const TextureUse& use : uses) {
      const Field& field = element_type<Material>().fields.at(use.field);
      if (is_surface_detail(field.name)) continue;
      const bool is_color = !field.is<double>();
      factors.push_back({number(use.texture, is_color), field.offset() / sizeof(double), is_color, use.channel});
    }
    return factors;
  }

  /// Multiplies a material's parameters, which are numbers of one type beside each other, by the textures.
  void multiply(FloatN* parameters, std::span<const TextureFactor> factors, const TexturePoint<FloatN>& point) const {
    for (const TextureFactor& factor : factors) {
      const Rgba<FloatN> value =
          std::visit([&](const auto& texture) { return texture.at(point); }, textures_[factor.texture]);
      const Rgb<FloatN>& color = value.color;
      FloatN* const first = parameters + factor.parameter;
      if (factor.is_color) {
        first[0] = first[0] * color.red;
        first[1] = first[1] * color.green;
        first[2] = first[2] * color.blue;
      } else {
        *first = *first * max(channel_of(value, factor.channel), FloatN(0));
      }
    }
  }

  /// The same by the most that the textures are, by magnitude.
  void multiply_by_largest(double* parameters, std::span<const TextureFactor> factors) const {
    for (const TextureFactor& factor : factors) {
      const double largest =
          std::visit([](const auto& texture) { return texture.largest(); }, textures_[factor.texture]);
      for (std::size_t i = 0; i < (factor.is_color ? 3U : 1U); ++i) parameters[factor.parameter + i] *= largest;
    }
  }

  /// The numbers of a texture that are no colour.
  Rgb<FloatN> vector_at(const TextureUse& use, const TexturePoint<FloatN>& point) const {
    return std::visit([&](const auto& texture) { return texture.at(point).color; },
                      textures_[number(use.texture, false)]);
  }

  /// The numbers of a texture that a field which is one names.
  FloatN number_at(const TextureUse& use, const TexturePoint<FloatN>& point) const {
    return std::visit(
        [&](const auto& texture) {
          TextureChannel channel = use.channel;
          if (channel == TextureChannel::automatic) channel = TextureChannel::red;
          if constexpr (requires { texture.has_alpha(); })
            if (use.channel == TextureChannel::automatic && texture.has_alpha()) channel = TextureChannel::alpha;
          return channel_of(texture.at(point), channel);
        },
        textures_[number(use.texture, false)]);
  }

 private:
  using AnyTexture = KernelVariant<Textures>::type;

  static UvSet uvset_of(const AnyTexture& any) {
    return std::visit(
        [](const auto& texture) {
          if constexpr (requires { texture.uvset(); })
            return texture.uvset();
          else
            return UvSet::first;
        },
        any);
  }

  static FloatN channel_of(const Rgba<FloatN>& value, TextureChannel channel) {
    if (channel == TextureChannel::red) return value.color.red;
    if (channel == TextureChannel::green) return value.color.green;
    return channel == TextureChannel::blue ? value.color.blue : value.alpha;
  }

  template <class T>
  void add(const TextureItem<T>& item) {
    if constexpr (std::is_same_v<T, Image>) {
      textures_.push_back(Kernel<Image>(item.parameters, item.image.color));
      textures_.push_back(Kernel<Image>(item.parameters, item.image.number));
    } else {
      textures_.push_back(Kernel<T>(item.parameters));
    }
  }

  /// Of an image there are two: for colours, and for numbers.
  std::size_t number(const TextureReference& texture, bool is_color) const {
    const std::size_t first = first_[texture.type], index = texture.index;
    return texture.type == index_of<Image>(Textures{}) ? first + 2 * index + (is_color ? 0 : 1) : first + index;
  }

  std::vector<std::size_t> first_;  ///< of each type
  std::vector<AnyTexture> textures_;
};

}  // namespace raytrace
