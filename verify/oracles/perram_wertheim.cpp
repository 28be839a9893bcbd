// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/perram_wertheim.hpp>

#include <array>
#include <cstddef>

namespace tangency::inline v0::verify {
namespace {

using Rows = std::array<Real3, 3>;

// Chosen: a bracket of one octave is halved to 120 digits.
constexpr int kHalvings = 400;

Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Real3 plus(const Real3& a, const Real& s, const Real3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

// Sum over k of w_k (u_k . v) u_k: the matrix with the body's axes u_k and eigenvalues w_k.
Real3 weighted(const Shape<Real>& body, const Real3& weights, const Real3& v) {
  Real3 sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    sum = plus(sum, weights[k] * dot(body.axes[k], v), body.axes[k]);
  }
  return sum;
}

Real3 squares(const Shape<Real>& body) {
  const auto& a = body.semi_axes;
  return {a[0] * a[0], a[1] * a[1], a[2] * a[2]};
}

// M v
Real3 shape_times(const Shape<Real>& body, const Real3& v) {
  return weighted(body, squares(body), v);
}

// u' M^-1 v
Real level_form(const Shape<Real>& body, const Real3& u, const Real3& v) {
  const Real3 a2 = squares(body);
  return dot(u, weighted(body, {1 / a2[0], 1 / a2[1], 1 / a2[2]}, v));
}

Rows shape_rows(const Shape<Real>& body) {
  return {shape_times(body, {1, 0, 0}), shape_times(body, {0, 1, 0}), shape_times(body, {0, 0, 1})};
}

Real determinant(const Rows& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// (M_A + l M_B)^-1 d times the determinant, by Cramer's rule; and that determinant.
struct Solution {
  Real3 scaled;
  Real det;
};

class Sum {
 public:
  Sum(const Rows& a, const Rows& b) : a_(a), b_(b) {}

  Solution solve(const Real& l, const Real3& d) const {
    Rows m;
    for (std::size_t i = 0; i < 3; ++i) m[i] = plus(a_[i], l, b_[i]);
    Solution solution{{}, determinant(m)};
    for (std::size_t k = 0; k < 3; ++k) {
      Rows replaced = m;  // symmetric, so a row will do for a column
      replaced[k] = d;
      solution.scaled[k] = determinant(replaced);
    }
    return solution;
  }

  // The sign of the slope of log F: F = l/(1+l) d'v, and d'v falls with l as v'M_B v.
  bool rising(const Real& l, const Real3& d) const {
    const Solution at = solve(l, d);
    Real fall = 0;
    for (std::size_t i = 0; i < 3; ++i) fall += at.scaled[i] * dot(b_[i], at.scaled);
    return dot(d, at.scaled) * at.det > l * (1 + l) * fall;
  }

 private:
  const Rows &a_, &b_;
};

Real best_ratio(const Sum& sum, const Real3& d) {
  Real low = 1, high = 1;
  while (!sum.rising(low, d)) low /= 2;
  while (sum.rising(high, d)) high *= 2;
  if (low < 1) high = 2 * low;
  if (high > 1) low = high / 2;
  for (int i = 0; i < kHalvings; ++i) {
    const Real middle = (low + high) / 2;
    (sum.rising(middle, d) ? low : high) = middle;
  }
  return (low + high) / 2;
}

Real3 support_point(const Shape<Real>& body, const Real3& n) {
  const Real3 m = shape_times(body, n);
  return plus({}, 1 / sqrt(dot(n, m)), m);
}

// Where the line p + t n, p and n from the body's centre, is in the body.
struct Stretch {
  Real first, last;
};

std::optional<Stretch> stretch_in(const Shape<Real>& body, const Real3& p, const Real3& n) {
  const Real a = level_form(body, n, n), b = level_form(body, p, n);
  const Real c = level_form(body, p, p) - 1, discriminant = b * b - a * c;
  if (discriminant < 0) return std::nullopt;
  const Real root = sqrt(discriminant);
  return Stretch{(-b - root) / a, (-b + root) / a};
}

}  // namespace

std::optional<PerramWertheimTruth> perram_wertheim(const RealEllipsoid& a, const RealEllipsoid& b) {
  const Separation<Real> pair = separation(a, b);
  const Real3& d = pair.d;
  if (dot(d, d) == 0) return std::nullopt;
  const Rows rows_a = shape_rows(pair.a), rows_b = shape_rows(pair.b);
  const Sum sum(rows_a, rows_b);
  const Real l = best_ratio(sum, d);
  const Solution at = sum.solve(l, d);
  const Real3 v = plus({}, 1 / at.det, at.scaled);  // (1-s) times the v of the header
  const Real3 n = plus({}, 1 / sqrt(dot(v, v)), v);
  PerramWertheimTruth truth;
  truth.contact_function = l / (1 + l) * dot(d, v);
  const Real share = 1 - 1 / sqrt(truth.contact_function);
  truth.centre_line = share * sqrt(dot(d, d));
  truth.tangent_planes = {share * dot(n, d), n, support_point(pair.a, n),
                          plus({}, -1, support_point(pair.b, n))};
  const Real3 from_a = shape_times(pair.a, v), from_b = plus(from_a, -1, d);
  const auto in_a = stretch_in(pair.a, from_a, n), in_b = stretch_in(pair.b, from_b, n);
  if (in_a && in_b) {
    truth.midpoint = DefinedGap{in_b->first - in_a->last, n, plus(from_a, in_a->last, n),
                                plus(from_b, in_b->first, n)};
  }
  return truth;
}

std::optional<PerramWertheimTruth> perram_wertheim(const RawEllipsoid& a, const RawEllipsoid& b) {
  return perram_wertheim(real(a), real(b));
}

}  // namespace tangency::inline v0::verify
