// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/exact_contact.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tangency::inline v0::verify::construction {
namespace {

// norm(q) R(q), by rows.
std::array<std::array<int, 3>, 3> rotation(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
}

void divide_by_content(Vector& v) {
  const mpz_class content = gcd(gcd(v[0], v[1]), v[2]);
  for (mpz_class& entry : v) entry /= content;
}

const mpz_class& least(const Vector& v) { return *std::min_element(v.begin(), v.end()); }
const mpz_class& largest(const Vector& v) { return *std::max_element(v.begin(), v.end()); }

}  // namespace

Quaternion small_quaternion(Draw& draw) {
  Quaternion q{};
  while (q == Quaternion{}) {
    for (int& v : q) v = draw.integer(-2, 2);
  }
  return q;
}

int norm(const Quaternion& q) { return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]; }

Vector turned(const Quaternion& q, const Vector& v, bool back) {
  const auto r = rotation(q);
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i] += (back ? r[j][i] : r[i][j]) * v[j];
  }
  return result;
}

std::optional<RawEllipsoid> raw(const ExactBody& body, int exponent) {
  RawEllipsoid result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (const mpz_class* v : {&body.centre[i], &body.axes[i]}) {
      if (mpz_sizeinbase(v->get_mpz_t(), 2) > 53) return std::nullopt;
    }
    result.centre[i] = std::ldexp(body.centre[i].get_d(), exponent);
    result.semi_axes[i] = std::ldexp(body.axes[i].get_d(), exponent);
  }
  std::ranges::copy(body.q, result.orientation.begin());
  return result;
}

SpherePoint sphere_point(Draw& draw) {
  static constexpr std::array<std::array<int, 4>, 8> kQuadruples{{{1, 2, 2, 3},
                                                                  {2, 3, 6, 7},
                                                                  {1, 4, 8, 9},
                                                                  {4, 4, 7, 9},
                                                                  {2, 6, 9, 11},
                                                                  {6, 6, 7, 11},
                                                                  {3, 4, 12, 13},
                                                                  {2, 5, 14, 15}}};
  const auto& t = draw.one_of(kQuadruples);
  std::array<int, 3> u{t[0], t[1], t[2]};
  draw.shuffle(u);
  for (int& v : u) v *= 2 * draw.integer(0, 1) - 1;
  return {{u[0], u[1], u[2]}, t[3]};
}

Vector small_vector(Draw& draw, int size) {
  return {draw.integer(-size, size), draw.integer(-size, size), draw.integer(-size, size)};
}

Vector small_axes(Draw& draw, int largest) {
  return {draw.integer(1, largest), draw.integer(1, largest), draw.integer(1, largest)};
}

std::optional<Contact> contact(Draw& draw, bool inside) {
  Contact c;
  c.inside = inside;
  c.a.q = small_quaternion(draw);
  c.b.q = small_quaternion(draw);
  const auto [u_a, radius_a] = sphere_point(draw);
  auto [u_b, radius_b] = sphere_point(draw);
  Vector axes_a = small_axes(draw, 6);
  const auto& [a1, a2, a3] = axes_a;
  c.n = turned(c.a.q, {u_a[0] * a2 * a3, u_a[1] * a3 * a1, u_a[2] * a1 * a2});
  divide_by_content(c.n);
  Vector m = turned(c.b.q, c.n, true);
  divide_by_content(m);
  if (m[0] == 0 || m[1] == 0 || m[2] == 0) return std::nullopt;
  const mpz_class multiple = lcm(lcm(m[0], m[1]), m[2]);
  Vector axes_b;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpz_class size = abs(u_b[k]);
    axes_b[k] = size * multiple / abs(m[k]);
    u_b[k] = size * sgn(m[k]) * (inside ? 1 : -1);
  }
  divide_by_content(axes_b);
  const auto scale = [](Vector& axes, const mpz_class& by) {
    for (mpz_class& axis : axes) axis *= by;
  };
  const mpz_class unit_a = norm(c.a.q) * radius_a, unit_b = norm(c.b.q) * radius_b;
  if (inside) {  // Blaschke: B inside A if B's largest radius of curvature is below A's smallest
    const mpz_class need = largest(axes_b) * largest(axes_b) * largest(axes_a) * unit_b /
                           (least(axes_b) * least(axes_a) * least(axes_a) * unit_a);
    scale(axes_a, need + draw.integer(1, 3));
  } else {
    scale(axes_a, draw.integer(1, 4));
  }
  const auto to_contact = [](const ExactBody& body, const Vector& axes, const Vector& u) {
    return turned(body.q, {axes[0] * u[0], axes[1] * u[1], axes[2] * u[2]});
  };
  const Vector x_a = to_contact(c.a, axes_a, u_a), x_b = to_contact(c.b, axes_b, u_b);
  scale(axes_a, unit_a);
  scale(axes_b, unit_b);
  c.a.axes = axes_a;
  c.b.axes = axes_b;
  c.a.centre = small_vector(draw, 100);
  for (std::size_t i = 0; i < 3; ++i) c.b.centre[i] = c.a.centre[i] + x_a[i] - x_b[i];
  const auto d = [](const mpz_class& v) { return v.get_d(); };
  const double rho_a = d(least(axes_a)) * d(least(axes_a)) / d(largest(axes_a));
  c.rho = inside ? rho_a - d(largest(axes_b)) * d(largest(axes_b)) / d(least(axes_b))
                 : rho_a + d(least(axes_b)) * d(least(axes_b)) / d(largest(axes_b));
  return c;
}

}  // namespace tangency::inline v0::verify::construction
