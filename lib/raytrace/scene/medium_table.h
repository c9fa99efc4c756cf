// The media of a scene, and which of them a path is in: dielectrics in each other, such as ice in water in a glass.
//
// Modelled walls overlap, or leave gaps, where real ones touch. So each clear material has a priority, and where
// several of them are, the one of the highest counts, of equal ones the one that the path came into last; what lies
// inside of one that counts more is not there (Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images",
// JGT 2002).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "raytrace/materials/medium.h"
#include "raytrace/math/color.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/scene.h"

namespace raytrace {

/// Media have numbers from 1 on. 0 is none: the air about all objects.
class MediumTable {
 public:
  /// media: each material's; none where nothing is inside. places: of those that are fogs with a density, in how many
  /// places they are besides the first: each has a number of its own, behind the medium's. Empty: there is no such fog.
  /// Throws RenderError for more than numbers of 16 bits count.
  void set(const std::vector<std::optional<Medium>>& media, const std::vector<std::optional<std::size_t>>& places) {
    *this = {};
    std::int32_t densities = 0;
    if (!places.empty()) densities_.push_back(-1);
    for (std::size_t i = 0; i < media.size(); ++i) {
      numbers_.push_back(0);
      if (!media[i]) continue;
      const bool is_uneven = !places.empty() && places[i];
      numbers_.back() = static_cast<std::int32_t>(ior_.size());
      const std::size_t count = is_uneven ? 1 + *places[i] : 1;
      if (ior_.size() + count > 1U << 16U)
        throw RenderError(
            "there are more than 65,535 clear materials, counting fogs that are not the same everywhere once for each "
            "instance");
      for (std::size_t j = 0; j < count; ++j) {
        add(*media[i]);
        if (!places.empty()) densities_.push_back(is_uneven ? densities++ : -1);
      }
    }
  }

  bool empty() const { return ior_.size() == 1; }
  /// Whether any of them disperses light.
  bool disperses() const { return disperses_; }
  /// Whether any of them but fogs scatters light, and which lanes' do.
  bool scatters() const { return scatters_; }
  MaskN scatters(const IntN& medium) const {
    const MaskN does = sum(scattering_, medium) > FloatN(0);
    return has_fog_ ? does & !is_fog(medium) : does;
  }
  /// Whether any of them is a fog, and which lanes' are.
  bool has_fog() const { return has_fog_; }
  MaskN is_fog(const IntN& medium) const {
    return float_mask<FloatN>(medium != IntN(0)) & float_mask<FloatN>(priority(medium) == IntN(Medium::fog_priority));
  }

  /// Whether any of them is a fog that is not the same everywhere, which lanes' are, and their numbers among such, in
  /// which those of one fog follow each other.
  bool has_densities() const { return !densities_.empty(); }
  IntN density(const IntN& medium) const { return gather(densities_.data(), medium); }
  MaskN has_density(const IntN& medium) const { return float_mask<FloatN>(density(medium) > IntN(-1)); }
  /// What so much of it that nothing shines through sends; whether any does.
  bool has_emission() const { return has_emission_; }
  Rgb<FloatN> emission(const IntN& medium) const {
    return {gather(emission_.red.data(), medium), gather(emission_.green.data(), medium),
            gather(emission_.blue.data(), medium)};
  }

  /// Of a fog that is in several places the first.
  IntN of_material(const IntN& material) const { return gather(numbers_.data(), material); }
  FloatN ior(const IntN& medium) const { return gather(ior_.data(), medium); }
  /// dispersion_of() its Abbe number; of none 0.
  FloatN dispersion(const IntN& medium) const { return gather(dispersion_.data(), medium); }
  /// Of none the least there is.
  IntN priority(const IntN& medium) const { return gather(priority_.data(), medium); }
  /// The share that is left of light that went so far in it. distance: may be infinite, of rays that meet nothing.
  Rgb<FloatN> transmittance(const IntN& medium, const FloatN& distance) const {
    const FloatN way = min(distance, FloatN(1e30F));
    return {exp(gather(red_.data(), medium) * way), exp(gather(green_.data(), medium) * way),
            exp(gather(blue_.data(), medium) * way)};
  }
  /// For a unit of length; the share of it that is scattered; and the mean cosine of a scattering.
  Rgb<FloatN> extinction(const IntN& medium) const {
    return {-gather(red_.data(), medium), -gather(green_.data(), medium), -gather(blue_.data(), medium)};
  }
  Rgb<FloatN> albedo(const IntN& medium) const {
    const FloatN least(1e-30F);
    const Rgb<FloatN> all = extinction(medium);
    return {gather(scattering_.red.data(), medium) / max(all.red, least),
            gather(scattering_.green.data(), medium) / max(all.green, least),
            gather(scattering_.blue.data(), medium) / max(all.blue, least)};
  }
  Rgb<FloatN> scattering(const IntN& medium) const {
    return {gather(scattering_.red.data(), medium), gather(scattering_.green.data(), medium),
            gather(scattering_.blue.data(), medium)};
  }
  FloatN anisotropy(const IntN& medium) const { return gather(anisotropy_.data(), medium); }

