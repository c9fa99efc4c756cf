#include "raytrace/description/read_attributes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/description/nearest_name.h"
#include "raytrace/description/parse_text.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/quoted.h"
#include "raytrace/description/report.h"

namespace raytrace {
namespace {

std::size_t find_field(std::span<const AttributeField> fields, std::string_view name) {
  std::size_t i = 0;
  while (i < fields.size() && fields[i].name != name) ++i;
  return i;
}

std::string example_of(Element element, std::span<const AttributeField> fields) {
  return "<" + printable(element.name()) + " " + example_of(fields) + "/>";
}

/// The field that an unknown attribute may have been meant for: a near one that is not there under its own name.
std::string_view nearest_missing(Element element, std::string_view name, std::span<const AttributeField> fields) {
  std::vector<std::string_view> missing;
  for (const AttributeField& field : fields) {
    Attribute present = element.first_attribute();
    while (present && present.name() != field.name) present = present.next();
    if (!present) missing.push_back(field.name);
  }
  return nearest_name(name, missing);
}

std::string explain_unknown(Element element, Attribute attribute, std::span<const AttributeField> fields,
                            std::string_view nearest) {
  const std::string start = "unknown attribute " + in_quotes(attribute.name()) + " in " + tag(element.name()) + "; ";
  if (!nearest.empty()) return start + "did you mean " + in_quotes(nearest) + "?";
  return start + "write " + example_of(element, fields);
}

bool read_attribute(Element element, Attribute attribute, const AttributeField& field, Diagnostics& diagnostics) {
  const auto parse = [&](std::string_view text) {
    const auto number = std::get_if<double*>(&field.target);
    return number ? parse_number(text, field.range, **number)
                  : parse_interpolation(trimmed(text), *std::get<Interpolation*>(field.target));
  };
  const auto where = [&] { return " for " + std::string(field.name) + " in " + tag(element.name()) + " "; };
  return parse_text<Dollars::never_fit>(attribute.value(), element, attribute, parse, where, diagnostics);
}

/// seen: bit i for fields[i].
bool require_all(Element element, std::span<const AttributeField> fields, std::uint64_t seen,
                 Diagnostics& diagnostics) {
  std::string missing;
  int count = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].required || (seen >> i & 1)) continue;
    missing += (count++ > 0 ? " and " : "") + in_quotes(fields[i].name);
  }
  if (count == 0) return true;
  report_error(diagnostics, element, [&] {
    return "missing " + std::string(count > 1 ? "attributes " : "attribute ") + missing + " in " + tag(element.name()) +
           "; write " + example_of(element, fields);
  });
  return false;
}

}  // namespace

bool read_attributes(Element element, std::span<const AttributeField> fields, bool example_shown,
                     Diagnostics& diagnostics) {
  bool fine = true;
  std::uint64_t seen = 0;
  for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next()) {
    const std::size_t i = find_field(fields, attribute.name());
    if (i < fields.size()) {
      seen |= std::uint64_t(1) << i;
      fine &= read_attribute(element, attribute, fields[i], diagnostics);
      continue;
    }
    fine = false;
    const std::string_view nearest = nearest_missing(element, attribute.name(), fields);
    report_error(diagnostics, attribute, [&] { return explain_unknown(element, attribute, fields, nearest); });
    // One slip, one message: an attribute that was only misspelt is not reported as missing too.
    if (nearest.empty())
      example_shown = true;
    else
      seen |= std::uint64_t(1) << find_field(fields, nearest);
  }
  return (example_shown || require_all(element, fields, seen, diagnostics)) && fine;
}

std::string example_of(std::span<const AttributeField> fields) {
  std::string example;
  for (const AttributeField& field : fields) {
    if (!field.required) continue;
    if (!example.empty()) example += ' ';
    example.append(field.name).append("=\"1\"");
  }
  return example;
}

}  // namespace raytrace
