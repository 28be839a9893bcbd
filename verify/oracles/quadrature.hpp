// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Quadrature through GSL, in double.
#pragma once

#include <functional>

namespace tangency::inline v0::verify {

/// The integral of f from `from` to `to`, both finite, to 1e-11 of itself (or to 1e-14 where it is
/// next to nothing), by the adaptive Gauss-Kronrod rule with extrapolation, for which ends may be
/// singular. f must not throw. Throws std::runtime_error where GSL does not reach that. Not for
/// several threads: GSL's error handler, which would end the program, is put aside meanwhile.
double integral(const std::function<double(double)>& f, double from, double to);

}  // namespace tangency::inline v0::verify
