// What depends on the instruction set, as compiled for one, and the choice among them. No SIMD type appears here.
//
// The files that variants/variant.cpp leads to are compiled once for each instruction set
// (cmake/instruction_sets.cmake) and joined to one object each, of which only raytrace_variant_<name>() is visible.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/film/film.h"
#include "raytrace/scene/scene.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

struct Variant {
  const char* isa;         ///< "x86-64-v4"
  const char* embree_isa;  ///< what Embree calls the best that it may use with it

  std::unique_ptr<const Scene> (*build)(const SceneDescription& description, int threads);

  /// Continues the pixels of `tile`, which must lie inside the film's region, until each has `samples` of the film's
  /// sample range. The scene must be of this variant. The sums do not depend on how a picture is cut into tiles, or the
  /// samples into calls. Safe to call from many threads for disjoint tiles that are aligned to the packets' blocks.
  /// Once `stop` is set (null: never), it returns within a few samples of a packet; the film keeps what was done.
  /// Pixels of a film of means get theirs at once, of all samples. In scenes with photons, all samples must be of the
  /// pass whose photons the film has.
  RenderReport (*render)(const Scene& scene, const Region& tile, std::uint32_t samples, Film& film,
                         const std::atomic<bool>* stop);

  /// In scenes with photons: gives the film those of a pass, unless it has them (tracing/photon_paths.h). Once `stop`
  /// is set, it may return without.
  RenderReport (*trace_photons)(const Scene& scene, std::uint32_t pass, int threads, const std::atomic<bool>* stop,
                                Film& film);
};

/// The variant of the named instruction set, or of the processor's best if the name is empty. Throws RenderError
/// if this program has none of that name, or the processor cannot run it.
const Variant& choose_variant(const std::string& isa);

/// The instruction sets that this program was built for, least first: "x86-64-v2", "x86-64-v3", "x86-64-v4".
std::vector<std::string> isa_names();

/// Whether this processor can run the named one.
bool isa_supported(const std::string& name);

/// The best one of isa_names() on this processor.
std::string best_isa();

struct BuildSettings {
  int threads = 0;       ///< 0: all processors
  std::string isa;       ///< one of isa_names(); empty: the best that this processor has
  bool checked = false;  ///< the description is as load_scene() gave it, so that check_scene() need not run again
};

/// The threads that a setting stands for: itself, or all processors for 0.
int thread_count(int wanted);

/// Makes the scene ready. Throws SceneError where the description breaks the format's rules, RenderError, or
/// std::bad_alloc where memory runs out; so does a render, for a BVH that waited for it.
std::unique_ptr<const Scene> build_scene(const SceneDescription& description, const BuildSettings& settings);

}  // namespace raytrace
