// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/cap_bounds.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tangency::inline v0::verify::cap {
namespace {

using ascent::dot;

Interval cosine_of(double sine) { return sqrt(Interval(1) - square(Interval(sine))); }

// Greatest of r x - q x^2 / 2 for |x| <= most.
double greatest_of_parabola(const Interval& r, const Interval& q, double most) {
  const Interval slope = std::max(-r.inf(), r.sup()), bend = q.inf(), end = most;
  // Without the limit where it is not certain to be the end: never less.
  if (bend.inf() > 0 && !(slope.inf() >= Interval(bend * end).sup())) {
    return Interval(square(slope) / (2 * bend)).sup();
  }
  return Interval(end * (slope - bend * end / 2)).sup();
}

// Takes a point of the body from v, for (3): the support point of n, but along those long axes
// whose sign may change on the cap whatever leaves least of v.
void take_point_at_crease(const Shape<Interval>& body, const Side& side, const Interval3& n,
                          double sine, Interval3& v) {
  const auto take = [&](const Interval& share, std::size_t k) {
    for (std::size_t i = 0; i < 3; ++i) v[i] -= share * body.semi_axes[k] * body.axes[k][i];
  };
  Interval3 along;
  std::array<bool, 3> creased;
  Interval squares = 0, room = 1;  // 1 less the squares of the shares taken
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval cosine = dot(body.axes[k], n);
    along[k] = body.semi_axes[k] * cosine;
    creased[k] = abs(cosine).inf() < sine && body.semi_axes[k].sup() * sine > side.at.h.inf();
    if (!creased[k]) squares += square(along[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!creased[k]) continue;
    // Chosen: what leaves a tenth for the other axes.
    const double most = std::sqrt(std::max(0.0, room.inf() - 0.01));
    const double best = middle(dot(body.axes[k], v)) / middle(body.semi_axes[k]);
    const Interval share = std::clamp(best, -most, most);
    take(share, k);
    room -= square(share);
  }
  if (!(squares.inf() > 0)) return;
  const Interval per = Interval(sqrt(room).inf()) / sqrt(squares);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!creased[k]) take(along[k] * per, k);
  }
}

// Sum over body axes k of (a_i a_j)^2 x_k y_k: x' adj(M) y.
Interval adjugate_form(const Shape<Interval>& body, const Interval3& x, const Interval3& y) {
  Interval sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Interval face = body.semi_axes[(k + 1) % 3] * body.semi_axes[(k + 2) % 3];
    sum += square(face) * dot(body.axes[k], x) * dot(body.axes[k], y);
  }
  return sum;
}

// Of h on the cap: h(n') >= n'.x, and no less than the smallest semi-axis.
double least_support(const Shape<Interval>& body, const Side& side, double sine) {
  const Interval along = side.at.h * cosine_of(sine) - Interval(sine) * side.reach;
  double least = body.semi_axes[0].inf();
  for (const Interval& a : body.semi_axes) least = std::min(least, a.inf());
  return std::max(least, along.inf());
}

}  // namespace

double upper_bound(const Point& at, double sine) {
  const Interval share_a = at.a.share(sine), share_b = at.b.share(sine);
  const double least = at.f.inf();
  // f cos <= f - f X^2 / 2 for f >= 0, f - f X^2 / (1 + cos) for f < 0.
  const Interval lift =
      least < 0 ? Interval(least * 2 / (Interval(1) + cosine_of(sine).inf())).inf() : least;
  const Interval qss = share_a * at.a.at.bend_ss + share_b * at.b.at.bend_ss + lift;
  const Interval qst = share_a * at.a.at.bend_st + share_b * at.b.at.bend_st;
  const Interval qtt = share_a * at.a.at.bend_tt + share_b * at.b.at.bend_tt + lift;
  // In any basis; in that of the axes of q the bound is sharp.
  const double half = (middle(qss) - middle(qtt)) / 2, off = middle(qst);
  const double high = std::sqrt(half * half + off * off) + std::abs(half);
  Interval x = half < 0 ? off : high, y = half < 0 ? high : off;
  if (!(high > 0)) x = 1, y = 0;
  const Interval norm = sqrt(square(x) + square(y));
  x /= norm;
  y /= norm;
  const Interval quu = square(x) * qss + 2 * x * y * qst + square(y) * qtt;
  const Interval qvv = square(y) * qss - 2 * x * y * qst + square(x) * qtt;
  const Interval quv = x * y * (qtt - qss) + (square(x) - square(y)) * qst;
  // Over the square about the cap in that basis, or over the cap with the least of q.
  const Interval mixed = square(Interval(sine)) * abs(quv);
  const double on_square = greatest_of_parabola(x * at.rs + y * at.rt, quu, sine) +
                           greatest_of_parabola(x * at.rt - y * at.rs, qvv, sine) + mixed.sup();
  const Interval least_q = Interval(std::min(quu.inf(), qvv.inf())) - abs(quv);
  const Interval gradient = sqrt(square(at.rs) + square(at.rt));
  return at.f.sup() + std::min(on_square, greatest_of_parabola(gradient, least_q, sine));
}

