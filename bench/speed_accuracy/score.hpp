// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far the answers of a method are from the truth, and which of them are wrong.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::speed_accuracy {

/// What the oracle knows of one pair.
struct Truth {
  double gap, gap_rest;  ///< the sum is the true gap to some 32 digits
  Vec3 normal, arm_a, arm_b;
  double unproven;  ///< > 0: open, the true gap may be larger by up to this
  bool unique;      ///< no other normal reaches a gap as great
  double unit;      ///< the length that errors are given in
};

enum class Standing {
  proven,    ///< |gap - true gap| <= gap_error is promised
  local,     ///< true gap >= gap - gap_error is
  estimate,  ///< nothing is
  none,      ///< no answer; nothing else of it counts
};

/// A method's answer for one pair.
struct Answer {
  Standing standing = Standing::none;
  std::optional<bool> overlaps{};  ///< of a method that answers no more than yes or no
  double gap = 0, gap_error = 0;
  Vec3 normal = Vec3::Zero(), arm_a = Vec3::Zero(), arm_b = Vec3::Zero();
};

/// Infinite where an answer is not finite. Ranks are nearest ranks.
struct Errors {
  double median, percentile_99, largest;
};

/// Errors are those of answers that are neither `none` nor `local`, for pairs that are not open.
/// Absent where no answer has such an error.
struct Score {
  std::size_t pairs = 0;
  /// Answers of the wrong sign (or yes or no), that are not finite, or that break what their
  /// standing promises.
  std::size_t wrong = 0;
  std::optional<std::size_t> first_wrong{};
  std::size_t local = 0, unanswered = 0;
  std::size_t open = 0;                 ///< pairs whose truth is
  std::optional<Errors> gap{};          ///< |gap - true gap| / unit
  std::optional<Errors> normal{};       ///< angle in rad, where the normal is unique
  std::optional<Errors> point{};        ///< of the worse witness point / unit, there
  std::optional<double> gap_error{};    ///< largest of the proven answers / unit
  std::optional<double> local_error{};  ///< largest |gap - true gap| / unit of the local answers
};

/// @param answers, truth  of the same pairs in the same order
Score score(std::span<const Answer> answers, std::span<const Truth> truth);

}  // namespace tangency::speed_accuracy
