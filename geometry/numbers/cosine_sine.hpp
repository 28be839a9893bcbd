// SPDX-License-Identifier: MIT
/// @file
/// Cosine and sine rounded correctly, which those of the C library need not be. Internal.
///
/// (1) Each is the double nearest to the true value, for every finite angle.
/// (2) cosine(-t) = cosine(t), sine(-t) = -sine(t).
#pragma once

namespace tangency::inline v0::detail {

struct CosineSine {
  double cosine, sine;
};

/// In double-double where its error bound leaves no doubt about the rounding, else in integers.
/// Assumes the default floating-point environment.
/// @param angle  rad, finite
CosineSine rounded_cosine_sine(double angle);

/// The same in integers alone: for tests.
CosineSine rounded_cosine_sine_in_integers(double angle);

}  // namespace tangency::inline v0::detail
