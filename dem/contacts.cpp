// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <tangency/dem/contacts.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/gap.hpp>

namespace tangency::dem {
namespace {

/// Below so many pairs, or particles, a loop is over before a second thread has woken up. Chosen:
/// some 50 us of work, a few times what waking takes.
constexpr std::size_t worth_sharing = 400;

/// What a contact takes from a Gap, or from a PlaneGap with 0 along z.
struct Touch {
  double gap;
  Vec3 normal, arm_a, arm_b;
};

Vec3 in_space(const Vec3& v) { return v; }
Vec3 in_space(const Vec2& v) { return {v[0], v[1], 0.0}; }

template <class AnyGap>
Touch touch_of(const AnyGap& gap) {
  return {gap.gap, in_space(gap.normal), in_space(gap.arm_a), in_space(gap.arm_b)};
}

/// A vector of space as geometry wants it for its solids there or for those in the plane.
const Vec3& as_for(const Ellipsoid&, const Vec3& v) { return v; }
Vec2 as_for(const Ellipse&, const Vec3& v) { return v.head<2>(); }

/// A particle's shape and orientation: its centre is not used.
void assign(std::vector<Ellipsoid>& bodies, std::size_t i, const Particles& particles) {
  bodies[i] = Ellipsoid(Vec3::Zero(), particles.semi_axes[i], particles.orientation[i]);
}
void assign(std::vector<Ellipse>& bodies, std::size_t i, const Particles& particles) {
  const Eigen::Quaterniond& q = particles.orientation[i];  // (cos, 0, 0, sin) of half the angle
  const Vec2 direction(q.w() * q.w() - q.z() * q.z(), 2.0 * q.w() * q.z());
  bodies[i] = Ellipse(Vec2::Zero(), particles.semi_axes[i].head<2>(), direction);
}

void resize(std::vector<Ellipsoid>& bodies, std::size_t count) {
  bodies.resize(count, Ellipsoid(Vec3::Zero(), Vec3::Ones()));
}
void resize(std::vector<Ellipse>& bodies, std::size_t count) {
  bodies.resize(count, Ellipse(Vec2::Zero(), Vec2::Ones()));
}

/// The gap of a pair, or nothing where it is known to be > 0 without finding it: the bounding
/// spheres do not meet, or the plane across the stored normal still parts the bodies (for any unit
/// n, n.d - h_a - h_b is at most the gap). Leaves the stored normal as a start for next time.
template <class Body>
std::optional<Touch> touch_unless_apart(const Body& a, const Body& b, Contact& contact) {
  const double reach = a.largest_semi_axis() + b.largest_semi_axis();
  if (contact.branch.squaredNorm() >= reach * reach) {
    contact.normal.setZero();
    return std::nullopt;
  }
  const auto& branch = as_for(a, contact.branch);
  if (contact.normal.isZero(0.0)) return touch_of(signed_gap(a, b, branch));
  const auto& n = as_for(a, contact.normal);
  if (n.dot(branch) - a.support(n) - b.support(n) > 0.0) return std::nullopt;
  return touch_of(follow_gap(a, b, branch, n));
}

/// Velocity of b relative to a at the contact point, the cell's strain included [Ouadfel1998,
/// eq. 3.1, 3.35].
Vec3 relative_velocity(const Particles& particles, const Cell& cell, const Pair& pair,
                       const Contact& contact) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const Vec3 arm_b = contact.arm - contact.branch;
  return particles.velocity[b] + particles.angular_velocity[b].cross(arm_b) -
         particles.velocity[a] - particles.angular_velocity[a].cross(contact.arm) +
         cell.rate.cwiseProduct(contact.branch);
}

void separate(Contact& contact) {
  contact.overlap = contact.normal_force = 0.0;
  contact.force.setZero();
  contact.shear.setZero();
}

}  // namespace

double ContactLaws::largest_stiffness() const {
  double largest = 0.0;
  for (const ContactLaw& one : law)
    largest = std::max({largest, one.normal_stiffness, one.shear_stiffness});
  return largest;
}

void Contacts::update(const Particles& particles, const Cell& cell, const NeighbourList& list,
                      const ContactLaws& laws, double dt) {
  if (cell.dimensions == 2)
    update_with(ellipses_, particles, cell, list, laws, dt);
  else
    update_with(ellipsoids_, particles, cell, list, laws, dt);
  add_up(list, particles.size());
}

template <class Body>
void Contacts::update_with(std::vector<Body>& bodies, const Particles& particles, const Cell& cell,
                           const NeighbourList& list, const ContactLaws& laws, double dt) {
  const std::size_t count = particles.size();
  resize(bodies, count);
#pragma omp parallel for schedule(static) if (count >= worth_sharing)
  for (std::size_t i = 0; i < count; ++i) assign(bodies, i, particles);

  const std::vector<Pair>& pairs = list.pairs();
#pragma omp parallel for schedule(dynamic, 64) if (pairs.size() >= worth_sharing)
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Pair& pair = pairs[k];
    Contact& contact = records_[k];
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    contact.branch = branch_vector(pair, particles, cell);
    const std::optional<Touch> gap = touch_unless_apart(bodies[a], bodies[b], contact);
    if (!gap || gap->gap >= 0.0) {
      if (gap) contact.normal = gap->normal;
      separate(contact);
      continue;
    }
    const ContactLaw& law = laws.between(particles.type[a], particles.type[b]);
    const Vec3 previous_normal = contact.touches() ? contact.normal : gap->normal;
    contact.normal = gap->normal;
    contact.overlap = -gap->gap;
    contact.arm = 0.5 * (gap->arm_a + contact.branch + gap->arm_b);
    contact.normal_stiffness = law.normal_stiffness;
    contact.normal_force = law.normal_force(contact.overlap);
    contact.force = contact.normal_force * contact.normal;
    if (law.bears_shear()) {
      const Vec3 displacement = dt * relative_velocity(particles, cell, pair, contact);
      contact.shear = law.shear_force(contact.shear, previous_normal, contact.normal, displacement,
                                      contact.normal_force);
      contact.force += contact.shear;
    } else {
      contact.shear.setZero();
    }
  }
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
#pragma omp parallel for schedule(static) if (particles >= worth_sharing)
  for (std::size_t i = 0; i < particles; ++i) {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (const auto* at = list.begin_of(i); at != list.end_of(i); ++at) {
      const Contact& contact = records_[at->index];
      if (!contact.touches()) continue;
      if (at->as_b) {
        force += contact.force;
        moment += (contact.arm - contact.branch).cross(contact.force);
      } else {
        force -= contact.force;
        moment -= contact.arm.cross(contact.force);
      }
    }
    resultants_.force[i] = force;
    resultants_.moment[i] = moment;
  }
}

}  // namespace tangency::dem
