// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Error against time, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

#include <tangency/bench/speed_accuracy/report.hpp>

namespace tangency::speed_accuracy {

/// @return an SVG
/// @throws std::runtime_error  gnuplot cannot be started, or failed
std::string draw(const std::vector<Row>& rows);

}  // namespace tangency::speed_accuracy
