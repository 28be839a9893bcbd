// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/show/pair_picture.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/grade/markup.hpp>

namespace tangency::inline v0::verify {
namespace {

using Vector = std::array<double, 3>;
using Point = std::array<double, 2>;

// A side of each panel and what stands around them, in pixels.
constexpr double kSide = 420, kMargin = 16, kHead = 56, kFoot = 30;
constexpr double kThin = 1e-3;  // chosen: what is thinner beside the picture is drawn as thick

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(const Vector& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

// The part of d across the normal, or where there is none a direction in the plane z = 0 if that
// holds the normal.
Vector across(const Vector& d, const Vector& normal) {
  const double along = dot(d, normal);
  const Vector rest{d[0] - along * normal[0], d[1] - along * normal[1], d[2] - along * normal[2]};
  constexpr double kNothing = 1e-9;  // chosen: of the size of the picture
  if (std::hypot(rest[0], rest[1], rest[2]) > kNothing) return unit(rest);
  const bool is_along_z = std::abs(normal[2]) > 0.9;
  return unit(cross(is_along_z ? Vector{1, 0, 0} : Vector{0, 0, 1}, normal));
}

// A body seen along the third direction: its shadow { centre + M^(1/2) u } in the plane.
struct Outline {
  Point centre;
  double xx = 0, xy = 0, yy = 0;  // of M, in the square of the picture's unit

  // Where its tangent is upright, towards `side` (+1 or -1).
  Point reach(double side) const {
    const double half = std::sqrt(xx);
    return {centre[0] + side * half, centre[1] + side * xy / half};
  }
  double half_height() const { return std::sqrt(yy); }
};

// `scale` makes lengths into the picture's unit.
Outline outline(const RawEllipsoid& body, const Point& centre, double scale, const Vector& x,
                const Vector& y) {
  Outline result{centre};
  const auto& q = body.orientation;
  const double most = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
  const double w0 = q[0] / most, x0 = q[1] / most, y0 = q[2] / most, z0 = q[3] / most;
  const double length = std::sqrt(w0 * w0 + x0 * x0 + y0 * y0 + z0 * z0);
  const double a = w0 / length, b = x0 / length, c = y0 / length, d = z0 / length;
  const std::array<Vector, 3> axes{
      Vector{1 - 2 * (c * c + d * d), 2 * (b * c + a * d), 2 * (b * d - a * c)},
      Vector{2 * (b * c - a * d), 1 - 2 * (b * b + d * d), 2 * (c * d + a * b)},
      Vector{2 * (b * d + a * c), 2 * (c * d - a * b), 1 - 2 * (b * b + c * c)}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double r = body.semi_axes[k] * scale, u = r * dot(axes[k], x), v = r * dot(axes[k], y);
    result.xx += u * u, result.xy += u * v, result.yy += v * v;
  }
  // So that a needle or a disc of the finest kind is still seen, and has a point to touch.
  result.xx = std::max(result.xx, kThin * kThin * 1e-6),
  result.yy = std::max(result.yy, kThin * kThin * 1e-6);
  return result;
}

std::string number(double value) { return tables::formatted("%.6g", value); }

// y points up in the plane and down in SVG.
std::string ellipse(const Outline& body, const char* colour) {
  const double middle = (body.xx + body.yy) / 2, off = std::hypot((body.xx - body.yy) / 2, body.xy);
  const double angle = std::atan2(2 * body.xy, body.xx - body.yy) / 2 * 180 / std::numbers::pi;
  const double shorter = std::max(middle - off, kThin * kThin * 1e-6);
  return "<ellipse rx=\"" + number(std::sqrt(middle + off)) + "\" ry=\"" +
         number(std::sqrt(shorter)) + "\" transform=\"translate(" + number(body.centre[0]) + ' ' +
         number(-body.centre[1]) + ") rotate(" + number(-angle) + ")\" fill=\"" + colour +
         "\" fill-opacity=\"0.25\" stroke=\"" + colour +
         "\" stroke-width=\"1.5\" vector-effect=\"non-scaling-stroke\"/>\n";
}

struct Window {
  Point centre;
  double half;
};

struct Drawing {
  Outline a, b;
  Point at_a, at_b;  // where the gap is: of a towards the normal, of b against it
};

// Everything, in the window, in a panel that begins at `left`.
std::string panel(const Drawing& drawing, const Window& window, double left) {
  const double pixel = 2 * window.half / kSide;
  const auto dot_at = [&](const Point& p, const char* colour) {
    return "<circle cx=\"" + number(p[0]) + "\" cy=\"" + number(-p[1]) + "\" r=\"" +
           number(3.5 * pixel) + "\" fill=\"" + colour + "\"/>\n";
  };
  const auto line = [&](const Point& from, const Point& to, const char* style) {
    return "<path d=\"M" + number(from[0]) + ' ' + number(-from[1]) + 'L' + number(to[0]) + ' ' +
           number(-to[1]) + "\" fill=\"none\" vector-effect=\"non-scaling-stroke\" " + style +
           "/>\n";
  };
  const Point from = drawing.at_a[0] > drawing.at_b[0] ? drawing.at_a : drawing.at_b;
  const Point tip{from[0] + 60 * pixel, from[1]};
  std::string svg = "<svg x=\"" + number(left) + "\" y=\"" + number(kHead) + "\" width=\"" +
                    number(kSide) + "\" height=\"" + number(kSide) + "\" viewBox=\"" +
                    number(window.centre[0] - window.half) + ' ' +
                    number(-window.centre[1] - window.half) + ' ' + number(2 * window.half) + ' ' +
                    number(2 * window.half) + "\">\n";
  svg += ellipse(drawing.a, "#1f5fa8") + ellipse(drawing.b, "#c05a00");
  svg += line(drawing.at_a, drawing.at_b, "stroke=\"#b00020\" stroke-width=\"3\"");
  svg += line(from, tip, "stroke=\"#222\" stroke-width=\"1.5\"");
  for (const double side : {1.0, -1.0}) {
    svg += line({tip[0] - 9 * pixel, tip[1] + side * 5 * pixel}, tip,
                "stroke=\"#222\" stroke-width=\"1.5\"");
  }
  svg += dot_at(drawing.at_a, "#1f5fa8") + dot_at(drawing.at_b, "#c05a00");
  return svg + "</svg>\n<rect x=\"" + number(left) + "\" y=\"" + number(kHead) + "\" width=\"" +
         number(kSide) + "\" height=\"" + number(kSide) + "\" fill=\"none\" stroke=\"#bbb\"/>\n";
}

Window whole(const Drawing& drawing) {
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const Outline* body : {&drawing.a, &drawing.b}) {
    const Point half{std::sqrt(body->xx), body->half_height()};
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], body->centre[k] - half[k]);
      high[k] = std::max(high[k], body->centre[k] + half[k]);
    }
  }
  return {{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2},
          0.55 * std::max(high[0] - low[0], high[1] - low[1])};
}

