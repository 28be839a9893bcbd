// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/manufactured.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tangency/verify/families/support.hpp>

namespace tangency::families {
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
  return families::uniform(random_, low, high);
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

ManufacturedContact ManufacturedContacts::next() {
  ManufacturedContact contact;
  RawEllipsoid &a = contact.a, &b = contact.b;
  a.semi_axes = semi_axes(1);
  b.semi_axes = semi_axes(log_uniform(Real(family_.size_ratio) * family_.size_ratio));
  a.orientation = draw_orientation(random_);
  b.orientation = draw_orientation(random_);
  for (double& c : a.centre) c = static_cast<double>(uniform(-1, 1));

  const Vector n = draw_direction(random_);
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
