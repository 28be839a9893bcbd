// SPDX-License-Identifier: MIT
#include <tangency/dem/lanes/contact_lanes.hpp>

#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/dem/lanes/contact_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 1  // more values live than there are registers, even so
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

using dem::ContactBlock;
using dem::ContactState;

/// A normal that turns by more in a step has gone over to another branch: its cosine. Chosen: 26
/// degrees, where a step turns neighbours by a hundredth of that.
constexpr double kSameBranchCosine = 0.9;

/// p where yes, else 0.
HWY_INLINE Pack only(const PackMask& yes, const Pack& p) {
  return {hn::IfThenElseZero(yes.low, p.low)};
}
HWY_INLINE PackVec3 only(const PackMask& yes, const PackVec3& v) {
  return {only(yes, v.x), only(yes, v.y), only(yes, v.z)};
}

/// The smallest rotation that takes one unit vector to another; of opposite ones, where that is not
/// unique, the reversal.
struct PackTurn {
  PackVec3 axis;
  Pack cosine, share;
  PackMask less_than_half;

  HWY_INLINE PackTurn(const PackVec3& from, const PackVec3& to)
      : axis(cross(from, to)), cosine(dot(from, to)) {
    const Pack above = all(1.0) + cosine;
    less_than_half = above > all(0.0);
    share = all(1.0) / above;
  }
  HWY_INLINE PackVec3 operator()(const PackVec3& v) const {
    const PackVec3 turned = multiply_add(cosine, v, cross(axis, v));
    return chosen(less_than_half, multiply_add(dot(axis, v) * share, axis, turned), -v);
  }
};

/// What the pairs of a pack give to the sums of their block.
struct PackSums {
  PackVec3 column[3];  ///< of force times branch', column by column
  Pack affine, sliding, boundary, branch, viscous;
};

/// Sums over a block. Pair k is added to place k modulo kPlaces of each, and the places at the end
/// by halves: in this order whatever the number of lanes.
class BlockSum {
 public:
  HWY_INLINE BlockSum() {
    for (auto& number : sums_)
      for (double& place : number) place = 0.0;
  }

  template <bool damped>
  HWY_INLINE void add(const PackSums& pack, std::size_t i) {
    double* to = &sums_[0][i % kPlaces];
    const auto add_one = [&](const Pack& p) HWY_ATTR {
      store(load(to) + p, to);
      to += kPlaces;
    };
    for (const PackVec3& one : pack.column) {
      add_one(one.x);
      add_one(one.y);
      add_one(one.z);
    }
    add_one(pack.affine);
    add_one(pack.sliding);
    add_one(pack.boundary);
    add_one(pack.branch);
    if constexpr (damped) add_one(pack.viscous);
  }

  HWY_INLINE void write(dem::BlockSums& to) const {
    double* const numbers = to.force_branch;
    for (std::size_t k = 0; k < kNumbers; ++k) {
      const double* const s = sums_[k];
      numbers[k] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
    }
  }

 private:
  static constexpr std::size_t kPlaces = 8, kNumbers = 14;
  static_assert(sizeof(dem::BlockSums) == kNumbers * sizeof(double));
  HWY_ALIGN double sums_[kNumbers][kPlaces];
};

/// Pairs as they are after a step.
struct PackContact {
  PackVec3 normal, branch, arm, shear;
  Pack normal_force, stiffness;  ///< 0 of pairs apart, as shear is
};

HWY_INLINE PackVec3 force_of(const PackContact& contact) {
  return multiply_add(contact.normal_force, contact.normal, contact.shear);
}

/// What the bodies get, and what the sums over contacts do.
HWY_INLINE void add_up(const PackContact& contact, const PackVec3& force, const ContactBlock& block,
                       std::size_t i, PackSums& sums) {
  store(force, block.force + 3 * i);
  // A force of 0 may have moments of -0, which this makes the 0 of pairs that are not looked at.
  const Pack zero = all(0.0);
  const PackVec3 plus_0{zero, zero, zero};
  store(cross(force, contact.arm) + plus_0, block.moment_a + 3 * i);
  store(cross(contact.arm - contact.branch, force) + plus_0, block.moment_b + 3 * i);
  sums.column[0] = force * contact.branch.x;
  sums.column[1] = force * contact.branch.y;
  sums.column[2] = force * contact.branch.z;
  const Pack along = dot(contact.normal, contact.branch);
  sums.affine = contact.stiffness * along * along;
}

