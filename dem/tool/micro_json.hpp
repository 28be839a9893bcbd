// SPDX-License-Identifier: MIT
/// @file
/// What `tangency-dem micro --json` writes.
#pragma once

#include <string>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/micro_summary.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/strain_report.hpp>

namespace tangency::inline v0::dem {

/// One object with all averages by the unbiased estimator, and under `published` and `contact_sums`
/// those by the other two. Numbers read back to the same double; what is not defined is null.
std::string micro_json(const State& state, const Packing& packing, const MicroSummary& summary,
                       const StrainReport& strain);

}  // namespace tangency::inline v0::dem
