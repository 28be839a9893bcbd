// SPDX-License-Identifier: MIT
/// @file
/// How much energy has gone through an assembly: the scale of an error of its account.
#pragma once

#include <algorithm>
#include <cmath>

#include <tangency/dem/observe.hpp>

namespace tangency::inline v0::dem {

/// The largest size of each work of an account so far: what goes to and fro comes to nothing in the
/// end. Losses are not in it: they are paid by the works.
class WorkDone {
 public:
  /// Takes an account into it.
  void note(const EnergyAccount& now) {
    for (const auto work :
         {&EnergyAccount::start, &EnergyAccount::boundary, &EnergyAccount::gravity,
          &EnergyAccount::growth, &EnergyAccount::branch})
      largest_.*work = std::max(largest_.*work, std::abs(now.*work));
  }
  /// The sum of them, energy.
  double sum() const { return largest_.sum(); }

 private:
  EnergyAccount largest_;
};

}  // namespace tangency::inline v0::dem
