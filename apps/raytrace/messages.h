// What the program tells a person, on standard error: "raytrace: error: ...".
#pragma once

#include <cstdint>
#include <string>

namespace raytrace {

enum class Verbosity { errors, warnings, steps, details };

/// What is told from here on; before the first call, warnings and errors.
void set_verbosity(Verbosity verbosity);

/// Whether messages of this weight are told.
bool tells(Verbosity verbosity);

void tell_error(const std::string& text);
void tell_warning(const std::string& text);
void tell_step(const std::string& text);

/// "1 object", "2 objects"
std::string counted(std::uint64_t count, const std::string& thing);

}  // namespace raytrace
