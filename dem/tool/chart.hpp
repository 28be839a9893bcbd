// SPDX-License-Identifier: MIT
/// @file
/// Line charts as SVG, for pages that need nothing else.
#pragma once

#include <string>
#include <vector>

namespace tangency::inline v0::dem {

struct Curve {
  std::string name;
  std::vector<double> x, y;   ///< of one length; what is not finite parts the curve
  bool on_the_right = false;  ///< read off the right axis
};

/// A shaded part of the x axis.
struct Band {
  std::string name;
  double from, to;
};

/// What an axis has. Where its numbers are large or small, a power of ten goes before the unit:
/// "stress (1e6 Pa)".
struct Scale {
  std::string name = {}, unit = {};
};

struct Chart {
  std::string title;
  Scale across, left, right;  ///< of the axes; a right one without a name is not drawn
  std::vector<Curve> curves;  ///< at most as many as there are colours, ten
  std::vector<Band> bands = {};
  bool logarithmic = false;  ///< the left axis: what is not > 0 parts the curve
};

/// The chart's <svg>. Long curves are thinned to what pixels can show, peaks kept.
std::string svg_of(const Chart& chart);

}  // namespace tangency::inline v0::dem
