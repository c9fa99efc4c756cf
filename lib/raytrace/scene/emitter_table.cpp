#include "raytrace/scene/emitter_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "raytrace/math/lanes.h"
#include "raytrace/scene/patch_emission.h"
#include "raytrace/scene/patch_geometry.h"
#include "raytrace/scene/patch_pieces.h"
#include "raytrace/scene/patch_shares.h"

namespace raytrace {

namespace {

/// Beyond so many patches, further ones are left to the rays that meet them.
constexpr std::size_t most_patches = std::size_t{1} << 24;

/// About as many pieces at most are textured patches cut into, and about as often is a texture looked up for them; but
/// at least once for each.
constexpr std::size_t most_pieces = std::size_t{1} << 16, most_look_ups = std::size_t{1} << 20;
/// Of a face and of a piece, each way: a longer way in the tree costs more than cells do, but cells know nothing of how
/// near they are.
constexpr int most_cuts = 4, most_cells = 64;

/// How far p is from the surface that the patch is a piece of.
float distance_to(const PatchRecord<float>& patch, const Vec3f& p) {
  const Vec3f from = p - patch.origin;
  if (PatchCode::shape_of(patch.code) != PatchShape::band) {
    const Vec3f across = cross(patch.a, patch.b);
    return std::abs(dot(from, across)) / length(across);
  }
  const float height = dot(from, patch.a), radius = length(from - patch.a * height), rise = patch.b.y - patch.b.x;
  return std::abs((radius - patch.b.x) * patch.b.z - height * rise) / std::hypot(rise, patch.b.z);
}

std::uint32_t place_of(std::uint32_t instance) {
  return instance == 0 ? 0 : static_cast<std::uint32_t>(InstanceTable::index_of(instance)) + 1;
}

Affine to_double(const AffineRecord<float>& affine) {
  return {Vec3d(affine.x), Vec3d(affine.y), Vec3d(affine.z), Vec3d(affine.origin)};
}

}  // namespace

EmitterTable::EmitterTable(const GeometryTable& world, std::span<const MaterialEmission> materials,
                           LightSampling sampling, const RadianceAt& radiance_at) {
  const auto shines = [](const MaterialEmission& material) { return material.radiance > 0; };
  if (std::none_of(materials.begin(), materials.end(), shines)) return;
  instances_ = &world.instances();
  Making making{materials, radiance_at};
  making.cuts = 0;
  // All are drawn alike where they are drawn evenly.
  if (sampling != LightSampling::uniform && std::any_of(materials.begin(), materials.end(), [&](const auto& material) {
        return shines(material) && material.textured;
      })) {
    std::size_t textured = 0;
    for_each_geometry(
        world, materials,
        [&](const GeometryTable& table, std::uint32_t geometry, const Primitives& primitives, const Setting& setting) {
          for (std::int32_t i = primitives.first; i < primitives.last; ++i)
            if (const auto& material = materials[static_cast<std::size_t>(material_of(table, geometry, i, setting))];
                shines(material) && material.textured)
              ++textured;
        });
    const auto each_way = [&](std::size_t all, int most) {
      const double each = std::sqrt(static_cast<double>(all) / static_cast<double>(std::max(textured, std::size_t{1})));
      return std::clamp(static_cast<int>(each), 1, most);
    };
    making.cuts = each_way(most_pieces, most_cuts);
    const int cells = each_way(most_look_ups, most_cuts * most_cells) / making.cuts;
    making.cells = static_cast<std::int32_t>(std::bit_floor(static_cast<unsigned>(std::clamp(cells, 1, most_cells))));
    shares_ = PatchShares(making.cells);
  }
  has_own_radiances_ = making.cuts > 0;
  if (!has_own_radiances_)
    for (const MaterialEmission& material : materials) radiances_.push_back(material.radiance);
  for_each_geometry(world, materials,
                    [&](const GeometryTable& table, std::uint32_t geometry, const Primitives& primitives,
                        const Setting& setting) { add_geometry(table, geometry, primitives, setting, making); });
  if (has_motion()) movers_.resize(patches_.size(), 0);
  tree_ = LightTree(making.emissions, sampling);
}

template <class Function>
void EmitterTable::for_each_geometry(const GeometryTable& world, std::span<const MaterialEmission> materials,
                                     const Function& f) {
  const auto each_of = [&](const GeometryTable& table, const Setting& setting) {
    for (std::uint32_t i = 0; i < table.geometries().size(); ++i)
      f(table, i, Primitives{0, static_cast<std::int32_t>(table.geometry(i).primitives)}, setting);
  };
  each_of(world, {});
  const InstanceTable& instances = world.instances();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const InstanceTarget& target = instances.target(i);
    const GeometryTable& table =
        target.group == InstanceTarget::no_group ? world : *world.groups()[static_cast<std::size_t>(target.group)];
    Setting setting{instances.number(i), instances.materials()[i], to_double(instances.world_from_object(i)),
                    static_cast<double>(instances.scale(i)), target.is_shape};
    if (instances.moves(i)) setting.moments = instances.moments(i);
    if (setting.material >= 0 && !(materials[static_cast<std::size_t>(setting.material)].radiance > 0)) continue;
    if (!target.is_shape) {
      each_of(table, setting);
      continue;
    }
    const auto primitive = static_cast<std::int32_t>(target.primitive);
    f(table, target.shape_type, Primitives{primitive, primitive + 1}, setting);
  }
}

