#include "raytrace/description/load_grids.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include "raytrace/import/grid_tiles.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Between two corners.
struct Corners {
  Vec3d lower{1e300, 1e300, 1e300}, upper{-1e300, -1e300, -1e300};

  void add(const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) {
      component(lower, axis) = std::min(component(lower, axis), component(p, axis));
      component(upper, axis) = std::max(component(upper, axis), component(p, axis));
    }
  }
  bool meets(const Corners& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (component(lower, axis) > component(other.upper, axis) ||
          component(upper, axis) < component(other.lower, axis))
        return false;
    return true;
  }
};

std::string corner_text(const Vec3d& p) {
  const auto short_text = [](double number) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.4g", number);
    return std::string(text.data());
  };
  return "(" + short_text(p.x) + ", " + short_text(p.y) + ", " + short_text(p.z) + ")";
}

Corners box_of(const MaterialItem<Fog>& fog) {
  const DensityGrid::Lattice& lattice = fog.grid.grid->lattice();
  const Affine map = fog.transform.affine() * lattice.world_from_lattice;
  Corners box;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto side = [&](unsigned axis, double lower, double upper) {
      return (corner >> axis & 1U) != 0 ? upper : lower;
    };
    box.add(map.point(Vec3d(side(0, lattice.lower.x, lattice.upper.x), side(1, lattice.lower.y, lattice.upper.y),
                            side(2, lattice.lower.z, lattice.upper.z))));
  }
  return box;
}

/// Warns of a fog none of whose objects is where its grid is, as far as that is known before meshes are read: it is not
/// seen, and the grid's place is written in a file that people cannot read.
void warn_of_other_place(const SceneDescription& scene, std::uint32_t index, const MaterialItem<Fog>& fog,
                         Diagnostics& diagnostics) {
  const Corners grid = box_of(fog);
  const MaterialReference material{static_cast<std::uint32_t>(index_of<Fog>(Materials{})), index};
  std::size_t objects = 0, met = 0;
  // all: those of an instance that has the fog in place of their materials.
  const auto look = [&](const auto& self, const ObjectLists& lists, bool all) -> void {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      for (const auto& item : std::get<ObjectItems<T>>(lists)) {
        if (!all && !(item.material == material)) continue;
        if constexpr (std::is_same_v<T, Instance>)
          if (!all) {
            for (const Group& group : scene.groups)
              if (group.name == item.parameters.group.name) self(self, group.objects, true);
            continue;
          }
        ++objects;
        if constexpr (requires { T::reach(item.parameters, Vec3d()); }) {
          const Affine map = item.transform.affine();
          const auto reach = [&](const Vec3d& along) {
            const Vec3d before(dot(along, map.x), dot(along, map.y), dot(along, map.z));
            return T::reach(item.parameters, before) + dot(along, map.origin);
          };
          Corners box;
          box.lower = Vec3d(-reach({-1, 0, 0}), -reach({0, -1, 0}), -reach({0, 0, -1}));
          box.upper = Vec3d(reach({1, 0, 0}), reach({0, 1, 0}), reach({0, 0, 1}));
          met += box.meets(grid);
        } else {
          ++met;
        }
      }
    });
  };
  look(look, scene.objects, false);
  for (const Group& group : scene.groups) look(look, group.objects, false);
  if (objects > 0 && met == 0)
    diagnostics.warning(location_of(fog), "the density of the fog " + in_quotes(fog.name) + " is between " +
                                              corner_text(grid.lower) + " and " + corner_text(grid.upper) +
                                              ", where no object of it is; put a <box> there, or move it by a "
                                              "<transform> in the fog");
}

}  // namespace

bool load_grids(SceneDescription& scene, Diagnostics& diagnostics, int threads,
                const std::function<std::string(const std::string& file)>& hash_of) {
  bool fine = true;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const DensityGrid>> grids;  // by hash and name
  auto& fogs = std::get<MaterialItems<Fog>>(scene.materials);
  const auto refuse = [&](const MaterialItem<Fog>& item, const std::string& why) {
    const FileName& file = item.parameters.densityfile;
    fine = false;
    diagnostics.add(Severity::error, file.line > 0 ? location_of(file) : location_of(item),
                    "the density " + in_quotes(file.path) + " cannot be used: " + why);
  };
  for (MaterialItem<Fog>& item : fogs) {
    const FileName& file = item.parameters.densityfile;
    if (file.path.empty() || !item.grid.hash.empty()) continue;
    const std::string& name = item.parameters.densitygrid.name;
    try {
      const std::string hash = hash_of(file.path);
      auto& grid = grids[{hash, name}];
      if (!grid)
        grid = file.path.ends_with(".vol") ? read_vol_grid(file.path, threads)
                                           : grid_of_tiles(read_vdb_tiles(file.path, name), threads);
      item.grid = {hash, grid};
      if (!diagnostics.has_errors())
        warn_of_other_place(scene, static_cast<std::uint32_t>(&item - fogs.data()), item, diagnostics);
    } catch (const std::runtime_error& error) {
      refuse(item, on_one_line(error.what()));
    } catch (const std::bad_alloc&) {
      refuse(item, "there is not enough memory for it");
    }
  }
  return fine;
}

}  // namespace raytrace
