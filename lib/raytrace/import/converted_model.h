// Models in formats that Assimp reads, as GLB files: FBX, Collada and others.
//
// Assimp is no part of this program: a program of its own, raytrace-convert, reads such a file. What a damaged one
// makes it do - crash, hang, take all memory - ends there, and is an error like others.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "raytrace/memory/large_array.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Of file names in lower case.
inline constexpr std::string_view converted_types[] = {".fbx", ".dae", ".3ds", ".blend", ".lwo", ".x",    ".3mf",
                                                       ".off", ".ac",  ".ase", ".amf",   ".x3d", ".ms3d", ".zae"};

/// Whether a file is one, by its name.
bool is_converted_model(const std::string& file);

/// ".fbx, .dae, .3ds ..."
std::string converted_types_text();

struct ConvertedModel {
  LargeArray<char> glb;
  std::size_t size = 0;
};

/// No value, and an error, if that cannot be done, or if there is no raytrace-convert.
std::optional<ConvertedModel> convert_model(const std::string& file, Diagnostics& diagnostics);

/// The same by that program.
std::optional<ConvertedModel> convert_model_by(const std::string& program, const std::string& file,
                                               Diagnostics& diagnostics);

}  // namespace raytrace
