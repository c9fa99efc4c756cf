#include "raytrace/description/read_fields.h"

#include <cstdint>
#include <optional>

#include "raytrace/description/refuse_content.h"
#include "raytrace/text/nearest_name.h"
#include "raytrace/text/quoted.h"
#include "raytrace/xml/report.h"

namespace raytrace {
namespace {

std::vector<std::string_view> names_of(std::span<const FieldInfo> infos) {
  std::vector<std::string_view> names;
  for (const FieldInfo& info : infos) names.push_back(info.name);
  return names;
}

/// Bit i: the element has a child infos[i].
std::uint64_t present_fields(Element element, std::span<const FieldInfo> infos) {
  std::uint64_t present = 0;
  for (Node node = element.first_child(); node; node = node.next()) {
    const std::size_t i = node.element() ? find_field(infos, node.element().name()) : infos.size();
    if (i < infos.size()) present |= std::uint64_t(1) << i;
  }
  return present;
}

/// The field that an unknown child may have been meant for: a near one that is not there under its own name.
std::string_view nearest_absent(std::string_view name, std::span<const FieldInfo> infos, std::uint64_t present) {
  std::vector<std::string_view> absent;
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (!(present >> i & 1)) absent.push_back(infos[i].name);
  }
  return nearest_name(name, absent);
}

}  // namespace

bool read_fields(Element element, std::span<const FieldInfo> infos, std::span<const FieldTarget> targets,
                 Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  refuse_attributes(element, infos, diagnostics);
  std::uint64_t seen = 0;  // bit i: infos[i]; no type has 64 fields
  std::optional<std::uint64_t> present;
  for (Node node = element.first_child(); node; node = node.next()) {
    if (refuse_text(node, element, diagnostics)) continue;
    const Element child = node.element();
    const std::size_t i = find_field(infos, child.name());
    if (i < infos.size()) {
      const std::uint64_t bit = std::uint64_t(1) << i;
      if (seen & bit) {
        report_error(diagnostics, child, [&] {
          return "a second " + tag(infos[i].name) + " in " + tag(element.name()) + "; the first one is in line " +
                 std::to_string(element.child(infos[i].name).line());
        });
      } else {
        read_value(child, infos[i], targets[i], diagnostics);
      }
      seen |= bit;
      continue;
    }
    std::string_view nearest;
    if (diagnostics.keeps_another(Severity::error)) {
      if (!present) present = present_fields(element, infos);
      nearest = nearest_absent(child.name(), infos, *present);
    }
    report_error(diagnostics, child, [&] {
      const std::string start = "unknown element " + tag(child.name()) + " in " + tag(element.name()) + "; ";
      if (!nearest.empty()) return start + "did you mean " + tag(nearest) + "?";
      return start + "it takes " + list_of_tags(names_of(infos));
    });
    // One slip, one message: a child that was only misspelt is not reported as missing too.
    if (!nearest.empty()) seen |= std::uint64_t(1) << find_field(infos, nearest);
  }
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (!infos[i].required || (seen >> i & 1)) continue;
    report_error(diagnostics, element, [&] {
      return "missing " + tag(infos[i].name) + " in " + tag(element.name()) + "; add " +
             example_value(infos[i], targets[i]);
    });
  }
  return diagnostics.error_count() == errors_before;
}

}  // namespace raytrace
