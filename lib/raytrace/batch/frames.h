// The frames of a batch, and what stands in a file's name for what differs from one picture of it to the next:
//
//   ####, %04d   the frame's number with at least so many digits; any number of #, %d for no zeros
//   {#}, %%      a # and a % as such
//   {scene}      the scene's file name without folder and last extension
//   {tile}       the tile's number
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace raytrace {

/// The frames of --frames, in the syntax of OpenJD's <IntRangeExpr>: "1-10", "1-10:3" (1, 4, 7, 10), "10-1:-3" (the
/// same), "-5--1", "7" and lists of them with commas; spaces and tabs may stand between the parts. The frames are in
/// increasing order. Throws SettingsError for anything else, for parts that overlap ("1-9:2,4": 4 lies between 1 and 9)
/// as in https://github.com/OpenJobDescription/openjd-specifications/wiki, "IntRangeExpr", and for more than 100,000
/// frames.
///
/// One thing differs: by the specification "10-1" is 10 alone, by its reference implementation an error; so it is here.
std::vector<int> frame_numbers(const std::string& text);

/// The short text of such frames, which are in increasing order: "1-10:3,15".
std::string frames_text(const std::vector<int>& frames);

/// What a file's name depends on.
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
