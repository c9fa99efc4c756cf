// Reports a diagnostic about a place in the document, but composes it only if it will be shown.
#pragma once

#include <string>

#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// place: an Element, Node or Attribute. make_message: called, for the text, only if the diagnostic is kept.
template <class Place, class MakeMessage>
void report_error(Diagnostics& diagnostics, const Place& place, MakeMessage&& make_message) {
  if (diagnostics.keeps_another(Severity::error))
    diagnostics.error(place.location(), make_message());
  else
    diagnostics.error({}, {});
}

/// The same of an error whose cause lies elsewhere, such as a variable that is not set: it is kept for one place.
template <class Place, class MakeMessage>
void report_error_once(Diagnostics& diagnostics, const std::string& cause, const Place& place,
                       MakeMessage&& make_message) {
  if (!diagnostics.repeats(cause)) report_error(diagnostics, place, make_message);
}

template <class Place, class MakeMessage>
void report_warning(Diagnostics& diagnostics, const Place& place, MakeMessage&& make_message) {
  if (diagnostics.keeps_another(Severity::warning))
    diagnostics.warning(place.location(), make_message());
  else
    diagnostics.warning({}, {});
}

}  // namespace raytrace
