#include "raytrace/description/keyframes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "raytrace/text/message.h"

namespace raytrace {
namespace {

/// A component of the keys as a function of the frame.
class TimeCurve {
 public:
  TimeCurve(const std::vector<Key>& keys, std::size_t component) : keys_(keys), component_(component) {}

  /// At a frame between keys[i] and keys[i + 1].
  double at(std::size_t i, double frame) const {
    const double start = value(i);
    const double end = value(i + 1);
    const double s = (frame - keys_[i].frame) / length(i);
    if (!is_smooth(i) && !is_smooth(i + 1)) return std::lerp(start, end, s);
    const double start_slope = is_smooth(i) ? smooth_slope(i) : slope(i);
    const double end_slope = is_smooth(i + 1) ? smooth_slope(i + 1) : slope(i);
    const double r = 1 - s;
    const double hermite = start * (1 + 2 * s) * r * r + end * s * s * (3 - 2 * s) +
                           length(i) * (start_slope * s * r * r - end_slope * s * s * r);
    return std::clamp(hermite, std::min(start, end), std::max(start, end));  // against rounding
  }

 private:
  double value(std::size_t i) const { return keys_[i].components[component_]; }
  double length(std::size_t i) const { return keys_[i + 1].frame - keys_[i].frame; }
  double slope(std::size_t i) const { return (value(i + 1) - value(i)) / length(i); }
  bool is_smooth(std::size_t i) const { return keys_[i].interpolation == Interpolation::smooth; }

  double smooth_slope(std::size_t i) const {
    if (i == 0 || i + 1 == keys_.size()) return 0;
    const double before = slope(i - 1);
    const double after = slope(i);
    if (before * after <= 0) return 0;
    const double before_weight = length(i - 1) + 2 * length(i);
    const double after_weight = 2 * length(i - 1) + length(i);
    return (before_weight + after_weight) / (before_weight / before + after_weight / after);
  }

  const std::vector<Key>& keys_;
  std::size_t component_;
};

constexpr std::string_view key_element = "key";

struct KeyElement {
  Key key;
  Element element;
};

class KeysReader {
 public:
  KeysReader(Element element, std::span<const std::string_view> components, Range range, const ReadContext& context,
             TextureAttributes* texture)
      : element_(element), components_(components), range_(range), context_(context), texture_(texture) {}

  bool read(std::span<double* const> values) {
    refuse_value();
    for (Node node = element_.first_child(); node; node = node.next()) {
      const Element child = node.element();
      if (child && child.name() == key_element)
        read_key(child);
      else
        refuse_child(node);
    }
    if (!fine_) return false;
    order();
    if (!fine_) return false;
    std::vector<Key> keys;
    for (const KeyElement& read : keys_) keys.push_back(read.key);
    const std::array<double, 4> components = value_at(keys, context_.variables.moment());
    for (std::size_t i = 0; i < values.size(); ++i) *values[i] = components[i];
    return true;
  }

 private:
  template <class At, class MakeMessage>
  void refuse(const At& at, const MakeMessage& make_message) {
    fine_ = false;
    context_.diagnostics.error(at, make_message);
  }

  void refuse_value() {
    const auto is_component = [&](Attribute attribute) {
      return std::find(components_.begin(), components_.end(), attribute.name()) != components_.end();
    };
    bool has_components = false;
    for (Attribute attribute = element_.first_attribute(); attribute; attribute = attribute.next())
      has_components |= is_component(attribute);
    if (texture_ != nullptr && !has_components) {
      fine_ = read_attributes(element_, texture_fields(*texture_, components_.size() == 1), true, context_);
      return;
    }
    for (Attribute attribute = element_.first_attribute(); attribute; attribute = attribute.next()) {
      if (texture_ != nullptr && !is_component(attribute)) continue;
      refuse(attribute, [&] {
        return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(element_.name()) +
               ", which has keys; write it into them, as in " + example(element_);
      });
    }
  }

  void refuse_child(Node node) {
    const Element child = node.element();
    if (!child && node.text().empty()) return;
    refuse(node, [&] {
      if (!child) {
        return "unexpected text " + in_quotes(node.text()) + " in " + tag(element_.name()) +
               ", which has keys; remove it or them";
      }
      const std::string start =
          "unexpected element " + tag(child.name()) + " beside the keys of " + tag(element_.name());
      return start + (nearest_name(child.name(), {&key_element, 1}).empty()
                          ? "; remove it"
                          : "; did you mean " + tag(key_element) + "?");
    });
  }

  std::vector<AttributeField> fields(Key& key) const {
    std::vector<AttributeField> fields{{"frame", &key.frame}};
    const Range range = range_of_components(range_);
    for (std::size_t i = 0; i < components_.size(); ++i) fields.push_back({components_[i], &key.components[i], range});
    fields.push_back({"interpolation", ChoiceReference(key.interpolation), Range::any, false});
    return fields;
  }

  /// A key with the numbers of `source`.
  std::string example(Element source) const {
    Key key;
    return example_of(key_element, fields(key), source);
  }

  void read_key(Element element) {
    KeyElement read{{}, element};
    fine_ &= read_attributes_alone(element, fields(read.key), context_, [&](Node) {
      return "unexpected content of " + tag(key_element) + "; write it as " + example(element);
    });
    keys_.push_back(read);
  }

  /// By their frames. Of two of one frame the second is refused.
  void order() {
    std::stable_sort(keys_.begin(), keys_.end(),
                     [](const KeyElement& a, const KeyElement& b) { return a.key.frame < b.key.frame; });
    for (std::size_t i = 1; i < keys_.size(); ++i) {
      const Key& before = keys_[i - 1].key;
      const Key& key = keys_[i].key;
      if (key.frame - before.frame >= least_key_distance) continue;
      refuse(keys_[i].element, [&] {
        return "a second key of frame " + number_text(key.frame) + " in " + tag(element_.name()) +
               "; the first one is in " +
               context_.diagnostics.line_name(keys_[i - 1].element.line(), keys_[i].element.line());
      });
    }
  }

  Element element_;
  std::span<const std::string_view> components_;
  Range range_;
  const ReadContext& context_;
  TextureAttributes* texture_;  ///< null if the element has none
  std::vector<KeyElement> keys_;
  bool fine_ = true;
};

}  // namespace

std::array<double, 4> value_at(const std::vector<Key>& keys, double frame) {
  const auto next = std::upper_bound(keys.begin(), keys.end(), frame,
                                     [](double wanted, const Key& key) { return wanted < key.frame; });
  if (next == keys.begin()) return keys.front().components;
  if (next == keys.end()) return keys.back().components;
  const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
  std::array<double, 4> components{};
  for (std::size_t component = 0; component < components.size(); ++component)
    components[component] = TimeCurve(keys, component).at(i, frame);
  return components;
}

bool has_keys(Element element) { return static_cast<bool>(element.child(key_element)); }

bool read_keys(Element element, std::span<const std::string_view> components, std::span<double* const> values,
               Range range, const ReadContext& context, TextureAttributes* texture) {
  return KeysReader(element, components, range, context, texture).read(values);
}

}  // namespace raytrace
