// SPDX-License-Identifier: MIT
#include <tangency/geometry/image_pair.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/gap/sign.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation/exact_pair.hpp>

namespace tangency {
namespace {

constexpr LatticeImage kHere{0, 0, 0};

/// A sum of doubles, and how far it may be from that of the numbers that were added.
struct TrackedSum {
  double value = 0.0;
  double error = 0.0;

  void add(double term) {
    const detail::DoubleDouble sum = detail::two_sum(value, term);
    value = sum.high;
    error += std::abs(sum.low);
  }
  void add_product(double edge, std::int32_t times) {
    const double product = edge * times;
    // By a power of two nothing is rounded, whatever the edge is.
    if (!std::has_single_bit(static_cast<std::uint32_t>(std::abs(std::int64_t{times}))))
      error += kUnitRoundoff * std::abs(product) + std::numeric_limits<double>::denorm_min();
    add(product);
  }
};

ImageSeparation separation_here(const Vec3& centre_a, const Vec3& centre_b, const Mat3& edges,
                                const LatticeImage& image) {
  ImageSeparation found{Vec3::Zero(), 0.0};
  for (int i = 0; i < 3; ++i) {
    TrackedSum sum{centre_b[i], 0.0};
    sum.add(-centre_a[i]);
    for (int k = 0; k < 3; ++k) {
      const std::int32_t times = image[static_cast<std::size_t>(k)];
      if (times != 0) sum.add_product(edges(i, k), times);
    }
    found.vector[i] = sum.value;
    found.error += sum.error;
  }
  found.error *= 1.0 + 0x1p-48;  // for the sums of the errors
  return found;
}

/// The form of the solid moved by edges * image.
exact::SolidForm<4> moved(exact::SolidForm<4> solid, const Mat3& edges, const LatticeImage& image) {
  int unit = 0;
  for (int k = 0; k < 3; ++k)
    if (image[static_cast<std::size_t>(k)] != 0 && !edges.col(k).isZero(0.0))
      unit = std::min(unit, exact::common_exponent(std::span(edges.col(k).data(), 3)));
  std::array<mpz_class, 3> by;  // in 2^unit, where 1 is `one`
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t times = image[static_cast<std::size_t>(k)];
      if (times != 0)
        by[static_cast<std::size_t>(i)] += times * exact::to_integer(edges(i, k), unit);
    }
  const mpz_class one = mpz_class(1) << static_cast<mp_bitcnt_t>(-unit);
  // (one x - by)' F (one x - by), with x and the number 1 in one vector.
  const exact::IntegerForm<4>& form = solid.form;
  exact::SolidForm<4> result;
  result.denominator = solid.denominator * one * one;
  result.form[3][3] = form[3][3] * one * one;
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_class turned;  // of the block
    for (std::size_t k = 0; k < 3; ++k) {
      result.form[i][k] = form[i][k] * one * one;
      turned += form[i][k] * by[k];
    }
    result.form[i][3] = result.form[3][i] = one * (one * form[i][3] - turned);
    result.form[3][3] += by[i] * turned - 2 * one * form[i][3] * by[i];
  }
  return result;
}

exact::SolidForm<4> form_of(const MatrixEllipsoid& body) {
  return body.exact() != nullptr ? exact::integer_form(*body.exact())
                                 : exact::ellipsoid_form(body.ellipsoid());
}

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

ImageSeparation separation(const Vec3& centre_a, const Vec3& centre_b, const Mat3& edges,
                           const LatticeImage& image) noexcept {
  return in_default_environment([&] {
    ImageSeparation found = separation_here(centre_a, centre_b, edges, image);
    if (found.vector.allFinite() && std::isfinite(found.error)) return found;
    // Terms that overflow on the way: in a unit that has room for four of them, 2^31 times an edge.
    constexpr double kSmall = 0x1p-40, kMost = std::numeric_limits<double>::max();
    found = separation_here(kSmall * centre_a, kSmall * centre_b, kSmall * edges, image);
    const Vec3 vector = (found.vector / kSmall).cwiseMin(kMost).cwiseMax(-kMost);
    // Scaling down rounds numbers below 2^-982.
    const bool in_range = kSmall * vector == found.vector;
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    return ImageSeparation{vector, in_range ? found.error / kSmall + 0x1p-990 : kInfinite};
  });
}

RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept {
  if (image == kHere) return relation(a, b);
  const ImageSeparation d = separation(a.centre(), b.centre(), edges, image);
  if (d.error == 0.0) return relation(a.moved_to(Vec3::Zero()), b.moved_to(d.vector));
  return in_default_environment(
      [&] { return exact::exact_relation(exact::ExactPair(a, b, edges, image)); });
}

RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept {
  if (image == kHere) return relation(a, b);
  if (a.exact() == nullptr && b.exact() == nullptr)
    return relation(a.ellipsoid(), b.ellipsoid(), edges, image);
  return in_default_environment([&] {
    return exact::exact_relation(exact::ExactPair(form_of(a), moved(form_of(b), edges, image)));
  });
}

Gap widened_gap(const Gap& rounded, double off, const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                const Mat3& edges, const LatticeImage& image) noexcept {
  if (off == 0.0 || !std::isfinite(rounded.gap)) return rounded;
  return in_default_environment([&] {
    const Vec3 d = separation(a.ellipsoid().centre(), b.ellipsoid().centre(), edges, image).vector;
    // gap + gap_error is rounded by no more than this.
    const double wide = off + 0x1p-52 * std::abs(rounded.gap);
    return detail::widened(rounded, wide, ExactImage{a, b, edges, image},
                           2.0 * d.cwiseAbs().maxCoeff() + wide);
  });
}

Gap signed_gap(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept {
  if (image == kHere) return signed_gap(a, b);
  const ImageSeparation d = separation(a.centre(), b.centre(), edges, image);
  return widened_gap(signed_gap(a, b, d.vector), d.error, a, b, edges, image);
}

Gap signed_gap(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
               const LatticeImage& image) noexcept {
  if (image == kHere) return signed_gap(a, b);
  const Ellipsoid &round_a = a.ellipsoid(), &round_b = b.ellipsoid();
  const ImageSeparation d = separation(round_a.centre(), round_b.centre(), edges, image);
  return widened_gap(signed_gap(round_a, round_b, d.vector), d.error + a.rounding() + b.rounding(),
                     a, b, edges, image);
}

}  // namespace tangency
