// SPDX-License-Identifier: MIT
/// @file
/// Numbers as files hold them, little-endian, whatever the order of bytes of the machine is. Where
/// it is the same, nothing is done. No function here throws, and all may run in threads.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace tangency::inline v0::dem {

inline constexpr bool kIsLittleEndian = std::endian::native == std::endian::little;
static_assert(kIsLittleEndian || std::endian::native == std::endian::big,
              "the order of bytes is neither of the two");

template <class T>
concept Number = std::is_arithmetic_v<T>;

/// The bytes of a number in a file.
template <Number T>
std::array<char, sizeof(T)> little_endian_bytes(T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (!kIsLittleEndian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// The number that these bytes of a file are.
template <Number T>
T of_little_endian_bytes(std::array<char, sizeof(T)> bytes) {
  if constexpr (!kIsLittleEndian) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Where the bytes of numbers were copied from a file as they are, makes them the numbers.
template <Number T>
void from_little_endian(T* numbers, std::size_t count) {
  if constexpr (!kIsLittleEndian)
    for (std::size_t k = 0; k < count; ++k)
      numbers[k] =
          of_little_endian_bytes<T>(std::bit_cast<std::array<char, sizeof(T)>>(numbers[k]));
}

}  // namespace tangency::inline v0::dem
