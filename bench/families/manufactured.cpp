// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/families/manufactured.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tangency::families {
namespace {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64,
              "the truth needs more digits than the kernel");
using Vector = std::array<Real, 3>;

Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Support point M n / h(n) of the stored doubles, from the centre.
Vector support_point(const RawEllipsoid& e, const Vector& n) {
  const Real w = e.orientation[0], x = e.orientation[1], y = e.orientation[2], z = e.orientation[3];
  const Real s = 2 / (w * w + x * x + y * y + z * z);
  const std::array<Vector, 3> columns = {{
      {1 - s * (y * y + z * z), s * (x * y + w * z), s * (z * x - w * y)},
      {s * (x * y - w * z), 1 - s * (z * z + x * x), s * (y * z + w * x)},
      {s * (z * x + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)},
  }};
  Vector scaled;
  for (std::size_t k = 0; k < 3; ++k) scaled[k] = e.semi_axes[k] * dot(columns[k], n);
  const Real h = std::sqrt(dot(scaled, scaled));
  Vector point{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] += columns[k][i] * (e.semi_axes[k] * scaled[k] / h);
    }
  }
  return point;
}

}  // namespace

std::span<const ContactFamily> contact_classes() {
  using F = ContactFamily;
  static const std::array<ContactFamily, 3> classes = {{
      {"class1", F::Shape::spheroid, 1.43, 1, F::GapUnit::smallest_semi_axis, 0.02},
      {"class2", F::Shape::drawn, 5, 3, F::GapUnit::smallest_semi_axis, 0.02},
      {"class3", F::Shape::drawn, 1000, 1000, F::GapUnit::rho, 1e-3},
  }};
  return classes;
}

ManufacturedContacts::ManufacturedContacts(const ContactFamily& family, std::uint64_t seed)
    : family_(family), random_(seed) {}

Real ManufacturedContacts::uniform(Real low, Real high) {
  // Not std::uniform_real_distribution, whose values differ between standard libraries.
  return low + (high - low) * (static_cast<Real>(random_() >> 11) * 0x1p-53L);
}

Real ManufacturedContacts::log_uniform(Real high_over_low) {
  const Real half = std::log(high_over_low) / 2;
  return std::exp(uniform(-half, half));
}

std::array<double, 3> ManufacturedContacts::semi_axes(Real size) {
  Real aspect = family_.aspect;
  if (family_.shape == ContactFamily::Shape::drawn) aspect = std::exp(uniform(0, std::log(aspect)));
  const Real middle =
      family_.shape == ContactFamily::Shape::spheroid ? 1 : std::exp(uniform(0, std::log(aspect)));
  std::array<double, 3> axes = {static_cast<double>(size * aspect),
                                static_cast<double>(size * middle), static_cast<double>(size)};
  for (std::size_t i = 2; i > 0; --i) std::swap(axes[i], axes[random_() % (i + 1)]);
  return axes;
}

std::array<double, 4> ManufacturedContacts::orientation() {
  // Uniform in the ball, by rejection: the direction is uniform over all rotations.
  for (;;) {
    std::array<double, 4> q;
    double norm2 = 0;
    for (double& c : q) c = static_cast<double>(uniform(-1, 1)), norm2 += c * c;
    if (norm2 > 0.01 && norm2 <= 1) return q;
  }
}

ManufacturedContact ManufacturedContacts::next() {
  ManufacturedContact contact;
  RawEllipsoid &a = contact.a, &b = contact.b;
  a.semi_axes = semi_axes(1);
  b.semi_axes = semi_axes(log_uniform(Real(family_.size_ratio) * family_.size_ratio));
  a.orientation = orientation();
  b.orientation = orientation();
  for (double& c : a.centre) c = static_cast<double>(uniform(-1, 1));

  Vector n;
  Real norm2;
  do {
    for (Real& c : n) c = uniform(-1, 1);
    norm2 = dot(n, n);
  } while (norm2 > 1 || norm2 < 0.01L);
  for (Real& c : n) c /= std::sqrt(norm2);

  const auto [min_a, max_a] = std::minmax_element(a.semi_axes.begin(), a.semi_axes.end());
  const auto [min_b, max_b] = std::minmax_element(b.semi_axes.begin(), b.semi_axes.end());
  contact.smallest_semi_axis = std::min(*min_a, *min_b);
  const Real rho = Real(*min_a) * *min_a / *max_a + Real(*min_b) * *min_b / *max_b;
  const Real unit =
      family_.gap_unit == ContactFamily::GapUnit::rho ? rho : contact.smallest_semi_axis;
  const Real largest = unit * family_.largest_gap;
  const Real wanted = uniform(-std::min(largest, rho), largest);

  const Vector point_a = support_point(a, n), point_b = support_point(b, n);
  Real rounding = 0, distance2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real centre = a.centre[i] + point_a[i] + wanted * n[i] + point_b[i];
    b.centre[i] = static_cast<double>(centre);
    rounding += n[i] * (b.centre[i] - centre);
    distance2 += (centre - a.centre[i]) * (centre - a.centre[i]);
    contact.normal[i] = static_cast<double>(n[i]);
  }
  contact.gap = static_cast<double>(wanted + rounding);
  contact.size = static_cast<double>(std::sqrt(distance2)) + *max_a + *max_b;
  return contact;
}

}  // namespace tangency::families
