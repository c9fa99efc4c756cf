#include "raytrace/render/renderer.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/description/check_scene.h"
#include "raytrace/film/photons.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parallel/worker_count.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// What this thread has taken of its processor.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// What all threads have taken.
double process_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Pixels an edge of a tile, the unit of work of a thread: multiples of every packet's block. Large ones cost nothing
/// to take; small ones leave the threads less to wait for at the end.
constexpr int largest_tile_edge = 32, smallest_tile_edge = 8;

/// The last tiles keep some threads waiting, for half a tile each on average: a thirty-second of the render's time.
constexpr int tiles_a_thread = 16;

struct TileGrid {
  Region region;
  int edge, left, top, columns, rows;

  TileGrid(const Region& wanted, int tile_edge)
      : region(wanted),
        edge(tile_edge),
        left(round_down(wanted.x0, edge)),
        top(round_down(wanted.y0, edge)),
        columns((wanted.x1 - left + edge - 1) / edge),
        rows((wanted.y1 - top + edge - 1) / edge) {}

  int count() const { return columns * rows; }

  /// The part of tile `index` that lies in the region. Tiles are aligned to the picture, so that they cut no packet's
  /// block.
  Region tile(int index) const {
    const int x = left + index % columns * edge, y = top + index / columns * edge;
    return {std::max(x, region.x0), std::max(y, region.y0), std::min(x + edge, region.x1),
            std::min(y + edge, region.y1)};
  }
};

/// The largest tiles of which there are enough.
TileGrid tiles_for(const Region& region, int threads) {
  int edge = largest_tile_edge;
  while (edge > smallest_tile_edge && TileGrid(region, edge).count() < tiles_a_thread * threads) edge /= 2;
  return {region, edge};
}

/// Whether all pixels of a tile have so many samples. Tiles are rendered row by row of blocks from the top, each from
/// its left; so of a tile of whatever size, one that is stopped has samples in all pixels before its last ones. This
/// looks at the last ones of all tiles of the smallest size.
bool is_rendered(const Film& film, const Region& tile, std::uint32_t samples) {
  const auto cell_end = [](int start, int end) {
    return std::min(round_down(start, smallest_tile_edge) + smallest_tile_edge, end);
  };
  for (int top = tile.y0; top < tile.y1; top = cell_end(top, tile.y1))
    for (int left = tile.x0; left < tile.x1; left = cell_end(left, tile.x1))
      if (film.sum(cell_end(left, tile.x1) - 1, cell_end(top, tile.y1) - 1).samples < samples) return false;
  return true;
}

/// Reports the progress without making any thread wait for another.
class ProgressReporter {
 public:
  ProgressReporter(const ProgressFunction& progress, int tiles) : progress_(progress), tiles_(tiles) {}

  /// A tile is done.
  void add(const ErrorEstimate& error) {
    {
      const std::scoped_lock lock(sum_mutex_);
      ++done_;
      error_ += error;
    }
    report();
  }

  void report() {
    if (!progress_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    RenderProgress progress;
    {
      const std::scoped_lock sum_lock(sum_mutex_);
      if (done_ <= reported_) return;
      reported_ = done_;
      progress = {static_cast<double>(done_) / tiles_, error_};
    }
    progress_(progress);
  }

 private:
  const ProgressFunction& progress_;
  int tiles_, reported_ = 0;
  std::mutex mutex_;      ///< of who reports
  std::mutex sum_mutex_;  ///< of the next two, once a tile for a moment
  int done_ = 0;
  ErrorEstimate error_;
};

/// Samples that are rendered together: until each pixel has `last`.
struct Pass {
  std::uint32_t last = 0;
  std::optional<std::uint32_t> photons;  ///< of which they are looked up; none: there are none
  double share = 1;                      ///< of the samples that are to be rendered
};

/// In scenes with photons, those that share some; else all.
std::vector<Pass> passes_of(const Scene& scene, const Film& film, std::uint32_t samples) {
  if (!scene.has_photons()) return {{samples, std::nullopt, 1}};
  std::vector<Pass> passes;
  const std::uint32_t begin = film.fewest_samples(), before = film.settings().samples.first;
  for (std::uint32_t done = begin; done < samples;) {
    const std::uint32_t number = PhotonPasses::pass_of(before + done), end = PhotonPasses::end_of(number) - before;
    const std::uint32_t last = std::min(samples, end);
    passes.push_back({last, number, static_cast<double>(last - done) / (samples - begin)});
    done = last;
  }
  return passes;
}

}  // namespace

