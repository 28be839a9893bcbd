// SPDX-License-Identifier: MIT
#include <tangency/dem/contact_law.hpp>

namespace tangency::dem {

Vec3 turned_with(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double cosine = from.dot(to);
  if (!(1.0 + cosine > 0.0)) return -v;
  return cosine * v + axis.cross(v) + axis * (axis.dot(v) / (1.0 + cosine));
}

Vec3 ContactLaw::shear_force(const Vec3& shear, const Vec3& previous_normal, const Vec3& normal,
                             const Vec3& displacement, double normal_force) const {
  Vec3 force = turned_with(shear, previous_normal, normal) - shear_stiffness * displacement;
  // Takes the normal part of the displacement away, and what rounding has left of earlier ones.
  force -= normal * normal.dot(force);
  const double limit = cohesion + normal_force * friction_coefficient;
  const double size = force.norm();
  return size > limit ? Vec3(force * (limit / size)) : force;
}

}  // namespace tangency::dem
