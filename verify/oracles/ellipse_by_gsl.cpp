// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_poly.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/quadrature.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

// The level of B, less 1, on A's boundary at the eccentric angle t, as k0 + k1 cos t + k2 sin t +
// k3 cos 2t + k4 sin 2t.
std::array<double, 5> level_on_boundary(const RawEllipse& a, const RawEllipse& b) {
  const double turn =
      std::atan2(a.direction[1], a.direction[0]) - std::atan2(b.direction[1], b.direction[0]);
  const double beta = std::atan2(b.direction[1], b.direction[0]);
  const double dx = a.centre[0] - b.centre[0], dy = a.centre[1] - b.centre[1];
  const double c = std::cos(turn), s = std::sin(turn), cb = std::cos(beta), sb = std::sin(beta);
  // Both components of B's circle frame: constant, cos t and sin t.
  const double p[3] = {(cb * dx + sb * dy) / b.semi_axes[0], c * a.semi_axes[0] / b.semi_axes[0],
                       -s * a.semi_axes[1] / b.semi_axes[0]};
  const double q[3] = {(cb * dy - sb * dx) / b.semi_axes[1], s * a.semi_axes[0] / b.semi_axes[1],
                       c * a.semi_axes[1] / b.semi_axes[1]};
  std::array<double, 5> k{};
  for (const double* v : {p, q}) {
    k[0] += v[0] * v[0] + 0.5 * (v[1] * v[1] + v[2] * v[2]);
    k[1] += 2 * v[0] * v[1];
    k[2] += 2 * v[0] * v[2];
    k[3] += 0.5 * (v[1] * v[1] - v[2] * v[2]);
    k[4] += v[1] * v[2];
  }
  k[0] -= 1;
  return k;
}

double level_at(const std::array<double, 5>& k, double t) {
  return k[0] + k[1] * std::cos(t) + k[2] * std::sin(t) + k[3] * std::cos(2 * t) +
         k[4] * std::sin(2 * t);
}

using Point = std::array<double, 2>;

// An ellipse with its centre relative to A's.
struct Placed {
  double x, y, c, s, p, q;

  Placed(const RawEllipse& e, const RawEllipse& origin)
      : x(e.centre[0] - origin.centre[0]),
        y(e.centre[1] - origin.centre[1]),
        c(e.direction[0] / std::hypot(e.direction[0], e.direction[1])),
        s(e.direction[1] / std::hypot(e.direction[0], e.direction[1])),
        p(e.semi_axes[0]),
        q(e.semi_axes[1]) {}
  // In the frame of the unit circle.
  Point on_circle(const Point& r) const {
    const double dx = r[0] - x, dy = r[1] - y;
    return {(c * dx + s * dy) / p, (c * dy - s * dx) / q};
  }
  bool holds(const Point& r) const {
    const Point u = on_circle(r);
    return u[0] * u[0] + u[1] * u[1] < 1;
  }
  Point at(double t) const {
    const double u = p * std::cos(t), v = q * std::sin(t);
    return {x + c * u - s * v, y + s * u + c * v};
  }
  // Twice the area that the radius from A's centre sweeps with t.
  double sweep(double t) const {
    const Point r = at(t);
    const double du = -p * std::sin(t), dv = q * std::cos(t);
    return r[0] * (s * du + c * dv) - r[1] * (c * du - s * dv);
  }
};

// What the arcs of `one` inside `other` contribute to the area of the common region.
double inner_arcs(const Placed& one, const Placed& other, const std::vector<Point>& crossings) {
  std::vector<double> angles;
  for (const Point& r : crossings) {
    const Point u = one.on_circle(r);
    angles.push_back(std::atan2(u[1], u[0]));
  }
  std::ranges::sort(angles);
  if (angles.empty()) angles.push_back(0);
  angles.push_back(angles.front() + 2 * kPi);
  double area = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    if (!other.holds(one.at((angles[i] + angles[i + 1]) / 2))) continue;
    area += integral([&](double t) { return one.sweep(t) / 2; }, angles[i], angles[i + 1]);
  }
  return area;
}

}  // namespace

double common_area_by_gsl(const RawEllipse& a, const RawEllipse& b, double imaginary) {
  const std::vector<Point> crossings = ellipse_crossings_by_gsl(a, b, imaginary);
  const Placed one(a, a), other(b, a);
  return inner_arcs(one, other, crossings) + inner_arcs(other, one, crossings);
}

std::vector<std::array<double, 2>> ellipse_crossings_by_gsl(const RawEllipse& a,
                                                            const RawEllipse& b, double imaginary) {
  const std::array<double, 5> k = level_on_boundary(a, b);
  // w = tan((t - zero) / 2) is infinite opposite to zero: there the level shall not vanish.
  double zero = 0, most = -1;
  for (int i = 0; i < 32; ++i) {
    const double t = i * (kPi / 16), value = std::abs(level_at(k, t + kPi));
    if (value > most) most = value, zero = t;
  }
  const std::complex<double> turned1 = std::complex<double>(k[1], -k[2]) * std::polar(1.0, zero);
  const std::complex<double> turned2 =
      std::complex<double>(k[3], -k[4]) * std::polar(1.0, 2 * zero);
  const double c1 = turned1.real(), s1 = -turned1.imag(), c2 = turned2.real(), s2 = -turned2.imag();
  const double quartic[5] = {k[0] + c1 + c2, 2 * s1 + 4 * s2, 2 * k[0] - 6 * c2, 2 * s1 - 4 * s2,
                             k[0] - c1 + c2};
  double roots[8];
  gsl_poly_complex_workspace* workspace = gsl_poly_complex_workspace_alloc(5);
  gsl_poly_complex_solve(quartic, 5, workspace, roots);
  gsl_poly_complex_workspace_free(workspace);

  std::vector<std::array<double, 2>> points;
  const double alpha = std::atan2(a.direction[1], a.direction[0]);
  for (int i = 0; i < 4; ++i) {
    const double w = roots[2 * i], wi = roots[2 * i + 1];
    if (std::abs(wi) > imaginary * (1 + std::abs(w))) continue;
    const double t = zero + 2 * std::atan(w);
    const double x = a.semi_axes[0] * std::cos(t), y = a.semi_axes[1] * std::sin(t);
    points.push_back(
        {std::cos(alpha) * x - std::sin(alpha) * y, std::sin(alpha) * x + std::cos(alpha) * y});
  }
  return points;
}

}  // namespace tangency::inline v0::verify