std::int32_t EmitterTable::material_of(const GeometryTable& table, std::uint32_t geometry, std::int32_t primitive,
                                       const Setting& setting) {
  return setting.material >= 0 ? setting.material
                               : table.material_of(0, geometry, static_cast<std::uint32_t>(primitive));
}

void EmitterTable::add_geometry(const GeometryTable& table, std::uint32_t geometry, Primitives primitives,
                                const Setting& setting, Making& making) {
  if (table.geometry(geometry).curves != nullptr) return;  // rays meet their light
  const MeshTable* const mesh = table.geometry(geometry).mesh;
  Range range{setting.instance,
              geometry,
              {},
              static_cast<std::int32_t>(patches_.size()),
              0,
              mesh != nullptr,
              setting.moments.empty() && setting.world_from_object.determinant() < 0};
  Faces faces;
  if (!setting.moments.empty()) faces.world_from_patches = setting.moments[setting.moments.size() / 2];
  const auto add = [&](std::int32_t primitive) {
    const std::int32_t number = material_of(table, geometry, primitive, setting);
    const MaterialEmission& material = making.materials[static_cast<std::size_t>(number)];
    if (!(material.radiance > 0)) return;
    std::vector<LightPatch>& patches = faces.patches;
    patches.clear();
    if (mesh != nullptr) {
      for (const bool second : {false, true})
        if (!second || mesh->corners() == 4)
          Kernel<Triangle>::add_patches(mesh->triangle(static_cast<std::size_t>(primitive), second), patches);
    } else {
      with_type(Shapes{}, geometry, [&]<class Shape>(std::type_identity<Shape>) {
        const auto& shapes = table.table<Shape>();
        const auto i = static_cast<std::size_t>(primitive);
        if constexpr (requires { Kernel<Shape>::add_patches(shapes.records[i], patches); })
          if (setting.is_shape || !shapes.is_instanced(i)) Kernel<Shape>::add_patches(shapes.records[i], patches);
      });
    }
    for (LightPatch& patch : patches) {
      if (setting.instance == 0 || !setting.moments.empty()) continue;
      const auto moved = transformed(patch, setting.world_from_object, setting.scale);
      if (!moved) return;
      patch = *moved;
    }
    faces.radiances.assign(patches.size(), material.radiance);
    faces.cuts = 1;
    faces.cells.clear();
    if (making.cuts > 0 && material.textured && std::all_of(patches.begin(), patches.end(), is_flat))
      weigh(faces, range, primitive, material, making);
    // Primitives of one geometry have equally many, but for caps and textures: ranges are of equals.
    const auto count = static_cast<std::int32_t>(patches.size());
    if (count == 0 || patches_.size() + patches.size() > most_patches) return;
    if (count != range.patches_each || faces.cuts != range.cuts) {
      if (!range.primitives.empty()) ranges_.push_back(range);
      range.primitives.clear();
      range.first_patch = static_cast<std::int32_t>(patches_.size());
      range.patches_each = count;
      range.cuts = faces.cuts;
    }
    range.primitives.push_back(primitive);
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const LightPatch& patch = patches[i];
      patches_.push_back({Vec3f(patch.origin), Vec3f(patch.a), Vec3f(patch.b),
                          PatchCode::of(patch.shape, number, setting.instance != 0)});
      if (has_own_radiances_) {
        radiances_.push_back(faces.radiances[i]);
        const std::size_t cells = faces.cells.size() / patches.size();
        shares_.add(std::span(faces.cells).subspan(i * cells, cells));
      }
      making.emissions.push_back(setting.moments.empty()
                                     ? emission_of(patch, faces.radiances[i], material.two_sided)
                                     : emission_of(patch, setting.moments, faces.radiances[i], material.two_sided));
    }
    if (!setting.moments.empty()) {
      movers_.resize(patches_.size() - patches.size(), 0);
      movers_.resize(patches_.size(), static_cast<std::int32_t>(setting.instance));
    }
  };
  for (std::int32_t i = primitives.first; i < primitives.last; ++i) add(i);
  if (!range.primitives.empty()) ranges_.push_back(range);
}

