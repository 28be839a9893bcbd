// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the numbers of dem/lanes/hertz_fit.hpp again, prints them, and says with its exit status
// whether they are those that stand there. docs/derivations/hertz-lanes.md has the formulas.
#include <boost/multiprecision/mpfr.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <tangency/dem/lanes/hertz_fit.hpp>
#include <tangency/dem/lanes/hertz_lanes.hpp>

namespace {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<70>,
                                           boost::multiprecision::et_off>;

// Of what is solved: far below a double's and far above this arithmetic's.
const Real kSmall = 1e-50;

Real pi() { return 4 * atan(Real(1)); }

struct Share {
  Real K, share;  ///< share = D/K
};

/// Of modulus sqrt(1 - k^2), by the arithmetic-geometric mean.
Share elliptic(const Real& k) {
  Real a = (1 + k) / 2, b = sqrt(k), c = (1 - k) / 2;
  Real part = (1 - k) / (4 * (1 + k)), sum = 1, weight = 2;
  while (weight * part > kSmall * kSmall / 1e10) {
    sum += weight * part;
    const Real mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
    part *= c * c / (16 * a * a);
    c = c * c / (4 * a);
    weight *= 2;
  }
  return {pi() / (a + b), sum / 2};
}

/// Of curvatures whose ratio is exp(-L).
Share of_ratio(const Real& L) {
  // ln(ratio) goes with ln k with a slope between 1.5 and 2.
  Real x = -L / 1.7;
  for (;;) {
    const auto [K, share] = elliptic(exp(x));
    const Real off = 2 * x + log(share / (1 - share)) + L;
    x -= off / 1.7;
    if (abs(off) < kSmall) return elliptic(exp(x));
  }
}

constexpr int kHalvings = 8;  // x = tanh(L / 8)

Real logarithm(const Real& z) { return kHalvings * atanh(sqrt(z)); }

Real force(const Real& z) {
  const Real L = logarithm(z);
  const auto [K, share] = of_ratio(L);
  return 2 * pi() / 3 * sqrt(2 * share * exp(L / 2)) / K;
}

Real share(const Real& z) { return (of_ratio(logarithm(z)).share - Real(0.5)) / sqrt(z); }

/// Solves A x = b, the columns of `rows` being those of A and then b.
std::vector<Real> solve(std::vector<std::vector<Real>> rows) {
  const std::size_t n = rows.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto pivot = std::max_element(
        rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
        [&](const auto& one, const auto& other) { return abs(one[k]) < abs(other[k]); });
    std::swap(rows[k], *pivot);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Real factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  std::vector<Real> x;
  for (std::size_t k = 0; k < n; ++k) x.push_back(rows[k][n] / rows[k][k]);
  return x;
}

/// The rational function with `over` and `under` terms, the lowest of the latter 1, that is
/// `function` at the Chebyshev points of [0, last], in powers of z - centre; prints it and
/// compares.
bool makes(const char* name, const std::function<Real(const Real&)>& function, const Real& last,
           double centre, std::span<const double> over, std::span<const double> under) {
  const std::size_t n = over.size() + under.size() - 1;
  std::vector<std::vector<Real>> rows;
  for (std::size_t i = 0; i < n; ++i) {
    const Real z = last / 2 * (1 + cos(pi() * (2 * Real(i) + 1) / (2 * Real(n))));
    const Real value = function(z), t = z - centre;
    std::vector<Real> row;
    Real power = 1;
    for (std::size_t k = 0; k < over.size(); ++k, power *= t) row.push_back(power);
    power = t;
    for (std::size_t k = 1; k < under.size(); ++k, power *= t) row.push_back(-value * power);
    row.push_back(value);
    rows.push_back(row);
  }
  std::vector<Real> x = solve(rows);
  x.insert(x.begin() + static_cast<std::ptrdiff_t>(over.size()), Real(1));
  bool same = true;
  const auto print = [&](const char* part, std::span<const double> committed, const Real* made) {
    std::printf("inline constexpr double k%s%s[] = {", name, part);
    for (std::size_t k = 0; k < committed.size(); ++k) {
      const auto value = static_cast<double>(made[k]);
      same = same && value == committed[k];
      std::printf("%s%a", k == 0 ? "" : ", ", value);
    }
    std::printf("};\n");
  };
  print("Over", over, x.data());
  print("Under", under, x.data() + over.size());
  return same;
}

}  // namespace

int main() {
  using namespace tangency::dem;
  const Real x = tanh(-log(Real(kLeastCurvatureRatio)) / kHalvings), last = x * x;
  const bool force_is = makes("Force", force, last, kForceCentre, kForceOver, kForceUnder);
  const bool share_is = makes("Share", share, last, 0.0, kShareOver, kShareUnder);
  if (!force_is || !share_is) std::fputs("dem/lanes/hertz_fit.hpp has other numbers\n", stderr);
  return force_is && share_is ? 0 : 1;
}
