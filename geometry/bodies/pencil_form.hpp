// SPDX-License-Identifier: MIT
/// @file
/// The pencil A + f B of two integer forms: invariants as polynomials in f, and the members in
/// order. Internal (GMP); pencil.hpp is the public side.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/integer_polynomial.hpp>
#include <tangency/geometry/pencil_member.hpp>

namespace tangency::inline v0::exact {

/// T1, T2, T3, D1, D2, D3, D4 of A + f B: sums of principal minors, of degrees at most 1 2 3 1 2
/// 3 4.
using PencilInvariants = std::array<IntegerPolynomial, 7>;
PencilInvariants pencil_invariants(const IntegerForm<4>& a, const IntegerForm<4>& b);

/// det(A + f B) of the leading blocks of a size, 3 or 4.
IntegerPolynomial pencil_determinant(const IntegerForm<4>& a, const IntegerForm<4>& b,
                                     std::size_t size);

/// As pencil_members() of pencil.hpp.
std::vector<PencilMember> pencil_members(const IntegerForm<4>& a, const IntegerForm<4>& b);

}  // namespace tangency::inline v0::exact