double upper_bound_by_plane(const Separation<Interval>& pair, const Point& at, double sine) {
  Interval3 v = pair.d;
  take_point_at_crease(pair.a, at.a, at.n, sine, v);
  take_point_at_crease(pair.b, at.b, at.n, sine, v);
  const double level = dot(at.n, v).sup();
  const Interval slope = sqrt(square(dot(at.s, v)) + square(dot(at.t, v)));
  const Interval flat = level < 0 ? Interval(level) * cosine_of(sine) : Interval(level);
  return Interval(flat + slope * sine).sup();
}

// From h(n') <= n'.x + sin^2 (h e'Hess h e) / (2 n'.x).
double lower_bound(const Point& at, double sine) {
  const Interval s = sine, cosine = cosine_of(sine);
  Interval least = Interval(at.f.inf()) * (at.f.inf() < 0 ? Interval(1) : cosine) -
                   s * sqrt(square(at.rs) + square(at.rt));
  for (const Side* side : {&at.a, &at.b}) {
    const Interval along = side->at.h * cosine - s * side->reach;
    if (!(along.inf() > 0)) return -std::numeric_limits<double>::infinity();
    least -= square(s) * side->at.h * (side->at.bend_ss + side->at.bend_tt) / (2 * along.inf());
  }
  return least.inf();
}

// m, normal to a normal of the cap, has |m.c| <=
// sine: for mu >= 0, m'Jm >= cos^2 y'(J_t - w w'/(J_cc + mu))y - mu sine^2, y its tangential
// direction, J_t, w and J_cc the blocks of J.
double least_radius(const Separation<Interval>& pair, const Point& at, double sine) {
  Interval jss = 0, jst = 0, jtt = 0, jns = 0, jnt = 0, jnn = 0;
  const auto add = [&](const Shape<Interval>& body, const Side& side) {
    const Interval share = side.share(sine), per = share / (square(side.at.h) * side.at.h);
    jss += share * side.at.bend_tt;
    jst -= share * side.at.bend_st;
    jtt += share * side.at.bend_ss;
    jns += per * adjugate_form(body, at.n, at.s);
    jnt += per * adjugate_form(body, at.n, at.t);
    jnn += per * adjugate_form(body, at.n, at.n);
  };
  add(pair.a, at.a);
  add(pair.b, at.b);
  const Interval s = sine;
  const double tilt = Interval(sqrt(square(jns) + square(jnt)) / s).sup();
  const Interval mu = std::max(0.0, tilt - jnn.inf());
  const Interval below = jnn + mu;
  const Interval kss = jss - square(jns) / below, ktt = jtt - square(jnt) / below;
  const Interval kst = jst - jns * jnt / below;
  const Interval low = (kss + ktt) / 2 - sqrt(square((kss - ktt) / 2) + square(kst));
  if (!(low.inf() > 0)) return 0;
  return std::max(0.0, Interval(low * (Interval(1) - square(s)) - mu * square(s)).inf());
}

// The Hessian of f along great circles has the eigenvalues -(f + R). If all are at most `most` in
// absolute value, the gradient, carried along a great circle, changes by no more than most angle,
// and is nowhere 0 if it is longer at the centre. If at every normal one is positive, no stationary
// point is a maximum; it is sought near that of the centre: m there, m' in the tangent plane of
// another normal, |m - m'| <= angle, so sqrt(m''Jm') <= sqrt(m'Jm) + angle sqrt(tr J).
bool holds_no_maximum(const Separation<Interval>& pair, const Point& at, double angle) {
  const double half =
      middle((at.a.at.bend_ss + at.b.at.bend_ss - at.a.at.bend_tt - at.b.at.bend_tt) / 2);
  const double off = middle(at.a.at.bend_st + at.b.at.bend_st);
  const double spread = std::sqrt(half * half + off * off);
  // e = (x, y) of the least bend at the centre, m = n x e = (-y, x).
  Interval x = half < 0 ? spread - half : -off, y = half < 0 ? -off : spread + half;
  if (!(spread > 0)) x = 1, y = 0;
  const Interval norm = sqrt(square(x) + square(y));
  Interval3 m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = (x * at.t[i] - y * at.s[i]) / norm;
  Interval least = 0, most = 0;  // upper bounds of the least and the greatest R
  const auto add = [&](const Shape<Interval>& body, const Side& side) {
    const Interval h = least_support(body, side, angle), hhh = square(h) * h;
    Interval trace = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      trace += square(body.semi_axes[(k + 1) % 3] * body.semi_axes[(k + 2) % 3]);
    }
    const Interval spare = Interval(angle) * sqrt(trace);
    const Interval bends = (side.at.bend_ss + side.at.bend_tt) * square(side.at.h) * side.at.h;
    most += square(sqrt(bends) + spare) / hhh;
    least += square(sqrt(adjugate_form(body, m, m)) + spare) / hhh;
  };
  add(pair.a, at.a);
  add(pair.b, at.b);
  const Interval highest = upper_bound(at, angle);
  if ((highest + least).sup() < 0) return true;
  const double bend = std::max(-lower_bound(at, angle), Interval(highest + most).sup());
  const Interval gradient = sqrt(square(at.rs) + square(at.rt));
  return gradient.inf() > Interval(Interval(angle) * bend).sup();
}

}  // namespace tangency::inline v0::verify::cap
