#include "raytrace/scene/density_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "raytrace/description/check_fogs.h"
#include "raytrace/math/bounds.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/scene/scene.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Points of a texture's lattice, of all together.
constexpr double most_texture_points = 1 << 24;
/// As many as there are numbers of media, and so many kinds of instances, of each fog.
constexpr std::size_t most_places = (1U << 16U) - 1, most_first_places = std::size_t{1} << 26U;

/// Between points, so that a texture's finest parts are there.
double edge_for(const SceneDescription& scene, const TextureReference& texture) {
  return with_type(Textures{}, texture.type, [&]<class T>(std::type_identity<T>) -> double {
    const auto& parameters = std::get<TextureItems<T>>(scene.textures)[texture.index].parameters;
    if constexpr (requires { parameters.octaves; })
      return std::ldexp(parameters.scale, 1 - parameters.octaves) / 4;
    else if constexpr (requires { parameters.scale; })
      return parameters.scale / 16;
    else
      return 1;
  });
}

/// How much of a texture is left so far inside of the bounds: 1 less the distance to where it is all there.
float inside_of_fade(const Vec3d& from_sides, const Vec3d& fade) {
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double wide = component(fade, axis);
    if (wide <= 0) continue;
    const double missing = std::max(0.0, 1 - component(from_sides, axis) / wide);
    squares += missing * missing;
  }
  return static_cast<float>(std::max(0.0, 1 - std::sqrt(squares)));
}

