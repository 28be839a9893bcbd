// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/rational_solid.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tangency/geometry/numbers/real_roots.hpp>

namespace tangency::inline v0::exact {
namespace {

// Floating-point numbers of so many bits that what they round is lost beside a double's rounding.
template <std::size_t N>
using WideMatrix = std::array<std::array<mpf_class, N>, N>;

/// Bits of the wide numbers beyond those that the condition of a matrix takes: a double has 53.
/// Chosen.
constexpr long kSpareBits = 192;
/// An entry off the diagonal ends as so many halvings of the smaller one on it; and of the largest,
/// as many less than there are bits. Chosen.
constexpr mp_bitcnt_t kOffBits = 128;
constexpr long kRoundingBits = 40;
/// What the wide numbers may have rounded, of a length relative to the smallest semi-axis: far
/// more than 2^-kSpareBits times the steps that are taken.
constexpr double kWideError = 0x1p-100;

template <std::size_t N>
mpq_class minor_of(const RationalMatrix<N>& m, std::size_t size) {
  if (size == 1) return m[0][0];
  if (size == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// floor(log2 |x|) or one more; x != 0.
long exponent_of(const mpq_class& x) {
  return bit_length(x.get_num()) - bit_length(x.get_den()) + 1;
}

/// Bits that tell the smallest eigenvalue from the largest: log2 of trace^N / determinant, an upper
/// bound of their ratio.
template <std::size_t N>
long condition_bits(const RationalMatrix<N>& m) {
  mpq_class trace;
  for (std::size_t i = 0; i < N; ++i) trace += abs(m[i][i]);
  const mpq_class determinant = minor_of(m, N);
  if (determinant == 0 || trace == 0) return 0;
  return std::max(0L, static_cast<long>(N) * exponent_of(trace) - exponent_of(determinant) + 2);
}

/// A number keeps the bits that it was made with, whatever is assigned to it.
template <std::size_t N>
std::array<mpf_class, N> wide_zeros(long bits) {
  std::array<mpf_class, N> zeros;
  for (mpf_class& zero : zeros) zero.set_prec(static_cast<mp_bitcnt_t>(bits));
  return zeros;
}

template <std::size_t N>
WideMatrix<N> wide(const RationalMatrix<N>& m, long bits) {
  WideMatrix<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = wide_zeros<N>(bits);
    for (std::size_t j = 0; j < N; ++j) result[i][j] = m[i][j];
  }
  return result;
}

template <std::size_t N>
struct Eigen {
  std::array<mpf_class, N> values;
  WideMatrix<N> vectors;  ///< in columns, a rotation
};

/// Turns rows and columns p and q of m so that their entry becomes 0, and the vectors alike. The
/// angle is at most an eighth of a turn: axes of a matrix that is diagonal stay where they are.
template <std::size_t N>
void turn(WideMatrix<N>& m, WideMatrix<N>& vectors, std::size_t p, std::size_t q) {
  const mpf_class theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const mpf_class size = abs(theta);
  mpf_class t = 1 / (size + sqrt(mpf_class(theta * theta + 1)));
  if (theta < 0) t = -t;
  const mpf_class c = 1 / sqrt(mpf_class(t * t + 1)), s = t * c;
  for (std::size_t k = 0; k < N; ++k) {
    const mpf_class kp = m[k][p], kq = m[k][q];
    m[k][p] = c * kp - s * kq;
    m[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < N; ++k) {
    const mpf_class pk = m[p][k], qk = m[q][k];
    m[p][k] = c * pk - s * qk;
    m[q][k] = s * pk + c * qk;
    const mpf_class vp = vectors[k][p], vq = vectors[k][q];
    vectors[k][p] = c * vp - s * vq;
    vectors[k][q] = s * vp + c * vq;
  }
}

/// Jacobi's method, by cycles, until what is off the diagonal is below the last bits of the
/// smallest eigenvalue.
template <std::size_t N>
Eigen<N> eigen(const RationalMatrix<N>& matrix) {
  const long bits = kSpareBits + 2 * condition_bits(matrix);
  WideMatrix<N> m = wide(matrix, bits);
  Eigen<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result.vectors[i] = wide_zeros<N>(bits);
    result.vectors[i][i] = 1;
  }
  mpf_class largest(0, static_cast<mp_bitcnt_t>(bits));
  for (std::size_t i = 0; i < N; ++i) largest = std::max(largest, mpf_class(abs(m[i][i])));
  // Of a singular matrix the smallest is nothing but rounding, and this is what ends the search.
  const mpf_class floor = largest >> static_cast<mp_bitcnt_t>(bits - kRoundingBits);
  for (bool off = true; off;) {
    off = false;
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t q = p + 1; q < N; ++q) {
        const mpf_class least = std::min(mpf_class(abs(m[p][p])), mpf_class(abs(m[q][q])));
        if (abs(m[p][q]) <= std::max(floor, mpf_class(least >> kOffBits))) continue;
        turn(m, result.vectors, p, q);
        off = true;
      }
    }
  }
  result.values = wide_zeros<N>(bits);
  for (std::size_t i = 0; i < N; ++i) result.values[i] = m[i][i];
  return result;
}

/// The nearest double, or infinity.
double nearest(const mpf_class& x) {
  const mpq_class exact(x);
  const double low = double_below(exact), high = double_above(exact);
  if (!std::isfinite(low)) return low;
  if (!std::isfinite(high)) return high;
  return exact - to_rational(low) <= to_rational(high) - exact ? low : high;
}

/// The quaternion of a rotation, of unit length: the row of the largest component first.
std::array<double, 4> orientation_of(const WideMatrix<3>& r) {
  const std::array<mpf_class, 4> squares{
      1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2],
      1 - r[0][0] + r[1][1] - r[2][2], 1 - r[0][0] - r[1][1] + r[2][2]};
  const auto largest = static_cast<std::size_t>(
      std::distance(squares.begin(), std::max_element(squares.begin(), squares.end())));
  const std::array<mpf_class, 3> turns{r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  const std::array<mpf_class, 3> sums{r[1][2] + r[2][1], r[2][0] + r[0][2], r[0][1] + r[1][0]};
  std::array<mpf_class, 4> q;
  if (largest == 0) {
    q = {squares[0], turns[0], turns[1], turns[2]};
  } else {
    q[0] = turns[largest - 1];
    for (std::size_t k = 1; k < 4; ++k) {
      // Of the other two axes, the third one's index names the pair.
      q[k] = k == largest ? squares[k] : sums[5 - largest - k];
    }
  }
  const mpf_class length = sqrt(mpf_class(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]));
  std::array<double, 4> result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = nearest(mpf_class(q[k] / length));
  return result;
}

