// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include <tangency/dem/lanes/particle_lanes.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/dem/lanes/motion_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tangency/dem/lanes/particle_packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

/// Part `axis` of a body that turns freely, by `half` of an angle: q <- q (c + s e_axis), and the
/// momentum, fixed in space, back by the whole angle. Names are those of axis 0.
HWY_INLINE void turn_about(const Pack& half, Pack& w, Pack& x, Pack& y, Pack& z, Pack& next,
                           Pack& last) {
  const PackAngle a = cosine_sine(half);
  const Pack c = a.cosine, s = a.sine, w0 = w, x0 = x, y0 = y, z0 = z;
  w = w0 * c - x0 * s;
  x = w0 * s + x0 * c;
  y = y0 * c + z0 * s;
  z = z0 * c - y0 * s;
  const Pack sine = (s + s) * c, cosine = all(1.0) - (s + s) * s;
  const Pack next0 = next, last0 = last;
  next = cosine * next0 + sine * last0;
  last = cosine * last0 - sine * next0;
}

/// About the axes 1, 2, 3, 2, 1 for dt/2, dt/2, dt, dt/2, dt/2, each turn exact [Dullweber1997].
/// @param momentum  in body axes
HWY_INLINE void turn_freely(PackQuaternion& q, PackVec3& momentum, const PackVec3& inverse_inertia,
                            double dt) {
  const PackVec3 share = inverse_inertia * all(0.25 * dt);
  PackVec3& l = momentum;
  turn_about(share.x * l.x, q.w, q.x, q.y, q.z, l.y, l.z);
  turn_about(share.y * l.y, q.w, q.y, q.z, q.x, l.z, l.x);
  turn_about((share.z + share.z) * l.z, q.w, q.z, q.x, q.y, l.x, l.y);
  turn_about(share.y * l.y, q.w, q.y, q.z, q.x, l.z, l.x);
  turn_about(share.x * l.x, q.w, q.x, q.y, q.z, l.y, l.z);
}

/// Takes orientations and angular velocities a step on. Returns what damping took over dt times the
/// larger damping, where there is any.
HWY_INLINE Pack turn(const ParticleColumns& c, const MovedColumns& moved, const MotionStep& step,
                     std::size_t at, PackMask& finite) {
  const PackVec3 axes = load_vectors(c.semi_axes + 3 * at);
  const PackInertia inertia = inertia_of(load(c.mass + at), axes, c.is_plane);
  const PackQuaternion q = load_quaternions(c.orientation + 4 * at);
  const PackRotation rotation(q);
  const PackVec3 moment = rotation.to_body(load_vectors(c.moment + 3 * at));
  const PackVec3 before = load_vectors(c.angular_velocity + 3 * at);
  const PackVec3 acceleration = rotation.to_space(times(moment, inertia.inverse));
  PackVec3 spin = before * all(step.of_turn.keep) + acceleration * all(step.of_turn.push);
  Pack lost = all(0.0);
  if (step.damping != 0.0) {
    const PackVec3 mean = rotation.to_body((before + spin) * all(0.5));
    lost = unfused_dot(inertia.moments, times(mean, mean)) * all(step.of_turn.share);
  }
  // A body whose quadratic terms are 0 takes the simplified equations.
  const PackMask is_shaped =
      (axes.x < axes.y) | (axes.x > axes.y) | (axes.y < axes.z) | (axes.y > axes.z);
  const PackMask is_sphere = without(axes.x > all(0.0), is_shaped);
  const bool is_full = step.is_full && !c.is_plane;
  const bool all_full = is_full && none(is_sphere), any_full = is_full && !none(is_shaped);
  PackQuaternion turned = q;
  if (!all_full) turned = turn_by(spin * all(step.dt)) * q;
  if (any_full) {
    PackQuaternion freely = q;
    PackVec3 momentum = times(inertia.moments, rotation.to_body(spin));
    turn_freely(freely, momentum, inertia.inverse, step.dt);
    turned = all_full ? freely : chosen(is_sphere, turned, freely);
    turned = normalised(turned);
    const PackVec3 in_space = PackRotation(turned).to_space(times(momentum, inertia.inverse));
    spin = all_full ? in_space : chosen(is_sphere, spin, in_space);
  } else {
    turned = normalised(turned);
  }
  store(turned, moved.orientation + 4 * at);
  store(spin, moved.angular_velocity + 3 * at);
  const Pack sum =
      absolute(turned.w) + absolute(turned.x) + absolute(turned.y) + absolute(turned.z);
  finite = finite & (sum <= all(4.0));
  return lost;
}

