// SPDX-License-Identifier: MIT
/// @file
/// How two ellipses lie, and the points where their boundaries meet: a filter, and exact integers
/// behind it. Internal (GMP inside).
///
/// Q is the 3 x 3 form that is negative inside, E(l) = l Q_A + Q_B, P(l) = det E(l), a cubic with
/// P(0) < 0 and a leading coefficient < 0, so that 0 or 2 of its roots are positive.
/// docs/derivations/ellipses.md derives:
///
/// (1) P has two distinct positive roots <=> separate; a double positive root <=> external touch.
/// (2) P has three distinct roots, none positive: the boundaries meet nowhere, if a member E(l) is
///     definite (positive: B inside A; negative: A inside B), else in four points.
/// (3) One real root and two complex: they meet in two points.
/// (4) A multiple root r of P is rational. E(r) has rank 0: equal; rank 1: they touch twice (a
///     double root) or to fourth order (a triple one); rank 2: they touch once, and E(r), if
///     indefinite, is two lines through that point that lead to the others.
#pragma once

#include <optional>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0::exact {

/// How the boundaries meet in real points, by their multiplicities.
enum class Meeting {
  equal,
  nowhere,
  two_simple,
  four_simple,
  one_double,  ///< and two complex points
  double_and_two_simple,
  two_double,
  triple_and_simple,
  quadruple,
};

struct ConicAnswer {
  Relation relation;
  Inner inner;
  Meeting meeting;
};

/// The exact relation and meeting.
ConicAnswer conic_relation(const Ellipse& a, const Ellipse& b);
/// Of forms that are negative inside, in the same coordinates.
ConicAnswer conic_relation(const IntegerForm<3>& a, const IntegerForm<3>& b);
/// In the coordinates themselves.
IntegerForm<3> conic_form(const Ellipse& e);
/// The same of an ellipse given in any form.
IntegerForm<3> conic_form(const MatrixEllipse& e);

}  // namespace tangency::inline v0::exact

namespace tangency::inline v0::detail {

/// The answer where running error bounds prove it; nothing where they leave a doubt and where
/// numbers overflow. Requires the default floating-point environment.
std::optional<exact::ConicAnswer> filter_meeting(const Ellipse& a, const Ellipse& b) noexcept;

struct MeetingAnswer {
  exact::ConicAnswer answer;
  Tier tier;
};

/// The filter, and the exact tier behind it.
MeetingAnswer ellipse_meeting(const Ellipse& a, const Ellipse& b) noexcept;

}  // namespace tangency::inline v0::detail
