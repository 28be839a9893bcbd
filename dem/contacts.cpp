// SPDX-License-Identifier: MIT
#include <tangency/dem/contacts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include <tangency/dem/parallel.hpp>

namespace tangency::dem {
namespace {

/// A normal that turns by more in a step has gone over to another branch: its cosine. Chosen: 26
/// degrees, where a step turns neighbours by a hundredth of that.
constexpr double kSameBranchCosine = 0.9;

std::size_t type_of(const Particles& particles, std::int32_t body, std::size_t walls) {
  const auto i = static_cast<std::size_t>(body);
  return i < particles.size() ? static_cast<std::size_t>(particles.type[i]) : walls;
}

/// Velocity of b relative to a at the contact point less the cell's strain [Ouadfel1998, eq. 3.1].
/// A wall moves with the strain alone.
Vec3 relative_velocity(const Particles& particles, const Pair& pair, const Vec3& arm,
                       const Vec3& branch) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const Vec3 of_a = particles.velocity[a] + particles.angular_velocity[a].cross(arm);
  if (b >= particles.size()) return -of_a;
  const Vec3 arm_b = arm - branch;
  return particles.velocity[b] + particles.angular_velocity[b].cross(arm_b) - of_a;
}

double stored(const Contact& contact) { return contact.normal_energy + contact.shear.energy; }

/// A Hertz contact stores c overlap^(5/2), where c goes with the curvatures: the mean over the step
/// of dc overlap^(5/2).
double gained_by_curvature(const Contact& before, const Contact& after) {
  const double ratio = after.overlap / before.overlap, power = ratio * ratio * std::sqrt(ratio);
  return 0.5 * (after.normal_energy - before.normal_energy * power + after.normal_energy / power -
                before.normal_energy);
}

}  // namespace

struct Contacts::Step {
  const Particles& particles;
  const Cell& cell;
  const std::vector<Pair>& pairs;
  const ContactLaws& laws;
  double dt;
  Branch branch;
};

ContactWork& ContactWork::operator+=(const ContactWork& other) {
  sliding += other.sliding;
  boundary += other.boundary;
  branch += other.branch;
  return *this;
}

double ContactLaws::largest_stiffness() const {
  double largest = 0.0;
  for (const ContactLaw& one : law)
    largest = std::max({largest, one.normal_stiffness, one.shear_stiffness});
  return largest;
}

ContactWork Contacts::update(const Particles& particles, const Cell& cell,
                             const NeighbourList& list, const ContactLaws& laws, double dt,
                             Branch branch) {
  narrow_phase_.refresh(particles);
  const Step step{particles, cell, list.pairs(), laws, dt, branch};
  const std::size_t blocks = (step.pairs.size() + NarrowPhase::kBlock - 1) / NarrowPhase::kBlock;
  work_.assign(blocks, {});
#pragma omp parallel for schedule(dynamic) if (step.pairs.size() >= kParallelThreshold)
  for (std::size_t k = 0; k < blocks; ++k) update_block(k, step);
  add_up(list, particles.size());
  ContactWork sum;
  for (const ContactWork& one : work_) sum += one;
  return sum;
}

void Contacts::update_block(std::size_t index, const Step& step) {
  const std::size_t first = index * NarrowPhase::kBlock;
  const auto pairs = std::span(step.pairs).subspan(first);
  const std::size_t count = std::min(NarrowPhase::kBlock, pairs.size());
  std::array<Vec3, NarrowPhase::kBlock> normals;
  std::array<PairGeometry, NarrowPhase::kBlock> geometries;
  for (std::size_t k = 0; k < count; ++k) normals[k] = records_[first + k].normal;
  narrow_phase_.measure(pairs.first(count), step.particles, step.cell, normals, step.branch,
                        geometries);
  for (std::size_t k = 0; k < count; ++k)
    apply(pairs[k], geometries[k], step, records_[first + k], work_[index]);
}

