// SPDX-License-Identifier: MIT
#include <tangency/geometry/normals/perram_wertheim.hpp>

#include <cmath>

namespace tangency::inline v0::detail {

double PerramWertheimSearch::between(double l, double slope) const noexcept {
  return std::sqrt(l) * std::sqrt(slope > 0.0 ? high_ : low_);
}

double PerramWertheimForm::first_guess() const noexcept {
  if (num_[0] > 0.0 && num_[2] > 0.0) {
    return std::sqrt((num_[2] * det_[0]) / (num_[0] * det_[3]));
  }
  return std::cbrt(det_[0] / det_[3]);
}

double PerramWertheimForm::maximise(int steps) const noexcept {
  constexpr double kSettled = 0.1;  // chosen: what follows is Newton's method on the normal itself
  PerramWertheimSearch search;
  double l = first_guess();
  for (int i = 0; i < steps; ++i) {
    const double next = search.next(at(l));
    const bool settled = std::abs(next - l) < kSettled * l;
    l = next;
    if (settled) break;
  }
  return l;
}

}  // namespace tangency::inline v0::detail
