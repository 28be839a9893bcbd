// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/contact_arrays.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tangency::micromechanics {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

void require_length(const char* name, std::size_t length, std::size_t contacts) {
  if (length != contacts)
    refuse(std::string(name) + ": " + std::to_string(length) + " entries, and there are " +
           std::to_string(contacts) + " normals");
}

void require_finite(const char* name, std::span<const Vec3> vectors) {
  for (std::size_t c = 0; c < vectors.size(); ++c)
    if (!vectors[c].allFinite())
      refuse(std::string(name) + "[" + std::to_string(c) + "]: must be finite");
}

void require_bodies(const ContactArrays& contacts) {
  if (contacts.bodies.empty() && contacts.size() > 0) refuse("bodies: needed, and empty");
}

}  // namespace

void require_sound(const ContactArrays& contacts) {
  const std::size_t count = contacts.size();
  if (contacts.dimensions != 2 && contacts.dimensions != 3)
    refuse("dimensions = " + std::to_string(contacts.dimensions) + ": must be 2 or 3");
  if (!(contacts.volume > 0.0) || !std::isfinite(contacts.volume))
    refuse("volume = " + std::to_string(contacts.volume) + ": must be > 0 and finite");
  require_length("branch", contacts.branch.size(), count);
  require_length("force", contacts.force.size(), count);
  if (!contacts.arm.empty()) require_length("arm", contacts.arm.size(), count);
  if (!contacts.bodies.empty()) require_length("bodies", contacts.bodies.size(), count);
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

Mat3 stress_of(const ContactArrays& contacts) {
  require_sound(contacts);
  Mat3 sum = Mat3::Zero();
  for (std::size_t c = 0; c < contacts.size(); ++c)
    sum += contacts.force[c] * contacts.branch[c].transpose();
  return sum / contacts.volume;
}

double stress_asymmetry(const Mat3& stress, int dimensions) {
  const double mean = stress.trace() / dimensions;
  if (mean == 0.0) return std::numeric_limits<double>::quiet_NaN();
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
  const double none = std::numeric_limits<double>::quiet_NaN();
  found.skewness = second > 0.0 ? third / (second * found.deviation) : none;
  found.excess_kurtosis = second > 0.0 ? fourth / (second * second) - 3.0 : none;
  return found;
}

std::vector<Vec3> contact_vectors(const ContactArrays& contacts,
                                  std::span<const Quaternion> orientation) {
  require_sound(contacts);
  if (contacts.arm.empty() && contacts.size() > 0) refuse("arm: needed, and empty");
  if (!orientation.empty()) {
    require_bodies(contacts);
    if (static_cast<std::int64_t>(orientation.size()) != contacts.particles)
      refuse("orientation: " + std::to_string(orientation.size()) + " entries, and there are " +
             std::to_string(contacts.particles) + " particles");
  }
  std::vector<Vec3> vectors;
  vectors.reserve(2 * contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const Vec3 lever = side == 0 ? contacts.arm[c] : Vec3(contacts.arm[c] - contacts.branch[c]);
      Vec3 unit = lever.normalized();
      if (!orientation.empty()) {
        const auto body = static_cast<std::size_t>(contacts.bodies[c][side]);
        unit = orientation[body].conjugate() * unit;
      }
      vectors.push_back(unit);
    }
  return vectors;
}

}  // namespace tangency::micromechanics
