// What becomes of memory that is freed.
#pragma once

namespace raytrace {

/// From now on it stays with the process, for what is asked for next: what is fresh from the system has to be cleared
/// first, which a virtual machine may take as long for as reading a scene's file. Where the C library has such a
/// choice.
void keep_freed_memory();

/// Gives the system what is free now.
void give_back_freed_memory();

}  // namespace raytrace
