// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/manufactured.hpp>

#include <algorithm>
#include <cstddef>

#include <tangency/verify/families/placing.hpp>

namespace tangency::inline v0::verify {

std::span<const ContactFamily> contact_classes() {
  using F = ContactFamily;
  static const std::array<ContactFamily, 3> classes{{
      {"class1", F::Shape::spheroid, 1.43, 1, F::GapUnit::smallest_semi_axis, 0.02},
      {"class2", F::Shape::drawn, 5, 3, F::GapUnit::smallest_semi_axis, 0.02},
      {"class3", F::Shape::drawn, 1000, 1000, F::GapUnit::rho, 1e-3},
  }};
  return classes;
}

EllipsoidPair contact_bodies(Draw& draw, const ContactFamily& family) {
  using Shape = ContactFamily::Shape;
  const auto axes = [&](double size) {
    if (family.shape == Shape::triaxial) return triaxial_axes(draw, size, family.aspect);
    if (family.shape == Shape::drawn) {
      return triaxial_axes(draw, size, draw.log_uniform(1, family.aspect));
    }
    std::array<double, 3> spheroid{size * family.aspect, size, size};
    draw.shuffle(spheroid);
    return spheroid;
  };
  EllipsoidPair pair{turned_body(draw, axes(1)), {}};
  const double size = draw.log_uniform(1 / family.size_ratio, family.size_ratio);
  pair.b = turned_body(draw, axes(size));
  for (double& v : pair.a.centre) v = draw.real(-1, 1);
  return pair;
}

ManufacturedContact drawn(Draw& draw, const ContactFamily& family) {
  ManufacturedContact contact{contact_bodies(draw, family), {}, 0, 0, 0};
  contact.smallest_semi_axis = least_axis(contact);
  const double radii = least_radii(contact);
  const bool by_radii = family.gap_unit == ContactFamily::GapUnit::rho;
  const double most = (by_radii ? radii : contact.smallest_semi_axis) * family.largest_gap;
  const double gap = draw.real(-std::min(most, radii), most);
  const Real3 n = drawn_direction(draw);
  contact.gap = rounded(place_b(contact, n, gap));
  Real square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real d = Real(contact.b.centre[i]) - contact.a.centre[i];
    square += d * d;
    contact.normal[i] = rounded(n[i]);
  }
  contact.size = rounded(sqrt(square)) + most_axis(contact.a) + most_axis(contact.b);
  return contact;
}

}  // namespace tangency::inline v0::verify