std::array<double, 2> orientation_of(const WideMatrix<2>& r) {
  return {nearest(r[0][0]), nearest(r[1][0])};
}

/// The rotation that an orientation means, whatever its length.
RationalMatrix<3> rotation_of(const std::array<double, 4>& stored) {
  const mpq_class w = to_rational(stored[0]), x = to_rational(stored[1]),
                  y = to_rational(stored[2]), z = to_rational(stored[3]);
  const mpq_class norm = w * w + x * x + y * y + z * z;
  RationalMatrix<3> r;
  r[0] = {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (z * x + w * y)};
  r[1] = {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)};
  r[2] = {2 * (z * x - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z};
  for (auto& row : r) {
    for (mpq_class& entry : row) entry /= norm;
  }
  return r;
}

/// The same in the plane, times |u|^2, which is 1 to a double's rounding; the length comes after.
RationalMatrix<2> frame_of(const std::array<double, 2>& u) {
  const mpq_class x = to_rational(u[0]), y = to_rational(u[1]);
  RationalMatrix<2> r;
  r[0] = {x, -y};
  r[1] = {y, x};
  return r;
}

template <std::size_t N>
WideMatrix<N> wide_rotation(const NearestSolid<N>& solid, long bits) {
  if constexpr (N == 3) {
    return wide(rotation_of(solid.orientation), bits);
  } else {
    WideMatrix<2> r = wide(frame_of(solid.orientation), bits);
    const mpf_class length = sqrt(mpf_class(r[0][0] * r[0][0] + r[1][0] * r[1][0]));
    for (auto& row : r) {
      for (mpf_class& entry : row) entry /= length;
    }
    return r;
  }
}

/// Upwards, a sum of a few squares' root included.
double rounded_up(const mpf_class& x) { return double_above(mpq_class(x)) * (1.0 + 0x1p-40); }

/// How far the solid of doubles is from the true one: with U = V diag(a), E = R diag(b),
/// h(n) = |U'n| differs from |E'n| by at most |U - E|, and by |E^-1 U - 1| times |E'n|.
template <std::size_t N>
void measure(const RationalSolid<N>& solid, const Eigen<N>& found,
             const std::array<mpf_class, N>& semi_axes, NearestSolid<N>& nearest_one) {
  const long bits = static_cast<long>(found.values[0].get_prec());
  const WideMatrix<N> r = wide_rotation(nearest_one, bits);
  mpf_class relative(0, static_cast<mp_bitcnt_t>(bits)), absolute = relative, shift = relative;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      mpf_class turned(0, static_cast<mp_bitcnt_t>(bits));
      for (std::size_t j = 0; j < N; ++j) turned += r[j][i] * found.vectors[j][k];
      turned *= semi_axes[k];
      turned /= mpf_class(nearest_one.semi_axes[i]);
      if (i == k) turned -= 1;
      relative += turned * turned;
      const mpf_class apart =
          found.vectors[i][k] * semi_axes[k] - r[i][k] * mpf_class(nearest_one.semi_axes[k]);
      absolute += apart * apart;
    }
    const mpf_class off(mpq_class(solid.centre[i] - to_rational(nearest_one.centre[i])),
                        static_cast<mp_bitcnt_t>(bits));
    shift += off * off;
  }
  const mpf_class distance = sqrt(shift);
  const double least =
      *std::min_element(nearest_one.semi_axes.begin(), nearest_one.semi_axes.end());
  nearest_one.relative = rounded_up(mpf_class(sqrt(relative) + distance / mpf_class(least)));
  nearest_one.absolute = rounded_up(mpf_class(sqrt(absolute) + distance));
  // An exact body, an axis parallel one say, costs nothing.
  if (nearest_one.relative > 0.0) nearest_one.relative += kWideError;
  if (nearest_one.absolute > 0.0) nearest_one.absolute += kWideError * least;
}

}  // namespace

