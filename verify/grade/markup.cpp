// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/grade/markup.hpp>

#include <array>
#include <cstddef>

namespace tangency::inline v0::verify {
namespace {

// Bytes of the character that begins here; 0 where none does that XML can hold.
std::size_t length(std::string_view text) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\n' || first == '\t' ? 1 : 0;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  unsigned code = first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = (code << 6) | (byte(i) & 0x3f);
  }
  constexpr std::array kLeast{0x80U, 0x800U, 0x10000U};
  const bool is_character = first >= 0xc0 && code >= kLeast[size - 2] && code < 0x110000 &&
                            (code < 0xd800 || code > 0xdfff) && (code & 0xfffe) != 0xfffe;
  return is_character ? size : 0;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t size = length(text);
    const std::string_view character = size == 0 ? "?" : text.substr(0, size);
    switch (character[0]) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += character;
    }
    text.remove_prefix(character.size());
  }
  return safe;
}

}  // namespace tangency::inline v0::verify
