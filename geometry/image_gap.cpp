// SPDX-License-Identifier: MIT
#include <tangency/geometry/image_gap.hpp>

#include <cmath>

#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {
namespace {

/// What the exact relation tells of a pair, for detail::widened().
struct ExactImage {
  const MatrixEllipsoid& a;
  const MatrixEllipsoid& b;
  const Mat3& edges;
  const LatticeImage& image;

  Relation relation() const { return tangency::relation(a, b, edges, image).relation; }
  bool overlaps(GapTier& tier) const {
    const RelationAnswer answer = tangency::relation(a, b, edges, image);
    if (answer.tier == Tier::exact) tier = GapTier::exact;
    return answer.relation != Relation::separate && answer.relation != Relation::external_touch;
  }
};

}  // namespace

Gap widened_gap(const Gap& rounded, double off, const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                const Mat3& edges, const LatticeImage& image) noexcept {
  if (off == 0.0 || !std::isfinite(rounded.gap)) return rounded;
  return in_default_environment([&] {
    const Vec3 d = separation(a.ellipsoid().centre(), b.ellipsoid().centre(), edges, image).vector;
    return detail::widened(rounded, off, ExactImage{a, b, edges, image},
                           2.0 * d.cwiseAbs().maxCoeff() + off);
  });
}

Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept {
  if (image == LatticeImage{}) return signed_gap(a, b);
  const ImageSeparation d = separation(a.centre(), b.centre(), edges, image);
  return widened_gap(signed_gap(a, b, d.vector), d.error, a, b, edges, image);
}

Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept {
  if (image == LatticeImage{}) return signed_gap(a, b);
  const Ellipsoid &round_a = a.ellipsoid(), &round_b = b.ellipsoid();
  const ImageSeparation d = separation(round_a.centre(), round_b.centre(), edges, image);
  return widened_gap(signed_gap(round_a, round_b, d.vector), d.error + a.rounding() + b.rounding(),
                     a, b, edges, image);
}

}  // namespace tangency::inline v0