/// The same of positions and velocities.
HWY_INLINE Pack shift(const ParticleColumns& c, const MovedColumns& moved, const MotionStep& step,
                      std::size_t at, Pack& fallen, PackMask& finite) {
  const Pack mass = load(c.mass + at);
  const PackVec3 before = load_vectors(c.velocity + 3 * at);
  const PackVec3 force = load_vectors(c.force + 3 * at);
  const double *g = step.gravity, *r = step.rate;
  const PackVec3 gravity{all(g[0]), all(g[1]), all(g[2])};
  const PackVec3 velocity = before * all(step.of_shift.keep) +
                            force * (all(step.of_shift.push) / mass) +
                            gravity * all(step.of_shift.push);
  const PackVec3 mean = (before + velocity) * all(0.5);
  const PackVec3 x = load_vectors(moved.position + 3 * at);
  const PackVec3 affine{unfused_dot({all(r[0]), all(r[1]), all(r[2])}, x),
                        unfused_dot({all(r[3]), all(r[4]), all(r[5])}, x),
                        unfused_dot({all(r[6]), all(r[7]), all(r[8])}, x)};
  const PackVec3 there = x + (velocity + affine) * all(step.dt);
  store(velocity, moved.velocity + 3 * at);
  store(there, moved.position + 3 * at);
  fallen = mass * unfused_dot(gravity, velocity);
  // A sum, since the larger of a NaN and a number may be the number.
  finite = (absolute(there.x) + absolute(there.y) + absolute(there.z)) <= all(__DBL_MAX__);
  return mass * unfused_dot(mean, mean) * all(step.of_shift.share);
}

HWY_ATTR MovedSum move_lanes(const ParticleColumns& columns, const MovedColumns& moved,
                             const MotionStep& step, std::size_t first, std::size_t last) {
  double lost[dem::kChunk + kMostLanes], fallen[dem::kChunk + kMostLanes];
  PackMask all_finite = all(0.0) <= all(0.0);
  for_each_pack(columns, moved, first, last,
                [&](const ParticleColumns& c, const MovedColumns& m, std::size_t at, std::size_t k)
                    HWY_ATTR {
                      Pack weight;
                      PackMask finite;
                      Pack slowed = shift(c, m, step, at, weight, finite);
                      if (step.turns) slowed = slowed + turn(c, m, step, at, finite);
                      store(slowed, lost + k);
                      store(weight, fallen + k);
                      all_finite = all_finite & finite;
                    });
  MovedSum sum;
  sum.blown_up = bits(all_finite) != (std::uint64_t{1} << pack_lanes()) - 1;
  for (std::size_t k = 0; k < last - first; ++k) {
    sum.damping += lost[k];
    sum.gravity += fallen[k];
  }
  sum.damping *= step.dt * step.damping;
  sum.gravity *= step.dt;
  return sum;
}

HWY_ATTR void cosine_sine_lanes(const double* angle, double* cosine, double* sine,
                                std::size_t count) {
  double angles[dem::kChunk + kMostLanes] = {}, cosines[dem::kChunk + kMostLanes],
                              sines[dem::kChunk + kMostLanes];
  for (std::size_t k = 0; k < count; ++k) angles[k] = angle[k];
  for (std::size_t k = 0; k < count; k += pack_lanes()) {
    const PackAngle turned = cosine_sine(load(angles + k));
    store(turned.cosine, cosines + k);
    store(turned.sine, sines + k);
  }
  for (std::size_t k = 0; k < count; ++k) {
    cosine[k] = cosines[k];
    sine[k] = sines[k];
  }
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(move_lanes);
HWY_EXPORT(cosine_sine_lanes);
}  // namespace

MovedSum move_lanes(const ParticleColumns& columns, const MovedColumns& moved,
                    const MotionStep& step, std::size_t first, std::size_t last) noexcept {
  return HWY_DYNAMIC_DISPATCH(move_lanes)(columns, moved, step, first, last);
}

void cosine_sine_lanes(const double* angle, double* cosine, double* sine,
                       std::size_t count) noexcept {
  HWY_DYNAMIC_DISPATCH(cosine_sine_lanes)(angle, cosine, sine, count);
}

}  // namespace tangency::inline v0::detail
#endif
