// How many threads there is room for.
#pragma once

namespace raytrace {

/// As many of the wanted threads as a render should use: all, if they can be started; where a limit on memory
/// (`ulimit -v`) or on threads does not allow that, half of those that can, so that something is left for the scene.
/// Starts them for a moment, since nothing else tells.
int threads_with_room(int wanted);

/// Warns if fewer threads are used than are wanted.
void log_missing_threads(int wanted, int used);

}  // namespace raytrace
