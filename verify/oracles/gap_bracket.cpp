// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/gap_bracket.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <tangency/verify/oracles/inner_ellipsoid.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>
#include <tangency/verify/oracles/proven_body.hpp>

namespace tangency::inline v0::verify {
namespace {

using ascent::dot;
using Long3 = std::array<long double, 3>;

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();

// ---- guesses, in double and in units of the pair's size

using Vector = std::array<double, 3>;
using Rows = std::array<Vector, 3>;

Rows squared(const Shape<long double>& body, long double size) {
  Rows m{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = static_cast<double>(body.semi_axes[k] / size);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        m[i][j] += a * a * static_cast<double>(body.axes[k][i] * body.axes[k][j]);
      }
    }
  }
  return m;
}

Vector times(const Rows& m, const Vector& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

Rows sum(const Rows& a, double l, const Rows& b) {
  Rows m = a;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] += l * b[i][j];
  }
  return m;
}

// adj(m) v and det m.
Vector adjugate_times(const Rows& m, const Vector& v, double& determinant) {
  const Rows adjugate{ascent::cross(m[1], m[2]), ascent::cross(m[2], m[0]),
                      ascent::cross(m[0], m[1])};
  determinant = dot(m[0], adjugate[0]);
  return times(adjugate, v);
}

// v = (M_A + l M_B)^-1 d up to a factor, at the l where the Perram-Wertheim function is greatest:
// there both terms below are equal; their ratio falls as l grows. And the point between both
// bodies, relative to A's centre.
struct Meeting {
  Vector normal, point;
};

Meeting guessed_meeting(const Rows& ma, const Rows& mb, const Vector& d) {
  double low = -60, high = 60;  // chosen: of log2 l, for ratios of lengths to 1e9
  Meeting meeting{d, {}};
  for (int step = 0; step < 24; ++step) {
    const double middle = (low + high) / 2, l = std::exp2(middle);
    double determinant = 0;
    const Vector v = adjugate_times(sum(ma, l, mb), d, determinant);
    const Vector of_a = times(ma, v);
    const double reach_a = dot(v, of_a), reach_b = l * l * dot(v, times(mb, v));
    if (!(determinant > 0) || !std::isfinite(reach_a + reach_b)) break;
    meeting = {v, ascent::scaled(1 / determinant, of_a)};
    (reach_a > reach_b ? low : high) = middle;
  }
  return meeting;
}

// ---- the proof

// The size of a pair, of its rounded numbers.
Separation<long double> guessed_pair(const RawEllipsoid& a, const RawEllipsoid& b) {
  Separation<long double> guess{{}, guessed_shape(a), guessed_shape(b)};
  for (std::size_t i = 0; i < 3; ++i) {
    guess.d[i] = static_cast<long double>(b.centre[i]) - static_cast<long double>(a.centre[i]);
  }
  return guess;
}

Ball3 proven(const Long3& v) { return {Ball(v[0]), Ball(v[1]), Ball(v[2])}; }

class Proof {
 public:
  Proof(const RawEllipsoid& a, const RawEllipsoid& b, const ClaimedGap& claimed)
      : guess_(guessed_pair(a, b)),
        size_(ascent::extent(guess_)),
        unit_(std::ilogb(size_)),
        a_(a, unit_),
        b_(b, unit_),
        claimed_(claimed),
        claimed_gap_(in_unit(claimed.gap, unit_)) {
    for (std::size_t i = 0; i < 3; ++i) {
      d_[i] = in_unit(b.centre[i], unit_) - in_unit(a.centre[i], unit_);
    }
  }

  GapBracket bracket() {
    const Vector unit_d{static_cast<double>(guess_.d[0] / size_),
                        static_cast<double>(guess_.d[1] / size_),
                        static_cast<double>(guess_.d[2] / size_)};
    const bool concentric = dot(unit_d, unit_d) == 0;
    const Meeting meeting =
        concentric ? Meeting{{1, 0, 0}, {}}
                   : guessed_meeting(squared(guess_.a, size_), squared(guess_.b, size_), unit_d);
    Long3 n{};
    std::ranges::copy(meeting.normal, n.begin());
    if (!(dot(n, n) > 0) || !std::isfinite(dot(n, n))) n = {1, 0, 0};
    // Chosen: as many steps as nearly all pairs take, and few where (2) will hardly apply.
    const bool shallow = ascent::value(guess_, ascent::normalised(n)).f / std::ldexp(1.0L, unit_) +
                             a_.least_radius().value() + b_.least_radius().value() >
                         0;
    n = top_from(n, shallow ? 40 : 6);
    GapBracket result = bounds_at(n);
    if (claimed_.normal && !(result.upper < kInfinity)) improve_by(*claimed_.normal, result);
    if (result.lower > 0) {
      result.relation = Relation::separate;
    } else if ((result.upper < 0 || share(meeting.point)) && protrudes(a_, b_, guess_.a, n, -1) &&
               protrudes(b_, a_, guess_.b, n, 1)) {
      result.relation = Relation::overlap;
    }
    in_its_unit(result);
    return result;
  }

