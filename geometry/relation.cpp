// SPDX-License-Identifier: MIT
#include <tangency/geometry/relation.hpp>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation/exact_pair.hpp>
#include <tangency/geometry/relation/overlap_filter.hpp>

namespace tangency {
namespace {

using detail::Filtered;
using detail::OverlapFilter;

/// Calls ask(a, b, d, d_low) with the pair in a unit that suits the filters, c_B - c_A = d + d_low;
/// `otherwise` where there is none.
template <class Answer, class Ask>
Answer filtered(const Ellipsoid& a, const Ellipsoid& b, Answer otherwise, const Ask& ask) noexcept {
  const Vec3 d = b.centre() - a.centre();
  if (detail::moderate(a, b, d)) {
    return ask(a, b, d, [&] { return detail::separation_error(a.centre(), b.centre(), d); });
  }
  const detail::ScaledPair pair = detail::scaled_pair(a, b);
  if (!detail::moderate(pair.a, pair.b, pair.d)) return otherwise;
  return ask(pair.a, pair.b, pair.d, [&] { return pair.d_low; });
}

/// The answer of the filter in double or, where it cannot tell, in double-double.
template <class SeparationError>
Filtered settled(const OverlapFilter& filter, const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                 const SeparationError& d_low) {
  if (filter.answer() != Filtered::unknown) return filter.answer();
  return detail::filter_overlap_in_double_double(a, b, d, d_low(), filter.normal());
}

enum class Found { apart, overlapping, a_inside, b_inside, meeting, unknown };

template <class SeparationError>
Found filter_relation(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                      const SeparationError& d_low) {
  const OverlapFilter filter(a, b, d);
  switch (settled(filter, a, b, d, d_low)) {
    case Filtered::apart:
      return Found::apart;
    case Filtered::unknown:
      return Found::unknown;
    case Filtered::interiors_meet:
      break;
  }
  const Vec3 n = filter.normal();
  if (!detail::proves_sticking_out(a, b, d, n)) {
    return detail::proves_inside(a, b, d) ? Found::a_inside : Found::meeting;
  }
  if (detail::proves_sticking_out(b, a, -d, n)) return Found::overlapping;
  return detail::proves_inside(b, a, -d) ? Found::b_inside : Found::meeting;
}

/// For a pair whose interiors meet.
RelationAnswer exact_containment(const exact::PairPolynomials& pair) {
  using exact::Containment;
  constexpr Tier tier = Tier::exact;
  if (exact::equal(pair)) return {Relation::equal, Inner::none, tier};
  switch (exact::containment(pair)) {
    case Containment::interior:
      return {Relation::a_in_b, Inner::none, tier};
    case Containment::touching:
      return {Relation::internal_touch, Inner::a, tier};
    case Containment::none:
      break;
  }
  switch (exact::containment(pair.exchanged())) {
    case Containment::interior:
      return {Relation::b_in_a, Inner::none, tier};
    case Containment::touching:
      return {Relation::internal_touch, Inner::b, tier};
    case Containment::none:
      break;
  }
  return {Relation::overlap, Inner::none, tier};
}

/// What both filters tell.
Filtered filter_overlap(const Ellipsoid& a, const Ellipsoid& b) {
  return filtered(a, b, Filtered::unknown,
                  [](const Ellipsoid& pa, const Ellipsoid& pb, const Vec3& d, const auto& d_low) {
                    return settled(OverlapFilter(pa, pb, d), pa, pb, d, d_low);
                  });
}

/// Whatever the filter in double does not tell at once.
OverlapAnswer doubtful_overlap(const Ellipsoid& a, const Ellipsoid& b) {
  const Filtered found = filter_overlap(a, b);
  if (found != Filtered::unknown) return {found == Filtered::interiors_meet, Tier::filter};
  const exact::Position position = exact::position(exact::pair_quartic(a, b));
  return {position == exact::Position::interiors_meet, Tier::exact};
}

RelationAnswer found_relation(const Ellipsoid& a, const Ellipsoid& b) {
  const Found found = filtered(a, b, Found::unknown,
                               [](const Ellipsoid& pa, const Ellipsoid& pb, const Vec3& d,
                                  const auto& d_low) { return filter_relation(pa, pb, d, d_low); });
  switch (found) {
    case Found::apart:
      return {Relation::separate, Inner::none, Tier::filter};
    case Found::overlapping:
      return {Relation::overlap, Inner::none, Tier::filter};
    case Found::a_inside:
      return {Relation::a_in_b, Inner::none, Tier::filter};
    case Found::b_inside:
      return {Relation::b_in_a, Inner::none, Tier::filter};
    case Found::meeting:
      return exact_containment(exact::pair_polynomials(a, b));
    case Found::unknown:
      break;
  }
  const exact::PairPolynomials pair = exact::pair_polynomials(a, b);
  switch (exact::position(pair.quartic)) {
    case exact::Position::apart:
      return {Relation::separate, Inner::none, Tier::exact};
    case exact::Position::touching:
      return {Relation::external_touch, Inner::none, Tier::exact};
    case exact::Position::interiors_meet:
      break;
  }
  return exact_containment(pair);
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
  // This filter holds in every environment; what it does not tell asks which one it is in.
  const Vec3 d = b.centre() - a.centre();
  if (detail::moderate(a, b, d)) {
    const Filtered found = OverlapFilter(a, b, d).answer();
    if (found != Filtered::unknown) return {found == Filtered::interiors_meet, Tier::filter};
  }
  return in_default_environment([&] { return doubtful_overlap(a, b); });
}

std::optional<bool> overlaps_by_filter(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  const Filtered found = in_default_environment([&] { return filter_overlap(a, b); });
  if (found == Filtered::unknown) return std::nullopt;
  return found == Filtered::interiors_meet;
}

RelationAnswer relation(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return found_relation(a, b); });
}

}  // namespace tangency
