// SPDX-License-Identifier: MIT
#include <tangency/dem/saved/stream_hash.hpp>

// Everything of the library is compiled here and nothing linked: docs/decisions/0011-state-hash.md.
#define XXH_INLINE_ALL
#include <xxhash.h>

static_assert(XXH_VERSION_NUMBER >= 800, "XXH3's values are fixed from 0.8.0 on");

namespace tangency::inline v0::dem {

struct StreamHash::Sums {
  XXH3_state_t xxh3;
};

StreamHash::StreamHash() : sums_(std::make_unique<Sums>()) { XXH3_64bits_reset(&sums_->xxh3); }
StreamHash::~StreamHash() = default;

void StreamHash::add(const void* bytes, std::size_t count) noexcept {
  XXH3_64bits_update(&sums_->xxh3, bytes, count);
}

std::uint64_t StreamHash::value() const noexcept { return XXH3_64bits_digest(&sums_->xxh3); }

}  // namespace tangency::inline v0::dem
