// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The grade of what calls answered, pair by pair, without a table between: benchmarks ask for it
/// before they take a time. By the rules of grade.hpp, with three differences: errors are in the
/// unit of each pair, answers that are `local` have an error of their own, and witness points are
/// graded, too.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <tangency/verify/grade/judge.hpp>

namespace tangency::inline v0::verify {

// What is true of one pair.
struct CallTruth {
  TwoDoubles gap;
  double unit = 1;      // the length that errors are given in
  double unproven = 0;  // > 0: open, the true gap may be larger by up to this
  // Where no other normal reaches a gap as great; else neither normal nor points are graded.
  struct Contact {
    std::array<double, 3> normal, arm_a, arm_b;
  };
  std::optional<Contact> contact{};
};

// What a call says of one pair. What it does not answer is absent.
struct CallAnswer {
  std::optional<bool> overlaps{};  // the yes or no; absent: the sign of the gap is it
  std::optional<double> gap{};
  std::optional<double> gap_error{};  // a claimed bound
  bool is_local = false;              // the bound is for a local gap
  std::optional<std::array<double, 3>> normal{}, arm_a{}, arm_b{};
};

// Errors are those of answers that are not local, for pairs that are not open: infinite where an
// answer is not finite.
struct CallGrade {
  std::size_t pairs = 0;
  // A yes or no, or without one a sign, that is not the truth's; a number that is not finite; a
  // broken bound.
  std::size_t wrong = 0, first_wrong = kNoRow;
  std::size_t local = 0, unanswered = 0;
  std::size_t open = 0;                 // pairs whose truth is
  ErrorSummary gap;                     // |gap - true gap| / unit
  ErrorSummary normal;                  // angle in rad
  ErrorSummary point;                   // of the worse witness point / unit
  std::optional<double> gap_error{};    // largest bound of the answers that are not local / unit
  std::optional<double> local_error{};  // largest |gap - true gap| / unit of the local answers
};

// `answers` and `truth` are of the same pairs in the same order; nothing for a pair that was given
// no answer.
CallGrade grade_calls(std::span<const std::optional<CallAnswer>> answers,
                      std::span<const CallTruth> truth);

}  // namespace tangency::inline v0::verify
