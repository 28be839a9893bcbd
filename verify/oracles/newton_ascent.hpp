// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The function whose maximum is the signed gap, and Newton ascent on the sphere of normals, in any
/// arithmetic T. Inner header of the gap oracles.
///
///     f(n) = n.d - h_A(n) - h_B(n),   h(n) = |diag(a) R'n|.
///
/// With a right-handed basis (s, t, n): the gradient on the sphere is e.(d - x_A - x_B) for e = s,
/// t; the Hessian along great circles is -K, K = f I + Hess h_A + Hess h_B, and
/// e' Hess h e' = (n x e)' adj(M) (n x e') / h^3, a sum of products in body axes that cancels
/// nothing.
#pragma once

#include <boost/multiprecision/number.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify::ascent {

template <class T>
using Triple = std::array<T, 3>;

template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
Triple<T> scaled(const T& s, const Triple<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

/// a + s u + t v.
template <class T>
Triple<T> combined(const Triple<T>& a, const T& s, const Triple<T>& u, const T& t,
                   const Triple<T>& v) {
  Triple<T> result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = a[i] + s * u[i] + t * v[i];
  return result;
}

/// Of any length within the range of T; nothing is promised for 0.
template <class T>
Triple<T> normalised(Triple<T> a) {
  using std::abs, std::sqrt;
  T most = abs(a[0]);
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(a[i]) > most) most = abs(a[i]);
  }
  for (T& v : a) v /= most;  // so that no square is lost
  return scaled(T(1 / sqrt(dot(a, a))), a);
}

/// Right-handed with the unit vector n, which is not along space axis k.
template <class T>
std::array<Triple<T>, 2> tangents(const Triple<T>& n, std::size_t k) {
  using std::sqrt;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const T scale = 1 / sqrt(T(n[i] * n[i] + n[j] * n[j]));
  Triple<T> s;
  s[i] = -n[j] * scale;
  s[j] = n[i] * scale;
  s[k] = 0;
  return {s, cross(n, s)};
}

/// The space axis most nearly normal to n.
template <class T>
std::size_t most_normal_axis(const Triple<T>& n) {
  using std::abs;
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (abs(n[i]) < abs(n[k])) k = i;
  }
  return k;
}

/// h and its derivatives at a unit n; e = s, t.
template <class T>
struct Support {
  T h;
  T slope_s, slope_t;           ///< e . x
  T bend_ss, bend_st, bend_tt;  ///< e' Hess h e'
};

template <class T>
Support<T> support(const Shape<T>& body, const Triple<T>& n, const Triple<T>& s,
                   const Triple<T>& t) {
  using std::sqrt;
  T hh = 0, xs = 0, xt = 0, jss = 0, jst = 0, jtt = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const T& a = body.semi_axes[k];
    const T along = a * dot(body.axes[k], n);
    const T on_s = dot(body.axes[k], s), on_t = dot(body.axes[k], t);
    hh += along * along;
    xs += a * along * on_s;
    xt += a * along * on_t;
    const T face = body.semi_axes[(k + 1) % 3] * body.semi_axes[(k + 2) % 3];
    const T face_s = face * on_s, face_t = face * on_t;
    jss += face_s * face_s;
    jst += face_s * face_t;
    jtt += face_t * face_t;
  }
  const T h = sqrt(hh);
  const T per = 1 / h, per3 = per / hh;
  return {h, xs * per, xt * per, jtt * per3, -jst * per3, jss * per3};
}

/// x(n) relative to the centre.
template <class T>
Triple<T> support_point(const Shape<T>& body, const Triple<T>& n) {
  using std::sqrt;
  T hh = 0;
  Triple<T> x{};
  for (std::size_t k = 0; k < 3; ++k) {
    const T along = body.semi_axes[k] * dot(body.axes[k], n);
    hh += along * along;
    for (std::size_t i = 0; i < 3; ++i) x[i] += body.semi_axes[k] * along * body.axes[k][i];
  }
  return scaled(T(1 / sqrt(hh)), x);
}

template <class T>
struct Value {
  Triple<T> n, s, t;
  T f;
  T rs, rt;         ///< gradient
  T residual;       ///< its length
  T kss, kst, ktt;  ///< K
};