/// One contact: from where its bodies are to its force, and what that did to energy.
void Contacts::apply(const Pair& pair, const PairGeometry& geometry, const Step& step,
                     Contact& contact, ContactWork& work) const {
  const bool touched = contact.touches();
  const bool touches = geometry.gap < 0.0;
  const Contact before = contact;
  contact.branch = geometry.branch;
  if (!touches && !touched) {
    contact.normal = geometry.normal;
    return;
  }
  const std::size_t walls = step.laws.types - 1;
  const ContactLaw& law = step.laws.between(type_of(step.particles, pair.a, walls),
                                            type_of(step.particles, pair.b, walls));
  contact = Contact{};
  contact.normal = geometry.normal;
  contact.branch = geometry.branch;
  contact.arm = touches ? geometry.arm : before.arm;
  // Half way through the step, but for the strain, which move() takes from where it began.
  const Contact& from = touched ? before : contact;
  const Vec3 strained = step.dt * (step.cell.rate * from.branch);
  const Vec3 moved =
      strained + step.dt * relative_velocity(step.particles, pair, 0.5 * (from.arm + contact.arm),
                                             0.5 * (from.branch + contact.branch));
  double sliding = before.shear.energy;  // of a spring that is let go
  if (touches) {
    contact.overlap = -geometry.gap;
    const NormalResponse response = law.normal_response(
        contact.overlap,
        law.hertz ? narrow_phase_.relative_curvature(pair, contact.normal) : PrincipalCurvatures{});
    contact.normal_force = response.force;
    contact.normal_stiffness = response.stiffness;
    contact.normal_energy = response.energy;
    contact.force = contact.normal_force * contact.normal;
    if (law.bears_shear()) {
      contact.shear = before.shear;
      // Half of it before the normal turns, half after.
      const Vec3 turning = 0.5 * (moved + turned_with(moved, from.normal, contact.normal));
      sliding = law.shear(contact.shear, {from.normal, contact.normal, turning}, response);
      contact.force += contact.shear.force;
    }
  }
  const Vec3 mean_force = 0.5 * (before.force + contact.force);
  work.sliding += sliding;
  work.boundary -= mean_force.dot(strained);
  if (!touches || !touched) return;
  if (before.normal.dot(contact.normal) < kSameBranchCosine)
    work.branch += stored(contact) - stored(before) + sliding + mean_force.dot(moved);
  else if (law.hertz)
    work.branch += gained_by_curvature(before, contact);
}

void Contacts::carry_over(const std::vector<Pair>& before, const std::vector<Pair>& now) {
  std::vector<Contact> kept(now.size());
  auto old = before.begin();
  for (std::size_t k = 0; k < now.size(); ++k) {
    old = std::lower_bound(old, before.end(), now[k]);
    if (old != before.end() && *old == now[k])
      kept[k] = records_[static_cast<std::size_t>(old - before.begin())];
  }
  records_ = std::move(kept);
}

void Contacts::restore(std::vector<Contact> records, const Particles& particles,
                       const NeighbourList& list) {
  records_ = std::move(records);
  add_up(list, particles.size());
}

void Contacts::add_up(const NeighbourList& list, std::size_t particles) {
  resultants_.force.resize(particles);
  resultants_.moment.resize(particles);
#pragma omp parallel for schedule(static) if (particles >= kParallelThreshold)
  for (std::size_t i = 0; i < particles; ++i) {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    list.for_each_pair_of(i, [&](std::size_t index, bool as_b) {
      const Contact& contact = records_[index];
      if (!contact.touches()) return;
      if (as_b) {
        force += contact.force;
        moment += (contact.arm - contact.branch).cross(contact.force);
      } else {
        force -= contact.force;
        moment -= contact.arm.cross(contact.force);
      }
    });
    resultants_.force[i] = force;
    resultants_.moment[i] = moment;
  }
}

}  // namespace tangency::dem
