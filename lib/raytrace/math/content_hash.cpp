#include "raytrace/math/content_hash.h"

// All of it here, so that programs which link the library need not find another one.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstdio>
#include <new>

namespace raytrace {

struct ContentHash::State {
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> hash{XXH3_createState()};
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
  if (!state_->hash || XXH3_128bits_reset(state_->hash.get()) == XXH_ERROR) throw std::bad_alloc();
}

ContentHash::~ContentHash() = default;

void ContentHash::add(const void* bytes, std::size_t count) {
  XXH3_128bits_update(state_->hash.get(), bytes, count);  // fails for null pointers only
}

std::string ContentHash::digits() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->hash.get());
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text.data();
}

}  // namespace raytrace