struct PackMotion {
  PackVec3 velocity, spin;
};

HWY_INLINE PackMotion motion_of(const Rows& rows) {
  Register column[8];
  load_columns(rows, 0, column);
  load_columns(rows, 4, column + 4);
  return {{{column[0]}, {column[1]}, {column[2]}}, {{column[4]}, {column[5]}, {column[6]}}};
}

/// Velocity of b relative to a where they touch, less the cell's strain [Ouadfel1998, eq. 3.1].
HWY_INLINE PackVec3 relative_velocity(const ContactBlock& block, std::size_t i, const PackVec3& arm,
                                      const PackVec3& branch) {
  Rows a, b;
  for (std::size_t k = 0; k < register_lanes(); ++k) {
    a.lane[k] = block.motion[block.pairs[i + k].a].velocity;
    b.lane[k] = block.motion[block.pairs[i + k].b].velocity;
  }
  const PackMotion of_a = motion_of(a), of_b = motion_of(b);
  return (of_b.velocity + cross(of_b.spin, arm - branch)) - (of_a.velocity + cross(of_a.spin, arm));
}

/// How stiff a contact is in shear: one number, or those along and across a direction.
template <bool hertz>
struct PackShearStiffness;

template <>
struct PackShearStiffness<false> {
  Pack stiffness, half_compliance;

  HWY_INLINE PackShearStiffness(const ContactBlock& block, std::size_t i)
      : stiffness(load(block.law.shear_stiffness + i)),
        half_compliance(load(block.law.half_compliance + i)) {}
  HWY_INLINE Pack largest() const { return stiffness; }
  HWY_INLINE PackVec3 times(const PackVec3& v) const { return v * stiffness; }
  /// Energy stored at a force.
  HWY_INLINE Pack energy(const PackVec3& force) const {
    return dot(force, force) * half_compliance;
  }
};

template <>
struct PackShearStiffness<true> {
  Pack along, across;
  PackVec3 direction;

  HWY_INLINE PackShearStiffness(const ContactBlock& block, std::size_t i)
      : along(load(block.hertz->along + i)),
        across(load(block.hertz->across + i)),
        direction(load_vectors(block.hertz->direction + 3 * i)) {}
  HWY_INLINE Pack largest() const { return larger(along, across); }
  HWY_INLINE PackVec3 times(const PackVec3& v) const {
    return multiply_add((along - across) * dot(direction, v), direction, v * across);
  }
  HWY_INLINE Pack energy(const PackVec3& force) const {
    const Pack part = dot(direction, force);
    const Pack rest = dot(force, force) / across;
    return all(0.5) * multiply_add(part * part, all(1.0) / along - all(1.0) / across, rest);
  }
};

/// Shear forces after a step, and what was lost to sliding.
struct PackShear {
  PackVec3 force;
  Pack stiffness, energy, sliding;
};

/// ContactLaw::shear() of a displacement half of which comes before the normal turns, half after.
/// @param old  the spring's force and energy before, turned
template <bool hertz>
HWY_INLINE PackShear shear_of(const ContactBlock& block, std::size_t i, const PackVec3& old,
                              const Pack& old_energy, const PackVec3& moved, const PackVec3& normal,
                              const Pack& normal_force) {
  const PackShearStiffness<hertz> stiffness(block, i);
  PackVec3 kept = old;
  if constexpr (hertz) {
    const Pack before = load(block.state.shear_stiffness + i);
    kept = chosen(stiffness.largest() < before, old * (stiffness.largest() / before), old);
  }
  PackVec3 trial = kept - stiffness.times(moved);
  // Takes the normal part of the displacement away, and what rounding has left of earlier ones.
  trial = multiply_take(dot(normal, trial), normal, trial);
  const Pack limit = multiply_add(normal_force, load(block.law.friction_coefficient + i),
                                  load(block.law.cohesion + i));
  const Pack size = root(dot(trial, trial));
  const PackVec3 force = chosen(size > limit, trial * (limit / size), trial);
  const Pack energy = stiffness.energy(force);
  const Pack work = all(-0.5) * dot(old + force, moved);
  return {force, stiffness.largest(), energy, (old_energy + work) - energy};
}

