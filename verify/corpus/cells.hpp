// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Numbers as the corpora write them.
#pragma once

#include <string>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

/// Correctly rounded to 40 significant digits, without trailing zeros.
std::string decimal(const Real& v);

/// Of a unit vector: what is left of nothing after 150 digits is nothing.
std::string component(const Real& v);
/// Three of them, and commas between.
std::string components(const Real3& n);

/// Exactly.
std::string hex(double value);
/// The nearest double.
inline std::string rounded_hex(const Real& v) { return hex(v.convert_to<double>()); }

/// After a comma, where `line` has a cell.
template <class Numbers>
void append_hex(std::string& line, const Numbers& numbers) {
  for (const double v : numbers) line += (line.empty() ? "" : ",") + hex(v);
}

}  // namespace tangency::inline v0::verify
