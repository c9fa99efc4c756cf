// The options of how files for display show the picture, which rendering and merging have in common.
#pragma once

#include "raytrace/output/view_options.h"

namespace raytrace {

class OptionParser;

/// Adds them to a parser, which fills `view`.
void define_view_options(OptionParser& parser, ViewOptions& view);

/// Throws UsageError for options of which one makes another useless, or for parts of an OpenColorIO configuration
/// without one.
void refuse_two_views(const ViewOptions& view);

}  // namespace raytrace
