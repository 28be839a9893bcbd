// SPDX-License-Identifier: MIT
/// @file
/// A hash of bytes that pass by: XXH3 of 64 bits [XXH3], seed 0. Its value depends on the bytes
/// alone, not on how they are cut nor on the machine. Not against forgers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace tangency::inline v0::dem {

class StreamHash {
 public:
  StreamHash();
  ~StreamHash();
  StreamHash(const StreamHash&) = delete;
  StreamHash& operator=(const StreamHash&) = delete;

  void add(const void* bytes, std::size_t count) noexcept;
  /// Of all bytes so far.
  std::uint64_t value() const noexcept;

 private:
  struct Sums;
  std::unique_ptr<Sums> sums_;
};

}  // namespace tangency::inline v0::dem