FilmSettings film_settings(const Scene& scene, const SceneDescription& description, const RenderSettings& settings) {
  const ViewPlane& viewplane = description.viewplane;
  require_good_viewplane(viewplane);
  const auto all = static_cast<std::uint32_t>(viewplane.samples);
  FilmSettings film;
  const bool whole = settings.region == Region();
  film.extent = {viewplane.hres, viewplane.vres,
                 whole ? Region{0, 0, viewplane.hres, viewplane.vres} : settings.region};
  if (film.extent.region.width() <= 0 || film.extent.region.height() <= 0)
    throw RenderError("the region to render has no pixel");
  if (scene.traces_light_paths()) {
    film.light_paths_of = film.extent.region;
    film.single_splats = settings.single_splats;
    if (settings.whole != Region()) film.extent.region = settings.whole;
  }
  film.samples = settings.samples.value_or(SampleRange{0, all, all == 1});
  if (film.samples.count == 0) throw RenderError("no samples to render");
  film.seed = settings.seed;
  const std::uint64_t most_samples = std::uint64_t{film.samples.first} + film.samples.count;
  film.unit_exponent = unit_exponent(scene.radiance_range(), most_samples);
  film.aovs = aov_settings(settings.aovs, {scene.largest_albedo()}, description, most_samples);
  film.transparent = settings.transparent;
  return film;
}

std::optional<std::string> rounding_warning(const Scene& scene, const FilmSettings& film) {
  if (is_fine_for_dimmest(scene.radiance_range(), film.unit_exponent)) return std::nullopt;
  return "radiance is rounded to multiples of " + formatted("%.2g", std::ldexp(1.0, film.unit_exponent)) +
         ": the scene's brightest light outshines its dimmest by more than sums can hold";
}

RenderReport render(const Scene& scene, Film& film, std::uint32_t samples, int threads,
                    const ProgressFunction& progress, const std::atomic<bool>* stop) {
  const int workers = worker_count(thread_count(threads));
  const TileGrid grid = tiles_for(film.settings().rendered(), workers);
  const Variant variant = choose_variant(scene.isa());
  const auto is_stopped = [&] { return stop != nullptr && stop->load(std::memory_order_relaxed); };
  const std::vector<Pass> passes = passes_of(scene, film, samples);
  ProgressReporter reporter(progress, grid.count() * static_cast<int>(passes.size()));
  RenderReport report;
  for (const Pass& pass : passes) {
    if (pass.photons) {
      const double start = process_seconds();
      report += variant.trace_photons(scene, *pass.photons, workers, stop, film);
      report.processor_seconds += process_seconds() - start;
      if (is_stopped()) break;
    }
    std::vector<RenderReport> reports(static_cast<std::size_t>(grid.count()));  // of each tile
    for_each_index(grid.count(), workers, [&](int index) {
      if (is_stopped()) return;
      const Region tile = grid.tile(index);
      RenderReport& of_tile = reports[static_cast<std::size_t>(index)];
      if (film.content() != FilmContent::sums || !is_rendered(film, tile, pass.last)) {
        const double start = thread_seconds();
        of_tile = variant.render(scene, tile, pass.last, film, stop);
        of_tile.processor_seconds = thread_seconds() - start;
      }
      reporter.add(of_tile.error.of_pass(pass.share));
    });
    reporter.report();  // the last may have found another thread reporting
    RenderReport of_pass;
    for (const RenderReport& of_tile : reports) of_pass += of_tile;
    of_pass.error = of_pass.error.of_pass(pass.share);
    report += of_pass;
  }
  return report;
}

Film render(const Scene& scene, const SceneDescription& description, const RenderSettings& settings, RayCounts& rays,
            const ProgressFunction& progress, const std::atomic<bool>* stop) {
  Film film(film_settings(scene, description, settings));
  rays = render(scene, film, film.settings().samples.count, settings.threads, progress, stop).rays;
  return film;
}

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
