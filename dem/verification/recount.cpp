// SPDX-License-Identifier: MIT
#include <tangency/dem/verification/recount.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Of one particle.
struct Borne {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double sizes = 0.0, levers = 0.0;  ///< of the forces, and of them times the arms
  std::int32_t contacts = 0;
};

struct Recount {
  std::int64_t contacts = 0;
  double push = 0.0, pushes = 0.0, overlap = 0.0, energy = 0.0;
  Mat3 force_branch = Mat3::Zero();
  double force_branches = 0.0;  ///< of the sizes
  std::vector<Borne> borne;
};

std::string text(double x) { return tables::to_text(x); }

/// Two numbers of one thing.
class Comparison {
 public:
  /// @param sizes  of what was added
  void compare(const char* what, double run, double again, double sizes) {
    if (difference_ || std::abs(run - again) <= kRecountError * sizes) return;
    difference_ = std::string("the run has ") + what + " = " + text(run) +
                  "; counted again it is " + text(again);
  }
  void compare(const std::string& what, const Vec3& run, const Vec3& again, double sizes) {
    if (difference_ || (run - again).norm() <= kRecountError * sizes) return;
    difference_ = "the run has a " + what + " of " + text(run.norm()) +
                  "; counted again it is another, of " + text(again.norm());
  }
  void require(bool holds, const std::string& what) {
    if (!difference_ && !holds) difference_ = what;
  }
  const std::optional<std::string>& difference() const { return difference_; }

 private:
  std::optional<std::string> difference_;
};

std::string pair_text(const State& state, const Pair& pair) {
  const auto id = [&](std::int32_t i) {
    return std::to_string(state.particles.id[static_cast<std::size_t>(i)]);
  };
  const auto count = static_cast<std::int32_t>(state.particles.size());
  return "particle " + id(pair.a) + " and " +
         (pair.b < count ? id(pair.b) : "wall " + std::to_string(pair.b - count));
}

void add_to(Borne& body, const Vec3& force, const Vec3& arm) {
  body.force += force;
  body.moment += arm.cross(force);
  body.sizes += force.norm();
  body.levers += arm.norm() * force.norm();
  ++body.contacts;
}

Recount counted_again(const State& state, Comparison& comparison) {
  Recount sum;
  const std::size_t count = state.particles.size();
  sum.borne.resize(count);
  for (std::size_t k = 0; k < state.list.pairs().size(); ++k) {
    const Pair& pair = state.list.pairs()[k];
    const Contact contact = state.contacts.records()[k];
    if (!contact.touches()) {
      comparison.require(contact.force.isZero(0.0) && contact.normal_energy == 0.0,
                         "the run has " + pair_text(state, pair) + " apart with a force of " +
                             text(contact.force.norm()));
      continue;
    }
    const Vec3 force = contact.normal_force * contact.normal + contact.shear.force;
    ++sum.contacts;
    sum.push += contact.normal_force;
    sum.pushes += std::abs(contact.normal_force);
    sum.overlap += contact.overlap;
    sum.energy += contact.normal_energy + contact.shear.energy;
    sum.force_branch += force * contact.branch.transpose();
    sum.force_branches += force.norm() * contact.branch.norm();
    add_to(sum.borne[static_cast<std::size_t>(pair.a)], -force, contact.arm);
    if (static_cast<std::size_t>(pair.b) < count)
      add_to(sum.borne[static_cast<std::size_t>(pair.b)], force, contact.arm - contact.branch);
  }
  return sum;
}

