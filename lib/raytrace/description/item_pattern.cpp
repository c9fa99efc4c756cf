#include "raytrace/description/item_pattern.h"

#include <algorithm>
#include <array>
#include <variant>

#include "raytrace/description/parse_value.h"
#include "raytrace/xml/xml_characters.h"
#include "raytrace/xml/xml_scanner.h"

namespace raytrace {
namespace {

/// Reads a value of plain characters. Each function is false where there is something to say.
class PlainValueReader {
 public:
  PlainValueReader(std::string_view text, Range range, int component)
      : text_(text), range_(range), component_(static_cast<std::size_t>(component)) {}

  bool operator()(double* value) const { return !parse_number(text_, range_, *value); }
  bool operator()(int* value) const { return !parse_integer(text_, range_, *value); }
  bool operator()(bool* value) const { return !parse_boolean(text_, *value); }
  bool operator()(std::string_view* value) const {
    *value = text_;
    return !text_.empty() && text_.front() != ' ' && text_.back() != ' ' && text_.find("  ") == std::string_view::npos;
  }
  bool operator()(std::string* value) const {
    std::string_view text;
    if (!(*this)(&text)) return false;
    *value = text;
    return true;
  }
  bool operator()(Vec3d* value) const { return read_component({&value->x, &value->y, &value->z}); }
  bool operator()(Rgb<double>* value) const { return read_component({&value->red, &value->green, &value->blue}); }

 private:
  bool read_component(const std::array<double*, 3>& components) const {
    return !parse_number(text_, range_of_components(range_), *components[component_]);
  }

  std::string_view text_;
  Range range_;
  std::size_t component_;
};

/// What a value is for.
struct Place {
  std::size_t field;
  int component;
};

/// Of the item's values, in the order of its text. None if it has other content.
std::optional<std::vector<Place>> find_places(Element item, std::span<const FieldInfo> infos,
                                              std::span<const FieldTarget> targets) {
  std::vector<Place> places;
  for (Node node = item.first_child(); node; node = node.next()) {
    const Element child = node.element();
    if (!child) return std::nullopt;
    const std::size_t field = find_field(infos, child.name());
    if (field == infos.size()) return std::nullopt;
    const auto components = component_names(targets[field]);
    for (Attribute attribute = child.first_attribute(); attribute; attribute = attribute.next()) {
      const auto component = std::find(components.begin(), components.end(), attribute.name());
      if (component == components.end()) return std::nullopt;
      places.push_back({field, static_cast<int>(component - components.begin())});
    }
    const Node content = child.first_child();
    if (components.empty() ? !content || content.element() || content.next() : bool(content)) return std::nullopt;
    if (components.empty()) places.push_back({field, 0});
  }
  return places;
}

}  // namespace

std::optional<ItemPattern> ItemPattern::of(std::string_view text, Element item, std::span<const FieldInfo> infos,
                                           std::span<const FieldTarget> targets) {
  if (text.find("<!") != std::string_view::npos) return std::nullopt;
  const auto places = find_places(item, infos, targets);
  const std::vector<std::string_view> values = find_values(text);
  if (!places || places->size() != values.size()) return std::nullopt;
  ItemPattern pattern;
  pattern.infos_.assign(infos.begin(), infos.end());
  const char* at = text.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    pattern.values_.push_back({std::string(at, values[i].data()), (*places)[i].field, (*places)[i].component});
    at = values[i].data() + values[i].size();
  }
  pattern.end_.assign(at, text.data() + text.size());
  // None stands in a value that is read by it.
  for (const Value& value : pattern.values_)
    pattern.line_ends_ += static_cast<std::uint32_t>(std::count(value.before.begin(), value.before.end(), '\n'));
  pattern.line_ends_ += static_cast<std::uint32_t>(std::count(pattern.end_.begin(), pattern.end_.end(), '\n'));
  return pattern;
}

std::size_t ItemPattern::read(std::string_view text, std::span<const FieldTarget> targets) const {
  std::string_view rest = text;
  for (const Value& value : values_) {
    if (!rest.starts_with(value.before)) return 0;
    rest.remove_prefix(value.before.size());
    std::size_t size = 0;
    while (size < rest.size() && xml::is(rest[size], xml::plain)) ++size;
    const PlainValueReader reader(rest.substr(0, size), infos_[value.field].range, value.component);
    if (!std::visit(reader, targets[value.field])) return 0;
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
