// The XML schema of scene files, for editors and validators.
#pragma once

#include <string>

namespace raytrace {

/// An XML Schema 1.0 document, made from the registries' tables of fields, so that it knows every type there is. A file
/// that it refuses is one that load_scene refuses. The reverse does not hold: no schema can say that a direction is not
/// 0, that a camera's eye is not where it looks, or that there is one ambient light in all; nor, since they may have
/// keys, that a number is one and a vector whole; nor, since names may have variables, that an object's material
/// exists.
std::string print_schema();

}  // namespace raytrace
