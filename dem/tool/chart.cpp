// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/chart.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <tangency/geometry/tables/html_text.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::escaped;

// Chosen: pixels. Narrow, so that letters are still read where a telephone shrinks it to 350.
constexpr double kWidth = 440, kHeight = 300;
constexpr double kLeft = 62, kRight = 62, kTop = 34, kBottom = 44;
/// Of the legend, below: a line's height, a line's sample, and letters at their widest.
constexpr double kLegendLine = 16, kSample = 22, kLetter = 6.6;
/// Of the largest value across, the least that is spanned. Chosen: a servo holds a stress to 1e-2.
constexpr double kLeastSpan = 0.04;
/// The same upwards. Chosen: below it is rounding, and ticks could not be told apart.
constexpr double kLeastSpanUp = 1e-9;
/// Numbers between these are shown whole. Chosen: a tick has at most five digits.
constexpr double kShownWholeFrom = 1e-2, kShownWholeBelow = 1e4;
/// Ticks of an axis, at most about as many as this.
constexpr double kTicksAcross = 5, kTicksUp = 6;
/// Pieces that a long curve is thinned to, its lowest and highest value of each kept.
constexpr std::size_t kPieces = 500;

/// Told apart by the colour-blind too [Wong2011], and four more.
constexpr std::array<const char*, 10> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#8a6d00", "#56b4e9", "#e69f00", "#555555",
                                                  "#7b3fa0", "#b22222"};

std::string pixels(double x) { return tables::formatted("%.1f", x); }

std::string label(double x, double y, const std::string& attributes, const std::string& text) {
  return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" " + attributes + ">" +
         escaped(text) + "</text>\n";
}

/// A name along an axis upwards.
std::string upright(double x, const std::string& text) {
  const double y = 0.5 * (kTop + kHeight - kBottom);
  return label(
      x, y, "text-anchor=\"middle\" transform=\"rotate(-90 " + pixels(x) + " " + pixels(y) + ")\"",
      text);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour) {
  return "<line x1=\"" + pixels(x1) + "\" y1=\"" + pixels(y1) + "\" x2=\"" + pixels(x2) +
         "\" y2=\"" + pixels(y2) + "\" stroke=\"" + colour + "\"/>\n";
}

/// An axis: values, or their logarithms, between two ends, and where they stand.
class Axis {
 public:
  Axis(double start, double end, bool logarithmic = false)
      : start_(start), end_(end), logarithmic_(logarithmic) {}

  void widen(double value) {
    const double v = scaled(value);
    if (!std::isfinite(v)) return;
    low_ = std::min(low_, v);
    high_ = std::max(high_, v);
  }
  /// Leaves room at both ends, a share of the whole.
  /// @param least  of the largest value, what is spanned: what is held shows as held
  void pad(double share, double least) {
    if (!(low_ <= high_)) low_ = 0.0, high_ = 1.0;
    const double lacking = 0.5 * (least * largest() - span());
    const double room =
        span() > 0.0 ? std::max(share * span(), lacking) : std::max(0.5 * std::abs(low_), 0.5);
    low_ -= room;
    high_ += room;
  }
  /// Not a number for what has no place.
  double at(double value) const {
    return start_ + (end_ - start_) * (scaled(value) - low_) / (high_ - low_);
  }

  /// Values at 1, 2 or 5 times a power of ten, of a logarithmic axis powers of ten.
  std::vector<double> ticks(double most) const {
    const double rough = (high_ - low_) / most;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0})
      if (factor * power >= rough) step = factor * power;
    if (logarithmic_) step = std::max(1.0, std::round(step));
    std::vector<double> values;
    for (double k = std::ceil(low_ / step); k * step <= high_; ++k)
      values.push_back(logarithmic_ ? std::pow(10.0, k * step) : k * step + 0.0);  // no -0
    return values;
  }
  /// Three times a whole number: the power of ten that numbers are shown without, so that they are
  /// short.
  int exponent() const {
    if (logarithmic_ || (largest() >= kShownWholeFrom && largest() < kShownWholeBelow)) return 0;
    return 3 * static_cast<int>(std::floor(std::log10(largest()) / 3.0));
  }
  double largest() const { return std::max(std::abs(low_), std::abs(high_)); }
  double span() const { return high_ - low_; }

 private:
  double scaled(double value) const {
    if (!logarithmic_) return value;
    return value > 0.0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
  }

  double start_, end_;
  bool logarithmic_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

