// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/arc_tangent.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tangency::inline v0::detail {
namespace {

/// atan(k / 8), rounded to double from 60 digits.
constexpr std::array<double, 9> kEighths{0.0,
                                         0x1.fd5ba9aac2f6ep-4,
                                         0x1.f5b75f92c80ddp-3,
                                         0x1.6f61941e4def1p-2,
                                         0x1.dac670561bb4fp-2,
                                         0x1.1e00babdefeb4p-1,
                                         0x1.4978fa3269ee1p-1,
                                         0x1.700a7c5784634p-1,
                                         0x1.921fb54442d18p-1};

/// t - t^3/3 + ... - t^15/15, for |t| <= 1/16: what is left out is below 2^-70 of t.
double arc_tangent_series(double t) noexcept {
  const double square = t * t;
  double sum = 1.0 / 15.0;
  for (int n = 13; n >= 3; n -= 2) sum = 1.0 / n - square * sum;
  return t - t * square * sum;
}

/// atan(low / high) for 0 <= low <= high.
double in_first_octant(double low, double high) noexcept {
  const auto k = static_cast<std::size_t>(8.0 * (low / high) + 0.5);
  if (k == 0) return arc_tangent_series(low / high);
  const double tangent = 0.125 * static_cast<double>(k);
  const double rest = (low - tangent * high) / (high + tangent * low);
  return kEighths[k] + arc_tangent_series(rest);
}

}  // namespace

double angle_of(double sine, double cosine) noexcept {
  double low = sine, high = std::abs(cosine);
  const bool steep = low > high;
  if (steep) std::swap(low, high);
  const double octant = in_first_octant(low, high);
  const double first = steep ? 0.5 * kPi - octant : octant;
  return std::signbit(cosine) ? kPi - first : first;
}

}  // namespace tangency::inline v0::detail
