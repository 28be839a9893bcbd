// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/average_strain.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "require_length.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

const Vec3& of_body(std::span<const Vec3> vectors, std::int64_t body) {
  return vectors[static_cast<std::size_t>(body)];
}

void require_bodies(const StrainMesh& mesh, const char* name, std::size_t count) {
  for (const MeshEdge& edge : mesh.edges)
    if (static_cast<std::size_t>(std::max(edge.bodies[0], edge.bodies[1])) >= count)
      throw std::invalid_argument(std::string(name) + ": " + std::to_string(count) +
                                  " entries, and the net has more particles");
}

void require_sound(const ContactMotion& motion, const PeriodicCentres& centres) {
  require_sound(motion.contacts, centres);
  const std::size_t contacts = motion.contacts.size(), bodies = centres.position.size();
  require_length("normal", motion.normal.size(), contacts, "contacts");
  require_length("arm", motion.arm.size(), contacts, "contacts");
  if (!motion.sliding.empty())
    require_length("sliding", motion.sliding.size(), contacts, "contacts");
  require_length("velocity", motion.velocity.size(), bodies, "centres");
  require_length("spin", motion.spin.size(), bodies, "centres");
}

/// w_a x l_a - w_b x l_b
Vec3 by_rotation(const ContactMotion& motion, const PeriodicCentres& centres, std::size_t c) {
  const auto& [a, b] = motion.contacts.bodies[c];
  const Vec3& arm = motion.arm[c];
  const Vec3 of_b = arm - centres.branch(motion.contacts.bodies[c], motion.contacts.image[c]);
  return of_body(motion.spin, a).cross(arm) - of_body(motion.spin, b).cross(of_b);
}

/// 1 of a contact that is given as its edge is, -1 of one that is given the other way round.
double sense_of(const MeshEdge& edge, const PeriodicPairs& pairs, std::size_t pair) {
  return edge.bodies == pairs.bodies[pair] && edge.image == pairs.image[pair] ? 1.0 : -1.0;
}

}  // namespace

Mat3 gradient_of(const StrainMesh& mesh, std::span<const Vec3> difference) {
  require_length("difference", difference.size(), mesh.edges.size(), "edges");
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < difference.size(); ++i)
    sum += difference[i] * mesh.edges[i].area.transpose();
  return sum / mesh.volume;
}

std::vector<Vec3> velocity_differences(const StrainMesh& mesh, std::span<const Vec3> velocity,
                                       const Mat3& rate) {
  require_bodies(mesh, "velocity", velocity.size());
  std::vector<Vec3> difference;
  difference.reserve(mesh.edges.size());
  for (const MeshEdge& edge : mesh.edges)
    difference.push_back(of_body(velocity, edge.bodies[1]) - of_body(velocity, edge.bodies[0]) +
                         rate * edge.branch);
  return difference;
}

std::vector<Vec3> displacement_differences(const StrainMesh& mesh, const PeriodicCentres& later) {
  require_sound(later);
  if (later.dimensions != mesh.dimensions)
    throw std::invalid_argument("later.dimensions = " + std::to_string(later.dimensions) +
                                ", and the net has " + std::to_string(mesh.dimensions));
  require_bodies(mesh, "later.position", later.position.size());
  std::vector<Vec3> difference;
  difference.reserve(mesh.edges.size());
  for (const MeshEdge& edge : mesh.edges)
    difference.push_back(later.branch(edge.bodies, edge.image) - edge.branch);
  return difference;
}

Vec3 sliding_velocity(const Vec3& tangential, const Vec3& shear_force, double stiffness,
                      double limit_rate) {
  const double size = shear_force.norm();
  if (!(stiffness > 0.0)) return tangential;
  if (!(size > 0.0)) return Vec3::Zero();
  const Vec3 along = shear_force / size;
  const double excess = -stiffness * tangential.dot(along) - limit_rate;
  return excess > 0.0 ? Vec3(-(excess / stiffness) * along) : Vec3(Vec3::Zero());
}

std::vector<Vec3> contact_velocities(const ContactMotion& motion, const PeriodicCentres& centres) {
  require_sound(motion, centres);
  std::vector<Vec3> velocity;
  velocity.reserve(motion.contacts.size());
  for (std::size_t c = 0; c < motion.contacts.size(); ++c) {
    const auto& bodies = motion.contacts.bodies[c];
    velocity.push_back(of_body(motion.velocity, bodies[1]) - of_body(motion.velocity, bodies[0]) +
                       motion.rate * centres.branch(bodies, motion.contacts.image[c]) -
                       by_rotation(motion, centres, c));
  }
  return velocity;
}

StrainParts strain_parts(const StrainMesh& mesh, const PeriodicCentres& centres,
                         const ContactMotion& motion) {
  const std::vector<Vec3> at_contact = contact_velocities(motion, centres);
  const std::vector<Vec3> difference = velocity_differences(mesh, motion.velocity, motion.rate);
  const auto contact_of = pairs_of_edges(mesh, motion.contacts);
  StrainParts parts;
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    const MeshEdge& edge = mesh.edges[i];
    if (!contact_of[i]) {
      parts.apart += difference[i] * edge.area.transpose();
      continue;
    }
    const std::size_t c = *contact_of[i];
    const Vec3 area = sense_of(edge, motion.contacts, c) * edge.area;
    const Vec3& v = at_contact[c];
    const Vec3 along = motion.normal[c].dot(v) * motion.normal[c];
    const Vec3 sliding = motion.sliding.empty() ? Vec3(Vec3::Zero()) : motion.sliding[c];
    parts.normal += along * area.transpose();
    parts.sliding += sliding * area.transpose();
    parts.elastic += (v - along - sliding) * area.transpose();
    parts.rotation += by_rotation(motion, centres, c) * area.transpose();
    ++parts.edges_in_contact;
  }
  parts.contacts_left_out = motion.contacts.size() - parts.edges_in_contact;
  for (Mat3* part : {&parts.normal, &parts.elastic, &parts.sliding, &parts.rotation, &parts.apart})
    *part /= mesh.volume;
  return parts;
}

StrainOfEdges strain_of_edges(const StrainMesh& mesh, std::span<const Vec3> difference,
                              const PeriodicPairs& before, const PeriodicPairs& later) {
  require_length("difference", difference.size(), mesh.edges.size(), "edges");
  const auto touched = pairs_of_edges(mesh, before), touches = pairs_of_edges(mesh, later);
  StrainOfEdges parts;
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    StrainOfEdges::Part& part = touched[i] ? (touches[i] ? parts.kept : parts.lost)
                                           : (touches[i] ? parts.gained : parts.apart);
    part.gradient += difference[i] * mesh.edges[i].area.transpose() / mesh.volume;
    ++part.edges;
  }
  return parts;
}

}  // namespace tangency::inline v0::micromechanics
