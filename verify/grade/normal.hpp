// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A normal beside all true ones. Inner header of the grade.
#pragma once

#include <array>

#include <tangency/verify/answers/truth_table.hpp>

namespace tangency::verify {

struct NormalVerdict {
  double error;   ///< length of the difference to the nearest true normal
  bool reversed;  ///< more than a right angle from every true normal
};

/// `n` of any finite length; `row` one of the table whose normal is defined. Where every normal is
/// true the error is that of the length alone, and none is reversed.
NormalVerdict judge_normal(const TruthTable& truth, const TruthRow& row,
                           const std::array<double, 3>& n);

}  // namespace tangency::verify