template <class T>
Value<T> value(const Separation<T>& pair, const Triple<T>& unit) {
  using std::sqrt;
  const auto [s, t] = tangents(unit, most_normal_axis(unit));
  const Support<T> a = support(pair.a, unit, s, t), b = support(pair.b, unit, s, t);
  const T f = dot(unit, pair.d) - a.h - b.h;
  const T rs = dot(s, pair.d) - a.slope_s - b.slope_s;
  const T rt = dot(t, pair.d) - a.slope_t - b.slope_t;
  return {unit,
          s,
          t,
          f,
          rs,
          rt,
          sqrt(rs * rs + rt * rt),
          f + a.bend_ss + b.bend_ss,
          a.bend_st + b.bend_st,
          f + a.bend_tt + b.bend_tt};
}

/// K = low u u' + high v v', low <= high, with v = (-u_t, u_s) in the basis (s, t).
template <class T>
struct Principal {
  T low, high;
  T us, ut;
};

template <class T>
Principal<T> principal(const Value<T>& at) {
  using std::sqrt;
  const T middle = (at.kss + at.ktt) / 2, half = (at.kss - at.ktt) / 2;
  const T spread = sqrt(half * half + at.kst * at.kst);
  if (spread == 0) return {middle, middle, 1, 0};
  const T x = half < 0 ? T(spread - half) : T(-at.kst);
  const T y = half < 0 ? T(-at.kst) : T(spread + half);
  const T per = 1 / sqrt(x * x + y * y);
  const T high = middle + spread;
  const T low = middle > 0 ? T((at.kss * at.ktt - at.kst * at.kst) / high) : T(middle - spread);
  return {low, high, x * per, y * per};
}

/// r / |k|, no longer than `radius`.
template <class T>
T bounded_step(const T& r, const T& k, const T& radius) {
  using std::abs;
  if (abs(r) < radius * abs(k)) return r / abs(k);
  return r == 0 ? T(0) : (r < 0 ? T(-radius) : radius);
}

template <class T>
struct Arrival {
  Value<T> at;
  bool stationary;  ///< |gradient| <= tolerance, and K >= 0 up to sqrt(epsilon) L
};

/// Sum of the bodies' extents and their distance.
template <class T>
T extent(const Separation<T>& pair) {
  using std::sqrt;
  T sum = sqrt(dot(pair.d, pair.d));
  for (const Shape<T>* body : {&pair.a, &pair.b}) {
    T most = body->semi_axes[0];
    for (const T& a : body->semi_axes) {
      if (a > most) most = a;
    }
    sum += most;
  }
  return sum;
}

/// Never downhill: Newton along either principal direction of K with its eigenvalue's absolute
/// value, held within a trust radius. Ends at a stationary point that is no saddle, or where
/// rounding stops it.
template <class T>
Arrival<T> ascend(const Separation<T>& pair, const Triple<T>& start, const T& tolerance,
                  int most_steps) {
  using std::abs, std::sqrt;
  const T epsilon = std::numeric_limits<T>::epsilon();
  const T size = extent(pair);
  const T noise = 16 * epsilon * size;
  const T flat = sqrt(epsilon) * size;
  T radius = 0.5;  // chosen: radians
  Value<T> at = value(pair, normalised(start));
  for (int step = 0; step < most_steps && radius > epsilon; ++step) {
    const Principal<T> k = principal(at);
    const bool level = at.residual <= tolerance;
    if (level && k.low >= -flat) return {at, true};
    const T ru = k.us * at.rs + k.ut * at.rt, rv = k.us * at.rt - k.ut * at.rs;
    const T du = level ? radius : bounded_step(ru, k.low, radius);
    const T dv = level ? T(0) : bounded_step(rv, k.high, radius);
    const T ds = k.us * du - k.ut * dv, dt = k.ut * du + k.us * dv;
    const Value<T> next = value(pair, normalised(combined(at.n, ds, at.s, dt, at.t)));
    const bool higher = next.f > at.f + noise;
    if (higher || (next.f >= at.f - noise && next.residual < at.residual)) {
      at = next;
      radius = radius < T(0.25) ? T(2 * radius) : T(0.5);
    } else {
      const T taken = abs(du) > abs(dv) ? abs(du) : abs(dv);
      radius = (taken < radius ? taken : radius) / 4;
    }
  }
  return {at, at.residual <= tolerance};
}

}  // namespace tangency::inline v0::verify::ascent
