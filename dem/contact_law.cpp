// SPDX-License-Identifier: MIT
#include <tangency/dem/contact_law.hpp>

#include <algorithm>

namespace tangency::dem {

Vec3 turned_with(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double cosine = from.dot(to);
  if (!(1.0 + cosine > 0.0)) return -v;
  return cosine * v + axis.cross(v) + axis * (axis.dot(v) / (1.0 + cosine));
}

NormalResponse ContactLaw::normal_response(double overlap,
                                           const PrincipalCurvatures& relative) const {
  if (!hertz) {
    const double force = normal_stiffness * overlap;
    return {force, normal_stiffness, 0.5 * force * overlap, {shear_stiffness, shear_stiffness}};
  }
  const HertzContact contact = hertz_contact(relative.curvature, overlap, *hertz);
  return {contact.force,
          contact.stiffness,
          contact.energy,
          {contact.shear_stiffness[0], contact.shear_stiffness[1], relative.direction[1]}};
}

double ContactLaw::shear(ShearState& state, const ContactStep& step,
                         const NormalResponse& normal) const {
  const Vec3 old = turned_with(state.force, step.previous_normal, step.normal);
  const double stiffness = normal.shear.largest();
  const bool unloaded = hertz && stiffness < state.stiffness;
  const Vec3 kept = unloaded ? Vec3(old * (stiffness / state.stiffness)) : old;
  Vec3 trial = kept - normal.shear.times(step.displacement);
  // Takes the normal part of the displacement away, and what rounding has left of earlier ones.
  trial -= step.normal * step.normal.dot(trial);
  const double limit = cohesion + normal.force * friction_coefficient;
  const double size = trial.norm();
  const double before = state.energy;
  state.force = size > limit ? Vec3(trial * (limit / size)) : trial;
  state.stiffness = stiffness;
  state.energy = 0.5 * state.force.dot(normal.shear.solve(state.force));
  const double work = -0.5 * (old + state.force).dot(step.displacement);
  return before + work - state.energy;
}

}  // namespace tangency::dem
