// The stages of a run, each with its messages and its part of the statistics.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "options.h"
#include "outputs.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/render/renderer.h"
#include "statistics.h"

namespace raytrace {

/// Throws OutputError or UsageError for what would fail at the end of a run.
void check_outputs(const Options& options);

/// Reads the scene and tells what is wrong with it; none if that is an error.
std::optional<SceneDescription> load(const Options& options, Statistics& statistics);

std::unique_ptr<const Scene> build(const SceneDescription& description, const Options& options, Statistics& statistics);

/// Renders the region into the outputs; large ones in bands from the top, so that no more than one of them need be in
/// memory. Returns early once `stop` is set, or if no output is left that could be written.
void render(const Scene& scene, const SceneDescription& description, const Region& region, const Options& options,
            const std::atomic<bool>& stop, Outputs& outputs, Statistics& statistics);

/// Completes the statistics, and tells or writes them if they were asked for.
void report(Statistics& statistics, const Options& options);

/// "scene.xml: ok (3 objects, 2 lights)"
std::string summary(const SceneDescription& description);

}  // namespace raytrace
