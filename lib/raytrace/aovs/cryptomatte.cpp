#include "raytrace/aovs/cryptomatte.h"

#include <bit>
#include <nlohmann/json.hpp>

#include "raytrace/text/message.h"

namespace raytrace::cryptomatte {

namespace {

std::uint32_t byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// A block of four bytes, or what is left of one, before it goes into the hash.
std::uint32_t scrambled(std::uint32_t block) { return std::rotl(block * 0xcc9e2d51U, 15) * 0x1b873593U; }

std::string hexadecimal(std::uint32_t number) { return formatted("%08x", number); }

}  // namespace

std::uint32_t murmur_hash3(std::string_view text) {
  std::uint32_t hash = 0;
  std::size_t at = 0;
  for (; at + 4 <= text.size(); at += 4) {
    const std::uint32_t block =
        byte_at(text, at) | byte_at(text, at + 1) << 8U | byte_at(text, at + 2) << 16U | byte_at(text, at + 3) << 24U;
    hash = std::rotl(hash ^ scrambled(block), 13) * 5 + 0xe6546b64U;
  }
  std::uint32_t rest = 0;
  for (std::size_t i = text.size(); i-- > at;) rest = rest << 8U | byte_at(text, i);
  hash ^= scrambled(rest);
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16U) * 0x85ebca6bU;
  hash = (hash ^ hash >> 13U) * 0xc2b2ae35U;
  return hash ^ hash >> 16U;
}

std::uint32_t id_of(std::string_view name) {
  constexpr unsigned exponent_shift = 23;
  constexpr std::uint32_t largest_exponent = 255;
  const std::uint32_t hash = murmur_hash3(name);
  const std::uint32_t exponent = hash >> exponent_shift & largest_exponent;
  // 0: zero or a denormal number; the largest: infinity or NaN.
  return exponent == 0 || exponent == largest_exponent ? hash ^ 1U << exponent_shift : hash;
}

std::vector<Channel> channels(std::string_view layer) {
  std::vector<Channel> list;
  for (std::size_t level = 0; level < pairs / 2; ++level)
    for (const char* component : {".R", ".G", ".B", ".A"})
      list.push_back({std::string(layer) + '0' + std::to_string(level) + component, ChannelType::float32});
  return list;
}

std::vector<ImageAttribute> attributes(std::string_view layer, const std::vector<std::string>& names) {
  constexpr std::size_t key_digits = 7;
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : names) manifest[name] = hexadecimal(id_of(name));
  const std::string key = "cryptomatte/" + hexadecimal(id_of(layer)).substr(0, key_digits) + '/';
  return {{key + "name", std::string(layer)},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)}};
}

}  // namespace raytrace::cryptomatte
