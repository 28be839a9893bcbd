// SPDX-License-Identifier: MIT
/// @file
/// How arrays of a wrong length are refused, everywhere alike. Internal.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace tangency::inline v0::micromechanics {

/// @param name    of the array
/// @param of      what the array must have one entry of each: "contacts"
/// @throws std::invalid_argument  where the length is not the wanted one
inline void require_length(const char* name, std::size_t length, std::size_t wanted,
                           const char* of) {
  if (length != wanted)
    throw std::invalid_argument(std::string(name) + ": " + std::to_string(length) +
                                " entries, and there are " + std::to_string(wanted) + " " + of);
}

}  // namespace tangency::inline v0::micromechanics
