// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipse_relation.hpp>

#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/plane/ellipse_meeting.hpp>

namespace tangency::inline v0 {
namespace {

std::optional<int> crossings(exact::Meeting meeting) {
  using exact::Meeting;
  switch (meeting) {
    case Meeting::equal:
      return std::nullopt;
    case Meeting::nowhere:
      return 0;
    case Meeting::one_double:
    case Meeting::quadruple:
      return 1;
    case Meeting::two_simple:
    case Meeting::two_double:
    case Meeting::triple_and_simple:
      return 2;
    case Meeting::double_and_two_simple:
      return 3;
    case Meeting::four_simple:
      break;
  }
  return 4;
}

}  // namespace

EllipseRelation relation(const Ellipse& a, const Ellipse& b) noexcept {
  const detail::MeetingAnswer found =
      in_default_environment([&] { return detail::ellipse_meeting(a, b); });
  return {found.answer.relation, found.answer.inner, crossings(found.answer.meeting), found.tier};
}

EllipseRelation relation(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  return relation(a.moved_to(Vec2::Zero()), b.moved_to(separation));
}

EllipseRelation relation(const MatrixEllipse& a, const MatrixEllipse& b) noexcept {
  if (a.exact() == nullptr && b.exact() == nullptr) return relation(a.ellipse(), b.ellipse());
  const exact::ConicAnswer found =
      exact::conic_relation(exact::conic_form(a), exact::conic_form(b));
  return {found.relation, found.inner, crossings(found.meeting), Tier::exact};
}

bool overlaps(const Ellipse& a, const Ellipse& b) noexcept {
  const Relation found =
      in_default_environment([&] { return detail::ellipse_meeting(a, b).answer.relation; });
  return found != Relation::separate && found != Relation::external_touch;
}

bool overlaps(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  return overlaps(a.moved_to(Vec2::Zero()), b.moved_to(separation));
}

}  // namespace tangency::inline v0
