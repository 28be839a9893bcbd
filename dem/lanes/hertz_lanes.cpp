// SPDX-License-Identifier: MIT
#include <tangency/dem/lanes/hertz_lanes.hpp>

#include <cstddef>

#include <tangency/dem/lanes/hertz_fit.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/dem/lanes/hertz_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/pack_bodies-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::dem::HWY_NAMESPACE {
namespace {

using namespace tangency::detail::HWY_NAMESPACE;

// The geometric mean of the relative curvatures has a square in this range, 1/length^2: chosen,
// what inverse_root() takes and no product of six lengths leaves the range of doubles for.
constexpr double kLeastProduct = 0x1p-100, kLargestProduct = 0x1p100;
// (larger + smaller) / (2 geometric mean) at kLeastCurvatureRatio, 64.004, a little less.
constexpr double kMostMean = 64.0;
// Curvatures whose relative difference is below 4 of these are equal: chosen, below their rounding.
constexpr double kEqual = 0x1p-50;

/// Columns a_k R e_k.
struct PackFactor {
  PackVec3 column[3];
};

/// What a flat body has for a row: curvature 0.
alignas(64) constexpr tangency::detail::LaneBody kFlatRow{};

/// Of the bodies with the indices that `index` tells of a lane's pair.
template <class Index>
HWY_INLINE PackFactor load_factor(const HertzBlock& block, std::size_t i, const Index& index) {
  Rows rows[TANGENCY_PACK_REGISTERS];
  for (std::size_t half = 0; half < TANGENCY_PACK_REGISTERS; ++half) {
    for (std::size_t k = 0; k < register_lanes(); ++k) {
      const std::uint32_t body = index(block.pairs[i + half * register_lanes() + k]);
      const auto* row = body == kFlatBody ? &kFlatRow : block.bodies + body;
      rows[half].lane[k] = &row->least_radius;
    }
  }
  return load_rows<12>(rows, [](const auto& column) HWY_ATTR {
    return PackFactor{{{column(1), column(2), column(3)},
                       {column(4), column(5), column(6)},
                       {column(7), column(8), column(9)}}};
  });
}

/// Tangents that complete a unit normal to a right-handed frame, where no division is by nearly 0
/// [Duff2017].
struct PackFrame {
  PackVec3 first, second, normal;
};

HWY_INLINE PackFrame frame_of(const PackVec3& n) {
  const Pack one = all(1.0), sign = chosen(n.z < all(0.0), all(-1.0), one);
  const Pack over = all(-1.0) / (sign + n.z), xy = n.x * n.y * over, signed_x = sign * n.x;
  return {{multiply_add(signed_x * n.x, over, one), sign * xy, -signed_x},
          {xy, multiply_add(n.y * n.y, over, sign), -n.y},
          n};
}

/// A body's tensor of curvature, weight F'F.
struct PackCurvature {
  PackVec3 first, second;  ///< columns of F, which belong to the frame's tangents
  Pack support;            ///< h
  Pack volume2;            ///< (a_1 a_2 a_3)^2, 1 of a flat body: weight = h / volume2
};

HWY_INLINE PackCurvature curvature(const PackFactor& body, const PackFrame& frame) {
  const PackVec3* s = body.column;
  const auto turned = [&](const PackVec3& v) HWY_ATTR {
    return PackVec3{dot(s[0], v), dot(s[1], v), dot(s[2], v)};
  };
  const PackVec3 y = turned(frame.normal), p = turned(frame.first), q = turned(frame.second);
  const Pack volume2 = dot(s[0], s[0]) * dot(s[1], s[1]) * dot(s[2], s[2]);
  const Pack nothing = all(0.0);
  return {cross(q, y), cross(y, p), root(dot(y, y)), chosen(volume2 <= nothing, all(1.0), volume2)};
}

/// The relative curvatures in units of their geometric mean: their half sum and half difference,
/// and where the larger one is.
struct PackRelative {
  Pack product;         ///< of the curvatures, 1/length^2
  Pack inverse_mean;    ///< 1 / sqrt(product)
  Pack sum;             ///< cosh(L/2), L = ln(larger / smaller)
  Pack difference;      ///< sinh(L/2)
  Pack along, between;  ///< half difference (xx - yy) / 2 and xy of the tensor
};

HWY_INLINE PackRelative relative(const PackCurvature& a, const PackCurvature& b) {
  const Pack inverse = all(1.0) / (a.volume2 * b.volume2);
  const Pack weight_a = a.support * (inverse * b.volume2);
  const Pack weight_b = b.support * (inverse * a.volume2);
  const Pack xx = multiply_add(weight_b, dot(b.first, b.first), weight_a * dot(a.first, a.first));
  const Pack yy =
      multiply_add(weight_b, dot(b.second, b.second), weight_a * dot(a.second, a.second));
  const Pack xy = multiply_add(weight_b, dot(b.first, b.second), weight_a * dot(a.first, a.second));
  // Cauchy and Binet: squares only, so that two nearly parallel thin bodies keep what they have.
  const auto minors = [&](const Pack& first, const Pack& second) HWY_ATTR {
    const PackVec3 m = multiply_take(second, b.first, b.second * first);
    return dot(m, m);
  };
  const Pack mixed =
      minors(a.first.x, a.second.x) + minors(a.first.y, a.second.y) + minors(a.first.z, a.second.z);
  const Pack alone_a = a.support * a.support * (a.support * weight_a);
  const Pack alone_b = b.support * b.support * (b.support * weight_b);
  const Pack product = multiply_add(weight_a * weight_b, mixed, alone_a + alone_b);
  const Pack inverse_mean = inverse_root(product), half = all(0.5) * inverse_mean;
  const Pack along = (xx - yy) * half, between = xy * inverse_mean;
  return {
      product, inverse_mean, (xx + yy) * half, root(multiply_add(along, along, between * between)),
      along,   between};
}

/// The unit tangent along which the curvature is smaller.
HWY_INLINE PackVec3 flatter(const PackRelative& k, const PackFrame& frame) {
  // Above kEqual, so that the square is in the range of inverse_root().
  const Pack large = larger(k.difference + absolute(k.along), all(kEqual)), small = -k.between;
  const Pack scale = inverse_root(multiply_add(large, large, small * small));
  const PackMask second = k.along >= all(0.0);
  const Pack x = chosen(second, small, large) * scale, y = chosen(second, large, small) * scale;
  return multiply_add(x, frame.first, frame.second * y);
}

template <std::size_t terms>
HWY_INLINE Pack polynomial(const double (&coefficient)[terms], const Pack& z) {
  Pack sum = all(coefficient[terms - 1]);
  for (std::size_t k = terms - 1; k-- > 0;) sum = multiply_add(sum, z, all(coefficient[k]));
  return sum;
}

/// All lanes from index i on; the answered ones as bits.
HWY_INLINE std::uint64_t answer(const HertzBlock& block, std::size_t i) {
  const PackFrame frame = frame_of(load_vectors(block.normal + 3 * i));
  const PackRelative k = relative(
      curvature(load_factor(block, i, [](const IndexedPair& p) HWY_ATTR { return p.a; }), frame),
      curvature(load_factor(block, i, [](const IndexedPair& p) HWY_ATTR { return p.b; }), frame));
  const Pack overlap = load(block.overlap + i), zero = all(0.0);

  // x = tanh(L/8) by halving twice; f and g of docs/derivations/hertz-lanes.md at z = x^2.
  const Pack quarter = root(multiply_add(all(0.5), k.sum, all(0.5)));
  const Pack x = k.difference / (all(2.0) * multiply_add(quarter, quarter, quarter)), z = x * x;
  const Pack t = z - all(kForceCentre);
  const Pack f_over = polynomial(kForceOver, t), f_under = polynomial(kForceUnder, t);
  const Pack g_over = polynomial(kShareOver, z), g_under = polynomial(kShareUnder, z);

  // 1 - nu/2 -+ nu (D/K - 1/2), all over g_under.
  const Pack nu = load(block.poisson_ratio + i), half_nu = multiply_take(all(0.5), nu, all(1.0));
  const Pack odd = nu * x * g_over;
  const Pack give_along = multiply_add(half_nu, g_under, odd);
  const Pack give_across = half_nu * g_under - odd;
  const Pack both = give_along * give_across, inverse = all(1.0) / (f_under * both);

  // 3/2 f sqrt(overlap / mean curvature): dP / d overlap over E*.
  const PackMask touching = overlap > zero, apart = overlap <= zero;
  const Pack radius = root(larger(overlap * k.inverse_mean, zero));
  const Pack slope = all(1.5) * radius * f_over * (inverse * both);
  const Pack shear = load(block.shear_modulus + i) * slope * g_under * (inverse * f_under);
  const Pack stiffness = load(block.contact_modulus + i) * slope;
  const Pack force = all(2.0 / 3.0) * stiffness * overlap;
  const auto of_touching = [&](const Pack& p) HWY_ATTR { return chosen(touching, p, zero); };
  store(of_touching(stiffness), block.stiffness + i);
  store(of_touching(force), block.force + i);
  store(of_touching(all(0.4) * force * overlap), block.energy + i);
  store(of_touching(shear * give_across), block.along + i);
  store(of_touching(shear * give_along), block.across + i);
  store(chosen(touching, flatter(k, frame), {zero, zero, zero}), block.direction + 3 * i);

  const PackMask in_range = (k.product >= all(kLeastProduct)) &
                            (k.product <= all(kLargestProduct)) & (k.sum <= all(kMostMean));
  return bits(apart | (touching & in_range));
}

HWY_ATTR std::uint64_t hertz_lanes(const HertzBlock& block) {
  std::uint64_t answered = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.count); i += pack_lanes()) {
    answered |= answer(block, i) << i;
  }
  return answered;
}

}  // namespace
}  // namespace tangency::inline v0::dem::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::dem {
namespace {
HWY_EXPORT(hertz_lanes);
}  // namespace

std::uint64_t hertz_lanes(const HertzBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(hertz_lanes)(block);
}

}  // namespace tangency::inline v0::dem
#endif