 private:
  void add(const Medium& medium) {
    ior_.push_back(medium.ior);
    dispersion_.push_back(medium.dispersion);
    disperses_ |= medium.dispersion > 0;
    priority_.push_back(medium.priority);
    red_.push_back(-medium.extinction.red);
    green_.push_back(-medium.extinction.green);
    blue_.push_back(-medium.extinction.blue);
    scattering_.red.push_back(medium.scattering.red);
    scattering_.green.push_back(medium.scattering.green);
    scattering_.blue.push_back(medium.scattering.blue);
    anisotropy_.push_back(medium.anisotropy);
    emission_.red.push_back(medium.emission.red);
    emission_.green.push_back(medium.emission.green);
    emission_.blue.push_back(medium.emission.blue);
    has_emission_ |= medium.emission.red + medium.emission.green + medium.emission.blue > 0;
    has_fog_ |= medium.is_fog();
    scatters_ |= !medium.is_fog() && medium.scattering.red + medium.scattering.green + medium.scattering.blue > 0;
  }

  struct Channels {
    std::vector<float> red{0}, green{0}, blue{0};
  };
  static FloatN sum(const Channels& channels, const IntN& medium) {
    return gather(channels.red.data(), medium) + gather(channels.green.data(), medium) +
           gather(channels.blue.data(), medium);
  }

  std::vector<std::int32_t> numbers_, priority_{std::numeric_limits<std::int32_t>::min()};
  std::vector<float> ior_{1}, dispersion_{0};
  std::vector<float> red_{0}, green_{0}, blue_{0};  ///< what is left of these colours, as exponents
  Channels scattering_, emission_;
  std::vector<float> anisotropy_{0};
  std::vector<std::int32_t> densities_;  ///< -1: it is the same everywhere; empty: all are
  bool disperses_ = false, scatters_ = false, has_fog_ = false, has_emission_ = false;
};

/// The media that each lane's path is in, in the order in which it came into them: four at most. Of more, the last
/// ones are not known.
class MediumStack {
 public:
  /// As they are kept in paths' records: two media in each number.
  struct Packed {
    IntN first{0}, last{0};
  };

  MediumStack() = default;
  explicit MediumStack(const Packed& packed)
      : media_{low(packed.first), high(packed.first), low(packed.last), high(packed.last)} {}
  Packed packed() const { return {media_[0] | media_[1] << 16, media_[2] | media_[3] << 16}; }

  MaskN is_in_any() const { return is(media_[0] != IntN(0)); }

  /// The medium that counts.
  IntN current(const MediumTable& table) const {
    IntN medium(0), priority(std::numeric_limits<std::int32_t>::min());
    for (const IntN& other : media_) {
      const IntN its_priority = table.priority(other);
      const MaskN counts = is(other != IntN(0)) & is(its_priority >= priority);
      medium = select_lanes(counts, other, medium);
      priority = select_lanes(counts, its_priority, priority);
    }
    return medium;
  }

  MaskN contains(const IntN& medium) const {
    return is(media_[0] == medium) | is(media_[1] == medium) | is(media_[2] == medium) | is(media_[3] == medium);
  }

  /// The path has come into it, in those lanes.
  void add(const MaskN& lanes, const IntN& medium) {
    MaskN left = lanes;
    for (IntN& place : media_) {
      const MaskN here = left & is(place == IntN(0));
      place = select_lanes(here, medium, place);
      left = left & !here;
    }
  }

