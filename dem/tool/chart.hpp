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

struct Chart {
  std::string title, x_label;
  std::string left_label, right_label;  ///< of the two y axes
  std::vector<Curve> curves;            ///< at most as many as there are colours, nine
  std::vector<Band> bands = {};
  bool logarithmic = false;  ///< the left axis: what is not > 0 parts the curve
};

/// The chart's <svg>. Long curves are thinned to what pixels can show, peaks kept.
std::string svg_of(const Chart& chart);

/// Text that HTML and SVG show as it is.
std::string escaped(const std::string& text);

}  // namespace tangency::inline v0::dem
