// SPDX-License-Identifier: MIT
/// @file
/// The filter in front of the exact relation of two ellipses. Internal.
#pragma once

#include <optional>

#include <tangency/geometry/plane/conic_pair.hpp>

namespace tangency::detail {

/// The answer where running error bounds prove it; nothing where they leave a doubt and where
/// numbers overflow. Requires the default floating-point environment.
std::optional<exact::ConicAnswer> filter_meeting(const Ellipse& a, const Ellipse& b) noexcept;

struct MeetingAnswer {
  exact::ConicAnswer answer;
  Tier tier;
};

/// The filter, and the exact tier behind it.
MeetingAnswer ellipse_meeting(const Ellipse& a, const Ellipse& b) noexcept;

}  // namespace tangency::detail
