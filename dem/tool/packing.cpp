// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/packing.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/dem/contact/coulomb_limit.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>

namespace tangency::inline v0::dem {
namespace {

/// In parts of the Coulomb limit. Chosen far above rounding: the law of a stage is another, or it
/// is not.
constexpr double kAboveTheLimit = 1e-6;

struct Entry {
  Pair of_ids;  ///< with a <= b by ids
  std::size_t pair;
  bool exchanged;  ///< a of the list is b here
};

/// The pair by ids, seen from the particle with the lower one.
Entry entry_of(const Pair& pair, std::size_t index, const std::vector<std::int32_t>& id) {
  Pair named{id[static_cast<std::size_t>(pair.a)], id[static_cast<std::size_t>(pair.b)],
             pair.image};
  const bool exchanged = named.a > named.b;
  if (exchanged) {
    std::swap(named.a, named.b);
    for (std::int32_t& k : named.image) k = -k;
  }
  return {named, index, exchanged};
}

void add(PackingContacts& all, const Entry& entry, const Contact& contact, const Vec3& centre_of_a,
         bool is_sliding) {
  // Zeros stay +0 from either side.
  const auto seen = [&](const Vec3& v) { return entry.exchanged ? Vec3(Vec3::Zero() - v) : v; };
  const Vec3 arm = entry.exchanged ? Vec3(contact.arm - contact.branch) : contact.arm;
  all.bodies.push_back({entry.of_ids.a, entry.of_ids.b});
  all.image.push_back(entry.of_ids.image);
  all.point.push_back(centre_of_a + arm);
  all.normal.push_back(seen(contact.normal));
  all.branch.push_back(seen(contact.branch));
  all.arm.push_back(arm);
  all.force.push_back(seen(contact.force));
  all.normal_force.push_back(contact.normal_force);
  all.gap.push_back(-contact.overlap);
  all.sliding.push_back(is_sliding ? 1 : 0);
  all.normal_stiffness.push_back(contact.normal_stiffness);
  all.shear_stiffness.push_back(contact.shear.stiffness);
}

PackingParticles particles_of(const State& state) {
  const Particles& from = state.particles;
  const std::vector<std::int32_t>& contacts = state.contacts.resultants().contacts;
  PackingParticles all;
  for (const std::uint32_t i : from.index_of_id()) {
    all.type.push_back(from.type[i]);
    all.position.push_back(from.position[i]);
    all.semi_axes.push_back(from.semi_axes[i]);
    all.orientation.push_back(from.orientation[i]);
    all.velocity.push_back(from.velocity[i]);
    all.angular_velocity.push_back(from.angular_velocity[i]);
    all.contacts.push_back(contacts[i]);
  }
  return all;
}

}  // namespace

micromechanics::ContactArrays Packing::arrays() const {
  return {.normal = contacts.normal,
          .branch = contacts.branch,
          .force = contacts.force,
          .arm = contacts.arm,
          .bodies = contacts.bodies,
          .particles = static_cast<std::int64_t>(particles.size()),
          .volume = volume,
          .dimensions = dimensions};
}

Packing packing_of(const State& state, const ContactLaws& laws) {
  const Particles& particles = state.particles;
  Packing packing;
  packing.dimensions = state.cell.dimensions;
  packing.edges = state.cell.edges;
  packing.volume = state.cell.volume();
  packing.particles = particles_of(state);
  const std::vector<Pair>& pairs = state.list.pairs();
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!state.contacts.touches(k)) continue;
    if (static_cast<std::size_t>(pairs[k].b) < particles.size()) {
      entries.push_back(entry_of(pairs[k], k, particles.id));
      continue;
    }
    ++packing.wall_contacts;
    packing.wall_stress +=
        state.contacts.force(k) * state.contacts.columns().branch[k].transpose() / packing.volume;
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& x, const Entry& y) { return x.of_ids < y.of_ids; });
  for (const Entry& entry : entries) {
    const auto a = static_cast<std::size_t>(pairs[entry.pair].a);
    const auto b = static_cast<std::size_t>(pairs[entry.pair].b);
    const Contact contact = state.contacts.records()[entry.pair];
    const auto type = [&](std::size_t i) { return static_cast<std::size_t>(particles.type[i]); };
    add(packing.contacts, entry, contact,
        packing.particles.position[static_cast<std::size_t>(entry.of_ids.a)],
        slides(laws.between(type(a), type(b)), contact.normal_force, contact.shear.force.norm()));
  }
  return packing;
}

ContactLaws with_friction(ContactLaws laws, double friction_coefficient) {
  for (ContactLaw& law : laws.law) law.friction_coefficient = friction_coefficient;
  return laws;
}

std::int64_t contacts_above_limit(const State& state, const ContactLaws& laws) {
  const std::vector<Pair>& pairs = state.list.pairs();
  const std::vector<std::int32_t>& types = state.particles.type;
  std::int64_t above = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto a = static_cast<std::size_t>(pairs[k].a), b = static_cast<std::size_t>(pairs[k].b);
    if (!state.contacts.touches(k) || b >= types.size()) continue;
    const ContactLaw& law =
        laws.between(static_cast<std::size_t>(types[a]), static_cast<std::size_t>(types[b]));
    const Contact contact = state.contacts.records()[k];
    above +=
        contact.shear.force.norm() > (1.0 + kAboveTheLimit) * shear_limit(law, contact.normal_force)
            ? 1
            : 0;
  }
  return above;
}

}  // namespace tangency::inline v0::dem
