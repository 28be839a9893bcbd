// SPDX-License-Identifier: MIT
#include <tangency/geometry/relation.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation/exact_pair.hpp>
#include <tangency/geometry/relation/overlap_filter.hpp>

namespace tangency::inline v0 {
namespace {

using detail::Filtered;
using detail::OverlapFilter;
using exact::Containment;
using exact::ExactPair;
using exact::Position;
using AskedPair = detail::AskedPair<Ellipsoid>;
using UnitPair = detail::UnitPair<Ellipsoid>;

/// In the unit of the caller or, where the filters cannot use that, in one that may suit them.
[[gnu::always_inline]] inline UnitPair in_unit(const AskedPair& asked) {
  const Vec3 d = asked.d();
  return {asked, d, detail::moderate(asked.a, asked.b, d)};
}
bool suits_the_filters(const UnitPair& pair) {
  return pair.in_own_unit() || detail::moderate(pair.a, pair.b, pair.d);
}

/// The answer of the filter in double or, where it cannot tell, in double-double.
Filtered settled(const OverlapFilter& filter, const UnitPair& pair) {
  if (filter.answer() != Filtered::unknown) return filter.answer();
  return detail::filter_overlap_in_double_double(pair.a, pair.b, pair.d, pair.rest_of_d(),
                                                 filter.normal());
}

/// What both filters tell.
Filtered filter_overlap(const AskedPair& asked) {
  const UnitPair pair = in_unit(asked);
  if (!suits_the_filters(pair)) return Filtered::unknown;
  return settled(OverlapFilter(pair.a, pair.b, pair.d), pair);
}

/// In integers, of the bodies about the centres that are asked for.
ExactPair exact_pair(const AskedPair& asked) {
  if (asked.separation == nullptr) return {asked.a, asked.b};
  const auto [a, b] = asked.placed();
  return {a, b};
}

/// Whatever the filter in double does not tell at once.
[[gnu::noinline]] OverlapAnswer doubtful_overlap(const AskedPair& asked) {
  const Filtered found = filter_overlap(asked);
  if (found != Filtered::unknown) return {found == Filtered::interiors_meet, Tier::filter};
  return {exact_pair(asked).position() == Position::interiors_meet, Tier::exact};
}

[[gnu::always_inline]] inline OverlapAnswer overlap(const AskedPair& asked) {
  // This filter holds in every environment; what it does not tell asks which one it is in.
  const Vec3 d = asked.d();
  if (detail::moderate(asked.a, asked.b, d)) {
    const Filtered found = OverlapFilter(asked.a, asked.b, d).answer();
    if (found != Filtered::unknown) return {found == Filtered::interiors_meet, Tier::filter};
  }
  return in_default_environment([&] { return doubtful_overlap(asked); });
}

std::optional<bool> overlap_by_filter(const AskedPair& asked) {
  const Filtered found = in_default_environment([&] { return filter_overlap(asked); });
  if (found == Filtered::unknown) return std::nullopt;
  return found == Filtered::interiors_meet;
}

/// What the filters tell: the relation, or no more than that the interiors meet, or nothing.
struct Found {
  std::optional<Relation> relation;
  bool interiors_meet = false;
};

Found filter_relation(const AskedPair& asked) {
  const UnitPair pair = in_unit(asked);
  if (!suits_the_filters(pair)) return {};
  const OverlapFilter filter(pair.a, pair.b, pair.d);
  const Filtered interiors = settled(filter, pair);
  if (interiors == Filtered::apart) return {Relation::separate};
  if (interiors == Filtered::unknown) return {};
  const Vec3 n = filter.normal();
  if (!detail::proves_sticking_out(pair.a, pair.b, pair.d, n)) {
    if (detail::proves_inside(pair.a, pair.b, pair.d)) return {Relation::a_in_b};
  } else if (detail::proves_sticking_out(pair.b, pair.a, -pair.d, n)) {
    return {Relation::overlap};
  } else if (detail::proves_inside(pair.b, pair.a, -pair.d)) {
    return {Relation::b_in_a};
  }
  return {std::nullopt, true};
}

RelationAnswer exactly(Relation relation, Inner inner = Inner::none) {
  return {relation, inner, Tier::exact};
}

/// For a pair whose interiors meet.
RelationAnswer exact_containment(const ExactPair& pair) {
  if (pair.equal()) return exactly(Relation::equal);
  const Containment a_in_b = pair.containment();
  if (a_in_b == Containment::interior) return exactly(Relation::a_in_b);
  if (a_in_b == Containment::touching) return exactly(Relation::internal_touch, Inner::a);
  const Containment b_in_a = pair.exchanged().containment();
  if (b_in_a == Containment::interior) return exactly(Relation::b_in_a);
  if (b_in_a == Containment::touching) return exactly(Relation::internal_touch, Inner::b);
  return exactly(Relation::overlap);
}

[[gnu::noinline]] RelationAnswer exact_relation(const ExactPair& pair,
                                                bool interiors_meet = false) {
  if (interiors_meet) return exact_containment(pair);
  const Position position = pair.position();
  if (position == Position::apart) return exactly(Relation::separate);
  if (position == Position::touching) return exactly(Relation::external_touch);
  return exact_containment(pair);
}

RelationAnswer found_relation(const AskedPair& asked) {
  const Found found = filter_relation(asked);
  if (found.relation) return {*found.relation, Inner::none, Tier::filter};
  return exact_relation(exact_pair(asked), found.interiors_meet);
}

/// @param centre  in place of its own, if it is given
exact::EllipsoidForm form_of(const MatrixEllipsoid& body, const Vec3* centre = nullptr) {
  if (body.exact() == nullptr) {
    const Ellipsoid& e = body.ellipsoid();
    return exact::ellipsoid_form(centre != nullptr ? e.moved_to(*centre) : e);
  }
  if (centre == nullptr) return exact::integer_form(*body.exact());
  exact::RationalSolid<3> moved = *body.exact();
  for (std::size_t i = 0; i < 3; ++i) {
    moved.centre[i] = exact::to_rational((*centre)[static_cast<int>(i)]);
  }
  return exact::integer_form(moved);
}

/// The form of the solid moved by edges * image.
exact::SolidForm<4> moved(exact::SolidForm<4> solid, const Mat3& edges, const LatticeImage& image) {
  const int unit = exact::length_exponent(edges, image, 0);
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

/// The solid by doubles, so much smaller or larger that the true one has it, or lies, inside.
struct Margins {
  Ellipsoid inner, outer;

  explicit Margins(const MatrixEllipsoid& body)
      : inner(scaled(body.ellipsoid(), 1.0 - margin(body))),
        outer(scaled(body.ellipsoid(), 1.0 + margin(body))) {}

 private:
  /// The share itself, the rounding of 1 + it and that of the products.
  static double margin(const MatrixEllipsoid& body) {
    return body.relative_rounding() + (body.exact() != nullptr ? 0x1p-50 : 0.0);
  }
  static Ellipsoid scaled(const Ellipsoid& e, double factor) {
    return Ellipsoid(e.centre(), factor * e.semi_axes(), e.orientation());
  }
};

/// What is so for all bodies between the margins. About other centres they are margins still: no
/// support function of the bodies about their centres differs by a larger share.
std::optional<Relation> relation_within(const Margins& a, const Margins& b,
                                        const Vec3* separation) {
  if (filter_overlap({a.outer, b.outer, separation}) == Filtered::apart) return Relation::separate;
  const auto of_larger_a = filter_relation({a.outer, b.inner, separation}).relation;
  if (of_larger_a == Relation::a_in_b) return of_larger_a;
  const auto of_larger_b = filter_relation({a.inner, b.outer, separation}).relation;
  if (of_larger_b == Relation::b_in_a) return of_larger_b;
  // Then the smaller b sticks out of the larger a, and the smaller a out of the larger b.
  const bool both = of_larger_a == Relation::overlap && of_larger_b == Relation::overlap;
  if (both && filter_overlap({a.inner, b.inner, separation}) == Filtered::interiors_meet)
    return Relation::overlap;
  return std::nullopt;
}

/// Beyond it a margin tells nothing, and axes that are near the ends of the range would leave it.
bool has_margin(const MatrixEllipsoid& body) {
  return body.relative_rounding() < 0x1p-10 && body.ellipsoid().moderate();
}

/// @param separation  in place of the centres, if it is given
RelationAnswer relation_of_matrices(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                                    const Vec3* separation) {
  if (has_margin(a) && has_margin(b)) {
    if (const auto known = relation_within(Margins(a), Margins(b), separation))
      return {*known, Inner::none, Tier::filter};
  }
  const Vec3 origin = Vec3::Zero();
  const ExactPair pair(form_of(a, separation != nullptr ? &origin : nullptr),
                       form_of(b, separation));
  return exact_relation(pair);
}

}  // namespace

std::string_view to_string(Relation relation) noexcept {
  switch (relation) {
    case Relation::separate:
      return "separate";
    case Relation::external_touch:
      return "external_touch";
    case Relation::overlap:
      return "overlap";
    case Relation::internal_touch:
      return "internal_touch";
    case Relation::a_in_b:
      return "a_in_b";
    case Relation::b_in_a:
      return "b_in_a";
    case Relation::equal:
      break;
  }
  return "equal";
}

OverlapAnswer overlap_answer(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return overlap({a, b});
}

OverlapAnswer overlap_answer(const Ellipsoid& a, const Ellipsoid& b,
                             const Vec3& separation) noexcept {
  contract::require_finite("overlap_answer", "separation", separation);
  return overlap({a, b, &separation});
}

std::optional<bool> overlaps_by_filter(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return overlap_by_filter({a, b});
}

std::optional<bool> overlaps_by_filter(const Ellipsoid& a, const Ellipsoid& b,
                                       const Vec3& separation) noexcept {
  contract::require_finite("overlaps_by_filter", "separation", separation);
  return overlap_by_filter({a, b, &separation});
}

RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return found_relation({a, b}); });
}

RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept {
  contract::require_finite("relation", "separation", separation);
  return in_default_environment([&] { return found_relation({a, b, &separation}); });
}

RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b) noexcept {
  if (a.exact() == nullptr && b.exact() == nullptr) return relation(a.ellipsoid(), b.ellipsoid());
  return in_default_environment([&] { return relation_of_matrices(a, b, nullptr); });
}

RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                        const Vec3& separation) noexcept {
  if (a.exact() == nullptr && b.exact() == nullptr) {
    return relation(a.ellipsoid(), b.ellipsoid(), separation);
  }
  contract::require_finite("relation", "separation", separation);
  return in_default_environment([&] { return relation_of_matrices(a, b, &separation); });
}

RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept {
  if (image == LatticeImage{}) return relation(a, b);
  const ImageSeparation d = separation(a.centre(), b.centre(), edges, image);
  if (d.error == 0.0) return relation(a, b, d.vector);
  return in_default_environment([&] { return exact_relation(ExactPair(a, b, edges, image)); });
}

RelationAnswer relation(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const Mat3& edges,
                        const LatticeImage& image) noexcept {
  if (image == LatticeImage{}) return relation(a, b);
  if (a.exact() == nullptr && b.exact() == nullptr)
    return relation(a.ellipsoid(), b.ellipsoid(), edges, image);
  return in_default_environment(
      [&] { return exact_relation(ExactPair(form_of(a), moved(form_of(b), edges, image))); });
}

}  // namespace tangency::inline v0
