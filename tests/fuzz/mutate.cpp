// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/mutate.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace tangency::testing::fuzz {
namespace {

constexpr std::array<std::string_view, 30> kFeared{
    "0",          "-0",          "1",
    "-1",         "nan",         "inf",
    "-inf",       "1e308",       "1e309",
    "1e-308",     "5e-324",      "1e-400",
    "0x1p-1074",  "0x1p1023",    "0x1p",
    "1e",         "+1",          ".5",
    "5.",         "1e+05",       "1 2",
    "\"1\"",      "\"\"",        "\"",
    "4294967296", "-2147483649", "18446744073709551616",
    "0.1",        "1e5",         ""};

constexpr std::array<double, 18> kFearedNumbers{
    0.0,       -0.0,      1.0,      -1.0,     0.5,     2.0,
    0x1p-1074, 0x1p-1022, 0x1p-600, 0x1p-270, 0x1p-60, 0x1p60,
    0x1p270,   0x1p600,   0x1p1023, 1e308,    -1e308,  0x1.fffffffffffffp-1};

bool is_of_a_number(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '.' || c == '-' || c == '+' ||
         c == 'x' || c == 'p';
}

/// A run of characters [first, end) of the text.
struct Run {
  std::size_t first, end;
};

template <class Is>
Run run_at(const std::string& text, std::size_t at, Is&& is) {
  Run run{at, at};
  while (run.first > 0 && is(text[run.first - 1])) --run.first;
  while (run.end < text.size() && is(text[run.end])) ++run.end;
  return run;
}

Run line_at(const std::string& text, std::size_t at) {
  Run run = run_at(text, at, [](char c) { return c != '\n'; });
  if (run.end < text.size()) ++run.end;
  return run;
}

void change_text(std::string& text, std::uint64_t& state) {
  const std::size_t at = below(state, text.size());
  const auto replace = [&](Run run, std::string_view by) {
    text.replace(run.first, run.end - run.first, by);
  };
  const auto of = [&](Run run) { return text.substr(run.first, run.end - run.first); };
  const auto is_of_a_cell = [](char c) { return c != ',' && c != '\n'; };
  switch (below(state, 8)) {
    case 0:
    case 1:
      replace(run_at(text, at, is_of_a_number), kFeared[below(state, kFeared.size())]);
      break;
    case 2:
      replace(line_at(text, at), "");
      break;
    case 3: {
      const std::string line = of(line_at(text, at));
      text.insert(line_at(text, below(state, text.size())).first, line);
      break;
    }
    case 4: {
      const std::string cell = of(run_at(text, at, is_of_a_cell));
      replace(run_at(text, below(state, text.size()), is_of_a_cell), cell);
      break;
    }
    case 5:
      replace(run_at(text, at, is_of_a_cell), "");
      break;
    case 6: {
      constexpr std::array<std::string_view, 12> kSigns{
          ",", "\n", "\r\n", "\"", "#", " ", "\t", "=", "[", "]", "'", "\xef\xbb\xbf"};
      text.insert(at, kSigns[below(state, kSigns.size())]);
      break;
    }
    default:
      text[at] = static_cast<char>(next(state));
  }
}

}  // namespace

std::uint64_t next(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

std::size_t below(std::uint64_t& state, std::size_t limit) {
  return static_cast<std::size_t>(next(state) % limit);
}

std::size_t mutate_bytes(std::uint8_t* data, std::size_t size, std::size_t most,
                         std::uint64_t seed) {
  std::uint64_t state = seed;
  std::vector<std::uint8_t> bytes(data, data + size);
  const auto offset = [&](std::size_t at) { return static_cast<std::ptrdiff_t>(at); };
  for (std::size_t turns = 1 + below(state, 3); turns > 0; --turns) {
    if (bytes.empty()) bytes.push_back(static_cast<std::uint8_t>(next(state)));
    const std::size_t at = below(state, bytes.size()), other = below(state, bytes.size());
    const auto [from, to] = std::minmax(at, other);
    const std::size_t length = std::min<std::size_t>(1 + below(state, 16), bytes.size() - to);
    switch (below(state, 5)) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << below(state, 8)));
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(next(state));
        break;
      case 2:
        bytes.erase(bytes.begin() + offset(to), bytes.begin() + offset(to + length));
        break;
      case 3: {
        const std::vector<std::uint8_t> piece(bytes.begin() + offset(to),
                                              bytes.begin() + offset(to + length));
        bytes.insert(bytes.begin() + offset(from), piece.begin(), piece.end());
        break;
      }
      default:
        std::copy_n(bytes.begin() + offset(from), length, bytes.begin() + offset(to));
    }
  }
  const std::size_t kept = std::min(bytes.size(), most);
  std::copy_n(bytes.begin(), kept, data);
  return kept;
}

std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t most,
                        std::uint64_t seed) {
  std::uint64_t state = seed;
  if (below(state, 8) == 0) return mutate_bytes(data, size, most, next(state));
  std::string text(reinterpret_cast<const char*>(data), size);
  for (std::size_t turns = 1 + below(state, 3); turns > 0; --turns) {
    if (text.empty()) text = "0";
    change_text(text, state);
  }
  const std::size_t kept = std::min(text.size(), most);
  std::memcpy(data, text.data(), kept);
  return kept;
}

double mutated(double value, std::uint64_t& state) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
  switch (below(state, 5)) {
    case 0:
      return kFearedNumbers[below(state, kFearedNumbers.size())];
    case 1:
      return std::bit_cast<double>(bits + below(state, 17) - 8);
    case 2:
      return std::bit_cast<double>(bits ^ (std::uint64_t{1} << below(state, 64)));
    case 3:
      return std::ldexp(value, static_cast<int>(below(state, 129)) - 64);
    default:
      return std::bit_cast<double>(next(state));
  }
}

}  // namespace tangency::testing::fuzz
