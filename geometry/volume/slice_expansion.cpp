// SPDX-License-Identifier: MIT
#include <tangency/geometry/volume/slice_expansion.hpp>

#include <tangency/geometry/normals/precise_perram_wertheim.hpp>

namespace tangency::inline v0::detail {
namespace {

template <class T>
using Quadratic = std::array<T, 3>;
template <class T>
using Quartic = std::array<T, 5>;

template <class T, std::size_t N>
SlicePolynomial<N> coefficients(const std::array<T, N>& c) {
  SlicePolynomial<N> result;
  for (std::size_t k = 0; k < N; ++k) result.c[k] = static_cast<double>(c[k]);
  return result;
}

template <class T>
Quartic<T> product(const Quadratic<T>& a, const Quadratic<T>& b) {
  return {a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0],
          a[1] * b[2] + a[2] * b[1], a[2] * b[2]};
}

// In units of the arithmetic's epsilon, over the sum of the absolute values of the terms: of a
// square of a sum of three, and of the eleven products of P. Section 4.
constexpr double kOfSquares = 32.0, kOfDiscriminant = 128.0;

/// Is a difference of numbers of one sign within a few epsilon of itself, and not only of them?
template <class T>
constexpr bool kSharpDifference = false;
template <>
constexpr bool kSharpDifference<DoubleDouble> = true;  // [JoldesMullerPopescu2017, theorem 3.1]

}  // namespace

template <class T>
SliceExpansion::SliceExpansion(const CircularSections<T>& s, const DoubleDouble& from,
                               double by) noexcept
    : base(from.high), step(by), y(static_cast<double>(s.y0)) {
  const T h(by), at = T(from.high) + T(from.low), two(2.0), four(4.0);
  const T at_z = at - s.z0, at_x = s.x0 + s.tau * at_z, up_x = s.tau * h;
  const Quadratic<T> of_ball{T(1.0) - at * at, -(two * at * h), -(h * h)};
  const Quadratic<T> of_second{s.beta - s.mu * at_z * at_z, -(two * s.mu * at_z * h),
                               -(s.mu * h * h)};
  const Quadratic<T> of_distance{at_x * at_x + s.y0 * s.y0, two * at_x * up_x, up_x * up_x};
  Quadratic<T> less, more;
  for (std::size_t k = 0; k < 3; ++k) {
    const T difference = of_ball[k] - of_second[k];
    less[k] = of_distance[k] + difference, more[k] = of_distance[k] - difference;
  }
  Quartic<T> discriminant = product(of_distance, of_ball);
  const Quartic<T> square = product(less, less);
  for (std::size_t k = 0; k < 5; ++k) discriminant[k] = four * discriminant[k] - square[k];

  x.c = {static_cast<double>(at_x), static_cast<double>(up_x)};
  ball = coefficients(of_ball), second = coefficients(of_second);
  distance = coefficients(of_distance), p = coefficients(discriminant);
  q1 = coefficients(less), q2 = coefficients(more);

  constexpr double epsilon = Arithmetic<T>::kEpsilon;
  const double tau = std::abs(static_cast<double>(s.tau)), away = kFarthest * std::abs(by);
  const double reach = std::abs(base) + away, z0 = std::abs(static_cast<double>(s.z0));
  const double far_z =
      std::abs(static_cast<double>(at_z)) + away + (kSharpDifference<T> ? 0.0 : reach + z0);
  const double far_x = std::abs(static_cast<double>(s.x0)) + tau * far_z;
  const double most_distance = far_x * far_x + y * y, most_ball = 1.0 + reach * reach;
  const double most_second =
      static_cast<double>(s.beta) + static_cast<double>(s.mu) * far_z * far_z;
  const double most = most_distance + most_ball + most_second;
  of_x = kOfSquares * epsilon * far_x;
  of_square = kOfSquares * epsilon * most;
  of_p = kOfDiscriminant * epsilon * (4.0 * most_distance * most_ball + most * most);
}

template SliceExpansion::SliceExpansion(const CircularSections<DoubleDouble>&, const DoubleDouble&,
                                        double) noexcept;
template SliceExpansion::SliceExpansion(const CircularSections<WideFloat>&, const DoubleDouble&,
                                        double) noexcept;

}  // namespace tangency::inline v0::detail
