// SPDX-License-Identifier: MIT
/// @file
/// A check that the tools of every folder share.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tangency::tool {

/// Refuses the empty text that a script's unset variable leaves.
inline CLI::Validator not_empty(const std::string& what = "file name") {
  return CLI::Validator(
      [what](const std::string& text) {
        return text.empty() ? "a " + what + " is empty" : std::string();
      },
      "");
}

}  // namespace tangency::tool
