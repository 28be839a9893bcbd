// SPDX-License-Identifier: MIT
/// @file
/// Real roots of quartics in double-double, of a multiplicity that is known beforehand. Internal.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/plane/conic_pair.hpp>

namespace tangency::detail {

/// Sorts the first few of an array. (std::sort's branch for more than sixteen makes g++ 12 warn of
/// accesses beyond so short an array.)
template <class T, std::size_t N, class Less>
void sort_few(std::array<T, N>& values, int count, const Less& less) noexcept {
  for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i) {
    for (std::size_t k = i; k > 0 && less(values[k], values[k - 1]); --k) {
      std::swap(values[k], values[k - 1]);
    }
  }
}

struct QuarticRoot {
  DoubleDouble at;
  int multiplicity;
};

struct QuarticRoots {
  int count = 0;  ///< distinct
  std::array<QuarticRoot, 4> root;
};

/// Ascending; none where the meeting is `equal` or `nowhere`. A multiple root is found as a simple
/// root of a derivative; of roots that double-double cannot tell apart both are put where the
/// polynomial is least.
/// @param c        from the constant upwards; the leading one not small beside the others
/// @param meeting  the multiplicities of the real roots
QuarticRoots real_quartic_roots(const std::array<DoubleDouble, 5>& c,
                                exact::Meeting meeting) noexcept;

}  // namespace tangency::detail
