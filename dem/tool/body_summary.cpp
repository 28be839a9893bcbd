// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/body_summary.hpp>

#include <algorithm>

#include <tangency/dem/micromechanics/spheroid.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;

/// That of all bodies; empty of spheres and of several.
std::optional<mm::Shape> common_shape(const mm::BodyArrays& bodies) {
  if (bodies.semi_axes.empty()) return std::nullopt;
  const mm::Shape shape = mm::shape_of(bodies.semi_axes.front());
  const bool is_common =
      std::all_of(bodies.semi_axes.begin(), bodies.semi_axes.end(),
                  [&](const Vec3& semi_axes) { return mm::shape_of(semi_axes) == shape; });
  return is_common && shape != mm::Shape::sphere ? std::optional(shape) : std::nullopt;
}

}  // namespace

BodySummary body_summary(const mm::ContactArrays& contacts, const mm::BodyArrays& bodies) {
  BodySummary found;
  if (contacts.size() == 0) return found;
  if (contacts.dimensions == 2) {
    found.in_plane = mm::plane_normal_rotation_of(contacts, bodies);
    if (found.in_plane) found.calculated_factor = found.in_plane->calculated;
    found.independence = mm::plane_normal_independence(contacts, bodies);
    return found;
  }
  const auto shape = common_shape(bodies);
  if (!shape) return found;
  found.contacts = mm::contact_statistics_of(contacts, bodies, *shape);
  found.rotation = mm::normal_rotation_of(contacts, bodies, *shape);
  found.independence = mm::normal_independence(contacts, bodies, *shape);
  if (found.rotation) found.calculated_factor = found.rotation->calculated.second;
  return found;
}

}  // namespace tangency::inline v0::dem
