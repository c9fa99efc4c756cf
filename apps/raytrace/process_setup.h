// What the program wants of its process before it does anything else.
#pragma once

#include <functional>

namespace raytrace {

/// Ends the process with the exit code of `program`, which runs in a process where
/// - files 0 to 2 are open: if one was closed, the next file that is opened, a picture perhaps, would get its number
/// and
///   whatever is printed;
/// - writing to a pipe that nobody reads, or beyond the limit on a file's size, is an error and no signal
///   (SIGPIPE, SIGXFSZ), and SIGUSR1, which asks a render for its picture, ends nothing that is no render;
/// - every stack is large enough, whatever `ulimit -s` says: the program's own and those of threads that libraries
///   start.
int run_in_prepared_process(const std::function<int()>& program);

}  // namespace raytrace