  /// The path was in it before it came into all others.
  void add_first(const MaskN& lanes, const IntN& medium) {
    for (std::size_t i = media_.size() - 1; i > 0; --i) media_[i] = select_lanes(lanes, media_[i - 1], media_[i]);
    media_[0] = select_lanes(lanes, medium, media_[0]);
  }

  /// The path was in all of these before: in those that are not known.
  void add_first(const MaskN& lanes, const MediumStack& others) {
    for (const IntN& medium : others.media_) add_first(lanes & is(medium != IntN(0)) & !contains(medium), medium);
  }

  /// Without the media that `others` do not have.
  void keep_common(const MediumStack& others) {
    for (std::size_t i = media_.size(); i-- > 0;) {
      const IntN medium = media_[i];
      remove(is(medium != IntN(0)) & !others.contains(medium), medium);
    }
  }

  /// The path has come out of it: of the last one of that number.
  void remove(const MaskN& lanes, const IntN& medium) {
    MaskN left = lanes;
    std::array<MaskN, 4> found;
    for (std::size_t i = media_.size(); i-- > 0;) {
      found[i] = left & is(media_[i] == medium);
      left = left & !found[i];
    }
    MaskN moves(false);
    for (std::size_t i = 0; i < media_.size(); ++i) {
      moves = moves | found[i];
      media_[i] = select_lanes(moves, i + 1 < media_.size() ? media_[i + 1] : IntN(0), media_[i]);
    }
  }

 private:
  static MaskN is(const typename IntN::batch_bool_type& mask) { return float_mask<FloatN>(mask); }
  static IntN low(const IntN& packed) { return packed & IntN(0xFFFF); }
  static IntN high(const IntN& packed) { return same_bits<IntN>(same_bits<UintN>(packed) >> 16); }

  std::array<IntN, 4> media_{IntN(0), IntN(0), IntN(0), IntN(0)};
};

/// What is on the two sides of the surfaces that paths come to.
struct MediumBoundary {
  IntN inside{0};            ///< the surface's own medium; 0 where it has none
  IntN current{0};           ///< that the path came through
  IntN outside{0};           ///< what is outside of the surface
  Refraction<FloatN> media;  ///< their indices of refraction
  MaskN is_there{true};      ///< false: it lies inside of a medium that counts more

  /// stack: of paths that came to surfaces of materials with that inside, from the front or not. Paths that come from
  /// the inside of what they are not known to be in have been there since they began.
  MediumBoundary(const MediumTable& table, MediumStack& stack, const MaskN& lanes, const IntN& its_inside,
                 const MaskN& front)
      : inside(its_inside) {
    const MaskN has_inside = float_mask<FloatN>(inside != IntN(0)), leaves = lanes & has_inside & !front;
    stack.add_first(leaves & !stack.contains(inside), inside);
    current = stack.current(table);
    MediumStack around = stack;
    around.remove(leaves, inside);
    outside = around.current(table);
    media.outside = table.ior(outside);
    const MaskN hidden_ahead = float_mask<FloatN>(table.priority(current) > table.priority(inside)) & front;
    const MaskN hidden_behind = float_mask<FloatN>(current != inside) & !front;
    is_there = !(has_inside & (hidden_ahead | hidden_behind));
  }
  MediumBoundary() = default;

  /// Those of the lanes at whose surfaces the indices depend on the wavelength.
  MaskN disperses(const MediumTable& table, const MaskN& lanes) const {
    const MaskN has_inside = float_mask<FloatN>(inside != IntN(0));
    return lanes & has_inside & (table.dispersion(inside) + table.dispersion(outside) > FloatN(0));
  }
  /// Sets the indices to those of light of that deviation (materials/dispersion.h).
  void set_deviation(const MediumTable& table, const FloatN& deviation) {
    media.disperses = true;
    media.factor = FloatN(1) + table.dispersion(inside) * deviation;
    media.outside = FloatN(1) + (table.ior(outside) - FloatN(1)) * (FloatN(1) + table.dispersion(outside) * deviation);
  }

  /// The paths go through the surfaces, in those lanes.
  void cross(MediumStack& stack, const MaskN& lanes, const MaskN& front) const {
    const MaskN has_inside = lanes & float_mask<FloatN>(inside != IntN(0));
    stack.add(has_inside & front, inside);
    stack.remove(has_inside & !front, inside);
  }
};

}  // namespace raytrace
