// SPDX-License-Identifier: MIT
#include <tangency/dem/fire.hpp>

#include <cmath>
#include <vector>

#include <tangency/dem/contacts.hpp>
#include <tangency/dem/parallel.hpp>

namespace tangency::dem {
namespace {

// The published values [Bitzek2006].
/// alpha_start: the mixing at the start of a stretch downhill.
constexpr double kStartMixing = 0.1;
/// f_alpha: the mixing's factor a cycle once the stretch has lasted.
constexpr double kMixingDecay = 0.99;
/// N_min: cycles after which it has.
constexpr std::int64_t kLeastDownhill = 5;

/// Accelerations by contacts and gravity, shift and turn, in space.
struct Acceleration {
  Vec3 shift, turn = Vec3::Zero();
};

/// Scalar products of velocities v and accelerations a, weighted by inertia.
struct Products {
  double vv = 0.0, va = 0.0, aa = 0.0;
};

Acceleration acceleration_of(const Particles& particles, std::size_t i,
                             const Resultants& resultants, const Motion& motion) {
  Acceleration a{resultants.force[i] / particles.mass[i] + motion.gravity};
  if (motion.rotation == Rotation::none) return a;
  const Vec3 inertia =
      principal_inertia(particles.mass[i], particles.semi_axes[i], particles.dimensions);
  const Mat3 axes = particles.orientation[i].toRotationMatrix();
  a.turn = axes * (axes.transpose() * resultants.moment[i]).cwiseQuotient(inertia);
  return a;
}

Products products_of(const Particles& particles, std::size_t i, const Acceleration& a,
                     const Resultants& resultants, const Motion& motion) {
  const double mass = particles.mass[i];
  const Vec3& velocity = particles.velocity[i];
  Products sum{mass * velocity.squaredNorm(), mass * velocity.dot(a.shift),
               mass * a.shift.squaredNorm()};
  if (motion.rotation == Rotation::none) return sum;
  const Vec3 inertia = principal_inertia(mass, particles.semi_axes[i], particles.dimensions);
  const Vec3& spin = particles.angular_velocity[i];
  const Vec3 in_body = particles.orientation[i].conjugate() * spin;
  sum.vv += inertia.dot(in_body.cwiseAbs2());
  sum.va += resultants.moment[i].dot(spin);
  sum.aa += resultants.moment[i].dot(a.turn);
  return sum;
}

double energy_at(const Products& p, double dt) { return 0.5 * p.vv + 0.5 * dt * p.va; }

}  // namespace

double Fire::steer(Particles& particles, const Resultants& resultants, const Motion& motion,
                   double dt) {
  const std::size_t count = particles.size();
  std::vector<Acceleration> a(count);
  std::vector<Products> products(count);
  for_ranges(count, kParallelThreshold, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      a[i] = acceleration_of(particles, i, resultants, motion);
      products[i] = products_of(particles, i, a[i], resultants, motion);
    }
  });
  Products sum;
  for (const Products& one : products) {
    sum.vv += one.vv;
    sum.va += one.va;
    sum.aa += one.aa;
  }
  const bool runs_downhill = sum.va > 0.0;
  if (!runs_downhill) *this = {kStartMixing, 0};
  const double keep = runs_downhill ? 1.0 - mixing : 0.0;
  const double push = runs_downhill ? mixing * std::sqrt(sum.vv / sum.aa) : 0.0;
  for_ranges(count, kParallelThreshold, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      particles.velocity[i] = keep * particles.velocity[i] + push * a[i].shift;
      if (motion.rotation != Rotation::none)
        particles.angular_velocity[i] = keep * particles.angular_velocity[i] + push * a[i].turn;
    }
  });
  if (runs_downhill && ++downhill > kLeastDownhill) mixing *= kMixingDecay;
  const Products after{keep * keep * sum.vv + 2.0 * keep * push * sum.va + push * push * sum.aa,
                       keep * sum.va + push * sum.aa, sum.aa};
  return energy_at(sum, dt) - energy_at(after, dt);
}

}  // namespace tangency::dem
