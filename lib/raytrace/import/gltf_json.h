// Values of a JSON text that know where they are, for messages. Inside of read_gltf().
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/import/gltf_bytes.h"
#include "raytrace/text/message.h"

namespace raytrace::gltf {

/// All throw Error where the value is not what is asked for. What is called from everywhere is not inlined: that took
/// the compiler half of its time.
class Item {
 public:
  Item(const nlohmann::json& value, std::string place) : value_(&value), place_(std::move(place)) {}

  /// Such as "accessors[3].count"; empty: the whole text.
  const std::string& place() const { return place_; }
  [[noreturn, gnu::noinline]] void fail(const std::string& message) const {
    throw Error(place_.empty() ? message : on_one_line(place_) + ": " + message);
  }

  [[gnu::noinline]] std::optional<Item> find(const char* key) const {
    if (!value_->is_object()) fail("must be a JSON object");
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return Item(*found, place_.empty() ? key : place_ + '.' + key);
  }
  [[gnu::noinline]] Item operator[](const char* key) const {
    std::optional<Item> found = find(key);
    if (!found) fail(std::string("has no '") + key + "'");
    return *std::move(found);
  }

  /// Of a JSON object, in their order.
  [[gnu::noinline]] std::vector<std::string> keys() const {
    if (!value_->is_object()) fail("must be a JSON object");
    std::vector<std::string> keys;
    for (const auto& item : value_->items()) keys.push_back(item.key());
    return keys;
  }

  bool is_text() const { return value_->is_string(); }

  std::size_t size() const {
    if (!value_->is_array()) fail("must be a JSON array");
    return value_->size();
  }
  [[gnu::noinline]] Item operator[](std::size_t i) const {
    if (i >= size()) fail("has " + std::to_string(size()) + " items, and not one of number " + std::to_string(i));
    return {(*value_)[i], place_ + '[' + std::to_string(i) + ']'};
  }

  double number() const {
    if (!value_->is_number()) fail("must be a number");
    return value_->get<double>();
  }
  [[gnu::noinline]] std::uint64_t whole() const {
    constexpr double most = 9007199254740992;
    const double value = value_->is_number() ? value_->get<double>() : -1;
    if (!(value >= 0 && value <= most) || value != std::floor(value)) fail("must be a whole number, 0 or more");
    return static_cast<std::uint64_t>(value);
  }
  [[gnu::noinline]] std::uint64_t whole(const char* key, std::uint64_t otherwise) const {
    const std::optional<Item> found = find(key);
    return found ? found->whole() : otherwise;
  }
  const std::string& text() const {
    if (!value_->is_string()) fail("must be a text");
    return value_->get_ref<const std::string&>();
  }
  double number(const char* key, double otherwise) const {
    const std::optional<Item> found = find(key);
    return found ? found->number() : otherwise;
  }
  /// Empty: it has none.
  [[gnu::noinline]] std::string name() const {
    const std::optional<Item> found = find("name");
    return found ? found->text() : std::string();
  }
  bool is_true() const { return value_->is_boolean() && value_->get<bool>(); }

  /// So many numbers, if it has that key.
  template <std::size_t count>
  std::optional<std::array<double, count>> numbers(const char* key) const {
    const std::optional<Item> found = find(key);
    if (!found) return std::nullopt;
    if (found->size() != count) found->fail("must have " + std::to_string(count) + " numbers");
    std::array<double, count> values{};
    for (std::size_t i = 0; i < count; ++i) values[i] = (*found)[i].number();
    return values;
  }

 private:
  const nlohmann::json* value_;
  std::string place_;
};

}  // namespace raytrace::gltf
