#include "raytrace/description/variables.h"

#include "raytrace/text/message.h"

namespace raytrace {
namespace {

constexpr const char* uses = "uses $";
constexpr const char* forms = "write ${name}, or ${name:-value} with a default, or ${name:04} for four digits";
constexpr const char* scene_too_long =
    "makes the scene longer than 2 GiB with the variables' values put in; shorten them";

bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// How many characters at the start of the text are a variable's name.
std::size_t name_length(std::string_view text) {
  if (text.empty() || !starts_name(text.front())) return 0;
  std::size_t length = 1;
  while (length < text.size() && (starts_name(text[length]) || (text[length] >= '0' && text[length] <= '9'))) ++length;
  return length;
}

/// "04" of "${frame:04}": 4. None: it is not such a form.
std::optional<std::size_t> digits_of(std::string_view form) {
  const bool fits = form.size() >= 2 && form.size() <= 3 && form[0] == '0';
  if (!fits || form.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  std::size_t digits = 0;
  for (const char c : form) digits = 10 * digits + static_cast<std::size_t>(c - '0');
  return digits;
}

/// As printf("%04d") does it: a minus sign is one of the digits.
bool append_padded(std::string_view value, std::size_t digits, std::string& result) {
  const bool is_negative = value.starts_with('-');
  const std::string_view number = value.substr(is_negative ? 1 : 0);
  if (number.empty() || number.find_first_not_of("0123456789") != std::string_view::npos) return false;
  if (is_negative) result += '-';
  if (value.size() < digits) result.append(digits - value.size(), '0');
  result += number;
  return true;
}

}  // namespace

bool is_variable_name(std::string_view text) { return !text.empty() && name_length(text) == text.size(); }

std::string with_dollars_doubled(std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled.append(c == '$' ? 2 : 1, c);
  return doubled;
}

Variables::Variables(const SceneSettings& settings) : frame_(settings.frame), after_frame_(settings.after_frame) {
  for (const auto& [name, value] : settings.variables) variables_[name].value = value;
  Variable& frame = variables_[std::string(frame_variable)];
  frame.value = std::to_string(settings.frame);
  frame.used = true;
}

OptionalMessage Variables::replace(std::string_view text, std::string& replaced) const {
  std::string result;
  while (true) {
    const std::size_t dollar = text.find('$');
    result += text.substr(0, dollar);
    if (result.size() > longest_text) return "is longer than 1 MiB with the variables' values put in; shorten them";
    if (dollar == std::string_view::npos) break;
    text.remove_prefix(dollar + 1);
    if (text.starts_with('$')) {
      result += '$';
      text.remove_prefix(1);
      continue;
    }
    if (OptionalMessage message = text.starts_with('{') ? replace_braced(text, result) : replace_plain(text, result))
      return message;
  }
  if (scene_length_.fetch_add(result.size(), std::memory_order_relaxed) > longest_scene) return scene_too_long;
  replaced = std::move(result);
  return std::nullopt;
}

bool Variables::is_cause(std::string_view message) { return message.starts_with(uses) || message == scene_too_long; }

OptionalMessage Variables::replace_plain(std::string_view& text, std::string& result) const {
  const std::string_view name = text.substr(0, name_length(text));
  if (name.empty()) return "has a '$' without a name behind it; write $$ for a dollar";
  const std::string* const value = find(name);
  if (value == nullptr) return explain_unset(name);
  result += *value;
  text.remove_prefix(name.size());
  return std::nullopt;
}

OptionalMessage Variables::replace_braced(std::string_view& text, std::string& result) const {
  static constexpr std::string_view default_sign = ":-";
  const std::size_t end = text.find('}');
  if (end == std::string_view::npos) return std::string("has a '${' without a '}'; ") + forms;
  std::string_view inside = text.substr(1, end - 1);
  text.remove_prefix(end + 1);
  const std::string_view name = inside.substr(0, name_length(inside));
  inside.remove_prefix(name.size());
  const bool has_default = inside.starts_with(default_sign);
  const auto digits = inside.starts_with(':') ? digits_of(inside.substr(1)) : std::nullopt;
  if (name.empty() || (!has_default && !digits && !inside.empty()))
    return std::string("has a '${' that is no variable; ") + forms;
  const std::string* const value = find(name);
  if (value == nullptr && !has_default) return explain_unset(name);
  if (digits) {
    if (append_padded(*value, *digits, result)) return std::nullopt;
    return "has a '${" + printable(name) + printable(inside) + "}', but " + in_quotes(*value) + " is no whole number";
  }
  if (value != nullptr && (!has_default || !value->empty())) {
    result += *value;
    return std::nullopt;
  }
  inside.remove_prefix(default_sign.size());
  for (std::size_t dollar; (dollar = inside.find('$')) != std::string_view::npos;) {
    if (inside.substr(dollar + 1, 1) != "$")
      return "has a variable in the default of ${" + printable(name) +
             "}; a default is a plain value, with $$ for a dollar";
    result += inside.substr(0, dollar + 1);
    inside.remove_prefix(dollar + 2);
  }
  result += inside;
  return std::nullopt;
}

const std::string* Variables::find(std::string_view name) const {
  const auto variable = variables_.find(name);
  if (variable == variables_.end()) return nullptr;
  // Written once only, so that the threads do not take it from each other.
  if (!variable->second.used.load(std::memory_order_relaxed)) variable->second.used = true;
  return &variable->second.value;
}

std::string Variables::explain_unset(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const auto& [known, variable] : variables_) names.push_back(known);
  const std::string_view nearest = nearest_name(name, names);
  const std::string start = uses + printable(name) + ", which is not set; ";
  if (!nearest.empty()) return start + "did you mean $" + std::string(nearest) + "?";
  return start + "set it: -D " + printable(name) + "=VALUE";
}

std::vector<std::string_view> Variables::unused() const {
  std::vector<std::string_view> names;
  for (const auto& [name, variable] : variables_) {
    if (!variable.used) names.push_back(name);
  }
  return names;
}

}  // namespace raytrace
