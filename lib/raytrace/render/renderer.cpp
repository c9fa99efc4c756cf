#include "raytrace/render/renderer.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "raytrace/render/handover.h"

namespace raytrace {

namespace {

/// Pixels an edge of a tile, the unit of work of a thread: a multiple of every packet's block, large enough that taking
/// one costs nothing, small enough that the last ones keep all threads busy.
constexpr int tile_edge = 32;

struct TileGrid {
  Region region;
  int first_column, first_row, columns, rows;

  explicit TileGrid(const Region& wanted)
      : region(wanted),
        first_column(wanted.x0 / tile_edge),
        first_row(wanted.y0 / tile_edge),
        columns((wanted.x1 + tile_edge - 1) / tile_edge - first_column),
        rows((wanted.y1 + tile_edge - 1) / tile_edge - first_row) {}

  int count() const { return columns * rows; }

  /// The part of tile `index` that lies in the region. Tiles are aligned to the picture, so that they cut no packet's
  /// block.
  Region tile(int index) const {
    const int column = first_column + index % columns, row = first_row + index / columns;
    return {std::max(column * tile_edge, region.x0), std::max(row * tile_edge, region.y0),
            std::min((column + 1) * tile_edge, region.x1), std::min((row + 1) * tile_edge, region.y1)};
  }
};

}  // namespace

Film render(const Scene& scene, const SceneDescription& description, const RenderSettings& settings, RayCounts& rays,
            const ProgressFunction& progress, const std::atomic<bool>* stop) {
  Film film(description.viewplane.hres, description.viewplane.vres, settings.region);
  const TileGrid grid(settings.region);
  // Asking for more than there can be (Embree sets that limit, too) would have oneTBB warn on the standard error
  // output.
  const auto most_threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const int threads =
      static_cast<int>(std::min(static_cast<std::size_t>(thread_count(settings.threads)), most_threads));
  std::mutex mutex;
  int done = 0;
  RayCounts counts;
  // Static: a worker must find it before it reads any argument of the loop.
  static constinit Handover to_workers, from_workers;
  const auto render_tile = [&](int index) {
    to_workers.take();
    if (stop == nullptr || !stop->load(std::memory_order_relaxed)) {
      const RayCounts tile_counts = scene.render_region(grid.tile(index), settings.seed, film, stop);
      const std::lock_guard lock(mutex);
      counts += tile_counts;
      ++done;
      if (progress) progress(static_cast<double>(done) / grid.count());
    }
    from_workers.give();
  };
  tbb::task_arena arena(threads);
  to_workers.give();
  arena.execute([&] { tbb::parallel_for(0, grid.count(), render_tile, tbb::simple_partitioner()); });
  from_workers.take();
  rays = counts;
  return film;
}

int thread_count(int wanted) { return wanted > 0 ? wanted : tbb::this_task_arena::max_concurrency(); }

CameraMatrices camera_matrices(const SceneDescription& description) {
  CameraMatrices matrices;
  for_each_type(Cameras{}, [&](auto type) {
    using Type = typename decltype(type)::type;
    if (const auto* parameters = std::get_if<typename Type::Parameters>(&description.camera))
      matrices = Type::matrices(*parameters, description.viewplane);
  });
  return matrices;
}

}  // namespace raytrace
