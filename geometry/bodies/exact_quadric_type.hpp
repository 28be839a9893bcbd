// SPDX-License-Identifier: MIT
/// @file
/// The decision diagram as a table, inertias of Q and Q_s to the type; and the exact tier.
/// Internal.
#pragma once

#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/quadric_type.hpp>

namespace tangency::inline v0::exact {

/// The type of a quadric whose discriminant matrix and sub-discriminant have these inertias; the
/// same for both negated.
/// Requires inertias that some quadric has: each pair of them is a row of the table, up to sign.
QuadricType type_of(Inertia discriminant, Inertia sub_discriminant) noexcept;

/// The type of the quadric with this discriminant matrix, up to a factor > 0 or < 0.
Classification classify_form(const IntegerForm<4>& form);

}  // namespace tangency::inline v0::exact
