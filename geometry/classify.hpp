// SPDX-License-Identifier: MIT
/// @file
/// The type of a quadric, exact for its ten stored doubles.
///
/// The type follows from the inertias of the discriminant matrix Q and the sub-discriminant Q_s.
/// A filter in double arithmetic decides where Q and Q_s are regular by more than its proven error
/// bound (docs/derivations/classification-filter.md); everything else is decided in integers. Both
/// are right in every rounding mode and when subnormals are flushed or read as zero, and for all
/// finite doubles, however their magnitudes are mixed. The decision diagram:
/// docs/classification.md.
///
/// (1) classify(q.negated()) and classify(q) have the same type and ranks (and, while rounding is
/// to
///     nearest, tier).
/// (2) The type is the same after any regular affine map with exact coefficients, and after a
///     power-of-two scaling of all coefficients that is exact.
/// (3) rank3 <= rank4 <= min(4, rank3 + 2).
#pragma once

#include <tangency/geometry/quadric.hpp>

namespace tangency::inline v0 {

/// Allocates only where integers decide, tier `exact`; where memory ends then, the process does.
Classification classify(const Quadric& quadric) noexcept;

}  // namespace tangency::inline v0
