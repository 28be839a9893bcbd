// SPDX-License-Identifier: MIT
#include "contact_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace tangency::inline v0::micromechanics {

void require_dimensions(const ContactArrays& contacts, int dimensions, const char* function) {
  if (contacts.dimensions != dimensions)
    throw std::invalid_argument("dimensions = " + std::to_string(contacts.dimensions) + ": " +
                                function + " takes contacts " +
                                (dimensions == 2 ? "in the plane" : "in space"));
}

Vec3 axis_in_space(const BodyArrays& bodies, std::size_t body, std::size_t axis) {
  return bodies.orientation[body].normalized() * Vec3(Vec3::Unit(static_cast<Eigen::Index>(axis)));
}

std::vector<Side> sides_of(const ContactArrays& contacts, const std::vector<bool>& asked) {
  std::vector<Side> sides;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const bool of_b : {false, true}) {
      const auto body = static_cast<std::size_t>(contacts.bodies[c][of_b ? 1 : 0]);
      if (asked[body]) sides.push_back({c, body, of_b});
    }
  return sides;
}

std::vector<Side> sides_of(const ContactArrays& contacts, const BodyArrays& bodies, Shape shape) {
  std::vector<bool> asked;
  asked.reserve(bodies.semi_axes.size());
  for (const Vec3& r : bodies.semi_axes) asked.push_back(shape_of(r) == shape);
  return sides_of(contacts, asked);
}

Vec3 contact_vector(const ContactArrays& contacts, const Side& side) {
  return contacts.lever(side.contact, side.of_b).normalized();
}

Vec3 local_vector(const ContactArrays& contacts, const BodyArrays& bodies, const Side& side) {
  return bodies.orientation[side.body].normalized().conjugate() * contact_vector(contacts, side);
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

std::optional<PlaneBody> plane_body(const BodyArrays& bodies, std::size_t body) {
  const Vec3& r = bodies.semi_axes[body];
  const double one = r[0], other = r[1];
  if (are_equal_axes(one, other)) return std::nullopt;
  Vec3 axis = axis_in_space(bodies, body, one > other ? 0 : 1);
  axis[2] = 0.0;
  return PlaneBody{{std::max(one, other), std::min(one, other)}, axis.normalized()};
}

PlaneSides plane_sides(const ContactArrays& contacts, const BodyArrays& bodies) {
  PlaneSides found;
  std::vector<bool> asked;
  for (std::size_t body = 0; body < bodies.semi_axes.size(); ++body) {
    found.of_body.push_back(plane_body(bodies, body));
    asked.push_back(found.of_body.back().has_value());
  }
  found.sides = sides_of(contacts, asked);
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
  std::vector<double> found(components_, kNotDefined);
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

}  // namespace tangency::inline v0::micromechanics
