// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/contact_fields.hpp>

#include <cstdint>
#include <utility>

#include <tangency/dem/micromechanics/average_strain.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0::dem {
namespace {

Ellipsoid body_at_origin(const PackingParticles& particles, std::int64_t id) {
  const auto i = static_cast<std::size_t>(id);
  return Ellipsoid(Vec3::Zero(), particles.semi_axes[i], particles.orientation[i]);
}

/// Of the outline of a disk where its normal is n: h^3 / (a b)^2, h the support function.
double outline_curvature(const PackingParticles& particles, std::int64_t id, const Vec3& normal) {
  const auto i = static_cast<std::size_t>(id);
  const Vec3 in_body = particles.orientation[i].conjugate() * normal;
  const Vec2 axes = particles.semi_axes[i].head<2>();
  const double support = axes.cwiseProduct(in_body.head<2>()).norm();
  const double area = axes.prod();
  return support * support * support / (area * area);
}

}  // namespace

Vec3 shear_force(const PackingContacts& contacts, std::size_t contact) {
  return contacts.force[contact] - contacts.normal_force[contact] * contacts.normal[contact];
}

std::vector<Vec3> contact_velocities(const Packing& packing, const Cell& cell) {
  namespace mm = micromechanics;
  const PackingParticles& particles = packing.particles;
  const PackingContacts& contacts = packing.contacts;
  return mm::contact_velocities(mm::ContactMotion{{contacts.bodies, contacts.image},
                                                  contacts.normal,
                                                  contacts.arm,
                                                  {},
                                                  particles.velocity,
                                                  particles.angular_velocity,
                                                  cell.rate},
                                {particles.position, packing.edges, packing.dimensions});
}

std::array<double, 2> relative_curvatures(const Packing& packing, std::size_t contact) {
  const auto& [a, b] = packing.contacts.bodies[contact];
  const Vec3& normal = packing.contacts.normal[contact];
  const PackingParticles& particles = packing.particles;
  if (packing.dimensions == 2)
    return {0.0, outline_curvature(particles, a, normal) + outline_curvature(particles, b, normal)};
  const PrincipalCurvatures relative =
      contact_curvature(body_at_origin(particles, a), body_at_origin(particles, b), normal)
          .relative;
  return {relative.curvature[1], relative.curvature[0]};
}

std::vector<Mat3> particle_stresses(const State& state) {
  const Particles& particles = state.particles;
  std::vector<Mat3> stress(particles.size(), Mat3::Zero());
  const auto of = [&](std::size_t i) -> Mat3& {
    return stress[static_cast<std::size_t>(particles.id[i])];
  };
  const std::vector<Pair>& pairs = state.list.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!state.contacts.touches(k)) continue;
    const Contact contact = state.contacts.records()[k];
    const auto a = static_cast<std::size_t>(pairs[k].a), b = static_cast<std::size_t>(pairs[k].b);
    if (b >= particles.size()) {
      of(a) += contact.force * contact.branch.transpose();
      continue;
    }
    of(a) += contact.force * contact.arm.transpose();
    of(b) += contact.force * (contact.branch - contact.arm).transpose();
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Mat3 sum = of(i);
    of(i) = 0.5 / volume_of(particles.semi_axes[i], particles.dimensions) * (sum + sum.transpose());
  }
  return stress;
}

}  // namespace tangency::inline v0::dem
