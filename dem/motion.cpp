// SPDX-License-Identifier: MIT
#include <tangency/dem/motion.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include <tangency/dem/parallel.hpp>

namespace tangency::dem {
namespace {

/// How velocities go over a step: v <- keep v + push (force / mass).
struct Step {
  double keep, push;
  Step(double damping, double dt)
      : keep((1.0 - 0.5 * damping * dt) / (1.0 + 0.5 * damping * dt)),
        push(dt / (1.0 + 0.5 * damping * dt)) {}
};

/// Turns a free body for a time dt: q and the angular momentum in body axes, which stays fixed in
/// space. About the axes 1, 2, 3, 2, 1 for dt/2, dt/2, dt, dt/2, dt/2, each turn exact
/// [Dullweber1997].
void turn_freely(Quaternion& q, Vec3& momentum, const Vec3& inertia, double dt) {
  const Vec3 half_angle_per_momentum = 0.5 * dt * inertia.cwiseInverse();
  for (const int axis : {0, 1, 2, 1, 0}) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double share = axis == 2 ? 1.0 : 0.5;
    const double half = share * half_angle_per_momentum[axis] * momentum[axis];
    const double c = std::cos(half), s = std::sin(half);
    // q <- q (c + s e_axis)
    const double w = q.w(), x = q.vec()[axis], y = q.vec()[next], z = q.vec()[last];
    q.w() = w * c - x * s;
    q.vec()[axis] = w * s + x * c;
    q.vec()[next] = y * c + z * s;
    q.vec()[last] = z * c - y * s;
    // momentum <- turned back by the whole angle
    const double sine = 2.0 * s * c, cosine = 1.0 - 2.0 * s * s;
    const double along_next = momentum[next];
    momentum[next] = cosine * along_next + sine * momentum[last];
    momentum[last] = cosine * momentum[last] - sine * along_next;
  }
  q.normalize();
}

bool is_free_of_quadratic_terms(const Particles& particles, std::size_t i) {
  const Vec3& axes = particles.semi_axes[i];
  return particles.dimensions == 2 || (axes[0] == axes[1] && axes[1] == axes[2]);
}

/// One particle's rotation. Returns what damping took.
double turn(Particles& particles, std::size_t i, const Vec3& moment_in_space, const Motion& motion,
            double dt) {
  const auto [keep, push] = Step(motion.damping, dt);
  Quaternion& q = particles.orientation[i];
  Vec3& spin = particles.angular_velocity[i];
  const Vec3 inertia =
      principal_inertia(particles.mass[i], particles.semi_axes[i], particles.dimensions);
  const Mat3 axes = q.toRotationMatrix();
  const Vec3 moment = axes.transpose() * moment_in_space;
  const Vec3 before = spin;
  spin = keep * spin + push * (axes * moment.cwiseQuotient(inertia));
  const Vec3 mean = axes.transpose() * (0.5 * (before + spin));
  if (motion.rotation == Rotation::full && !is_free_of_quadratic_terms(particles, i)) {
    Vec3 momentum = inertia.cwiseProduct(axes.transpose() * spin);
    turn_freely(q, momentum, inertia, dt);
    spin = q.toRotationMatrix() * momentum.cwiseQuotient(inertia);
  } else {
    q = turned_by(q, dt * spin);
  }
  return dt * motion.damping * inertia.dot(mean.cwiseAbs2());
}

}  // namespace

Quaternion turned_by(const Quaternion& q, const Vec3& rotation_vector) {
  const double half = 0.5 * rotation_vector.norm();
  // sin(x)/x differs from 1 by less than half an ulp below 1e-8.
  const double sinc = half > 1e-8 ? std::sin(half) / half : 1.0;
  Quaternion turn;
  turn.w() = std::cos(half);
  turn.vec() = (0.5 * sinc) * rotation_vector;
  return (turn * q).normalized();
}

double characteristic_time(const Particles& particles, double largest_stiffness) {
  const double lightest = *std::min_element(particles.mass.begin(), particles.mass.end());
  return std::sqrt(lightest / largest_stiffness);
}

MotionWork move(Particles& particles, Cell& cell, const Resultants& resultants,
                const Motion& motion, double dt) {
  const auto [keep, push] = Step(motion.damping, dt);
  const std::size_t count = particles.size();
  std::vector<MotionWork> work(count);
  std::atomic<bool> finite = true;
  const auto move_one = [&](std::size_t i) {
    const double mass = particles.mass[i];
    Vec3& velocity = particles.velocity[i];
    const Vec3 before = velocity;
    velocity = keep * velocity + (push / mass) * resultants.force[i] + push * motion.gravity;
    const Vec3 mean = 0.5 * (before + velocity);
    work[i] = {dt * motion.damping * mass * mean.squaredNorm(),
               dt * mass * motion.gravity.dot(velocity)};
    Vec3& x = particles.position[i];
    x += dt * (velocity + cell.rate * x);
    if (motion.rotation != Rotation::none)
      work[i].damping += turn(particles, i, resultants.moment[i], motion, dt);
    if (!x.allFinite() || !particles.orientation[i].coeffs().allFinite()) finite = false;
  };
  for_ranges(count, kParallelThreshold, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) move_one(i);
  });
  cell.strain(dt);
  if (!finite || !(cell.volume() > 0.0))
    throw Diverged("the run blew up: a particle's velocity is no longer finite");
  MotionWork sum;
  for (const MotionWork& one : work) {
    sum.damping += one.damping;
    sum.gravity += one.gravity;
  }
  return sum;
}

double kinetic_energy_at(const Particles& particles, const Resultants& resultants,
                         const Motion& motion, double dt) {
  double power = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3& velocity = particles.velocity[i];
    power += (resultants.force[i] + particles.mass[i] * motion.gravity).dot(velocity);
    if (motion.rotation == Rotation::none) continue;
    power += resultants.moment[i].dot(particles.angular_velocity[i]);
  }
  return kinetic_energy(particles) + 0.5 * dt * power;
}

}  // namespace tangency::dem