// The gap in a third of the width, but no closer than a fiftieth of the smaller body.
Window near_contact(const Drawing& drawing, double most) {
  const auto size = [](const Outline& body) { return std::sqrt(std::max(body.xx, body.yy)); };
  const double apart =
      std::hypot(drawing.at_b[0] - drawing.at_a[0], drawing.at_b[1] - drawing.at_a[1]);
  return {{(drawing.at_a[0] + drawing.at_b[0]) / 2, (drawing.at_a[1] + drawing.at_b[1]) / 2},
          std::clamp(1.5 * apart, std::min({size(drawing.a), size(drawing.b), most}) / 50, most)};
}

std::string text(double x, double y, const std::string& what, const char* style) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + style + '>' + escaped(what) +
         "</text>\n";
}

}  // namespace

std::string picture(const Solids& pair, const std::array<double, 3>& normal,
                    const std::string& title, const std::string& caption) {
  // Every length in units of the largest, so that none overflows when it is squared.
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    size = std::max({size, pair.a.semi_axes[k], pair.b.semi_axes[k],
                     std::abs(pair.b.centre[k] / 2 - pair.a.centre[k] / 2) * 2});
  }
  Vector d{};
  for (std::size_t k = 0; k < 3; ++k) d[k] = (pair.b.centre[k] / size - pair.a.centre[k] / size);
  const Vector x = unit(normal), y = across(d, x);
  const double scale = 1 / size;
  Drawing drawing{outline(pair.a, {0, 0}, scale, x, y),
                  outline(pair.b, {dot(d, x), dot(d, y)}, scale, x, y),
                  {},
                  {}};
  drawing.at_a = drawing.a.reach(1);
  drawing.at_b = drawing.b.reach(-1);
  const Window all = whole(drawing), close = near_contact(drawing, all.half);
  const double width = 2 * kSide + 3 * kMargin, height = kHead + kSide + kFoot;
  constexpr const char* kPlain = "font-size=\"14\" fill=\"#222\"";
  const double second = kSide + 2 * kMargin, foot = height - 10;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + ' ' +
         number(height) + "\" width=\"" + number(width) + "\" height=\"" + number(height) +
         "\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         text(kMargin, 22, title, "font-size=\"16\" font-weight=\"bold\" fill=\"#222\"") +
         text(kMargin, 43, caption, kPlain) + panel(drawing, all, kMargin) +
         panel(drawing, close, second) +
         text(kMargin, foot, "a", "font-size=\"14\" fill=\"#1f5fa8\"") +
         text(kMargin + 18, foot, "b", "font-size=\"14\" fill=\"#c05a00\"") +
         text(kMargin + 36, foot, "normal from a to b, gap in red", kPlain) +
         text(second, foot, "enlarged " + tables::rounded_text(all.half / close.half, 2) + " times",
              kPlain) +
         "</svg>\n";
}

}  // namespace tangency::inline v0::verify
