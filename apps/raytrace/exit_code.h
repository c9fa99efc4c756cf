// What the program's exit code says. (docs/command-line.md)
#pragma once

namespace raytrace::exit_code {

inline constexpr int done = 0;
inline constexpr int failed = 1;          ///< the scene, the render, or a file
inline constexpr int usage = 2;           ///< the command line
inline constexpr int out_of_memory = 33;  ///< render farms give a job more memory on it
inline constexpr int resumable = 75;      ///< stopped by a signal, with a checkpoint to go on from
inline constexpr int stopped = 128;       ///< plus the signal's number

}  // namespace raytrace::exit_code
