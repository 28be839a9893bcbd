// SPDX-License-Identifier: MIT
/// @file
/// The columns of micro.csv. Those that are not defined are empty cells.
#pragma once

#include <string>
#include <vector>

#include <tangency/dem/observe.hpp>
#include <tangency/dem/tool/micro_summary.hpp>

namespace tangency::inline v0::dem {

/// All columns between cycle, time, stage, stage_cycle, axial_strain and the shear strains at the
/// end, in their order; numbers that are not defined are NaN.
std::vector<Field> micro_fields(const MicroSummary& summary);

}  // namespace tangency::inline v0::dem
