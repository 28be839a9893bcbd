// SPDX-License-Identifier: MIT
/// @file
/// The charts of a run's report.
#pragma once

#include <string>

#include <tangency/dem/tool/reported_run.hpp>

namespace tangency::inline v0::dem {

/// What a shear test is looked at for, over the strain that it shears by: principal stresses, in a
/// simple shear those along and across its layers, the path of q over p, volume, coordination, and
/// fabric where micro.csv has it; as <svg>s one after the other. Nothing of a stage that keeps its
/// cell's shape.
std::string shear_charts(const ReportedRun& run, const StageRows& stage);

/// Everything against time, stages shaded.
std::string time_charts(const ReportedRun& run);

}  // namespace tangency::inline v0::dem