void compare_contacts(const Observation& seen, const Recount& again, const State& state,
                      Comparison& comparison) {
  const auto count = static_cast<double>(again.contacts);
  const auto bodies = static_cast<double>(state.particles.size());
  comparison.compare("contacts", static_cast<double>(seen.contacts), count, 0.0);
  const double mean = 2.0 * count / bodies;
  comparison.compare("coordination_number", seen.coordination_number, mean, mean);
  double squares = 0.0;
  for (const Borne& body : again.borne) squares += (body.contacts - mean) * (body.contacts - mean);
  const double spread = std::sqrt(squares / bodies);
  comparison.compare("coordination_std", seen.coordination_std, spread, mean);
  const double each = again.contacts > 0 ? 1.0 / count : 0.0;
  comparison.compare("mean_normal_force", seen.mean_normal_force, each * again.push,
                     each * again.pushes);
  comparison.compare("mean_overlap", seen.mean_overlap, each * again.overlap, each * again.overlap);
  comparison.compare("elastic_energy", seen.elastic_energy, again.energy, again.energy);
  const double volume = std::abs(state.cell.edges.determinant());
  const Mat3 stress = (again.force_branch + again.force_branch.transpose()) / (2.0 * volume);
  static constexpr const char* kNames[3][3] = {
      {"s_xx", "s_xy", "s_zx"}, {"s_xy", "s_yy", "s_yz"}, {"s_zx", "s_yz", "s_zz"}};
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k)
      comparison.compare(kNames[i][k], seen.stress.tensor(i, k), stress(i, k),
                         again.force_branches / volume);
}

void compare_particles(const Observation& seen, const Recount& again, const State& state,
                       Comparison& comparison) {
  const Particles& particles = state.particles;
  const Resultants& resultants = state.contacts.resultants();
  double solid = 0.0, kinetic = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3& axes = particles.semi_axes[i];
    solid += std::numbers::pi * axes[0] * axes[1] *
             (particles.dimensions == 2 ? 1.0 : 4.0 / 3.0 * axes[2]);
    const Vec3 spin = particles.orientation[i].conjugate() * particles.angular_velocity[i];
    const Vec3 inertia = principal_inertia(particles.mass[i], axes, particles.dimensions);
    kinetic += 0.5 * particles.mass[i] * particles.velocity[i].squaredNorm() +
               0.5 * inertia.dot(spin.cwiseAbs2());
    const Borne& body = again.borne[i];
    const std::string of = " on particle " + std::to_string(particles.id[i]);
    comparison.compare("force" + of, resultants.force[i], body.force, body.sizes);
    comparison.compare("moment" + of, resultants.moment[i], body.moment, body.levers);
    comparison.require(resultants.contacts[i] == body.contacts,
                       "the run has " + std::to_string(resultants.contacts[i]) + " contacts" + of +
                           "; counted again there are " + std::to_string(body.contacts));
  }
  const double volume = std::abs(state.cell.edges.determinant());
  comparison.compare("porosity", seen.porosity, 1.0 - solid / volume, 1.0 + solid / volume);
  comparison.compare("kinetic_energy", seen.kinetic_energy, kinetic, kinetic);
}

void compare_laws(const Simulation& simulation, Comparison& comparison) {
  const State& state = simulation.state();
  const ContactLaws& laws = simulation.laws();
  const auto type_of = [&](std::int32_t body) {
    const auto i = static_cast<std::size_t>(body);
    return i < state.particles.size() ? static_cast<std::size_t>(state.particles.type[i])
                                      : laws.types - 1;
  };
  for (std::size_t k = 0; k < state.list.pairs().size(); ++k) {
    const Contact contact = state.contacts.records()[k];
    if (!contact.touches()) continue;
    const Pair& pair = state.list.pairs()[k];
    const ContactLaw& law = laws.between(type_of(pair.a), type_of(pair.b));
    const double push = contact.normal_force, by_law = law.normal_stiffness * contact.overlap;
    if (!law.hertz && !law.dissipates())
      comparison.require(std::abs(push - by_law) <= kRecountError * by_law,
                         "the run has " + pair_text(state, pair) + " push each other by " +
                             text(push) + "; stiffness times overlap is " + text(by_law));
    const double most = law.bears_shear() ? law.cohesion + law.friction_coefficient * push : 0.0;
    const double shear = contact.shear.force.norm();
    comparison.require(shear <= (1.0 + kRecountError) * most,
                       "the run has a shear force of " + text(shear) + " between " +
                           pair_text(state, pair) + "; friction bears at most " + text(most));
  }
}

}  // namespace

std::optional<std::string> difference_from_recount(const Simulation& simulation, bool with_laws) {
  const State& state = simulation.state();
  const Observation seen = simulation.observe();
  Comparison comparison;
  const Recount again = counted_again(state, comparison);
  compare_contacts(seen, again, state, comparison);
  compare_particles(seen, again, state, comparison);
  if (with_laws) compare_laws(simulation, comparison);
  return comparison.difference();
}

}  // namespace tangency::inline v0::dem
