// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// The styles that this project adds to LAMMPS, by the names that an input script calls them.
#pragma once

#include <compute.h>
#include <fix.h>
#include <lammps.h>
#include <pair.h>

#include <span>

namespace tangency::inline v0::lammps {

/// A style of the commands `pair_style`, `fix` or `compute`, and what makes one.
template <class Style, class... Words>
struct StyleEntry {
  const char* name;                                       ///< in the input script
  Style* (*create)(LAMMPS_NS::LAMMPS* lammps, Words...);  ///< for LAMMPS, which owns what it gets
};
/// A pair style is made without words: LAMMPS calls its settings() afterwards.
using PairEntry = StyleEntry<LAMMPS_NS::Pair>;
/// Made from the words of the command.
using FixEntry = StyleEntry<LAMMPS_NS::Fix, int, char**>;
/// Made from the words of the command.
using ComputeEntry = StyleEntry<LAMMPS_NS::Compute, int, char**>;

/// All pair styles of this project.
std::span<const PairEntry> pair_styles();
/// All its fixes.
std::span<const FixEntry> fix_styles();
/// All its computes.
std::span<const ComputeEntry> compute_styles();

}  // namespace tangency::inline v0::lammps
