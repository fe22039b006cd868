#include "core/content_hash.hpp"

#define XXH_INLINE_ALL  // header only, nothing to link
#include <xxhash.h>

namespace clay {

struct ContentHasher::State {
  XXH3_state_t xxh3;
};

ContentHasher::ContentHasher() : state_(new State) { XXH3_128bits_reset(&state_->xxh3); }

void ContentHasher::Free::operator()(State* state) const noexcept { delete state; }

void ContentHasher::add(std::span<const std::byte> bytes) noexcept {
  XXH3_128bits_update(&state_->xxh3, bytes.data(), bytes.size());
}

ContentHash ContentHasher::digest() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&state_->xxh3));
  constexpr char kDigits[] = "0123456789abcdef";
  ContentHash text;
  for (const unsigned char byte : canonical.digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

ContentHash hash_of(std::span<const std::byte> bytes) {
  ContentHasher hasher;
  hasher.add(bytes);
  return hasher.digest();
}

}  // namespace clay