/// A Hertz contact stores c overlap^(5/2), where c goes with the curvatures: the mean over the step
/// of dc overlap^(5/2).
HWY_INLINE Pack gained_by_curvature(const Pack& overlap_before, const Pack& energy_before,
                                    const Pack& overlap, const Pack& energy) {
  const Pack ratio = overlap / overlap_before, power = ratio * ratio * root(ratio);
  return all(0.5) * (((energy - energy_before * power) + energy / power) - energy_before);
}

/// The part of a linear push, 1 of a Hertz one 2/3, that stiffness times overlap is.
template <bool hertz>
constexpr double kElasticShare = hertz ? 2.0 / 3.0 : 1.0;

/// The push of a damped approach, >= 0. Velocities are those of half a step ago: what the push
/// itself changes of them until now is in the denominator.
/// @param elastic  push of the overlap
/// @param approached  growth of the overlap during the step, by the velocities
template <bool hertz>
HWY_INLINE Pack damped_push(const ContactBlock& block, std::size_t i, const Pack& elastic,
                            const Pack& stiffness, const Pack& overlap, const PackMask& touched,
                            const Pack& approached) {
  const Pack zero = all(0.0), one = all(1.0), half = all(0.5);
  // Of a contact that begins: the step around now, from half a step ago on, of which the contact
  // has been there for `since`. Else the damper, which sets in at once, acts too short or too long.
  constexpr double least = 0x1p-20;  // chosen: then the overlap is as good as none
  const PackMask comes = approached > zero;
  const Pack ratio = overlap / chosen(comes, approached, one);
  const Pack since = chosen(ratio < one, larger(ratio, all(least)), one);
  const Pack until = since + half;
  Pack share = until;
  if constexpr (hertz) share = all(0.8) * until * root(root(until / since));
  const Pack damped = load(block.dashpots->viscosity + i) * root(stiffness);
  const Pack viscosity = damped * chosen(touched, one, chosen(comes, share, one));
  const double over_dt = block.dt > 0.0 ? 1.0 / block.dt : 0.0;
  const Pack lag = all(0.5 * block.dt) * viscosity * load(block.dashpots->inverse_mass + i);
  const Pack push = multiply_add(viscosity, approached * all(over_dt), elastic) / (one + lag);
  return larger(push, zero);
}

