// SPDX-License-Identifier: MIT
#include <cstddef>

#include <tangency/dem/lanes/particle_lanes.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/dem/lanes/inertia_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tangency/dem/lanes/particle_packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

/// With the weight, which a force may balance to the last bit.
HWY_INLINE PackVec3 force_on(const ParticleColumns& c, std::size_t at, const Pack& mass,
                             const double* gravity) {
  const PackVec3 weight{mass * all(gravity[0]), mass * all(gravity[1]), mass * all(gravity[2])};
  return c.force == nullptr ? weight : load_vectors(c.force + 3 * at) + weight;
}

HWY_INLINE PackInertia inertia_at(const ParticleColumns& c, std::size_t at) {
  return inertia_of(load(c.mass + at), load_vectors(c.semi_axes + 3 * at), c.is_plane);
}

/// Of one pack, the sums of its shifts and turns.
struct PackProducts {
  Pack vv, va, aa;
};

HWY_INLINE PackProducts products_of(const ParticleColumns& c, std::size_t at, const double* gravity,
                                    bool turns) {
  const Pack mass = load(c.mass + at);
  const PackVec3 velocity = load_vectors(c.velocity + 3 * at);
  const PackVec3 force = force_on(c, at, mass, gravity);
  PackProducts p{mass * unfused_dot(velocity, velocity), unfused_dot(force, velocity),
                 unfused_dot(force, force) / mass};
  if (!turns) return p;
  const PackInertia inertia = inertia_at(c, at);
  const PackRotation rotation(load_quaternions(c.orientation + 4 * at));
  const PackVec3 spin = rotation.to_body(load_vectors(c.angular_velocity + 3 * at));
  p.vv = p.vv + unfused_dot(inertia.moments, times(spin, spin));
  if (c.moment == nullptr) return p;
  const PackVec3 moment = rotation.to_body(load_vectors(c.moment + 3 * at));
  p.va = p.va + unfused_dot(moment, spin);
  p.aa = p.aa + unfused_dot(inertia.inverse, times(moment, moment));
  return p;
}

HWY_ATTR InertiaProducts inertia_products_lanes(const ParticleColumns& columns,
                                                const double* gravity, bool turns,
                                                std::size_t first, std::size_t last) {
  constexpr std::size_t most = dem::kChunk + kMostLanes;
  double vv[most], va[most], aa[most];
  for_each_pack(columns, {}, first, last,
                [&](const ParticleColumns& c, const MovedColumns&, std::size_t at, std::size_t k)
                    HWY_ATTR {
                      const PackProducts p = products_of(c, at, gravity, turns);
                      store(p.vv, vv + k);
                      store(p.va, va + k);
                      store(p.aa, aa + k);
                    });
  InertiaProducts sum;
  for (std::size_t k = 0; k < last - first; ++k) {
    sum.vv += vv[k];
    sum.va += va[k];
    sum.aa += aa[k];
  }
  return sum;
}

HWY_ATTR void steer_lanes(const ParticleColumns& columns, const MovedColumns& moved, double keep,
                          double push, const double* gravity, bool turns, std::size_t first,
                          std::size_t last) {
  for_each_pack(
      columns, moved, first, last,
      [&](const ParticleColumns& c, const MovedColumns& m, std::size_t at, std::size_t) HWY_ATTR {
        const PackVec3 v = load_vectors(c.velocity + 3 * at);
        const Pack mass = load(c.mass + at);
        const PackVec3 a = force_on(c, at, mass, gravity) * (all(1.0) / mass);
        store(v * all(keep) + a * all(push), m.velocity + 3 * at);
        if (!turns) return;
        const PackRotation rotation(load_quaternions(c.orientation + 4 * at));
        const PackVec3 moment = rotation.to_body(load_vectors(c.moment + 3 * at));
        const PackVec3 turn = rotation.to_space(times(moment, inertia_at(c, at).inverse));
        const PackVec3 spin = load_vectors(c.angular_velocity + 3 * at);
        store(spin * all(keep) + turn * all(push), m.angular_velocity + 3 * at);
      });
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(inertia_products_lanes);
HWY_EXPORT(steer_lanes);
}  // namespace

InertiaProducts inertia_products_lanes(const ParticleColumns& columns, const double* gravity,
                                       bool turns, std::size_t first, std::size_t last) noexcept {
  return HWY_DYNAMIC_DISPATCH(inertia_products_lanes)(columns, gravity, turns, first, last);
}

void steer_lanes(const ParticleColumns& columns, const MovedColumns& moved, double keep,
                 double push, const double* gravity, bool turns, std::size_t first,
                 std::size_t last) noexcept {
  HWY_DYNAMIC_DISPATCH(steer_lanes)(columns, moved, keep, push, gravity, turns, first, last);
}

}  // namespace tangency::inline v0::detail
#endif