/// What a texture is at the points of a lattice in the bounds of a fog.
class TextureLattice {
 public:
  TextureLattice(const SceneDescription& scene, const MaterialItem<Fog>& fog, const TextureUse& use,
                 const Bounds& bounds, const TextureTable& textures, int threads)
      : lower_(bounds.lower), fade_(fog.parameters.densityfade) {
    const Vec3d extent = Vec3d(bounds.upper) - lower_;
    const double volume = extent.x * extent.y * extent.z, wanted = edge_for(scene, use.texture);
    const double edge = std::max(wanted, std::cbrt(volume / most_texture_points));
    for (int axis = 0; axis < 3; ++axis) {
      const double edges = std::clamp(std::ceil(component(extent, axis) / edge), 1.0, 2000.0);
      lattice_.points[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(edges) + 1;
      component(edges_, axis) = std::max(component(extent, axis), smallest_size) / edges;
      component(lattice_.upper, axis) = edges;
    }
    lattice_.lower = Vec3d(0, 0, 0);
    lattice_.world_from_lattice = {{edges_.x, 0, 0}, {0, edges_.y, 0}, {0, 0, edges_.z}, lower_};
    from_texture_ = fog.transform.affine().inverse();
    fill(use, textures, threads);
  }

  std::shared_ptr<const DensityGrid> grid(int threads) const {
    return std::make_shared<const DensityGrid>(lattice_, threads, [&](const std::array<int, 3>& first, float* to) {
      for (int z = 0; z < DensityGrid::cell_points; ++z)
        for (int y = 0; y < DensityGrid::cell_points; ++y)
          for (int x = 0; x < DensityGrid::cell_points; ++x)
            *to++ = numbers_[number(first[0] + x, first[1] + y, first[2] + z)];
    });
  }

 private:
  std::size_t number(int x, int y, int z) const {
    const auto& points = lattice_.points;
    const auto in = [&](int i, std::size_t axis) { return std::min<std::int64_t>(i, points[axis] - 1); };
    return static_cast<std::size_t>((in(z, 2) * points[1] + in(y, 1)) * points[0] + in(x, 0));
  }

  void fill(const TextureUse& use, const TextureTable& textures, int threads) {
    const auto& points = lattice_.points;
    numbers_.resize(static_cast<std::size_t>(points[0] * points[1] * points[2]));
    const auto layers = static_cast<int>(points[2]);
    for_each_index(layers, threads, [&](int z) {
      for (int y = 0; y < points[1]; ++y)
        for (int x = 0; x < points[0]; x += packet_lanes) set_row(use, textures, x, y, z);
    });
    if (!(length(fade_) > 0)) return;
    const float largest = *std::max_element(numbers_.begin(), numbers_.end());
    for_each_index(layers, threads, [&](int z) {
      for (int y = 0; y < points[1]; ++y)
        for (int x = 0; x < points[0]; ++x) {
          const auto from_side = [&](int i, int axis) {
            const auto last = static_cast<double>(points[static_cast<std::size_t>(axis)] - 1);
            return std::min<double>(i, last - i) * component(edges_, axis);
          };
          const float share = inside_of_fade({from_side(x, 0), from_side(y, 1), from_side(z, 2)}, fade_);
          float& there = numbers_[number(x, y, z)];
          there = std::max(there - (1 - share) * largest, 0.0F);
        }
    });
  }

  /// As many points along x as a packet has lanes.
  void set_row(const TextureUse& use, const TextureTable& textures, int x, int y, int z) {
    // In the fog's space before its transform: there the texture is looked up, each point for what is around it.
    const Affine to_texture = from_texture_ * lattice_.world_from_lattice;
    const Vec3d start = to_texture.point(Vec3d(x, y, z));
    const FloatN lane = to_float(lane_numbers<IntN>());
    TexturePoint<FloatN> point{};
    const Vec3<FloatN> along(Vec3f(to_texture.x));
    const auto half = [](const Vec3d& edge) { return Vec3<FloatN>(Vec3f(edge * 0.5)); };
    point.world = {Vec3<FloatN>(Vec3f(start)) + along * lane, half(to_texture.x), half(to_texture.y)};
    point.object = point.world;
    alignas(64) std::array<float, packet_lanes> values;
    max(textures.number_at(use, point), FloatN(0)).store_aligned(values.data());
    const int count = std::min<int>(packet_lanes, static_cast<int>(lattice_.points[0]) - x);
    std::copy_n(values.begin(), count, numbers_.begin() + static_cast<std::ptrdiff_t>(number(x, y, z)));
  }

  Vec3d lower_, fade_, edges_;
  Affine from_texture_;
  DensityGrid::Lattice lattice_;
  std::vector<float> numbers_;
};

/// How far it is from one plane of the lattice's points to the next, at least.
double shortest_edge(const Affine& lattice_from_world) {
  const auto& [x, y, z, origin] = lattice_from_world;
  return 1 / std::max({length(Vec3d(x.x, y.x, z.x)), length(Vec3d(x.y, y.y, z.y)), length(Vec3d(x.z, y.z, z.z))});
}

[[noreturn]] void refuse_places(const SceneDescription& scene, const MaterialItem<Fog>& fog) {
  throw RenderError((scene.file.empty() ? "" : scene.file + ":") + std::to_string(fog.line) + ":" +
                    std::to_string(fog.column) + ": the fog " + in_quotes(fog.name) +
                    " is in too many instances: fogs that are not the same everywhere may be in " +
                    std::to_string(most_places) + " places, all of them together");
}

}  // namespace

