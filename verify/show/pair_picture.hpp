// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A pair of solids as a picture: SVG, self-contained.
#pragma once

#include <array>
#include <string>

#include <tangency/verify/show/shown_row.hpp>

namespace tangency::inline v0::verify {

/// The outlines of both bodies, projected along the common perpendicular of the line of centres and
/// the normal: in this plane their distance along the normal is the true gap. The normal points to
/// the right. Beside it the place of the contact, enlarged.
///
/// @param normal  unit, from a to b: a true one
/// @param title, caption  one line each, of any origin
std::string picture(const Solids& pair, const std::array<double, 3>& normal,
                    const std::string& title, const std::string& caption);

}  // namespace tangency::inline v0::verify
