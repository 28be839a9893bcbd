// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/gap.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>

#include <tangency/verify/oracles/gap_enclosure.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using ascent::cross;
using ascent::dot;

// Chosen: in units of L; gap.hpp says what follows from it.
const Real kTolerance("1e-130");
// Chosen: a degenerate maximum takes 300 steps, a needle of aspect 1e8 from afar 200.
constexpr int kMostSteps = 2000;
constexpr int kMostGuessSteps = 300;

// A symmetric matrix as its rows.
using Rows = std::array<Real3, 3>;

// Sum over k of w_k u_k u_k'.
Rows weighted(const Shape<Real>& body, const Real3& weights) {
  Rows rows{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Real scaled = weights[k] * body.axes[k][i];
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] += scaled * body.axes[k][j];
    }
  }
  return rows;
}

Rows squared(const Shape<Real>& body) {
  const auto& a = body.semi_axes;
  return weighted(body, {a[0] * a[0], a[1] * a[1], a[2] * a[2]});
}

Rows adjugate(const Rows& m) { return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])}; }

Real3 times(const Rows& m, const Real3& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

// Trace of the product of symmetric matrices.
Real contraction(const Rows& a, const Rows& b) {
  return dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2]);
}

// With l = s/(1-s): log l where F = l N / ((1+l) D), N quadratic and D cubic in l with positive
// coefficients, is greatest. F is concave in s, so its slope has one sign either side.
long double best_log_ratio(const std::array<long double, 3>& n,
                           const std::array<long double, 4>& d) {
  // Chosen: ratios of squares of lengths to e^+-200, to the last bits.
  long double low = -200, high = 200;
  for (int step = 0; step < 72; ++step) {
    const long double middle = low + (high - low) / 2;
    const long double l = std::exp(middle);
    const long double slope =
        1 / (1 + l) + l * (n[1] + 2 * l * n[2]) / (n[0] + l * (n[1] + l * n[2])) -
        l * (d[1] + l * (2 * d[2] + 3 * l * d[3])) / (d[0] + l * (d[1] + l * (d[2] + l * d[3])));
    (slope > 0 ? low : high) = middle;
  }
  return low;
}

// n ~ adj(M_A + l M_B) d at the greatest F. Requires d != 0.
Real3 perram_wertheim_normal(const Separation<Real>& pair) {
  const Rows ma = squared(pair.a), mb = squared(pair.b);
  const Rows ja = adjugate(ma), jb = adjugate(mb);
  Rows sum = ma;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] += mb[i][j];
  }
  Rows mixed = adjugate(sum);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) mixed[i][j] -= ja[i][j] + jb[i][j];
  }
  const std::array<Real3, 3> terms{times(ja, pair.d), times(mixed, pair.d), times(jb, pair.d)};
  const std::array<Real, 4> determinants{dot(ma[0], ja[0]), contraction(ja, mb),
                                         contraction(jb, ma), dot(mb[0], jb[0])};
  // In units of the geometric mean of the bodies' sizes, so that long doubles hold them.
  const Real per_n = 1 / (dot(pair.d, terms[1]) + dot(pair.d, terms[0]) + dot(pair.d, terms[2]));
  const Real per_d = 1 / (determinants[1] + determinants[2]);
  std::array<long double, 3> n{};
  std::array<long double, 4> d{};
  for (std::size_t i = 0; i < 3; ++i) {
    n[i] = static_cast<long double>(Real(dot(pair.d, terms[i]) * per_n));
  }
  for (std::size_t i = 0; i < 4; ++i)
    d[i] = static_cast<long double>(Real(determinants[i] * per_d));
  const Real l = std::exp(best_log_ratio(n, d));
  return ascent::normalised(ascent::combined(terms[0], l, terms[1], Real(l * l), terms[2]));
}

Separation<long double> rounded(const Separation<Real>& pair, const Real& unit) {
  const auto round = [](const Real& v) { return static_cast<long double>(v); };
  Separation<long double> result{};
  const auto shape = [&](const Shape<Real>& from, Shape<long double>& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      to.semi_axes[k] = round(from.semi_axes[k] / unit);
      std::ranges::transform(from.axes[k], to.axes[k].begin(), round);
    }
  };
  shape(pair.a, result.a);
  shape(pair.b, result.b);
  for (std::size_t i = 0; i < 3; ++i) result.d[i] = round(pair.d[i] / unit);
  return result;
}

Real least_radius(const Shape<Real>& body) {
  const auto [least, most] = std::ranges::minmax(body.semi_axes);
  return least * least / most;
}

bool is_sphere(const Shape<Real>& body) {
  const auto& a = body.semi_axes;
  return a[0] == a[1] && a[1] == a[2];
}

class Search {
 public:
  Search(const RealEllipsoid& a, const RealEllipsoid& b)
      : pair_(separation(a, b)),
        size_(ascent::extent(pair_)),
        tolerance_(kTolerance * size_),
        rho_(least_radius(pair_.a) + least_radius(pair_.b)),
        spheres_(is_sphere(pair_.a) && is_sphere(pair_.b)),
        guess_pair_(rounded(pair_, size_)) {}

  const Separation<Real>& pair() const { return pair_; }
  // Of a gap: gap.hpp.
  Real error() const { return Real("1e-140") * size_; }

