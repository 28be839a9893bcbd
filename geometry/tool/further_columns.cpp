// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/further_columns.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tangency::inline v0::tool::further {
namespace {

/// "F, mu and F_error"
std::string listed(const std::vector<std::string_view>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool last = i + 1 == names.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + std::string(names[i]);
  }
  return text;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(',');
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string refused(std::string_view asked, const std::vector<std::string_view>& allowed) {
  const std::vector<std::string_view> names = split(asked);
  for (auto at = names.begin(); at != names.end(); ++at) {
    const std::string name(*at);
    if (std::ranges::find(allowed, *at) == allowed.end()) {
      return (name.empty() ? "an empty name" : name) + " is not a further column; " +
             listed(allowed) + " are, separated by commas";
    }
    if (std::find(names.begin(), at, *at) != at) {
      return name + " is named twice; each column may be named once";
    }
  }
  return {};
}

}  // namespace tangency::inline v0::tool::further
