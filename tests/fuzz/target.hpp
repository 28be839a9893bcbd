// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What every fuzz target has in common: an input, what is done with it, and what was counted.
///
/// A target takes any bytes. It ends the process, with one line that begins with its name, where an
/// answer breaks a promise; what a sanitizer or an assertion finds ends the process too. It keeps
/// nothing from one input to the next but counts. One input at a time: nothing here is for threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangency::testing::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Changes the first `size` bytes of `data` in place, which has room for `most`; returns the new
/// size, at most that.
using Mutate = std::function<std::size_t(std::uint8_t* data, std::size_t size, std::size_t most,
                                         std::uint64_t seed)>;

struct Target {
  std::string name;
  std::string what;                                 ///< one line: what is held
  std::size_t most_bytes;                           ///< of an input
  std::function<std::vector<std::string>()> seeds;  ///< inputs to begin with
  std::function<void(Bytes)> run;
  Mutate mutate;
};

/// All of them but the planted one.
const std::vector<Target>& targets();

/// One of them, or the planted one; null for a name that none has.
const Target* target_named(std::string_view name);

/// What has been counted since the process began, by name: `runs`, `pairs`, `tier fast`, ...
std::map<std::string, std::uint64_t, std::less<>>& counts();
void count(std::string_view what, std::uint64_t number = 1);

/// Ends the process.
[[noreturn]] void broken(std::string_view target, std::string_view what);

inline void require(bool holds, std::string_view target, std::string_view what) {
  if (!holds) broken(target, what);
}

/// The same for the same bytes, on every machine.
std::uint64_t hash_of(Bytes input);

/// A file of the source tree; its first `lines` lines, or all of it where that is 0.
std::string source_file(const std::string& path, std::size_t lines = 0);

/// One that is broken by an input with a `!` in it: to see what a finding looks like.
const Target& planted_target();

std::vector<Target> pair_targets();       ///< calls
std::vector<Target> batch_targets();      ///< batch
std::vector<Target> table_targets();      ///< one for each subcommand of `tangency`
std::vector<Target> simulator_targets();  ///< scene, state, history
std::vector<Target> grader_targets();     ///< answers, truth
std::vector<Target> c_targets();          ///< c

}  // namespace tangency::testing::fuzz
