// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Every method, option and number of steps that is held against the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/bench/pairs.hpp>

namespace tangency::speed_accuracy {

using bench::Pairs;
using Answer = std::optional<verify::CallAnswer>;  ///< to one pair

/// What the gap of a method is. Beside the signed gap an "error" of the others is a difference of
/// definition, not of accuracy.
enum class Definition { common_normal, perram_wertheim, midpoint_potential, trace };
std::string_view to_string(Definition definition);

/// One way to answer all pairs of a family.
struct Method {
  std::string name;            ///< of the call
  std::string option;          ///< of it; empty: it has none
  std::optional<int> steps{};  ///< of the iteration that the option limits
  std::int64_t level = 0;      ///< instruction set of a batch; 0: one pair at a time
  Definition definition = Definition::common_normal;
  bool promises = false;  ///< that no answer is wrong (verify::CallGrade)

  std::function<void()> run;                     ///< all pairs once: what is timed
  std::function<std::vector<Answer>()> answers;  ///< of the last run
  /// Of a batch: the pairs that no lane proves, in order, which the single call answers.
  std::function<std::vector<std::size_t>()> left{};
};

/// "single" for 0, else the name of the instruction set.
std::string level_name(std::int64_t level);

/// All methods on these pairs, which must outlive them. A batch runs at the level that is in force
/// when run() is called: bench::force_level(method.level).
std::vector<Method> methods_on(const Pairs& pairs, std::span<const std::int64_t> levels);

}  // namespace tangency::speed_accuracy
