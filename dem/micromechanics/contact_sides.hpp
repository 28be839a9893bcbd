// SPDX-License-Identifier: MIT
/// @file
/// The sides of contacts one by one, and the scatter of means over sides that depend on each other.
/// Internal.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/spheroid.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// @throws std::invalid_argument unless contacts have the dimensions that the function takes
void require_dimensions(const ContactArrays& contacts, int dimensions, const char* function);

struct Side {
  std::size_t contact = 0, body = 0;
  bool of_b = false;
};
/// Of the bodies that are asked for, one flag a body. In the order of contacts, of a first.
std::vector<Side> sides_of(const ContactArrays& contacts, const std::vector<bool>& asked);
/// Of bodies of one shape.
std::vector<Side> sides_of(const ContactArrays& contacts, const BodyArrays& bodies, Shape shape);

/// Unit vector from the body's centre to the contact, in space.
Vec3 contact_vector(const ContactArrays& contacts, const Side& side);
/// The same in body axes.
Vec3 local_vector(const ContactArrays& contacts, const BodyArrays& bodies, const Side& side);

/// What tells how the normal of a side lies to its body.
struct Turned {
  Vec3 normal, axis;    ///< of the contact; of symmetry, in space
  double cosine = 0.0;  ///< of the angle between them
};
/// @param sides  of bodies of revolution
std::vector<Turned> turned_of(const ContactArrays& contacts, const BodyArrays& bodies,
                              std::span<const Side> sides);
/// A body axis, 0 to 2: a unit vector.
Vec3 axis_in_space(const BodyArrays& bodies, std::size_t body, std::size_t axis);
/// Has it an axis of symmetry?
bool rotates(Shape shape);

/// An ellipse in the plane: its semi-axes, and the direction of the long one.
struct PlaneBody {
  Spheroid ellipse;
  Vec3 axis = Vec3::Zero();
};
/// Empty of a circle.
std::optional<PlaneBody> plane_body(const BodyArrays& bodies, std::size_t body);
struct PlaneSides {
  std::vector<std::optional<PlaneBody>> of_body;
  std::vector<Side> sides;  ///< of bodies that are no circles
};
/// Of sound contacts and bodies in the plane.
PlaneSides plane_sides(const ContactArrays& contacts, const BodyArrays& bodies);

/// The deviation of a sum of influences, one a side: those of one body may depend on each other,
/// and those of one contact. The variance is the sum of squares by bodies and by contacts, less
/// that by sides, which is in both.
class ClusteredErrors {
 public:
  ClusteredErrors(std::size_t bodies, std::size_t components);

  /// Sides of a contact one after the other.
  void add(const Side& side, std::span<const double> influence);

  /// Of each component. NaN with fewer than two contacts; where bodies and contacts leave less than
  /// nothing, that of independent sides.
  std::vector<double> deviations();

 private:
  void close_contact();

  std::size_t components_, contacts_ = 0;
  std::vector<double> of_body_;  ///< by bodies, then components
  std::vector<double> first_, second_;
  std::vector<double> by_contact_, by_side_;
  std::optional<Side> open_;
};

/// The mean of a value a side, and its deviation.
Estimate mean_of(std::span<const Side> sides, std::span<const double> values, std::size_t bodies);

}  // namespace tangency::inline v0::micromechanics