EmitterTable::Sample EmitterTable::sample(const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const FloatN& time,
                                          const FloatN& u, const FloatN& u1, const FloatN& u2) const {
  const LightTree::Choice choice = tree_.sample(p, normal, u);
  Sample sample = this->sample(choice.light, p, time, u1, u2);
  sample.point.pdf = sample.point.pdf * choice.probability;
  return sample;
}

std::int32_t EmitterTable::patch_of(const Hits& hits, std::size_t lane, Vec3f p) const {
  const std::uint32_t instance = hits.instance.get(lane), geometry = hits.geometry.get(lane);
  const std::int32_t primitive = hits.primitive.get(lane);
  const std::uint32_t place = place_of(instance);
  const auto key = [](const Range& range) {
    return std::tuple(place_of(range.instance), range.geometry, range.primitives.back());
  };
  const std::tuple wanted(place, geometry, primitive);
  const auto range = std::lower_bound(ranges_.begin(), ranges_.end(), wanted,
                                      [&](const Range& a, const auto& b) { return key(a) < b; });
  if (range == ranges_.end() || place_of(range->instance) != place || range->geometry != geometry) return -1;
  const auto& primitives = range->primitives;
  const auto found = std::lower_bound(primitives.begin(), primitives.end(), primitive);
  if (found == primitives.end() || *found != primitive) return -1;
  const std::int32_t first =
      range->first_patch + static_cast<std::int32_t>(found - primitives.begin()) * range->patches_each;
  const std::int32_t pieces = range->pieces();
  std::int32_t face = first;
  if (has_motion() && !range->is_mesh && movers_[static_cast<std::size_t>(first)] != 0)
    p = apply_point(instances_->maps(InstanceTable::index_of(instance), hits.time.get(lane)).object_from_world, p);
  if (range->is_mesh) {
    face += range->patches_each == 2 * pieces && hits.u.get(lane) + hits.v.get(lane) > 1 ? pieces : 0;
  } else {
    for (std::int32_t i = first + pieces; i < first + range->patches_each; i += pieces)
      if (distance_to(patches_[static_cast<std::size_t>(i)], p) <
          distance_to(patches_[static_cast<std::size_t>(face)], p))
        face = i;
  }
  if (pieces == 1) return face;
  return face + piece_of_face(*range, face, range->turned({hits.u.get(lane), hits.v.get(lane)}, face != first), p);
}

std::int32_t EmitterTable::piece_of_face(const Range& range, std::int32_t face, const Vec2<float>& uv,
                                         const Vec3f& p) const {
  const PatchRecord<float>& piece = patches_[static_cast<std::size_t>(face)];
  const PatchShape shape = PatchCode::shape_of(piece.code);
  const auto cuts = static_cast<float>(range.cuts);
  if (shape == PatchShape::triangle) return piece_at(shape, range.cuts, {uv.x * cuts, uv.y * cuts});
  const Vec3f from = p - piece.origin, normal = cross(piece.a, piece.b);
  const float scale = 1 / dot(normal, normal);
  return piece_at(shape, range.cuts,
                  {dot(cross(from, piece.b), normal) * scale, dot(cross(piece.a, from), normal) * scale});
}