/// One step of the pairs from i on.
template <bool hertz, bool shear, bool damped>
HWY_INLINE void step(const ContactBlock& block, std::size_t i, BlockSum& block_sum) {
  const ContactState& state = block.state;
  const Pack zero = all(0.0), half = all(0.5), gap = load(block.gap + i);
  const Pack overlap_before = load(state.overlap + i);
  const PackMask touches = gap<zero, touched = overlap_before> zero;
  const PackVec3 normal = load_vectors(block.normal + 3 * i);
  const PackVec3 branch = load_vectors(block.branch + 3 * i);
  const PackVec3 no_force{zero, zero, zero};
  if (none(touches | touched)) {
    store(normal, state.normal + 3 * i);
    store(branch, state.branch + 3 * i);
    store(no_force, block.force + 3 * i);
    store(no_force, block.moment_a + 3 * i);
    store(no_force, block.moment_b + 3 * i);
    return;
  }
  const PackVec3 normal_before = load_vectors(state.normal + 3 * i);
  const PackVec3 branch_before = load_vectors(state.branch + 3 * i);
  const PackVec3 arm_before = load_vectors(state.arm + 3 * i);
  const PackVec3 arm = chosen(touches, load_vectors(block.arm + 3 * i), arm_before);
  // Half way through the step, but for the strain, which move() takes from where it began.
  const PackVec3 from_normal = chosen(touched, normal_before, normal);
  const PackVec3 from_branch = chosen(touched, branch_before, branch);
  const PackVec3 from_arm = chosen(touched, arm_before, arm);
  const double* const r = block.rate;
  const Pack dt = all(block.dt);
  const PackVec3 strained = PackVec3{dot({all(r[0]), all(r[3]), all(r[6])}, from_branch),
                                     dot({all(r[1]), all(r[4]), all(r[7])}, from_branch),
                                     dot({all(r[2]), all(r[5]), all(r[8])}, from_branch)} *
                            dt;
  const PackVec3 moved = multiply_add(
      dt, relative_velocity(block, i, (from_arm + arm) * half, (from_branch + branch) * half),
      strained);

  PackContact now{normal, branch, arm, no_force, {}, {}};
  const Pack overlap = only(touches, -gap);
  Pack normal_energy;
  if constexpr (hertz) {
    now.normal_force = only(touches, load(block.hertz->force + i));
    now.stiffness = only(touches, load(block.hertz->stiffness + i));
    normal_energy = only(touches, load(block.hertz->energy + i));
  } else {
    now.stiffness = only(touches, load(block.law.normal_stiffness + i));
    now.normal_force = now.stiffness * overlap;
    normal_energy = half * now.normal_force * overlap;
  }
  Pack viscous = zero;
  if constexpr (damped) {
    const Pack elastic = now.normal_force;
    now.normal_force = only(touches, damped_push<hertz>(block, i, elastic, now.stiffness, overlap,
                                                        touched, -dot(moved, normal)));
    const Pack elastic_before =
        all(kElasticShare<hertz>) * load(state.normal_stiffness + i) * overlap_before;
    const Pack along = (load(state.normal_force + i) - elastic_before) * dot(moved, normal_before);
    viscous = -half * multiply_add(now.normal_force - elastic, dot(moved, normal), along);
  }
  const Pack normal_energy_before = load(state.normal_energy + i);
  PackVec3 force_before = normal_before * load(state.normal_force + i);
  Pack energy = normal_energy, energy_before = normal_energy_before;
  Pack sliding = zero;
  if constexpr (shear) {
    const PackVec3 shear_before = load_vectors(state.shear_force + 3 * i);
    const Pack shear_energy_before = load(state.shear_energy + i);
    force_before = multiply_add(load(state.normal_force + i), normal_before, shear_before);
    energy_before = energy_before + shear_energy_before;
    const PackTurn turn(from_normal, normal);
    // Half of it before the normal turns, half after.
    const PackVec3 turning = (moved + turn(moved)) * half;
    const PackShear after = shear_of<hertz>(block, i, turn(shear_before), shear_energy_before,
                                            turning, normal, now.normal_force);
    const PackMask bears =
        touches & (load(block.law.shear_stiffness + i) > zero) &
        ((load(block.law.friction_coefficient + i) > zero) | (load(block.law.cohesion + i) > zero));
    now.shear = only(bears, after.force);
    const Pack shear_energy = only(bears, after.energy);
    energy = energy + shear_energy;
    sliding = chosen(bears, after.sliding, shear_energy_before);  // of a spring that is let go
    store(now.shear, state.shear_force + 3 * i);
    store(only(bears, after.stiffness), state.shear_stiffness + i);
    store(shear_energy, state.shear_energy + i);
  }

  const PackVec3 force = force_of(now);
  PackSums sums;
  add_up(now, force, block, i, sums);
  const PackVec3 mean_force = (force_before + force) * half;
  sums.sliding = sliding;
  sums.boundary = -dot(mean_force, strained);
  const PackMask both = touches & touched;
  const PackMask elsewhere = both & (dot(normal_before, normal) < all(kSameBranchCosine));
  Pack gained = ((energy - energy_before) + sliding) + dot(mean_force, moved);
  if constexpr (damped) gained = gained + viscous;
  Pack branch_work = only(elsewhere, gained);
  if constexpr (hertz) {
    branch_work = branch_work + only(without(both, elsewhere),
                                     gained_by_curvature(overlap_before, normal_energy_before,
                                                         overlap, normal_energy));
  }
  sums.branch = branch_work;
  sums.viscous = viscous;
  block_sum.add<damped>(sums, i);

  store(normal, state.normal + 3 * i);
  store(branch, state.branch + 3 * i);
  store(arm, state.arm + 3 * i);
  store(overlap, state.overlap + i);
  store(now.normal_force, state.normal_force + i);
  store(now.stiffness, state.normal_stiffness + i);
  store(normal_energy, state.normal_energy + i);
}

