// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/ellipse_meeting.hpp>

namespace tangency::methods {

std::optional<exact::ConicAnswer> filter_meeting(const Ellipse&, const Ellipse&) noexcept {
  return std::nullopt;
}

MeetingAnswer ellipse_meeting(const Ellipse& a, const Ellipse& b) noexcept {
  if (const auto found = filter_meeting(a, b)) return {*found, Tier::filter};
  return {exact::conic_relation(a, b), Tier::exact};
}

}  // namespace tangency::methods
