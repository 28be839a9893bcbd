// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Regular expressions of ECMAScript on what a tool says. The templates of <regex> take seconds a
/// file, and are compiled in patterns.cpp alone.
#pragma once

#include <optional>
#include <string>

namespace tangency::testing {

/// Whether the pattern matches somewhere in the text.
bool has_pattern(const std::string& text, const std::string& pattern);

/// What the first group of the pattern matched, if the pattern matches somewhere in the text.
std::optional<std::string> captured(const std::string& text, const std::string& pattern);

/// The text with `by` in place of every match.
std::string replaced(const std::string& text, const std::string& pattern, const std::string& by);

}  // namespace tangency::testing
