// SPDX-License-Identifier: MIT
/// @file
/// perram_wertheim.hpp with one pair in each lane. Compiled once for each instruction set.
#if defined(TANGENCY_PERRAM_WERTHEIM_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PERRAM_WERTHEIM_LANES_INL
#undef TANGENCY_PERRAM_WERTHEIM_LANES_INL
#else
#define TANGENCY_PERRAM_WERTHEIM_LANES_INL
#endif

#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

/// The X of adj(A + l B) = adj A + l X + l^2 adj B.
template <class P>
HWY_INLINE Symmetric3Of<P> mixed_adjugate(const Symmetric3Of<P>& a, const Symmetric3Of<P>& b) {
  // Entry by entry minor(...) of adjugate(), polarised.
  const auto polar = [](const P& ap, const P& bp, const P& aq, const P& bq, const P& ar,
                        const P& br, const P& as, const P& bs) HWY_ATTR {
    const P plus = multiply_add(ap, bq, aq * bp);
    return multiply_take(ar, bs, multiply_take(as, br, plus));
  };
  return {polar(a.yy, b.yy, a.zz, b.zz, a.yz, b.yz, a.yz, b.yz),
          polar(a.zz, b.zz, a.xx, b.xx, a.zx, b.zx, a.zx, b.zx),
          polar(a.xx, b.xx, a.yy, b.yy, a.xy, b.xy, a.xy, b.xy),
          polar(a.zx, b.zx, a.xy, b.xy, a.xx, b.xx, a.yz, b.yz),
          polar(a.xy, b.xy, a.yz, b.yz, a.yy, b.yy, a.zx, b.zx),
          polar(a.yz, b.yz, a.zx, b.zx, a.zz, b.zz, a.xy, b.xy)};
}

/// D and N at one l by their terms, and what Euler's operator l d/dl makes of them once and twice.
template <class P>
struct PerramWertheimAt {
  P l, det, det1, det2, num, num1, num2;
};

template <class P>
struct PerramWertheimForm {
  Vec3Of<P> v0, v1, v2;  ///< J_A d, X d, J_B d
  P d0, d1, d2, d3;
  P n0, n1, n2;

  PerramWertheimForm() = default;
  HWY_INLINE PerramWertheimForm(const Symmetric3Of<P>& a, const Symmetric3Of<P>& b,
                                const Vec3Of<P>& d) {
    const Symmetric3Of<P> ja = adjugate(a), jb = adjugate(b);
    d0 = determinant(a, ja);
    d1 = trace_of_product(ja, b);
    d2 = trace_of_product(jb, a);
    d3 = determinant(b, jb);
    v0 = ja * d;
    v1 = mixed_adjugate(a, b) * d;
    v2 = jb * d;
    n0 = dot(v0, d);
    n1 = dot(v1, d);
    n2 = dot(v2, d);
  }

  /// Where the outer coefficients balance, roughly.
  HWY_INLINE P first_guess() const { return rough_root((n2 * d0) * rough_inverse(n0 * d3)); }

  HWY_INLINE PerramWertheimAt<P> at(const P& l) const {
    const P l2 = l * l;
    const P t1 = l * d1, t2 = l2 * d2, t3 = (l * l2) * d3, m1 = l * n1, m2 = l2 * n2;
    return {l,
            (d0 + t1) + (t2 + t3),
            multiply_add(all<P>(3.0), t3, multiply_add(all<P>(2.0), t2, t1)),
            multiply_add(all<P>(9.0), t3, multiply_add(all<P>(4.0), t2, t1)),
            (n0 + m1) + m2,
            multiply_add(all<P>(2.0), m2, m1),
            multiply_add(all<P>(4.0), m2, m1)};
  }

  /// A multiple > 0 of (M_A + l M_B)^-1 d.
  HWY_INLINE Vec3Of<P> direction(const P& l) const {
    return multiply_add(l, multiply_add(l, v2, v1), v0);
  }
};

using PackPerramWertheim = PerramWertheimForm<Pack>;
using PackPerramWertheimAt = PerramWertheimAt<Pack>;
using FloatPerramWertheim = PerramWertheimForm<FloatPack>;
using FloatPerramWertheimAt = PerramWertheimAt<FloatPack>;

/// One step of Newton's method on log l towards the maximum of F, of no more than 1.8.
template <class P>
HWY_INLINE P next(const PerramWertheimAt<P>& at) {
  const P one_more = all<P>(1.0) + at.l, both = at.num * at.det;
  // One division for three.
  const P inverse = rough_inverse(both * one_more);
  const P s = both * inverse, n = (at.det * one_more) * inverse, d = (at.num * one_more) * inverse;
  const P p = n * at.num1, q = d * at.det1;
  const P slope = (s + p) - q;
  const P bend_n = multiply_take(p, p, n * at.num2), bend_d = multiply_take(q, q, d * at.det2);
  const P curvature = multiply_take(at.l * s, s, bend_n - bend_d);
  // With half = -slope / (2 curvature), exp(2 half) is nearly (1 + half) / (1 - half).
  const auto usual = absolute(slope) < all<P>(-1.8) * curvature;
  const P twice = curvature + curvature;
  const P factor = (twice - slope) * rough_inverse(twice + slope);
  const P most = chosen(slope > all<P>(0.0), all<P>(19.0), all<P>(1.0 / 19.0));  // half = 0.9, -0.9
  return at.l * chosen(usual, factor, most);
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