struct Axes {
  Axis x{kLeft, kWidth - kRight};
  Axis y, y_right{kHeight - kBottom, kTop};

  explicit Axes(const Chart& chart) : y(kHeight - kBottom, kTop, chart.logarithmic) {
    for (const Curve& curve : chart.curves)
      for (std::size_t k = 0; k < curve.x.size(); ++k) {
        x.widen(curve.x[k]);
        (curve.on_the_right ? y_right : y).widen(curve.y[k]);
      }
    x.pad(0.0, kLeastSpan);
    y.pad(0.04, kLeastSpanUp);
    y_right.pad(0.04, kLeastSpanUp);
  }
};

/// Indices of a curve's points that are drawn: of each piece those at its ends, where it is least
/// and greatest, and all where it is parted.
std::vector<std::size_t> thinned(const Curve& curve) {
  const std::size_t count = curve.x.size();
  const std::size_t piece = std::max<std::size_t>(1, count / kPieces);
  std::vector<std::size_t> kept;
  for (std::size_t first = 0; first < count; first += piece) {
    const std::size_t end = std::min(first + piece, count);
    std::vector<std::size_t> points;
    for (std::size_t k = first; k < end; ++k) points.push_back(k);
    const auto has_place = [&](std::size_t k) {
      return std::isfinite(curve.x[k]) && std::isfinite(curve.y[k]);
    };
    if (std::all_of(points.begin(), points.end(), has_place)) {
      std::vector<std::size_t> ends{first, end - 1};
      for (const std::vector<double>* values : {&curve.x, &curve.y}) {
        const auto less = [&](std::size_t p, std::size_t q) { return (*values)[p] < (*values)[q]; };
        const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
        ends.insert(ends.end(), {*low, *high});
      }
      std::sort(ends.begin(), ends.end());
      ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
      points = std::move(ends);
    }
    kept.insert(kept.end(), points.begin(), points.end());
  }
  return kept;
}

/// How a curve's line is drawn, in the chart and in the legend.
std::string pen_of(const Curve& curve, const char* colour) {
  return std::string(" fill=\"none\" stroke=\"") + colour +
         "\" stroke-width=\"1.6\" stroke-linejoin=\"round\"" +
         (curve.on_the_right ? " stroke-dasharray=\"6 2\"" : "") + "/>\n";
}

std::string drawn(const Curve& curve, const Axis& x, const Axis& y, const char* colour) {
  std::string path;
  bool pen_is_up = true;
  for (const std::size_t k : thinned(curve)) {
    const double px = x.at(curve.x[k]), py = y.at(curve.y[k]);
    if (!std::isfinite(px) || !std::isfinite(py)) {
      pen_is_up = true;
      continue;
    }
    path += (pen_is_up ? "M" : "L") + pixels(px) + " " + pixels(py);
    pen_is_up = false;
  }
  return "<path d=\"" + path + "\"" + pen_of(curve, colour);
}

std::string bands_of(const Chart& chart, const Axis& x) {
  std::string svg;
  bool dark = false;
  double last_label = -1e9;
  for (const Band& band : chart.bands) {
    const double from = x.at(band.from), to = x.at(band.to);
    if (to - from > 2.0) dark = !dark;  // what shows
    svg += "<rect x=\"" + pixels(from) + "\" y=\"" + pixels(kTop) + "\" width=\"" +
           pixels(std::max(0.0, to - from)) + "\" height=\"" + pixels(kHeight - kBottom - kTop) +
           "\" fill=\"" + (dark ? "#eef2f7" : "#fbf6ec") + "\"><title>" + escaped(band.name) +
           "</title></rect>\n";
    // Names that would run into one another are left to the mouse; 6.5 pixels a letter.
    const double wide = 6.5 * static_cast<double>(band.name.size());
    const double middle = 0.5 * (from + to);
    if (middle - 0.5 * wide < last_label || to - from < 0.6 * wide) continue;
    svg += label(middle, kTop - 4, "text-anchor=\"middle\" class=\"stage\"", band.name);
    last_label = middle + 0.5 * wide;
  }
  return svg;
}

