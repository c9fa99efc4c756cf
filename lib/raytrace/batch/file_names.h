// What stands in a file's name for what differs from one picture of a batch to the next.
//
//   ####, %04d   the frame's number with at least so many digits; any number of #, %d for no zeros
//   {#}, %%      a # and a % as such
//   {scene}      the scene's file name without folder and last extension
//   {tile}       the tile's number
#pragma once

#include <optional>
#include <string>

namespace raytrace {

struct NameValues {
  std::optional<int> frame;  ///< none: all that has # or % stands for itself
  std::optional<int> tile;   ///< none: {tile} is an error
  std::string scene;         ///< the scene's file
};

/// The name with the values put in. Throws SettingsError for {tile} without a tile, and for {scene} without a name.
std::string file_name(const std::string& name, const NameValues& values);

/// The same for the name of a scene, which has frames only.
std::string scene_file_name(const std::string& name, std::optional<int> frame);

/// The name for which the folders that are there keep their names: what stands for the frame's number in them stands
/// for itself. "C#/a.#.exr" is "C{#}/a.#.exr" where there is a folder C#, and "out/####/a.exr" stays what it is.
std::string with_folders_kept(const std::string& name);

/// Whether something in the name stands for the frame's number.
bool has_frame_token(const std::string& name);

/// The name with what stands for the frame and for the scene before its extension, where it lacks that and it is asked
/// for.
std::string with_tokens(const std::string& name, bool frame, bool scene);

}  // namespace raytrace
