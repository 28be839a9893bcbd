// SPDX-License-Identifier: MIT
/// @file
/// Numbers as text that reads back to the same double, the shortest.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace tangency::dem {

template <class Number>
std::string to_text(Number x) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  return {buffer.data(), end.ptr};
}

}  // namespace tangency::dem
