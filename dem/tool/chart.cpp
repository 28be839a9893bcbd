// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/chart.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

// Chosen: pixels.
constexpr double kWidth = 620, kHeight = 330;
constexpr double kLeft = 66, kRight = 66, kTop = 34, kBottom = 74;
/// Pieces that a long curve is thinned to, its lowest and highest value of each kept.
constexpr std::size_t kPieces = 500;

/// Told apart by the colour-blind too [Wong2011], and three more.
constexpr std::array<const char*, 9> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                 "#cc79a7", "#8a6d00", "#56b4e9",
                                                 "#e69f00", "#555555", "#7b3fa0"};

std::string pixels(double x) { return tables::formatted("%.1f", x); }

std::string label(double x, double y, const std::string& attributes, const std::string& text) {
  return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" " + attributes + ">" +
         escaped(text) + "</text>\n";
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
  void pad(double share) {
    if (!(low_ <= high_)) low_ = 0.0, high_ = 1.0;
    const double span = high_ - low_;
    const double room = span > 0.0 ? share * span : std::max(0.5 * std::abs(low_), 0.5);
    low_ -= room;
    high_ += room;
  }
  /// Not a number for what has no place.
  double at(double value) const {
    return start_ + (end_ - start_) * (scaled(value) - low_) / (high_ - low_);
  }

  /// Values at 1, 2 or 5 times a power of ten, of a logarithmic axis powers of ten.
  std::vector<double> ticks() const {
    const double rough = (high_ - low_) / 6.0;
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
    x.pad(0.0);
    y.pad(0.04);
    y_right.pad(0.04);
  }
};

/// Indices of a curve's points that are drawn.
std::vector<std::size_t> thinned(const Curve& curve) {
  const std::size_t count = curve.x.size();
  std::vector<std::size_t> kept;
  const std::size_t piece = std::max<std::size_t>(1, count / kPieces);
  for (std::size_t first = 0; first < count; first += piece) {
    const auto from = curve.y.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = curve.y.begin() + static_cast<std::ptrdiff_t>(std::min(first + piece, count));
    const auto [low, high] = std::minmax_element(from, to);
    for (const auto at : {std::min(low, high), std::max(low, high)}) {
      const auto index = static_cast<std::size_t>(at - curve.y.begin());
      if (kept.empty() || kept.back() < index) kept.push_back(index);
    }
  }
  if (count > 0 && kept.back() + 1 < count) kept.push_back(count - 1);
  return kept;
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
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour +
         "\" stroke-width=\"1.6\" stroke-linejoin=\"round\"" +
         (curve.on_the_right ? " stroke-dasharray=\"6 2\"" : "") + "/>\n";
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
    svg += label(middle, kTop + 13, "text-anchor=\"middle\" class=\"stage\"", band.name);
    last_label = middle + 0.5 * wide;
  }
  return svg;
}

std::string frame_of(const Chart& chart, const Axes& axes) {
  std::string svg;
  for (const double value : axes.y.ticks()) {
    const double y = axes.y.at(value);
    svg += line(kLeft, y, kWidth - kRight, y, "#d8d8d8") +
           label(kLeft - 6, y + 4, "text-anchor=\"end\"", tables::formatted("%.4g", value));
  }
  if (!chart.right_label.empty())
    for (const double value : axes.y_right.ticks()) {
      const double y = axes.y_right.at(value);
      svg += line(kWidth - kRight, y, kWidth - kRight + 4, y, "#555") +
             label(kWidth - kRight + 7, y + 4, "", tables::formatted("%.4g", value));
    }
  for (const double value : axes.x.ticks()) {
    const double x = axes.x.at(value);
    svg += line(x, kHeight - kBottom, x, kHeight - kBottom + 4, "#555") +
           label(x, kHeight - kBottom + 17, "text-anchor=\"middle\"",
                 tables::formatted("%.4g", value));
  }
  svg += "<rect x=\"" + pixels(kLeft) + "\" y=\"" + pixels(kTop) + "\" width=\"" +
         pixels(kWidth - kLeft - kRight) + "\" height=\"" + pixels(kHeight - kTop - kBottom) +
         "\" fill=\"none\" stroke=\"#555\"/>\n";
  const auto upright = [](double x, const std::string& text) {
    const double y = 0.5 * (kTop + kHeight - kBottom);
    return label(
        x, y,
        "text-anchor=\"middle\" transform=\"rotate(-90 " + pixels(x) + " " + pixels(y) + ")\"",
        text);
  };
  return svg + label(0.5 * kWidth, 18, "text-anchor=\"middle\" class=\"title\"", chart.title) +
         label(0.5 * kWidth, kHeight - kBottom + 34, "text-anchor=\"middle\"", chart.x_label) +
         upright(14, chart.left_label) + upright(kWidth - 8, chart.right_label);
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

std::string svg_of(const Chart& chart) {
  const Axes axes(chart);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + pixels(kWidth) +
                    "\" height=\"" + pixels(kHeight) + "\" viewBox=\"0 0 " + pixels(kWidth) + " " +
                    pixels(kHeight) + "\" role=\"img\" aria-label=\"" + escaped(chart.title) +
                    "\">\n";
  svg += bands_of(chart, axes.x) + frame_of(chart, axes);
  double at_x = kLeft, at_y = kHeight - 22;
  for (std::size_t k = 0; k < chart.curves.size(); ++k) {
    const Curve& curve = chart.curves[k];
    const char* colour = kColours[k % kColours.size()];
    svg += drawn(curve, axes.x, curve.on_the_right ? axes.y_right : axes.y, colour);
    if (chart.curves.size() == 1) continue;  // the axis says what it is
    const double wide = 34 + 6.5 * static_cast<double>(curve.name.size());
    if (at_x + wide > kWidth - 10) at_x = kLeft, at_y += 16;
    svg +=
        line(at_x, at_y - 4, at_x + 18, at_y - 4, colour) + label(at_x + 22, at_y, "", curve.name);
    at_x += wide;
  }
  return svg + "</svg>\n";
}

}  // namespace tangency::inline v0::dem
