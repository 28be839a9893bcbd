// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/contact_arrays.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "require_length.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

void require_finite(const char* name, std::span<const Vec3> vectors) {
  for (std::size_t c = 0; c < vectors.size(); ++c)
    if (!vectors[c].allFinite())
      refuse(std::string(name) + "[" + std::to_string(c) + "]: must be finite");
}

void require_bodies(const ContactArrays& contacts) {
  if (contacts.bodies.empty() && contacts.size() > 0) refuse("bodies: needed, and empty");
}

void require_arm(const ContactArrays& contacts) {
  if (contacts.arm.empty() && contacts.size() > 0) refuse("arm: needed, and empty");
}

}  // namespace

void require_sound(const ContactArrays& contacts) {
  const std::size_t count = contacts.size();
  if (contacts.dimensions != 2 && contacts.dimensions != 3)
    refuse("dimensions = " + std::to_string(contacts.dimensions) + ": must be 2 or 3");
  if (!(contacts.volume > 0.0) || !std::isfinite(contacts.volume))
    refuse("volume = " + std::to_string(contacts.volume) + ": must be > 0 and finite");
  require_length("branch", contacts.branch.size(), count, "normals");
  require_length("force", contacts.force.size(), count, "normals");
  if (!contacts.arm.empty()) require_length("arm", contacts.arm.size(), count, "normals");
  if (!contacts.bodies.empty()) require_length("bodies", contacts.bodies.size(), count, "normals");
  require_finite("normal", contacts.normal);
  require_finite("branch", contacts.branch);
  require_finite("force", contacts.force);
  require_finite("arm", contacts.arm);
  for (std::size_t c = 0; c < count; ++c) {
    const Vec3& n = contacts.normal[c];
    if (!(std::abs(n.norm() - 1.0) <= kUnitTolerance))
      refuse("normal[" + std::to_string(c) + "]: length " + std::to_string(n.norm()) +
             ": must be 1");
    if (contacts.dimensions == 2 && n[2] != 0.0)
      refuse("normal[" + std::to_string(c) + "]: z must be 0 in the plane");
  }
  for (std::size_t c = 0; c < contacts.bodies.size(); ++c)
    for (const std::int64_t body : contacts.bodies[c])
      if (body < 0 || body >= contacts.particles)
        refuse("bodies[" + std::to_string(c) + "] = " + std::to_string(body) + ", and there are " +
               std::to_string(contacts.particles) + " particles");
}

void require_sound(const BodyArrays& bodies, std::int64_t particles, int dimensions) {
  const auto count = static_cast<std::size_t>(particles);
  require_length("orientation", bodies.orientation.size(), count, "particles");
  require_length("semi_axes", bodies.semi_axes.size(), count, "particles");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string place = "[" + std::to_string(i) + "]";
    const Quaternion& q = bodies.orientation[i];
    if (!(std::abs(q.norm() - 1.0) <= kUnitTolerance))
      refuse("orientation" + place + ": length " + std::to_string(q.norm()) + ": must be 1");
    if (dimensions == 2 &&
        !(std::abs((q.normalized() * Vec3(Vec3::UnitZ()))[2]) >= 1.0 - kUprightTolerance))
      refuse("orientation" + place + ": body axis 2 must be that of z in the plane");
    for (const double r : bodies.semi_axes[i])
      if (!(r > 0.0) || !std::isfinite(r))
        refuse("semi_axes" + place + ": " + std::to_string(r) + ": must be finite and > 0");
  }
}

void require_sound(const ContactArrays& contacts, const BodyArrays& bodies) {
  require_sound(contacts);
  require_sound(bodies, contacts.particles, contacts.dimensions);
  require_bodies(contacts);
  require_arm(contacts);
}

Mat3 stress_of(const ContactArrays& contacts) {
  require_sound(contacts);
  Mat3 sum = Mat3::Zero();
  for (std::size_t c = 0; c < contacts.size(); ++c)
    sum += contacts.force[c] * contacts.branch[c].transpose();
  return sum / contacts.volume;
}

double stress_asymmetry(const Mat3& stress, int dimensions) {
  const double mean = stress.trace() / dimensions;
  if (mean == 0.0) return kNotDefined;
  return (stress - stress.transpose()).norm() / std::abs(mean);
}

double contact_density(const ContactArrays& contacts) {
  require_sound(contacts);
  return 2.0 * static_cast<double>(contacts.size()) / contacts.volume;
}

Coordination coordination_of(const ContactArrays& contacts) {
  require_sound(contacts);
  require_bodies(contacts);
  if (contacts.particles < 1)
    refuse("particles = " + std::to_string(contacts.particles) + ": must be at least 1");
  std::vector<std::int64_t> of(static_cast<std::size_t>(contacts.particles), 0);
  for (const auto& pair : contacts.bodies)
    for (const std::int64_t body : pair) ++of[static_cast<std::size_t>(body)];
  Coordination found;
  found.histogram.resize(static_cast<std::size_t>(*std::ranges::max_element(of)) + 1, 0);
  for (const std::int64_t count : of) ++found.histogram[static_cast<std::size_t>(count)];
  const auto particles = static_cast<double>(contacts.particles);
  found.mean = 2.0 * static_cast<double>(contacts.bodies.size()) / particles;
  double second = 0.0, third = 0.0, fourth = 0.0;
  for (std::size_t count = 0; count < found.histogram.size(); ++count) {
    const double off = static_cast<double>(count) - found.mean;
    const double share = static_cast<double>(found.histogram[count]) / particles;
    second += share * off * off;
    third += share * off * off * off;
    fourth += share * off * off * off * off;
  }
  found.deviation = std::sqrt(second);
  found.skewness = second > 0.0 ? third / (second * found.deviation) : kNotDefined;
  found.excess_kurtosis = second > 0.0 ? fourth / (second * second) - 3.0 : kNotDefined;
  return found;
}

std::vector<Vec3> contact_vectors(const ContactArrays& contacts,
                                  std::span<const Quaternion> orientation) {
  require_sound(contacts);
  require_arm(contacts);
  if (!orientation.empty()) {
    require_bodies(contacts);
    require_length("orientation", orientation.size(), static_cast<std::size_t>(contacts.particles),
                   "particles");
  }
  std::vector<Vec3> vectors;
  vectors.reserve(2 * contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const bool of_b : {false, true}) {
      Vec3 unit = contacts.lever(c, of_b).normalized();
      if (!orientation.empty()) {
        const auto body = static_cast<std::size_t>(contacts.bodies[c][of_b ? 1 : 0]);
        unit = orientation[body].normalized().conjugate() * unit;
      }
      vectors.push_back(unit);
    }
  return vectors;
}

}  // namespace tangency::inline v0::micromechanics
