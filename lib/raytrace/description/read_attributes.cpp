// Elements whose values are in attributes, and how such an element is written, for messages.
#include <algorithm>
#include <charconv>

#include "raytrace/description/keyframes.h"
#include "raytrace/description/read_value.h"
#include "raytrace/math/srgb.h"

namespace raytrace {

namespace {

bool is_number_or_variable(std::string_view word) {
  double number = 0;
  return word.starts_with('$') ? is_variable_name(word.substr(1)) : !parse_number(word, Range::any, number);
}

/// Numbers with spaces, commas or semicolons between them, in brackets or not. False if there is anything else.
bool append_numbers(std::string_view text, std::vector<std::string>& numbers) {
  static constexpr std::string_view separators = " \t\r\n,;()[]{}";
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    if (text.empty()) return true;
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    if (!is_number_or_variable(word)) return false;
    numbers.emplace_back(word);
    text.remove_prefix(word.size());
  }
}

/// Of a hexadecimal colour, #4080a0 or #48a, the linear numbers that it stands for, as texts; none of other words.
std::vector<std::string> linear_of_hexadecimal(std::string_view word) {
  if (!word.starts_with('#') || (word.size() != 4 && word.size() != 7)) return {};
  std::vector<std::string> numbers;
  const std::size_t digits = word.size() / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view code = word.substr(1 + i * digits, digits);
    int value = 0;
    if (std::from_chars(code.data(), code.data() + digits, value, 16).ptr != code.data() + digits || value < 0)
      return {};
    numbers.push_back(formatted("%.4g", linear_of_srgb(value / (digits == 1 ? 15.0 : 255.0))));
  }
  return numbers;
}

/// What an element holds for some fields.
class OwnNumbers {
 public:
  OwnNumbers(Element element, std::span<const AttributeField> fields) : fields_(fields), values_(fields.size()) {
    if (!element) return;
    for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next())
      take(attribute.name(), attribute.value());
    for (Node node = element.first_child(); node; node = node.next()) {
      const Element child = node.element();
      const Node content = child ? child.first_child() : node;
      if (content && !content.element()) take(child ? child.name() : std::string_view(), content.text());
    }
    give_others();
  }

  /// Of fields[i]; empty if it is not known.
  const std::string& operator[](std::size_t i) const { return values_[i]; }
  /// Whether they are those of a hexadecimal colour.
  bool of_hexadecimal() const { return of_hexadecimal_; }

 private:
  void take(std::string_view name, std::string_view text) {
    const std::size_t i = find_field(fields_, name);
    std::vector<std::string> numbers;
    if (find_field(fields_, Components<Rgb<double>>::names[0]) < fields_.size())
      numbers = linear_of_hexadecimal(xml::trimmed(text));
    takes_own_ |= i < fields_.size();
    of_hexadecimal_ = (of_hexadecimal_ || !numbers.empty()) && !takes_own_;
    const bool fine = !numbers.empty() || append_numbers(text, numbers);
    if (i == fields_.size()) {
      others_fine_ = others_fine_ && fine;
      others_.insert(others_.end(), numbers.begin(), numbers.end());
    } else if (fine && numbers.size() == 1) {
      values_[i] = numbers.front();
    }
  }

  /// Numbers without a field's name go to the required fields that have none, in their order.
  void give_others() {
    std::vector<std::string*> absent;
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (fields_[i].required && values_[i].empty()) absent.push_back(&values_[i]);
    if (!others_fine_) return;
    if (others_.size() == 1 && absent.size() == 3) others_.assign(3, others_.front());  // a grey
    if (others_.size() != absent.size()) return;
    for (std::size_t i = 0; i < absent.size(); ++i) *absent[i] = others_[i];
  }

  std::span<const AttributeField> fields_;
  std::vector<std::string> values_, others_;  ///< by the fields' names, and by others
  bool others_fine_ = true, takes_own_ = false, of_hexadecimal_ = false;
};

/// Bit i: the element has the attribute fields[i].
std::uint64_t present_attributes(Element element, std::span<const AttributeField> fields) {
  std::uint64_t present = 0;
  for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next()) {
    const std::size_t i = find_field(fields, attribute.name());
    if (i < fields.size()) present |= std::uint64_t(1) << i;
  }
  return present;
}

bool read_attribute(Element element, Attribute attribute, const AttributeField& field, const ReadContext& context) {
  const auto parse = [&](std::string_view text) -> OptionalMessage {
    if (const auto* const number = std::get_if<double*>(&field.target))
      return parse_number(text, field.range, **number);
    if (const auto* const choice = std::get_if<ChoiceReference>(&field.target)) return parse_choice(text, *choice);
    text = xml::trimmed(text);
    *std::get<std::string_view*>(field.target) = text;
    return text.empty() ? "is empty" : check_label(text);
  };
  const auto where = [&] { return " for " + std::string(field.name) + " in " + tag(element.name()) + " "; };
  return parse_text(attribute.value(), element, attribute, parse, where, context);
}

/// Reports the required fields that are missing, if any: then it is false. present: bit i for fields[i].
bool require_all(Element element, std::span<const AttributeField> fields, std::uint64_t present,
                 Diagnostics& diagnostics) {
  std::string missing;
  int count = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].required || (present >> i & 1)) continue;
    missing += (count++ > 0 ? " and " : "") + in_quotes(fields[i].name);
  }
  if (count == 0) return true;
  diagnostics.error(element, [&] {
    return "missing " + std::string(count > 1 ? "attributes " : "attribute ") + missing + " in " + tag(element.name()) +
           "; write " + example_of(element.name(), fields, element);
  });
  return false;
}

}  // namespace

bool read_attributes(Element element, std::span<const AttributeField> fields, bool example_shown,
                     const ReadContext& context) {
  bool fine = true;
  std::uint64_t present = 0;  // bit i: fields[i]
  for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next()) {
    const std::size_t i = find_field(fields, attribute.name());
    if (i < fields.size()) {
      present |= std::uint64_t(1) << i;
      fine &= read_attribute(element, attribute, fields[i], context);
      continue;
    }
    fine = false;
    const std::string_view nearest = nearest_absent(fields, present_attributes(element, fields), attribute.name());
    context.diagnostics.error(attribute, [&] {
      return "unknown attribute " + in_quotes(attribute.name()) + " in " + tag(element.name()) +
             (nearest.empty() ? "; write " + example_of(element.name(), fields, element)
                              : "; did you mean " + in_quotes(nearest) + "?");
    });
    // One slip, one message: an attribute that was only misspelt is not reported as missing too.
    if (nearest.empty())
      example_shown = true;
    else
      present |= std::uint64_t(1) << find_field(fields, nearest);
  }
  return (example_shown || require_all(element, fields, present, context.diagnostics)) && fine;
}

std::string example_of(std::string_view element, std::span<const AttributeField> fields, Element source) {
  const OwnNumbers own(source, fields);
  std::string text = "<" + printable(element);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].required) continue;
    const std::string_view any = std::holds_alternative<std::string_view*>(fields[i].target) ? "..."
                                 : fields[i].name == temperature_attribute                   ? "2700"
                                                                                             : "1";
    text.append(" ").append(fields[i].name).append("=\"").append(own[i].empty() ? any : own[i]).append("\"");
  }
  return text + (own.of_hexadecimal() ? "/>, the linear values of that sRGB colour" : "/>");
}

}  // namespace raytrace
