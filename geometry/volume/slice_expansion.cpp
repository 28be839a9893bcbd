// SPDX-License-Identifier: MIT
#include <tangency/geometry/volume/slice_expansion.hpp>

namespace tangency::detail {
namespace {

using Quadratic = std::array<DoubleDouble, 3>;

template <std::size_t N>
SlicePolynomial<N> coefficients(const std::array<DoubleDouble, N>& c) {
  SlicePolynomial<N> result;
  for (std::size_t k = 0; k < N; ++k) result.c[k] = c[k].high;
  return result;
}


std::array<DoubleDouble, 5> product(const Quadratic& a, const Quadratic& b) {
  return {a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0],
          a[1] * b[2] + a[2] * b[1], a[2] * b[2]};
}

// In units of kDoubleDoubleEpsilon, over the sum of the absolute values of the terms: of a square
// of a sum of three, and of the eleven products of P. Section 4.
constexpr double kOfSquares = 32.0 * kDoubleDoubleEpsilon;
constexpr double kOfDiscriminant = 128.0 * kDoubleDoubleEpsilon;

}  // namespace

SliceExpansion::SliceExpansion(const CircularSections& s, const DoubleDouble& from,
                               double by) noexcept
    : base(from.high), step(by), y(s.y0.high) {
  const DoubleDouble at_x = s.x0 + s.tau * from, up_x = s.tau * DoubleDouble(by);
  const DoubleDouble at_z = from - s.z0, two(2.0), four(4.0), h(by);
  const Quadratic of_ball{DoubleDouble(1.0) - from * from, -(two * from * h), -(h * h)};
  const Quadratic of_second{s.beta - s.mu * at_z * at_z, -(two * s.mu * at_z * h),
                            -(s.mu * h * h)};
  const Quadratic of_distance{at_x * at_x + s.y0 * s.y0, two * at_x * up_x, up_x * up_x};
  Quadratic less{}, more{};
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDouble difference = of_ball[k] - of_second[k];
    less[k] = of_distance[k] + difference, more[k] = of_distance[k] - difference;
  }
  std::array<DoubleDouble, 5> discriminant = product(of_distance, of_ball);
  const std::array<DoubleDouble, 5> square = product(less, less);
  for (std::size_t k = 0; k < 5; ++k) discriminant[k] = four * discriminant[k] - square[k];

  x.c = {at_x.high, up_x.high};
  ball = coefficients(of_ball), second = coefficients(of_second), distance = coefficients(of_distance);
  q1 = coefficients(less), q2 = coefficients(more), p = coefficients(discriminant);

  const double reach = std::abs(base) + kFarthest * std::abs(by);
  const double far_x = std::abs(s.x0.high) + std::abs(s.tau.high) * reach;
  const double far_z = reach + std::abs(s.z0.high);
  const double most_distance = far_x * far_x + y * y;
  const double most_ball = 1.0 + reach * reach;
  const double most_second = s.beta.high + s.mu.high * far_z * far_z;
  const double most = most_distance + most_ball + most_second;
  of_x = kOfSquares * far_x;
  of_square = kOfSquares * most;
  of_p = kOfDiscriminant * (4.0 * most_distance * most_ball + most * most);
}

}  // namespace tangency::detail