template <std::size_t N>
bool is_positive_definite(const RationalMatrix<N>& matrix) {
  for (std::size_t size = 1; size <= N; ++size) {
    if (minor_of(matrix, size) <= 0) return false;
  }
  return true;
}

template <std::size_t N>
RationalMatrix<N> inverse(const RationalMatrix<N>& m) {
  const mpq_class determinant = minor_of(m, N);
  RationalMatrix<N> result;
  if constexpr (N == 2) {
    result[0] = {m[1][1] / determinant, -m[0][1] / determinant};
    result[1] = {-m[1][0] / determinant, m[0][0] / determinant};
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t r = (j + 1) % 3, s = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
        result[i][j] = (m[r][p] * m[s][q] - m[r][q] * m[s][p]) / determinant;
      }
    }
  }
  return result;
}

template <std::size_t N>
double smallest_eigenvalue(const RationalMatrix<N>& matrix) {
  const Eigen<N> found = eigen(matrix);
  return nearest(*std::min_element(found.values.begin(), found.values.end()));
}

template <std::size_t N>
SolidForm<N + 1> integer_form(const RationalSolid<N>& solid) {
  const RationalMatrix<N> block = inverse(solid.shape);
  std::array<std::array<mpq_class, N + 1>, N + 1> q;
  q[N][N] = -1;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      q[i][j] = block[i][j];
      q[i][N] -= block[i][j] * solid.centre[j];
    }
    q[N][i] = q[i][N];
    q[N][N] -= q[i][N] * solid.centre[i];
  }
  SolidForm<N + 1> result;
  result.denominator = 1;
  for (const auto& row : q) {
    for (const mpq_class& entry : row) {
      mpz_lcm(result.denominator.get_mpz_t(), result.denominator.get_mpz_t(),
              entry.get_den_mpz_t());
    }
  }
  for (std::size_t i = 0; i <= N; ++i) {
    for (std::size_t j = 0; j <= N; ++j) {
      result.form[i][j] = q[i][j].get_num() * (result.denominator / q[i][j].get_den());
    }
  }
  return result;
}

template <std::size_t N>
NearestSolid<N> nearest_solid(const RationalSolid<N>& solid) {
  const Eigen<N> found = eigen(solid.shape);
  NearestSolid<N> result;
  auto semi_axes = wide_zeros<N>(static_cast<long>(found.values[0].get_prec()));
  for (std::size_t k = 0; k < N; ++k) {
    semi_axes[k] = sqrt(found.values[k]);
    result.semi_axes[k] = nearest(semi_axes[k]);
    result.centre[k] = nearest(mpf_class(solid.centre[k], found.values[k].get_prec()));
  }
  result.orientation = orientation_of(found.vectors);
  result.relative = result.absolute = std::numeric_limits<double>::infinity();
  const auto in_range = [](double axis) { return std::isfinite(axis) && axis > 0.0; };
  const auto finite = [](double x) { return std::isfinite(x); };
  if (std::all_of(result.semi_axes.begin(), result.semi_axes.end(), in_range) &&
      std::all_of(result.centre.begin(), result.centre.end(), finite)) {
    measure(solid, found, semi_axes, result);
  }
  return result;
}

template bool is_positive_definite<2>(const RationalMatrix<2>&);
template bool is_positive_definite<3>(const RationalMatrix<3>&);
template RationalMatrix<2> inverse<2>(const RationalMatrix<2>&);
template RationalMatrix<3> inverse<3>(const RationalMatrix<3>&);
template double smallest_eigenvalue<2>(const RationalMatrix<2>&);
template double smallest_eigenvalue<3>(const RationalMatrix<3>&);
template SolidForm<3> integer_form<2>(const RationalSolid<2>&);
template SolidForm<4> integer_form<3>(const RationalSolid<3>&);
template NearestSolid<2> nearest_solid<2>(const RationalSolid<2>&);
template NearestSolid<3> nearest_solid<3>(const RationalSolid<3>&);

}  // namespace tangency::inline v0::exact
