// Parses the text of a value, with its variables replaced.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/document.h"
#include "raytrace/description/quoted.h"
#include "raytrace/description/report.h"
#include "raytrace/description/variables.h"

namespace raytrace {

enum class Dollars {
  never_fit,  ///< parse refuses every text that has one, so only such texts are searched for variables
  may_fit,
};

/// parse(text): a Complaint; what it is given lives as long as the element does. text: that of `place`, a Node or
/// Attribute of the element. where(): " in <radius> ". False, with a report, if there is a complaint.
template <Dollars dollars, class Place, class Parse, class Where>
bool parse_text(std::string_view text, Element element, const Place& place, const Parse& parse, const Where& where,
                Diagnostics& diagnostics) {
  Complaint complaint = parse(text);
  bool once = false;
  if ((complaint || dollars == Dollars::may_fit) && text.find('$') != std::string_view::npos) {
    std::string replaced;
    complaint = element.variables().replace(text, replaced);
    once = complaint && Variables::is_cause(*complaint);
    if (!complaint && trimmed(replaced).empty()) {
      complaint = "is empty with the variables' values put in";
    } else if (!complaint) {
      text = trimmed(element.keep(std::move(replaced)));
      complaint = parse(text);
    }
  }
  if (!complaint) return true;
  const auto message = [&] { return in_quotes(text) + where() + *complaint; };
  if (once)
    report_error_once(diagnostics, *complaint, place, message);
  else
    report_error(diagnostics, place, message);
  return false;
}

}  // namespace raytrace
