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
using exact::Containment;
using exact::ExactPair;
using exact::Position;
using UnitPair = detail::UnitPair<Ellipsoid>;

/// In the unit of the caller or, where the filters cannot use that, in one that may suit them.
[[gnu::always_inline]] inline UnitPair in_unit(const Ellipsoid& a, const Ellipsoid& b) {
  const Vec3 d = b.centre() - a.centre();
  return {{a, b}, d, detail::moderate(a, b, d)};
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
Filtered filter_overlap(const Ellipsoid& a, const Ellipsoid& b) {
  const UnitPair pair = in_unit(a, b);
  if (!suits_the_filters(pair)) return Filtered::unknown;
  return settled(OverlapFilter(pair.a, pair.b, pair.d), pair);
}

/// Whatever the filter in double does not tell at once.
[[gnu::noinline]] OverlapAnswer doubtful_overlap(const Ellipsoid& a, const Ellipsoid& b) {
  const Filtered found = filter_overlap(a, b);
  if (found != Filtered::unknown) return {found == Filtered::interiors_meet, Tier::filter};
  return {ExactPair(a, b).position() == Position::interiors_meet, Tier::exact};
}

/// What the filters tell: the relation, or no more than that the interiors meet, or nothing.
struct Found {
  std::optional<Relation> relation;
  bool interiors_meet = false;
};

Found filter_relation(const Ellipsoid& a, const Ellipsoid& b) {
  const UnitPair pair = in_unit(a, b);
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

/// @param interiors_meet  is that known?
[[gnu::noinline]] RelationAnswer exact_relation(const Ellipsoid& a, const Ellipsoid& b,
                                                bool interiors_meet) {
  const ExactPair pair(a, b);
  if (interiors_meet) return exact_containment(pair);
  const Position position = pair.position();
  if (position == Position::apart) return exactly(Relation::separate);
  if (position == Position::touching) return exactly(Relation::external_touch);
  return exact_containment(pair);
}

RelationAnswer found_relation(const Ellipsoid& a, const Ellipsoid& b) {
  const Found found = filter_relation(a, b);
  if (found.relation) return {*found.relation, Inner::none, Tier::filter};
  return exact_relation(a, b, found.interiors_meet);
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