 private:
  // Where Newton's ascent from n ends, to some roundings of long doubles.
  Long3 top_from(const Long3& n, int most_steps) const {
    return ascent::ascend(guess_, n, 0x1p-62L * size_, most_steps).at.n;
  }

  // (1) to (3)
  GapBracket bounds_at(const Long3& n) const {
    const Ball3 along = proven(n);
    Ball3 w = d_;
    const Ball h_a = a_.support_from(along, w), h_b = b_.support_from(along, w);
    const Ball length = sqrt(inner(along, along));
    const Ball f = (inner(along, d_) - h_a - h_b) / length;
    // |n x w| is |n| times the part of w across n, however n is rounded.
    const Ball3 across = cross(along, w);
    const long double slope = (sqrt(Ball(inner(across, across).most())) / length).most();
    const long double raised = (f + a_.least_radius() + b_.least_radius()).least();
    GapBracket result{-kInfinity,
                      kInfinity,
                      {},
                      -kInfinity,
                      kInfinity,
                      std::numeric_limits<double>::infinity(),
                      static_cast<double>(size_),
                      std::nullopt};
    for (std::size_t i = 0; i < 3; ++i) result.normal[i] = static_cast<double>(n[i]);
    if (f.least() > -kInfinity) {  // not so where it is unknown
      result.lower = f.least();
      result.least_excess = (f - claimed_gap_).least();
    }
    if (!(raised > 0 && slope < kInfinity)) return result;
    const Ball excess = Ball(slope) * Ball(slope) / (Ball(2) * Ball(raised));
    const Ball highest = f + Ball(excess.most());
    if (highest.most() < kInfinity) {
      bound_above(highest, result);
      result.normal_error = static_cast<double>(2 * slope / raised);
    }
    return result;
  }

  // A claimed normal is a start as good as any; (6) proves what (2) does not reach.
  void improve_by(const std::array<double, 3>& claimed, GapBracket& result) const {
    Long3 n{};
    std::ranges::copy(claimed, n.begin());
    if (!(dot(n, n) > 0) || !std::isfinite(dot(n, n))) return;
    // Chosen: a normal that is true to its digits takes one or two.
    constexpr int kSteps = 12;
    n = top_from(n, kSteps);
    const GapBracket there = bounds_at(n);
    if (there.lower > result.lower) result = there;
    if (result.upper < kInfinity) return;
    const Ball3 along = proven(n);
    const Ball f = inner(along, d_) - a_.support(along) - b_.support(along);
    if (const auto depth = depth_by_inner_ellipsoid(a_, b_, d_, along, -f)) {
      bound_above(-*depth, result);
    }
  }

  void bound_above(const Ball& gap, GapBracket& result) const {
    result.upper = gap.most();
    result.most_excess = (gap - claimed_gap_).most();
  }

  void in_its_unit(GapBracket& result) const {
    result.lower = std::ldexp(result.lower, unit_);
    result.upper = std::ldexp(result.upper, unit_);
    result.least_excess = std::ldexp(result.least_excess, unit_);
    result.most_excess = std::ldexp(result.most_excess, unit_);
  }

  // Is the point, relative to A's centre in units of the size, inside both?
  bool share(const Vector& point) const {
    const long double per = size_ / std::ldexp(1.0L, unit_);
    Ball3 of_a, of_b;
    for (std::size_t i = 0; i < 3; ++i) {
      of_a[i] = Ball(point[i] * per);
      of_b[i] = of_a[i] - d_[i];
    }
    return a_.holds(of_a) && b_.holds(of_b);
  }

  // (5): does `body` reach beyond `other`? `sign` is that of the side where it lies along n.
  bool protrudes(const ProvenBody& body, const ProvenBody& other, const Shape<long double>& shape,
                 const Long3& n, long double sign) const {
    const auto reaches = [&](const Long3& m) {
      const Ball3 way = proven(m);
      const Ball shift = inner(way, d_);
      const Ball beyond = body.support(way) - other.support(way);
      return (sign > 0 ? beyond + shift : beyond - shift).least() > 0;
    };
    if (reaches(ascent::scaled(sign, n))) return true;
    for (const Long3& axis : shape.axes) {
      if (reaches(axis) || reaches(ascent::scaled(-1.0L, axis))) return true;
    }
    return false;
  }

  Separation<long double> guess_;
  long double size_;
  int unit_;  // of the proof: lengths in units of 2^unit_
  ProvenBody a_, b_;
  Ball3 d_;
  ClaimedGap claimed_;
  Ball claimed_gap_;
};

}  // namespace

GapBracket gap_bracket(const RawEllipsoid& a, const RawEllipsoid& b, const ClaimedGap& claimed) {
  return Proof(a, b, claimed).bracket();
}

}  // namespace tangency::inline v0::verify
