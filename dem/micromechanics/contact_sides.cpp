// SPDX-License-Identifier: MIT
#include "contact_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace tangency::micromechanics {

Vec3 axis_in_space(const BodyArrays& bodies, std::size_t body, std::size_t axis) {
  return bodies.orientation[body] * Vec3(Vec3::Unit(static_cast<Eigen::Index>(axis)));
}

std::vector<Side> sides_of(const ContactArrays& contacts, const BodyArrays& bodies, Shape shape) {
  std::vector<char> asked;
  asked.reserve(bodies.semi_axes.size());
  for (const Vec3& r : bodies.semi_axes) asked.push_back(shape_of(r) == shape ? 1 : 0);
  std::vector<Side> sides;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const auto body = static_cast<std::size_t>(contacts.bodies[c][end]);
      if (asked[body] != 0) sides.push_back({c, body, end == 1});
    }
  return sides;
}

Vec3 contact_vector(const ContactArrays& contacts, const Side& side) {
  const Vec3& arm = contacts.arm[side.contact];
  return (side.of_b ? Vec3(arm - contacts.branch[side.contact]) : arm).normalized();
}

bool rotates(Shape shape) { return shape == Shape::prolate || shape == Shape::oblate; }

std::vector<Turned> turned_of(const ContactArrays& contacts, const BodyArrays& bodies,
                              std::span<const Side> sides) {
  std::vector<Turned> found;
  found.reserve(sides.size());
  for (const Side& side : sides) {
    const Vec3& n = contacts.normal[side.contact];
    const auto symmetry = symmetry_of(bodies.semi_axes[side.body]);
    const Vec3 u = axis_in_space(bodies, side.body, symmetry->axis);
    found.push_back({n, u, std::clamp(n.dot(u), -1.0, 1.0)});
  }
  return found;
}

namespace {

/// Empty of a circle.
std::optional<PlaneBody> plane_body(const BodyArrays& bodies, std::size_t body) {
  constexpr double kUpright = 1e-6;  // chosen: text files of six digits pass
  std::size_t up = 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(axis_in_space(bodies, body, axis)[2]) > 1.0 - kUpright) up = axis;
  if (up == 3)
    throw std::invalid_argument("orientation[" + std::to_string(body) +
                                "]: a body axis must be that of z in the plane");
  const Vec3& r = bodies.semi_axes[body];
  std::size_t major = (up + 1) % 3, minor = (up + 2) % 3;
  const auto semi_axis = [&r](std::size_t axis) { return r[static_cast<Eigen::Index>(axis)]; };
  if (semi_axis(major) < semi_axis(minor)) std::swap(major, minor);
  static_cast<void>(shape_of(r));  // semi-axes that are not sound are refused
  if (semi_axis(major) - semi_axis(minor) <= kEqualAxes * semi_axis(major)) return std::nullopt;
  Vec3 axis = axis_in_space(bodies, body, major);
  axis[2] = 0.0;
  return PlaneBody{{semi_axis(major), semi_axis(minor)}, axis.normalized()};
}

}  // namespace

PlaneSides plane_sides(const ContactArrays& contacts, const BodyArrays& bodies) {
  require_sound(contacts, bodies);
  if (contacts.dimensions != 2)
    throw std::invalid_argument("dimensions = 3: normal_rotation_of takes contacts in space");
  PlaneSides found;
  for (std::size_t body = 0; body < bodies.semi_axes.size(); ++body)
    found.of_body.push_back(plane_body(bodies, body));
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const auto body = static_cast<std::size_t>(contacts.bodies[c][end]);
      if (found.of_body[body]) found.sides.push_back({c, body, end == 1});
    }
  return found;
}

ClusteredErrors::ClusteredErrors(std::size_t bodies, std::size_t components)
    : components_(components),
      of_body_(bodies * components, 0.0),
      first_(components, 0.0),
      second_(components, 0.0),
      by_contact_(components, 0.0),
      by_side_(components, 0.0) {}

void ClusteredErrors::add(const Side& side, std::span<const double> influence) {
  const bool same_contact = open_ && open_->contact == side.contact;
  if (!same_contact) {
    close_contact();
    open_ = side;
  }
  // A body that touches its own image has both sides: they are one cluster either way.
  const bool second = same_contact && side.body != open_->body;
  for (std::size_t m = 0; m < components_; ++m) {
    (second ? second_ : first_)[m] += influence[m];
    of_body_[side.body * components_ + m] += influence[m];
  }
}

void ClusteredErrors::close_contact() {
  if (!open_) return;
  ++contacts_;
  for (std::size_t m = 0; m < components_; ++m) {
    by_contact_[m] += (first_[m] + second_[m]) * (first_[m] + second_[m]);
    by_side_[m] += first_[m] * first_[m] + second_[m] * second_[m];
    first_[m] = second_[m] = 0.0;
  }
  open_.reset();
}

std::vector<double> ClusteredErrors::deviations() {
  close_contact();
  std::vector<double> by_body(components_, 0.0);
  for (std::size_t at = 0; at < of_body_.size(); ++at)
    by_body[at % components_] += of_body_[at] * of_body_[at];
  std::vector<double> found(components_, std::numeric_limits<double>::quiet_NaN());
  if (contacts_ < 2) return found;
  const auto count = static_cast<double>(contacts_);
  for (std::size_t m = 0; m < components_; ++m) {
    const double clustered = by_body[m] + by_contact_[m] - by_side_[m];
    const double variance = clustered > 0.0 ? clustered : by_side_[m];
    found[m] = std::sqrt(variance * count / (count - 1.0));
  }
  return found;
}

Estimate mean_of(std::span<const Side> sides, std::span<const double> values, std::size_t bodies) {
  const auto count = static_cast<double>(sides.size());
  Estimate found;
  for (const double value : values) found.value += value / count;
  ClusteredErrors errors(bodies, 1);
  for (std::size_t s = 0; s < sides.size(); ++s)
    errors.add(sides[s], std::array{(values[s] - found.value) / count});
  found.error = errors.deviations().front();
  return found;
}

}  // namespace tangency::micromechanics
