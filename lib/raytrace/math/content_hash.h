// A fingerprint of bytes: XXH3 with 128 bits (https://xxhash.com). Not for secrets.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace raytrace {

class ContentHash {
 public:
  /// Throws std::bad_alloc.
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  void add(const void* bytes, std::size_t count);

  /// Of all bytes so far: 32 hexadecimal digits.
  std::string digits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace raytrace
