// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/contact_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <tangency/dem/lanes/hertz_lanes.hpp>

namespace tangency::inline v0::dem {
namespace {

static_assert(ContactBlock::kPairs == kPairBlock);

template <class T>
using BlockColumn = BlockGeometry::Column<T>;

/// The laws of a block's pairs.
struct BlockLaws {
  BlockColumn<const ContactLaw*> law;
  BlockColumn<double> normal_stiffness, shear_stiffness, friction_coefficient, cohesion;
  BlockColumn<double> half_compliance;

  BlockLaws(const ContactLaws& laws, const Particles& particles, const BlockGeometry& block) {
    const std::size_t walls = laws.types - 1;
    const auto type_of = [&](std::uint32_t body) {
      return body < particles.size() ? static_cast<std::size_t>(particles.type[body]) : walls;
    };
    const ContactLaw* last = nullptr;
    double compliance = 0.0;
    for (std::size_t k = 0; k < kPairBlock; ++k) {
      const ContactLaw& one =
          laws.types == 1 ? laws.law.front()
                          : laws.between(type_of(block.pairs[k].a), type_of(block.pairs[k].b));
      if (&one != last) compliance = one.bears_shear() ? 0.5 / one.shear_stiffness : 0.0;
      law[k] = last = &one;
      half_compliance[k] = compliance;
      normal_stiffness[k] = one.normal_stiffness;
      shear_stiffness[k] = one.shear_stiffness;
      friction_coefficient[k] = one.friction_coefficient;
      cohesion[k] = one.cohesion;
    }
  }

  LawColumns columns() const {
    return {normal_stiffness.data(), shear_stiffness.data(), friction_coefficient.data(),
            cohesion.data(), half_compliance.data()};
  }
};

/// What Hertz's law makes of a block's pairs that touch.
class BlockHertz {
 public:
  BlockHertz(const BlockLaws& laws, const NarrowPhase& narrow_phase, const BlockGeometry& block,
             std::size_t count) {
    direction_.fill(Vec3::Zero());
    BlockColumn<double> overlap{}, contact_modulus, shear_modulus, poisson_ratio;
    for (std::size_t k = 0; k < count; ++k) overlap[k] = block.gap[k] < 0.0 ? -block.gap[k] : 0.0;
    const ContactLaw* last = nullptr;
    double of_contact = 0.0, of_shear = 0.0;
    for (std::size_t k = 0; k < kPairBlock; ++k) {
      const Material& material = *laws.law[k]->hertz;
      if (laws.law[k] != last) {
        of_contact = material.contact_modulus();
        of_shear = material.shear_modulus();
        last = laws.law[k];
      }
      contact_modulus[k] = of_contact;
      shear_modulus[k] = of_shear;
      poisson_ratio[k] = material.poisson_ratio;
    }
    BlockColumn<IndexedPair> pairs = block.pairs;
    const std::size_t bodies = narrow_phase.rows().size();
    for (IndexedPair& pair : pairs)
      if (pair.b >= bodies) pair.b = kFlatBody;
    const std::uint64_t answered =
        bodies == 0
            ? 0
            : hertz_lanes({narrow_phase.rows().data(), pairs.data(), static_cast<int>(count),
                           block.normal[0].data(), overlap.data(), contact_modulus.data(),
                           shear_modulus.data(), poisson_ratio.data(), force_.data(),
                           stiffness_.data(), energy_.data(), along_.data(), across_.data(),
                           direction_[0].data()});
    for (std::size_t k = 0; k < count; ++k)
      if ((answered >> k & 1) == 0)
        answer(k, *laws.law[k], overlap[k],
               narrow_phase.relative_curvature(block.pairs[k], block.normal[k]));
  }

  HertzColumns columns() const {
    return {force_.data(), stiffness_.data(), energy_.data(),
            along_.data(), across_.data(),    direction_[0].data()};
  }

