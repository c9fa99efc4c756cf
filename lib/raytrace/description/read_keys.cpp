#include "raytrace/description/read_keys.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "raytrace/description/keyframes.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_attributes.h"
#include "raytrace/description/variables.h"
#include "raytrace/text/nearest_name.h"
#include "raytrace/text/quoted.h"
#include "raytrace/xml/report.h"

namespace raytrace {
namespace {

constexpr std::string_view key_element = "key";

struct PlacedKey {
  Key key;
  Element element;
};

class KeysReader {
 public:
  KeysReader(Element element, std::span<const std::string_view> components, Range range, Diagnostics& diagnostics)
      : element_(element), components_(components), range_(range), diagnostics_(diagnostics) {}

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
    for (const PlacedKey& placed : keys_) keys.push_back(placed.key);
    const std::array<double, 3> components = value_at(keys, element_.variables().frame());
    for (std::size_t i = 0; i < values.size(); ++i) *values[i] = components[i];
    return true;
  }

 private:
  template <class Place, class MakeMessage>
  void refuse(const Place& place, const MakeMessage& make_message) {
    fine_ = false;
    report_error(diagnostics_, place, make_message);
  }

  void refuse_value() {
    for (Attribute attribute = element_.first_attribute(); attribute; attribute = attribute.next()) {
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
    const Range range = range_ == Range::nonzero ? Range::any : range_;
    for (std::size_t i = 0; i < components_.size(); ++i) fields.push_back({components_[i], &key.components[i], range});
    fields.push_back({"interpolation", &key.interpolation, Range::any, false});
    return fields;
  }

  /// A key with the numbers of `source`.
  std::string example(Element source) const {
    Key key;
    return own_example(key_element, fields(key), source);
  }

  void read_key(Element element) {
    PlacedKey placed{{}, element};
    bool has_content = false;
    for (Node node = element.first_child(); node; node = node.next()) {
      if (!node.element() && node.text().empty()) continue;
      has_content = true;
      refuse(node, [&] { return "unexpected content of " + tag(key_element) + "; write it as " + example(element); });
    }
    fine_ &= read_attributes(element, fields(placed.key), has_content, diagnostics_);
    keys_.push_back(placed);
  }

  /// By their frames. Of two of one frame the second is refused.
  void order() {
    std::stable_sort(keys_.begin(), keys_.end(),
                     [](const PlacedKey& a, const PlacedKey& b) { return a.key.frame < b.key.frame; });
    for (std::size_t i = 1; i < keys_.size(); ++i) {
      const Key& before = keys_[i - 1].key;
      const Key& key = keys_[i].key;
      if (key.frame - before.frame >= least_key_distance) continue;
      refuse(keys_[i].element, [&] {
        return "a second key of frame " + number_text(key.frame) + " in " + tag(element_.name()) +
               "; the first one is in line " + std::to_string(keys_[i - 1].element.line());
      });
    }
  }

  Element element_;
  std::span<const std::string_view> components_;
  Range range_;
  Diagnostics& diagnostics_;
  std::vector<PlacedKey> keys_;
  bool fine_ = true;
};

}  // namespace

bool has_keys(Element element) { return static_cast<bool>(element.child(key_element)); }

bool read_keys(Element element, std::span<const std::string_view> components, std::span<double* const> values,
               Range range, Diagnostics& diagnostics) {
  return KeysReader(element, components, range, diagnostics).read(values);
}

}  // namespace raytrace
