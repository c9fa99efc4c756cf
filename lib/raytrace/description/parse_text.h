// Parses the text of a value, with its variables replaced.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "raytrace/description/variables.h"
#include "raytrace/text/quoted.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/report.h"

namespace raytrace {

enum class Dollars {
  never_fit,  ///< parse refuses every text that has one, so only such texts are searched for variables
  may_fit,
};

/// parse(text): a DiagnosticText; what it is given lives as long as the element does. text: that of `place`, a Node or
/// Attribute of the element. where(): " in <radius> ". False, with a report, if there is a diagnostic.
template <Dollars dollars, class Place, class Parse, class Where>
bool parse_text(std::string_view text, Element element, const Place& place, const Parse& parse, const Where& where,
                Diagnostics& diagnostics) {
  DiagnosticText diagnostic = parse(text);
  bool once = false;
  if ((diagnostic || dollars == Dollars::may_fit) && text.find('$') != std::string_view::npos) {
    std::string replaced;
    diagnostic = element.variables().replace(text, replaced);
    once = diagnostic && Variables::is_cause(*diagnostic);
    if (!diagnostic && trimmed(replaced).empty()) {
      diagnostic = "is empty with the variables' values put in";
    } else if (!diagnostic) {
      text = trimmed(element.keep(std::move(replaced)));
      diagnostic = parse(text);
    }
  }
  if (!diagnostic) return true;
  const auto message = [&] { return in_quotes(text) + where() + *diagnostic; };
  if (once)
    report_error_once(diagnostics, *diagnostic, place, message);
  else
    report_error(diagnostics, place, message);
  return false;
}

}  // namespace raytrace
