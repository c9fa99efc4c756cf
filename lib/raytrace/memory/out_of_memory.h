// Libraries that say in words only that memory ran out.
#pragma once

#include <exception>
#include <string_view>

namespace raytrace {

/// Whether a library's message says so, or that there was no room for the stack of a thread.
bool says_out_of_memory(std::string_view message);

/// Throws std::bad_alloc if the exception is that, or a library's that was made of it: OpenEXR's threads keep no more
/// of an exception than its text.
void rethrow_out_of_memory(const std::exception& exception);

}  // namespace raytrace
