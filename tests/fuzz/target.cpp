// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/target.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <tangency/tests/fuzz/mutate.hpp>

namespace tangency::testing::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> list;
    for (auto&& part : {pair_targets(), batch_targets(), table_targets(), simulator_targets(),
                        grader_targets(), c_targets()})
      list.insert(list.end(), part.begin(), part.end());
    return list;
  }();
  return all;
}

const Target* target_named(std::string_view name) {
  for (const Target& target : targets()) {
    if (target.name == name) return &target;
  }
  return name == planted_target().name ? &planted_target() : nullptr;
}

const Target& planted_target() {
  static const Target planted{"planted",
                              "no input has a ! in it",
                              16,
                              [] { return std::vector<std::string>{"a"}; },
                              [](Bytes input) {
                                require(std::ranges::find(input, std::uint8_t{'!'}) == input.end(),
                                        "planted", "a fault");
                              },
                              mutate_bytes};
  return planted;
}

std::map<std::string, std::uint64_t, std::less<>>& counts() {
  static std::map<std::string, std::uint64_t, std::less<>> all;
  return all;
}

void count(std::string_view what, std::uint64_t number) {
  auto& all = counts();
  const auto found = all.find(what);
  if (found != all.end())
    found->second += number;
  else
    all.emplace(what, number);
}

void broken(std::string_view target, std::string_view what) {
  std::fprintf(stderr, "%.*s: %.*s\n", static_cast<int>(target.size()), target.data(),
               static_cast<int>(what.size()), what.data());
  std::fflush(stderr);
  std::abort();
}

// FNV-1a.
std::uint64_t hash_of(Bytes input) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : input) hash = (hash ^ byte) * 0x100000001b3U;
  return hash ^ (hash >> 29);
}

std::string source_file(const std::string& path, std::size_t lines) {
  std::ifstream file(std::filesystem::path(TANGENCY_SOURCE) / path, std::ios::binary);
  if (!file) broken("seeds", path + " cannot be read");
  if (lines == 0) return {std::istreambuf_iterator<char>(file), {}};
  std::string text;
  for (std::string line; lines > 0 && std::getline(file, line); --lines) text += line + '\n';
  return text;
}

}  // namespace tangency::testing::fuzz
