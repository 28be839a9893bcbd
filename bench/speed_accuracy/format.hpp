// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Numbers as text.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace tangency::speed_accuracy {

/// As printf; up to 255 characters.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

}  // namespace tangency::speed_accuracy
