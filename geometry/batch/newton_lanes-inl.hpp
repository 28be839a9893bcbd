// SPDX-License-Identifier: MIT
/// @file
/// Support functions from M, and the matrix of Newton's method for n.d - h_A - h_B on the sphere of
/// normals, one pair in each lane, in double and in float. Compiled once for each instruction set.
#if defined(TANGENCY_NEWTON_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_NEWTON_LANES_INL
#undef TANGENCY_NEWTON_LANES_INL
#else
#define TANGENCY_NEWTON_LANES_INL
#endif

#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

/// Of a body at a normal: 1 / h and the support point.
template <class P>
struct SupportOf {
  P inverse_h;
  Vec3Of<P> point;
};
using PackSupport = SupportOf<Pack>;
using FloatSupport = SupportOf<FloatPack>;

/// From M: quicker than from a factor, and good enough to see where to go.
template <class P>
HWY_INLINE SupportOf<P> glance(const Symmetric3Of<P>& shape, const Vec3Of<P>& n) {
  const Vec3Of<P> point = shape * n;
  const P inverse = inverse_root(dot(n, point));
  return {inverse, point * inverse};
}

/// K = H + gap (I - n n') + L n n' with H = Hess (h_A + h_B) = (M - x x') / h of both, H n = 0: the
/// step is K^-1 r, as r is normal to n.
/// @param size  L
template <class P>
HWY_INLINE Symmetric3Of<P> newton_matrix(const Symmetric3Of<P>& shape_a,
                                         const Symmetric3Of<P>& shape_b, const SupportOf<P>& a,
                                         const SupportOf<P>& b, const P& size, const P& gap,
                                         const Vec3Of<P>& n) {
  Symmetric3Of<P> k = multiply_add(b.inverse_h, shape_b, shape_a * a.inverse_h);
  k = with_square(k, -a.inverse_h, a.point);
  k = with_square(k, -b.inverse_h, b.point);
  k = with_square(k, size - gap, n);
  k.xx = k.xx + gap;
  k.yy = k.yy + gap;
  k.zz = k.zz + gap;
  return k;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
