// The wide part of the renderer as compiled for one instruction set, and the choice among them.
//
// The files that variants/variant.cpp leads to are compiled once for each instruction set
// (cmake/instruction_sets.cmake) and joined to one object each, of which only raytrace_variant_<name>() is visible.
#pragma once

#include <memory>
#include <string>

#include "raytrace/render/renderer.h"

namespace raytrace {

struct Variant {
  const char* isa;         ///< "x86-64-v4"
  const char* embree_isa;  ///< what Embree calls the best that it may use with it
  std::unique_ptr<const Scene> (*build)(const SceneDescription& description, int threads);
};

/// The variant of the named instruction set, or of the processor's best if the name is empty. Throws RenderError
/// if this program has none of that name, or the processor cannot run it.
const Variant& choose_variant(const std::string& isa);

}  // namespace raytrace
