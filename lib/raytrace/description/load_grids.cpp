#include "raytrace/description/load_grids.h"

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include "raytrace/import/grid_tiles.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/text/extension.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

bool overlap(const Bounds& a, const Bounds& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

std::string corner_text(const Vec3f& p) {
  return formatted("(%.4g, %.4g, %.4g)", double{p.x}, double{p.y}, double{p.z});
}

/// Warns of a fog none of whose objects is where its grid is, as far as that is known before meshes are read: it is not
/// seen, and the grid's place is written in a file that people cannot read.
void warn_of_other_place(const SceneDescription& scene, std::uint32_t index, const MaterialItem<Fog>& fog,
                         Diagnostics& diagnostics) {
  const Bounds grid = grid_bounds(fog);
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
          const Vec3d lower(-reach({-1, 0, 0}), -reach({0, -1, 0}), -reach({0, 0, -1}));
          const Vec3d upper(reach({1, 0, 0}), reach({0, 1, 0}), reach({0, 0, 1}));
          met += overlap({Vec3f(lower), Vec3f(upper)}, grid);
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

Bounds grid_bounds(const MaterialItem<Fog>& fog) {
  const DensityGrid::Lattice& lattice = fog.grid.grid->lattice();
  const Affine map = fog.transform.affine() * lattice.world_from_lattice;
  Bounds bounds = empty_bounds;
  for (const double x : {lattice.lower.x, lattice.upper.x})
    for (const double y : {lattice.lower.y, lattice.upper.y})
      for (const double z : {lattice.lower.z, lattice.upper.z}) {
        const Vec3f corner(map.point(Vec3d(x, y, z)));
        bounds = join(bounds, {corner, corner});
      }
  return bounds;
}

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
        grid = has_extension(file.path, ".vol") ? read_vol_grid(file.path, threads)
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