template <bool hertz, bool shear, bool damped = false>
HWY_INLINE void steps(const ContactBlock& block) {
  BlockSum sum;
  for (std::size_t i = 0; i < block.count; i += pack_lanes())
    step<hertz, shear, damped>(block, i, sum);
  sum.write(*block.sums);
}

HWY_ATTR void contact_lanes(const ContactBlock& block) {
  if (block.dashpots != nullptr)
    block.hertz == nullptr ? steps<false, true, true>(block) : steps<true, true, true>(block);
  else if (block.hertz == nullptr)
    block.bears_shear ? steps<false, true>(block) : steps<false, false>(block);
  else
    block.bears_shear ? steps<true, true>(block) : steps<true, false>(block);
}

HWY_ATTR void restored_lanes(const ContactBlock& block) {
  const ContactState& state = block.state;
  BlockSum sum;
  for (std::size_t i = 0; i < block.count; i += pack_lanes()) {
    PackSums sums;
    sums.sliding = sums.boundary = sums.branch = sums.viscous = all(0.0);
    const PackContact contact{
        load_vectors(state.normal + 3 * i), load_vectors(state.branch + 3 * i),
        load_vectors(state.arm + 3 * i),    load_vectors(state.shear_force + 3 * i),
        load(state.normal_force + i),       load(state.normal_stiffness + i)};
    add_up(contact, force_of(contact), block, i, sums);
    sum.add<false>(sums, i);
  }
  sum.write(*block.sums);
}

HWY_ATTR void sphere_lanes(std::size_t count, const double* radius_a, const double* radius_b,
                           const double* branch, double* gap, double* normal, double* arm) {
  const Pack zero = all(0.0), one = all(1.0);
  for (std::size_t i = 0; i < count; i += pack_lanes()) {
    const PackVec3 d = load_vectors(branch + 3 * i);
    const Pack a = load(radius_a + i), distance = root(dot(d, d));
    const Pack apart = distance - (a + load(radius_b + i));
    const PackVec3 n = chosen(distance > zero, d * (one / distance), PackVec3{one, zero, zero});
    store(apart, gap + i);
    store(n, normal + 3 * i);
    store(n * multiply_add(all(0.5), apart, a), arm + 3 * i);
  }
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(contact_lanes);
HWY_EXPORT(restored_lanes);
HWY_EXPORT(sphere_lanes);
}  // namespace
}  // namespace tangency::inline v0::detail

namespace tangency::inline v0::dem {

void contact_lanes(const ContactBlock& block) noexcept {
  using namespace detail;
  HWY_DYNAMIC_DISPATCH(contact_lanes)(block);
}

void restored_lanes(const ContactBlock& block) noexcept {
  using namespace detail;
  HWY_DYNAMIC_DISPATCH(restored_lanes)(block);
}

void sphere_lanes(std::size_t count, const double* radius_a, const double* radius_b,
                  const double* branch, double* gap, double* normal, double* arm) noexcept {
  using namespace detail;
  HWY_DYNAMIC_DISPATCH(sphere_lanes)(count, radius_a, radius_b, branch, gap, normal, arm);
}

}  // namespace tangency::inline v0::dem
#endif