/// Of the axis' ticks, with as many digits as tell them apart, four at least.
std::string number(double value, const Axis& axis) {
  const double of_a_step = axis.largest() / axis.span();
  const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(of_a_step))) + 2, 4, 15);
  return tables::rounded_text(value / std::pow(10.0, axis.exponent()), digits);
}

/// "stress (1e6 Pa)"
std::string name_of(const Scale& scale, int exponent) {
  std::string unit = exponent == 0 ? "" : "1e" + std::to_string(exponent);
  if (!scale.unit.empty()) unit += (unit.empty() ? "" : " ") + scale.unit;
  return unit.empty() ? scale.name : scale.name + " (" + unit + ")";
}

/// Numbers and name of the axis upwards, beside the frame.
std::string left_of(const Scale& scale, const Axis& y) {
  std::string svg;
  for (const double value : y.ticks(kTicksUp))
    svg += line(kLeft, y.at(value), kWidth - kRight, y.at(value), "#d8d8d8") +
           label(kLeft - 6, y.at(value) + 4, "text-anchor=\"end\"", number(value, y));
  return svg + upright(14, name_of(scale, y.exponent()));
}
std::string right_of(const Scale& scale, const Axis& y) {
  std::string svg;
  if (scale.name.empty()) return svg;
  const double x = kWidth - kRight;
  for (const double value : y.ticks(kTicksUp))
    svg += line(x, y.at(value), x + 4, y.at(value), "#555") +
           label(x + 7, y.at(value) + 4, "", number(value, y));
  return svg + upright(kWidth - 8, name_of(scale, y.exponent()));
}

std::string frame_of(const Chart& chart, const Axes& axes) {
  std::string svg = left_of(chart.left, axes.y) + right_of(chart.right, axes.y_right);
  const double bottom = kHeight - kBottom;
  const int exponent = axes.x.exponent();
  for (const double value : axes.x.ticks(kTicksAcross)) {
    const double x = axes.x.at(value);
    svg += line(x, bottom, x, bottom + 4, "#555") +
           label(x, bottom + 17, "text-anchor=\"middle\"", number(value, axes.x));
  }
  svg += "<rect x=\"" + pixels(kLeft) + "\" y=\"" + pixels(kTop) + "\" width=\"" +
         pixels(kWidth - kLeft - kRight) + "\" height=\"" + pixels(bottom - kTop) +
         "\" fill=\"none\" stroke=\"#555\"/>\n";
  return svg + label(0.5 * kWidth, 18, "text-anchor=\"middle\" class=\"title\"", chart.title) +
         label(0.5 * kWidth, bottom + 34, "text-anchor=\"middle\"",
               name_of(chart.across, exponent));
}

/// A legend below the chart, and where it ends. One curve alone has none: the axis says what it is.
struct Legend {
  std::string svg;
  double end = kHeight;
};
Legend legend_of(const Chart& chart) {
  Legend legend;
  if (chart.curves.size() == 1) return legend;
  double x = kLeft, y = kHeight + 8;
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const Curve& curve = chart.curves[k];
    const double wide = kSample + 16 + kLetter * static_cast<double>(curve.name.size());
    if (x > kLeft && x + wide > kWidth) x = kLeft, y += kLegendLine;
    legend.svg += "<path d=\"M" + pixels(x) + " " + pixels(y - 4) + "h" + pixels(kSample) + "\"" +
                  pen_of(curve, kColours[k % kColours.size()]) +
                  label(x + kSample + 4, y, "", curve.name);
    x += wide;
  }
  legend.end = y + 8;
  return legend;
}

}  // namespace

std::string svg_of(const Chart& chart) {
  const Axes axes(chart);
  const Legend legend = legend_of(chart);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + pixels(kWidth) +
                    "\" height=\"" + pixels(legend.end) + "\" viewBox=\"0 0 " + pixels(kWidth) +
                    " " + pixels(legend.end) + "\" role=\"img\" aria-label=\"" +
                    escaped(chart.title) + "\">\n";
  svg += bands_of(chart, axes.x) + frame_of(chart, axes);
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const Curve& curve = chart.curves[k];
    svg += drawn(curve, axes.x, curve.on_the_right ? axes.y_right : axes.y,
                 kColours[k % kColours.size()]);
  }
  return svg + legend.svg + "</svg>\n";
}

}  // namespace tangency::inline v0::dem
