// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A pair of ellipsoids as the beginning of a debugging session: a whole program, or a file that
/// one reads. Numbers are exactly the doubles of the pair, but for LAMMPS, which reads decimals and
/// makes quaternions unit ones.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <tangency/verify/show/shown_row.hpp>

namespace tangency::inline v0::verify {

/// Names of the languages: what `as_code` takes.
inline constexpr std::array<std::string_view, 5> kCodes{"csv", "cpp", "c", "python", "lammps"};

/// @param code  of kCodes, not csv
/// @param title  what the pair is: one line, for a comment
/// @param truth  of the relation and the gap: one line, for a comment
///
/// The programs print gap, bound and normal, in C++ the relation too. The LAMMPS data file is of
/// atom_style ellipsoid, its shapes are diameters, and its box holds both bodies.
std::string as_code(std::string_view code, const Solids& pair, const std::string& title,
                    const std::string& truth);

}  // namespace tangency::inline v0::verify
