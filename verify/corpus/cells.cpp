// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/cells.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <ios>

namespace tangency::inline v0::verify {
namespace {

constexpr int kDigits = 40;

}  // namespace

std::string decimal(const Real& v) {
  if (v == 0) return "0";
  std::string text = v.str(kDigits - 1, std::ios::scientific);
  const std::size_t exponent = text.find('e');
  std::size_t last = text.find_last_not_of('0', exponent - 1);
  if (text[last] == '.') --last;
  text.erase(last + 1, exponent - last - 1);
  if (text.ends_with("e+00")) text.resize(text.size() - 4);
  return text;
}

std::string component(const Real& v) { return decimal(abs(v) < Real("1e-60") ? Real(0) : v); }

std::string components(const Real3& n) {
  return component(n[0]) + ',' + component(n[1]) + ',' + component(n[2]);
}

std::string hex(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::abs(value),
                                 std::chars_format::hex)
                       .ptr;
  return (value < 0 ? "-0x" : "0x") + std::string(digits.data(), end);
}

}  // namespace tangency::inline v0::verify
