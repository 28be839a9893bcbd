// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/support/patterns.hpp>

#include <regex>

namespace tangency::testing {

bool has_pattern(const std::string& text, const std::string& pattern) {
  return std::regex_search(text, std::regex(pattern));
}

std::optional<std::string> captured(const std::string& text, const std::string& pattern) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(pattern))) return std::nullopt;
  return found[1].str();
}

std::string replaced(const std::string& text, const std::string& pattern, const std::string& by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

}  // namespace tangency::testing
