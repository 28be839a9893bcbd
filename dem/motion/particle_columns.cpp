// SPDX-License-Identifier: MIT
#include <tangency/dem/motion/particle_columns.hpp>

#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Quaternion) == 4 * sizeof(double));

const double* start_of(const std::vector<double>& numbers) { return numbers.data(); }
const double* start_of(const std::vector<Vec3>& vectors) {
  return vectors.empty() ? nullptr : vectors.front().data();
}
const double* start_of(const std::vector<Quaternion>& quaternions) {
  return quaternions.empty() ? nullptr : quaternions.front().coeffs().data();
}
double* start_of(std::vector<Vec3>& vectors) {
  return vectors.empty() ? nullptr : vectors.front().data();
}
double* start_of(std::vector<Quaternion>& quaternions) {
  return quaternions.empty() ? nullptr : quaternions.front().coeffs().data();
}

}  // namespace

ParticleColumns columns_of(const dem::Particles& particles) {
  return {start_of(particles.velocity),
          start_of(particles.angular_velocity),
          start_of(particles.orientation),
          start_of(particles.semi_axes),
          start_of(particles.mass),
          nullptr,
          nullptr,
          particles.dimensions == 2};
}

ParticleColumns columns_of(const dem::Particles& particles, const dem::Resultants& resultants) {
  ParticleColumns columns = columns_of(particles);
  columns.force = start_of(resultants.force);
  columns.moment = start_of(resultants.moment);
  return columns;
}

MovedColumns moved_columns_of(dem::Particles& particles) {
  return {start_of(particles.position), start_of(particles.velocity),
          start_of(particles.angular_velocity), start_of(particles.orientation)};
}

}  // namespace tangency::inline v0::detail
