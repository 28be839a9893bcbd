// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <tangency/dem/motion.hpp>

namespace tangency::dem {
namespace {

/// Below so many particles the loop is over before a second thread has woken up: contacts.cpp.
constexpr std::size_t worth_sharing = 400;

}  // namespace

Eigen::Quaterniond turned_by(const Eigen::Quaterniond& q, const Vec3& rotation_vector) {
  const double half = 0.5 * rotation_vector.norm();
  // sin(x)/x differs from 1 by less than half an ulp below 1e-8.
  const double sinc = half > 1e-8 ? std::sin(half) / half : 1.0;
  Eigen::Quaterniond turn;
  turn.w() = std::cos(half);
  turn.vec() = (0.5 * sinc) * rotation_vector;
  return (turn * q).normalized();
}

double characteristic_time(const Particles& particles, double largest_stiffness) {
  const double lightest = *std::min_element(particles.mass.begin(), particles.mass.end());
  return std::sqrt(lightest / largest_stiffness);
}

void move(Particles& particles, Cell& cell, const Resultants& resultants, double damping,
          double dt) {
  const double keep = (1.0 - 0.5 * damping * dt) / (1.0 + 0.5 * damping * dt);
  const double push = dt / (1.0 + 0.5 * damping * dt);
  bool finite = true;
  const std::size_t count = particles.size();
#pragma omp parallel for schedule(static) reduction(&& : finite) if (count >= worth_sharing)
  for (std::size_t i = 0; i < count; ++i) {
    Vec3& velocity = particles.velocity[i];
    Vec3& spin = particles.angular_velocity[i];
    Eigen::Quaterniond& axes = particles.orientation[i];
    velocity = keep * velocity + (push / particles.mass[i]) * resultants.force[i];

    const Vec3 inertia =
        principal_inertia(particles.mass[i], particles.semi_axes[i], particles.dimensions);
    const Vec3 moment = axes.conjugate() * resultants.moment[i];
    spin = keep * spin + push * (axes * moment.cwiseQuotient(inertia));

    Vec3& x = particles.position[i];
    x += dt * (velocity + cell.rate.cwiseProduct(x));
    axes = turned_by(axes, dt * spin);
    finite = finite && x.allFinite() && axes.coeffs().allFinite();
  }
  cell.strain(dt);
  if (!finite || !(cell.length.minCoeff() > 0.0))
    throw Diverged("the run blew up: a particle's velocity is no longer finite");
}

}  // namespace tangency::dem
