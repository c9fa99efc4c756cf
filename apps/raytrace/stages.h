// The stages of a run, each with its messages and its part of the statistics.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "options.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/render/renderer.h"
#include "statistics.h"

namespace raytrace {

/// Throws OutputError or UsageError for what would fail at the end of a render. All of it:
void check_outputs(const Options& options);
/// What depends on the outputs' formats alone.
void check_formats(const Options& options);
/// A checkpoint that is there without --resume.
void check_checkpoint(const Options& options);

/// Whether there is anything that --skip-existing might leave as it is. A checkpoint that is still there tells that
/// the outputs are not complete, whatever their formats can.
bool might_be_skipped(const Options& options);

/// Whether all outputs are there, whole, and of this picture, as far as their formats can tell.
bool outputs_are_complete(const SceneDescription& description, const Region& whole, const Region& region,
                          const Options& options);

/// What check_outputs() does, for what depends on the size of the picture.
void check_output_sizes(const Options& options, const Region& region);

/// Reads the scene and tells what is wrong with it; none if that is an error.
std::optional<SceneDescription> load(const Options& options, Statistics& statistics);

std::unique_ptr<const Scene> build(const SceneDescription& description, const Options& options, Statistics& statistics);

/// What the statistics say of the picture that is to be rendered.
void describe(const SceneDescription& description, const Region& region, const Options& options,
              Statistics& statistics);

/// Prints the pixel's samples, each in a line as soon as it is there, and their mean.
void print_pixel(const Scene& scene, const SceneDescription& description, const Region& pixel, const Options& options);

/// Completes the statistics, and tells or writes them if they were asked for.
void report(Statistics& statistics, const Options& options);

/// "scene.xml: ok (3 objects, 2 lights)"
std::string summary(const SceneDescription& description);

}  // namespace raytrace
