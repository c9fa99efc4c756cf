#include "raytrace/description/item_pattern.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "raytrace/xml/xml_scanner.h"

namespace raytrace {
namespace {

/// Where a value goes.
struct ValueTarget {
  std::size_t field;
  std::size_t component;  // of a vector or a color
};

/// Reads a value of plain characters; false where there is something to say.
bool read_plain(std::string_view text, Range range, std::size_t component, const FieldTarget& target) {
  return std::visit(
      [&]<class Target>(const Target& value) {
        if constexpr (std::is_same_v<Target, double*>)
          return !parse_number(text, range, *value);
        else if constexpr (std::is_same_v<Target, int*>)
          return !parse_integer(text, range, *value);
        else if constexpr (std::is_same_v<Target, bool*>)
          return !parse_boolean(text, *value);
        else if constexpr (std::is_same_v<Target, ChoiceReference>)
          return !parse_choice(text, value);
        else if constexpr (std::is_same_v<Target, std::string_view*>)
          return *value = text, !text.empty() && text.front() != ' ' && text.back() != ' ' && !check_label(text);
        else if constexpr (std::is_same_v<Target, FileName*> || std::is_same_v<Target, NumberGroups*> ||
                           std::is_same_v<Target, WordOrGroups*> || std::is_same_v<Target, Transform*> ||
                           std::is_same_v<Target, Reference*>)
          return false;
        else
          return !parse_number(text, range_of_components(range),
                               value->*Components<std::remove_pointer_t<Target>>::members[component]);
      },
      target);
}

/// Those of the item's values, in the order of its text. None if it has other content.
std::optional<std::vector<ValueTarget>> find_targets(Element item, std::span<const FieldInfo> infos,
                                                     std::span<const FieldTarget> targets) {
  std::vector<ValueTarget> found;
  for (Node node = item.first_child(); node; node = node.next()) {
    const Element child = node.element();
    if (!child) return std::nullopt;
    const std::size_t field = find_field(infos, child.name());
    if (field == infos.size()) return std::nullopt;
    const auto components = component_names(targets[field]);
    for (Attribute attribute = child.first_attribute(); attribute; attribute = attribute.next()) {
      const auto component = std::find(components.begin(), components.end(), attribute.name());
      if (component == components.end()) return std::nullopt;
      found.push_back({field, static_cast<std::size_t>(component - components.begin())});
    }
    const Node content = child.first_child();
    if (components.empty() ? !content || content.element() || content.next() : bool(content)) return std::nullopt;
    if (components.empty()) found.push_back({field, 0});
  }
  return found;
}

}  // namespace

std::optional<ItemPattern> ItemPattern::of(std::string_view text, Element item, std::span<const FieldInfo> infos,
                                           std::span<const FieldTarget> targets) {
  if (text.find("<!") != std::string_view::npos) return std::nullopt;
  const auto found = find_targets(item, infos, targets);
  const std::vector<std::string_view> values = find_values(text);
  if (!found || found->size() != values.size()) return std::nullopt;
  ItemPattern pattern;
  pattern.infos_.assign(infos.begin(), infos.end());
  const char* at = text.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    pattern.values_.push_back({std::string(at, values[i].data()), (*found)[i].field, (*found)[i].component});
    at = values[i].data() + values[i].size();
  }
  pattern.end_.assign(at, text.data() + text.size());
  // None is in a value that is read by it.
  pattern.line_ends_ = xml::line_ends(pattern.end_);
  for (const Value& value : pattern.values_) pattern.line_ends_ += xml::line_ends(value.before);
  return pattern;
}

std::size_t ItemPattern::read(std::string_view text, std::span<const FieldTarget> targets) const {
  std::string_view rest = text;
  for (const Value& value : values_) {
    if (!rest.starts_with(value.before)) return 0;
    rest.remove_prefix(value.before.size());
    std::size_t size = 0;
    while (size < rest.size() && xml::is(rest[size], xml::plain)) ++size;
    if (!read_plain(rest.substr(0, size), infos_[value.field].range, value.component, targets[value.field])) return 0;
    rest.remove_prefix(size);
  }
  if (!rest.starts_with(end_)) return 0;
  for (std::size_t field = 0; field < infos_.size(); ++field) {
    const auto* const vector = std::get_if<Vec3d*>(&targets[field]);
    if (infos_[field].range == Range::nonzero && vector != nullptr && !is_direction(**vector)) return 0;
  }
  return text.size() - rest.size() + end_.size();
}

}  // namespace raytrace