float EmitterTable::radiance(std::size_t number) const {
  const auto material = std::bit_cast<std::int32_t>(patches_[number].code) >> PatchCode::material_shift;
  return radiances_[has_own_radiances_ ? number : static_cast<std::size_t>(material)];
}

EmitterTable::Sample EmitterTable::sample(const IntN& patch, const Vec3<FloatN>& from, const FloatN& time,
                                          const FloatN& u1, const FloatN& u2) const {
  const auto record = gather_records<PatchRecord, FloatN>(patches_.data(), LaneIndices(patch));
  const PatchTextures textures{shares_, patch};
  return {has_motion() ? sample_moving(record, textures, from, time, u1, u2)
                       : sample_patch(record, from, u1, u2, if_any(textures)),
          PatchCode::material_of(record.code), patch, time};
}

MaskN EmitterTable::has_patch(const Hits& hits, const MaskN& lanes, const Vec3<FloatN>& p) const {
  return lanes & float_mask<FloatN>(patches_of(hits, lanes, p) >= IntN(0));
}

IntN EmitterTable::patches_of(const Hits& hits, const MaskN& lanes, const Vec3<FloatN>& p) const {
  alignas(64) std::array<std::int32_t, packet_lanes> patches;
  patches.fill(-1);
  for (const std::size_t lane : SetLanes(lanes)) patches[lane] = patch_of(hits, lane, in_lane(p, lane));
  return IntN::load_aligned(patches.data());
}

FloatN EmitterTable::pdf(const Vec3<FloatN>& from, const Vec3<FloatN>& from_normal, const Hits& hits,
                         const MaskN& lanes, const SurfaceInteraction<FloatN>& surface) const {
  const IntN patch = patches_of(hits, lanes, surface.p);
  const MaskN drawn = float_mask<FloatN>(patch >= IntN(0));
  if (none(drawn)) return FloatN(0);
  const IntN existing = select_lanes(drawn, patch, IntN(0));
  const auto record = gather_records<PatchRecord, FloatN>(patches_.data(), LaneIndices(existing));
  const PatchTextures textures{shares_, existing};
  const FloatN density = has_motion() ? pdf_of_moving(record, textures, from, hits.time, surface.p, surface.ng)
                                      : patch_pdf(record, from, surface.p, surface.ng, if_any(textures));
  return select(drawn, tree_.probability(from, from_normal, existing) * density, FloatN(0));
}

Hits EmitterTable::hits(const Sample& sample, const MaskN& lanes) const {
  alignas(64) std::array<std::uint32_t, packet_lanes> instance{}, geometry{};
  alignas(64) std::array<std::int32_t, packet_lanes> primitive{};
  alignas(64) std::array<float, packet_lanes> u{}, v{};
  sample.point.u.store_aligned(u.data());
  sample.point.v.store_aligned(v.data());
  for (const std::size_t lane : SetLanes(lanes)) {
    const std::int32_t patch = sample.patch.get(lane);
    const Range& range =
        *std::prev(std::upper_bound(ranges_.begin(), ranges_.end(), patch,
                                    [](std::int32_t i, const Range& other) { return i < other.first_patch; }));
    const std::int32_t offset = patch - range.first_patch;
    instance[lane] = range.instance;
    geometry[lane] = range.geometry;
    primitive[lane] = range.primitives[static_cast<std::size_t>(offset / range.patches_each)];
    const std::int32_t in_primitive = offset % range.patches_each, face = in_primitive / range.pieces();
    Vec2<float> uv{u[lane], v[lane]};
    if (range.cuts > 1) {
      const PatchShape shape = PatchCode::shape_of(patches_[static_cast<std::size_t>(patch)].code);
      uv = in_whole(shape, range.cuts, in_primitive % range.pieces(), uv);
    }
    uv = range.turned(uv, range.is_mesh && face > 0);
    u[lane] = uv.x;
    v[lane] = uv.y;
  }
  Hits hits;
  hits.hit = lanes;
  hits.time = sample.time;
  hits.instance = UintN::load_aligned(instance.data());
  hits.geometry = UintN::load_aligned(geometry.data());
  hits.primitive = IntN::load_aligned(primitive.data());
  hits.u = FloatN::load_aligned(u.data());
  hits.v = FloatN::load_aligned(v.data());
  hits.find_first();
  return hits;
}

}  // namespace raytrace