std::vector<DensityTable::WorldFromPlaces> DensityTable::find_places(const std::vector<std::uint8_t>& uneven,
                                                                     const GeometryTable& geometry,
                                                                     const Affine& world_from_file) {
  const auto fogs = static_cast<std::size_t>(fogs_), first = static_cast<std::size_t>(first_fog_);
  std::vector<std::vector<GeometryTable::PlaceOfGroup>> places(fogs);
  std::map<std::size_t, std::vector<std::size_t>> fogs_in;  // of each instance
  for (std::size_t fog = 0; fog < fogs; ++fog) {
    if (uneven[first + fog] == 0) continue;
    std::vector<std::uint8_t> wanted(uneven.size());
    wanted[first + fog] = 1;
    places[fog] = geometry.places_of_groups(wanted);
    for (const auto& place : places[fog]) fogs_in[place.instance].push_back(fog);
  }
  std::vector<WorldFromPlaces> all(fogs);
  for (std::size_t fog = 0; fog < fogs; ++fog)
    if (uneven[first + fog] != 0) all[fog].resize(1 + places[fog].size(), world_from_file);
  if (fogs_in.empty()) return all;
  kinds_.resize(1 + geometry.instances().size());
  ranks_.resize(kinds_.size());
  std::map<std::vector<std::size_t>, std::int32_t> kinds;
  std::vector<std::int32_t> counts{0};
  for (const auto& [instance, its_fogs] : fogs_in) {
    const auto [kind, is_new] = kinds.try_emplace(its_fogs, static_cast<std::int32_t>(counts.size()));
    if (is_new) counts.push_back(0);
    kinds_[1 + instance] = kind->second;
    ranks_[1 + instance] = counts[static_cast<std::size_t>(kind->second)]++;
  }
  if (counts.size() * fogs > most_first_places) throw GridError("there are too many kinds of instances with fogs");
  first_places_.resize(counts.size() * fogs);
  std::vector<std::int32_t> next(fogs, 1);
  for (const auto& [its_fogs, kind] : kinds)
    for (const std::size_t fog : its_fogs) {
      first_places_[static_cast<std::size_t>(kind) * fogs + fog] = next[fog];
      next[fog] += counts[static_cast<std::size_t>(kind)];
    }
  for (std::size_t fog = 0; fog < fogs; ++fog)
    for (const auto& [instance, map] : places[fog]) {
      const auto kind = static_cast<std::size_t>(kinds_[1 + instance]);
      all[fog][static_cast<std::size_t>(first_places_[kind * fogs + fog] + ranks_[1 + instance])] = map;
    }
  return all;
}

DensityTable::DensityTable(const SceneDescription& description, std::int32_t first_fog,
                           const std::vector<std::uint8_t>& used_materials, const GeometryTable& geometry,
                           const Vec3d& origin, const TextureTable& textures, int threads) {
  const auto& fogs = std::get<MaterialItems<Fog>>(description.materials);
  std::vector<std::uint8_t> uneven(used_materials.size());
  for (std::size_t i = 0; i < fogs.size(); ++i) {
    const std::size_t material = static_cast<std::size_t>(first_fog) + i;
    if (used_materials[material] != 0 && (fogs[i].grid.grid || density_texture(fogs[i]) != nullptr))
      uneven[material] = 1;
  }
  if (std::find(uneven.begin(), uneven.end(), 1) == uneven.end()) return;
  first_fog_ = first_fog;
  fogs_ = static_cast<std::int32_t>(fogs.size());
  const auto all_places = find_places(uneven, geometry, Affine{.origin = Vec3d(0, 0, 0) - origin});
  std::size_t count = 0;
  for (std::size_t i = 0; i < fogs.size(); ++i)
    if ((count += all_places[i].size()) > most_places) refuse_places(description, fogs[i]);
  places_.resize(used_materials.size());
  for (std::size_t i = 0; i < fogs.size(); ++i) {
    const std::size_t material = static_cast<std::size_t>(first_fog) + i;
    if (uneven[material] == 0) continue;
    const MaterialItem<Fog>& fog = fogs[i];
    std::shared_ptr<const DensityGrid> grid = fog.grid.grid;
    Affine from_lattice;
    if (const TextureUse* const use = density_texture(fog); use != nullptr) {
      std::vector<std::uint8_t> wanted(used_materials.size());
      wanted[material] = 1;
      grid = TextureLattice(description, fog, *use, geometry.bounds_in_file(wanted, origin), textures, threads)
                 .grid(threads);
      from_lattice = grid->lattice().world_from_lattice;
    } else {
      from_lattice = fog.transform.affine() * grid->lattice().world_from_lattice;
    }
    const auto extinction =
        static_cast<float>(std::clamp(fog.parameters.density / fog.parameters.meanfreepath, 0.0, 1e17));
    places_[material] = all_places[i].size() - 1;
    for (const Affine& world_from_place : all_places[i]) {
      const Affine to_lattice = (world_from_place * from_lattice).inverse();
      const double most = double{Density::most_depth} / shortest_edge(to_lattice);
      densities_.push_back({grid.get(), to_float(to_lattice), extinction, static_cast<float>(std::min(most, 1e37))});
    }
    grids_.push_back(std::move(grid));
  }
}

}  // namespace raytrace
