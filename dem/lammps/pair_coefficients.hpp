// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// The words of pair_coeff that say a contact law, in the manner of LAMMPS' pair style granular:
///
///     hooke KN | hertz/material E NU
///     [tangential linear KT MU | tangential mindlin MU] [cohesion C] [restitution E]
///
/// `tangential linear` belongs to hooke, `tangential mindlin` to hertz/material; without either the
/// contact bears no shear. C is the shear force that a contact bears without a push; E is the part
/// of a head-on approach that an impact gives back, 1 if left out. Units are those of the script.
#pragma once

#include <array>

#include <tangency/dem/contact/contact_law.hpp>

namespace tangency::inline v0::lammps {

class Words;

/// The law that the words to the end of the command say. Ends LAMMPS with a line that says what is
/// wrong with them.
dem::ContactLaw law_of(Words& words);

/// A law as a restart file has it, to the bit.
using StoredLaw = std::array<double, 8>;
/// What restores it.
StoredLaw stored(const dem::ContactLaw& law);
/// The law that was stored.
dem::ContactLaw restored(const StoredLaw& numbers);

}  // namespace tangency::inline v0::lammps