  // Where the ascent from `start` leads that begins in long doubles, or all in 150 digits.
  std::optional<GapTruth> answer(const Real3& start, bool guess) const {
    Real3 from = start;
    if (guess) {
      ascent::Triple<long double> n{};
      for (std::size_t i = 0; i < 3; ++i) n[i] = static_cast<long double>(start[i]);
      // Chosen: some roundings of long doubles.
      constexpr long double kGuessTolerance = 0x1p-60L;
      n = ascent::ascend(guess_pair_, n, kGuessTolerance, kMostGuessSteps).at.n;
      std::ranges::copy(n, from.begin());
    }
    const ascent::Arrival<Real> end = ascent::ascend(pair_, from, tolerance_, kMostSteps);
    if (!end.stationary) return std::nullopt;
    GapTruth truth{end.at.f,
                   end.at.n,
                   ascent::support_point(pair_.a, end.at.n),
                   ascent::scaled(Real(-1), ascent::support_point(pair_.b, end.at.n)),
                   spheres_ || end.at.f > tolerance_ - rho_,
                   std::numeric_limits<double>::infinity()};
    if (truth.global) truth.unproven = 0;
    return truth;
  }

 private:
  Separation<Real> pair_;
  Real size_, tolerance_, rho_;
  bool spheres_;                        // then gap >= -rho always, and all normals tie at -rho
  Separation<long double> guess_pair_;  // in units of size_
};

// By (1) to (3) of gap.hpp; nothing if they do not apply.
std::optional<GapTruth> shallow_gap(const Search& search) {
  Real3 n{1, 0, 0};
  const bool concentric = dot(search.pair().d, search.pair().d) == 0;
  if (!concentric) n = perram_wertheim_normal(search.pair());
  auto truth = search.answer(n, true);
  if (truth && truth->global) return truth;
  if (concentric || ascent::value(search.pair(), n).f <= 0) return std::nullopt;
  truth = search.answer(n, false);
  return truth && truth->global ? truth : std::nullopt;
}

bool parallel(const Real3& m, const Real3& n) {
  const Real3 difference{m[0] - n[0], m[1] - n[1], m[2] - n[2]};
  return dot(difference, difference) < Real("1e-80");  // chosen: half of the digits of the normals
}

// The angle between unit vectors is at most pi/2 of their chord.
bool holds(const NormalCap& cap, const Real3& n) {
  Real3 chord = ascent::normalised(Real3{cap.centre[0], cap.centre[1], cap.centre[2]});
  for (std::size_t i = 0; i < 3; ++i) chord[i] -= n[i];
  return dot(chord, chord) * Real(2.4675) < Real(cap.radius) * cap.radius;
}

// (4) of gap.hpp.
std::vector<GapTruth> deep_gaps(const Search& search, const GapEnclosure& found, double within) {
  std::vector<GapTruth> maxima;
  bool complete = found.isolated;
  // Chosen: caps are sorted, and more than these come only from ties along a curve.
  constexpr std::size_t kMostCaps = 24;
  for (std::size_t i = 0; i < found.caps.size() && i < kMostCaps; ++i) {
    const NormalCap& cap = found.caps[i];
    const auto& c = cap.centre;
    const auto truth = search.answer({c[0], c[1], c[2]}, true);
    complete = complete && truth && holds(cap, truth->normal);
    if (!truth) continue;
    if (std::ranges::none_of(
            maxima, [&](const GapTruth& known) { return parallel(known.normal, truth->normal); })) {
      maxima.push_back(*truth);
    }
  }
  complete = complete && found.caps.size() <= kMostCaps;
  if (maxima.empty()) throw std::runtime_error("oracle: no ascent arrived");
  std::ranges::sort(maxima, std::ranges::greater{}, &GapTruth::gap);
  const Real least = maxima.front().gap - within - 2 * search.error();
  std::erase_if(maxima, [&](const GapTruth& truth) { return truth.gap < least; });
  maxima.front().global = complete;
  const Real excess = found.upper - maxima.front().gap;
  maxima.front().unproven =
      complete ? 0 : std::max(0.0, mpfr_get_d(excess.backend().data(), MPFR_RNDU));
  return maxima;
}

}  // namespace

GapTruth stationary_gap(const RealEllipsoid& a, const RealEllipsoid& b,
                        const std::array<double, 3>& start) {
  Real3 n;
  std::ranges::copy(start, n.begin());
  if (!(dot(n, n) > 0) || !boost::multiprecision::isfinite(dot(n, n))) {
    throw std::invalid_argument("oracle: no direction to start from");
  }
  const Search search(a, b);
  n = ascent::normalised(n);
  auto truth = search.answer(n, true);
  if (!truth) truth = search.answer(n, false);
  if (!truth) throw std::runtime_error("oracle: the ascent did not arrive");
  return *truth;
}

std::vector<GapTruth> highest_gaps(const RealEllipsoid& a, const RealEllipsoid& b, double within,
                                   std::size_t most_boxes) {
  const Search search(a, b);
  if (const auto truth = shallow_gap(search); truth && within == 0) return {*truth};
  return deep_gaps(search, gap_enclosure(a, b, {0, within, most_boxes}), within);
}

GapTruth signed_gap(const RealEllipsoid& a, const RealEllipsoid& b) {
  return highest_gaps(a, b, 0).front();
}

GapTruth signed_gap(const RawEllipsoid& a, const RawEllipsoid& b) {
  return signed_gap(real(a), real(b));
}

}  // namespace tangency::inline v0::verify
