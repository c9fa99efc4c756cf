#include "raytrace/description/read_transform.h"

#include <algorithm>
#include <array>

#include "raytrace/description/keyframes.h"

namespace raytrace {

namespace {

bool read_matrix(Element element, TransformStep& step, const ReadContext& context) {
  NumberGroups numbers;
  const std::size_t errors_before = context.diagnostics.error_count();
  read_value(element, {element.name()}, &numbers, context);
  if (context.diagnostics.error_count() > errors_before) return false;
  if (numbers.numbers.size() != step.values.size()) {
    context.diagnostics.error(element, [&] {
      return tag(element.name()) + " has " + std::to_string(numbers.numbers.size()) +
             " numbers; it takes 16, row by row";
    });
    return false;
  }
  std::copy(numbers.numbers.begin(), numbers.numbers.end(), step.values.begin());
  return true;
}

/// <rotate axis="y" angle="30"/>
bool refuse_axis(Element element, const ReadContext& context) {
  const Attribute axis = find_attribute(element, "axis"), angle = find_attribute(element, "angle");
  if (!axis) return false;
  context.diagnostics.error(axis, [&] {
    const auto is = [&](char letter) {
      return axis.value().size() == 1 && (axis.value()[0] == letter || axis.value()[0] == letter - 'a' + 'A');
    };
    const std::string numbers = is('x')   ? "x=\"1\" y=\"0\" z=\"0\""
                                : is('z') ? "x=\"0\" y=\"0\" z=\"1\""
                                          : "x=\"0\" y=\"1\" z=\"0\"";
    return "unknown attribute 'axis' in " + tag(element.name()) + "; write <" + printable(element.name()) + " " +
           numbers + " angle=\"" + (angle ? printable(angle.value()) : "30") + "\"/>";
  });
  return true;
}

bool read_attributes_of_step(Element element, TransformStep& step, const ReadContext& context) {
  const std::span<const std::string_view> names = step_attributes(step.type);
  std::vector<double*> values;
  for (std::size_t i = 0; i < names.size(); ++i) values.push_back(&step.values[i]);
  if (step.type == TransformStep::rotate && refuse_axis(element, context)) return false;
  if (has_keys(element)) return read_keys(element, names, values, Range::any, context);
  std::vector<AttributeField> fields;
  for (std::size_t i = 0; i < names.size(); ++i) fields.push_back({names[i], values[i]});
  return read_attributes_alone(element, fields, context, [&](Node) {
    return "unexpected content of " + tag(element.name()) + "; write " + example_of(element.name(), fields, element);
  });
}

/// Whether it leaves objects their depth.
bool keeps_depth(const Affine& affine) {
  const double sizes = length(affine.x) * length(affine.y) * length(affine.z);
  return std::abs(affine.determinant()) > 1e-9 * sizes && sizes > smallest_size;
}

}  // namespace

std::span<const std::string_view> step_attributes(TransformStep::Type type) {
  static constexpr std::array<std::string_view, 4> names = {"x", "y", "z", "angle"};
  if (type == TransformStep::matrix) return {};
  return {names.data(), type == TransformStep::rotate ? 4U : 3U};
}

OptionalMessage check_step(const TransformStep& step) {
  for (std::size_t i = 0; i < step.value_count(); ++i)
    if (const OptionalMessage message = check_value(step.values[i], Range::any)) return "has a number that " + *message;
  const auto& v = step.values;
  switch (step.type) {
    case TransformStep::translate:
      return std::nullopt;
    case TransformStep::rotate:
      if (is_direction({v[0], v[1], v[2]})) return std::nullopt;
      return "has an axis of length 0; write one such as x=\"0\" y=\"1\" z=\"0\"";
    case TransformStep::matrix:
      if (v[12] != 0 || v[13] != 0 || v[14] != 0 || v[15] != 1) return "must end with the row 0 0 0 1";
      break;
    case TransformStep::scale:
      break;
  }
  if (keeps_depth(step.affine())) return std::nullopt;
  return step.type == TransformStep::scale ? "must not be 0: it would leave nothing of the object's depth"
                                           : "flattens the object: its determinant is 0";
}

OptionalMessage check_affine(const Affine& affine) {
  for (const Vec3d& column : {affine.x, affine.y, affine.z, affine.origin})
    for (const double number : {column.x, column.y, column.z})
      if (!(std::abs(number) <= largest_number))
        return "makes, with all its steps, a matrix with a number beyond the largest that a scene may have, " +
               number_text(largest_number);
  if (keeps_depth(affine)) return std::nullopt;
  return "flattens the object, or makes it too small: with all its steps, it leaves nothing of its depth";
}

bool read_transform(Element element, Transform& transform, const ReadContext& context) {
  Diagnostics& diagnostics = context.diagnostics;
  const std::size_t errors_before = diagnostics.error_count();
  refuse_attributes(element, {}, diagnostics);
  for (Node node = element.first_child(); node; node = node.next()) {
    if (refuse_text(node, element, diagnostics)) continue;
    const Element child = node.element();
    const auto& elements = TransformStep::elements;
    const auto found = std::find(elements.begin(), elements.end(), child.name());
    if (found == elements.end()) {
      diagnostics.error(child, [&] {
        const std::string_view nearest = nearest_name(child.name(), elements);
        return "unknown element " + tag(child.name()) + " in " + tag(element.name()) +
               (nearest.empty() ? "; it takes " + list_of_tags(elements) : "; did you mean " + tag(nearest) + "?");
      });
      continue;
    }
    TransformStep step{static_cast<TransformStep::Type>(found - elements.begin()), {}};
    const bool fine = step.type == TransformStep::matrix ? read_matrix(child, step, context)
                                                         : read_attributes_of_step(child, step, context);
    if (!fine) continue;
    if (const OptionalMessage message = check_step(step))
      diagnostics.error(child, [&] { return tag(child.name()) + " " + *message; });
    transform.steps.push_back(step);
  }
  if (transform.steps.size() > 1 && diagnostics.error_count() == errors_before)
    if (const OptionalMessage message = check_affine(transform.affine()))
      diagnostics.error(element, [&] { return tag(element.name()) + " " + *message; });
  return diagnostics.error_count() == errors_before;
}

}  // namespace raytrace