 private:
  void answer(std::size_t k, const ContactLaw& law, double overlap,
              const PrincipalCurvatures& curvatures) {
    direction_[k].setZero();
    force_[k] = stiffness_[k] = energy_[k] = along_[k] = across_[k] = 0.0;
    if (!(overlap > 0.0)) return;
    const NormalResponse response = law.hertz_response(overlap, curvatures);
    force_[k] = response.force;
    stiffness_[k] = response.stiffness;
    energy_[k] = response.energy;
    along_[k] = response.shear.along;
    across_[k] = response.shear.across;
    direction_[k] = response.shear.direction;
  }

  BlockColumn<double> force_{}, stiffness_{}, energy_{}, along_{}, across_{};
  BlockColumn<Vec3> direction_;
};

/// How the approach of a block's pairs that touch is damped.
class BlockDashpots {
 public:
  BlockDashpots(const BlockLaws& laws, const Particles& particles, const BlockGeometry& block,
                std::size_t count, bool turns) {
    // Of a Hertz contact: with it the damping has the same shape as the linear one
    // (docs/derivations/restitution.md).
    const double of_law = 2.0 * (laws.law[0]->hertz ? std::sqrt(5.0 / 6.0) : 1.0);
    for (std::size_t k = 0; k < count; ++k) {
      if (!(block.gap[k] < 0.0) || !laws.law[k]->dissipates()) continue;
      const IndexedPair& pair = block.pairs[k];
      const Vec3 &normal = block.normal[k], &arm = block.arm[k];
      double inverse = inverse_mass(particles, pair.a, arm, normal, turns);
      if (pair.b < particles.size())
        inverse += inverse_mass(particles, pair.b, arm - block.branch[k], normal, turns);
      inverse_mass_[k] = inverse;
      viscosity_[k] = of_law * laws.law[k]->damping_ratio / std::sqrt(inverse);
    }
  }

  DashpotColumns columns() const { return {viscosity_.data(), inverse_mass_.data()}; }

 private:
  /// Velocity along the normal that an impulse of 1 along it gives to a body where it acts.
  static double inverse_mass(const Particles& particles, std::size_t i, const Vec3& arm,
                             const Vec3& normal, bool turns) {
    const double mass = particles.mass[i];
    const Vec3& axes = particles.semi_axes[i];
    if (!turns || (axes[0] == axes[1] && axes[1] == axes[2])) return 1.0 / mass;
    const Vec3 moment = particles.orientation[i].conjugate() * arm.cross(normal);
    const Vec3 inertia = principal_inertia(mass, axes, particles.dimensions);
    return 1.0 / mass + moment.cwiseAbs2().cwiseQuotient(inertia).sum();
  }

  BlockColumn<double> viscosity_{}, inverse_mass_{};
};

}  // namespace

void step_block(const BlockStep& step, const BlockGeometry& geometry, ContactBlock& block) {
  const BlockLaws laws(step.laws, step.particles, geometry);
  block.pairs = geometry.pairs.data();
  block.motion = step.motion.data();
  block.dt = step.dt;
  std::copy_n(step.rate.data(), 9, block.rate);
  block.gap = geometry.gap.data();
  block.normal = geometry.normal[0].data();
  block.branch = geometry.branch[0].data();
  block.arm = geometry.arm[0].data();
  block.law = laws.columns();
  block.bears_shear = step.bears_shear;
  std::optional<BlockHertz> hertz;
  HertzColumns of_hertz;
  if (step.laws.are_hertz()) {
    of_hertz = hertz.emplace(laws, step.narrow_phase, geometry, block.count).columns();
    block.hertz = &of_hertz;
  }
  std::optional<BlockDashpots> dashpots;
  DashpotColumns of_dashpots;
  if (step.damped) {
    const bool turns = step.laws.bodies_turn;
    of_dashpots = dashpots.emplace(laws, step.particles, geometry, block.count, turns).columns();
    block.dashpots = &of_dashpots;
  }
  contact_lanes(block);
}

}  // namespace tangency::inline v0::dem
