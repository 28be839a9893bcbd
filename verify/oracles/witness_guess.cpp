// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/witness_guess.hpp>

#include <cmath>
#include <cstddef>

namespace tangency::inline v0::verify {
namespace {

using Form = std::array<Point, 3>;

// Chosen: how clear a guess must look before it is worth verifying. Weaker ones would cost time,
// not correctness.
constexpr long double kClear = 1e-13L;
// Chosen: t is sought within e^+-kRange of the ratio of the traces of the forms, to the last bit of
// kSteps halvings: enough for aspect and size ratios of 1e8.
constexpr long double kRange = 100;
constexpr int kSteps = 70;
// Chosen: support points are drawn in by this part, so that rounding leaves them in the body.
constexpr long double kDrawnIn = 1e-9L;

long double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point times(const Form& m, const Point& x) { return {dot(m[0], x), dot(m[1], x), dot(m[2], x)}; }

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

long double level(const ApproximateBody& body, const Point& x) {
  const Point y = minus(x, body.centre);
  return dot(y, times(body.form, y)) - 1;
}

// Solves h x = r by Cholesky; nothing if h does not look positive definite.
std::optional<Point> solve(const Form& h, const Point& r) {
  const long double l00 = h[0][0];
  if (!(l00 > 0)) return std::nullopt;
  const long double l10 = h[1][0] / l00, l20 = h[2][0] / l00;
  const long double d1 = h[1][1] - l10 * h[1][0];
  if (!(d1 > 0)) return std::nullopt;
  const long double s21 = h[2][1] - l20 * h[1][0];
  const long double l21 = s21 / d1;
  const long double d2 = h[2][2] - l20 * h[2][0] - l21 * s21;
  if (!(d2 > 0)) return std::nullopt;
  const long double y1 = r[1] - l10 * r[0];
  const long double y2 = r[2] - l20 * r[0] - l21 * y1;
  const long double x2 = y2 / d2;
  const long double x1 = y1 / d1 - l21 * x2;
  const long double x0 = r[0] / l00 - l10 * x1 - l20 * x2;
  return Point{x0, x1, x2};
}

Point support_point(const ApproximateBody& body, const Point& n, long double sign) {
  Point x{};
  long double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const long double along = body.lengths[k] * dot(body.axes[k], n);
    squared += along * along;
    for (std::size_t i = 0; i < 3; ++i) x[i] += body.lengths[k] * along * body.axes[k][i];
  }
  const long double scale = sign * (1 - kDrawnIn) / std::sqrt(squared);
  for (std::size_t i = 0; i < 3; ++i) x[i] = body.centre[i] + scale * x[i];
  return x;
}

}  // namespace

ApproximateBody approximate_body(const RawEllipsoid& body, const Point& centre) {
  ApproximateBody result{centre, {}, {}, {}};
  const auto& q = body.orientation;
  long double scale = 0;
  for (const double v : q) scale = std::fmax(scale, std::fabs(static_cast<long double>(v)));
  const long double w = q[0] / scale, x = q[1] / scale, y = q[2] / scale, z = q[3] / scale;
  const long double n = w * w + x * x + y * y + z * z;
  const Form columns{{{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
                      {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
                      {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}}};
  for (std::size_t k = 0; k < 3; ++k) {
    result.lengths[k] = body.semi_axes[k];
    for (std::size_t i = 0; i < 3; ++i) result.axes[k][i] = columns[k][i] / n;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        result.form[i][j] +=
            result.axes[k][i] * result.axes[k][j] / (result.lengths[k] * result.lengths[k]);
      }
    }
  }
  return result;
}

Guess guess_member(const ApproximateBody& a, const ApproximateBody& b, int sign_a, int sign_b) {
  const auto trace = [](const Form& m) { return m[0][0] + m[1][1] + m[2][2]; };
  const Point pull = times(b.form, b.centre);
  const long double middle = std::log(trace(b.form)) - std::log(trace(a.form));
  long double low = middle - kRange;
  long double high = middle + kRange;
  for (int step = 0; step < kSteps; ++step) {
    const long double u = low + (high - low) / 2;
    const long double t = std::exp(u);
    Form h;
    Point r;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        h[i][j] = sign_a * t * a.form[i][j] + sign_b * b.form[i][j];
      }
      r[i] = sign_b * pull[i];
    }
    const std::optional<Point> x = solve(h, r);  // where the member is least, A's centre being 0
    if (!x) {
      (sign_a > 0 ? low : high) = u;
      continue;
    }
    const long double at_a = level(a, *x);
    const long double at_b = level(b, *x);
    if (sign_a > 0 && sign_b > 0 && at_a < -kClear && at_b < -kClear) return CommonPoint{*x};
    if (sign_a * t * at_a + sign_b * at_b > kClear * (t + 1)) return DefiniteMember{t};
    (sign_a * at_a > 0 ? low : high) = u;
  }
  return std::monostate{};
}

std::optional<Point> guess_protruding_point(const ApproximateBody& body,
                                            const ApproximateBody& other) {
  const Point directions[7] = {body.axes[0],
                               body.axes[1],
                               body.axes[2],
                               other.axes[0],
                               other.axes[1],
                               other.axes[2],
                               minus(body.centre, other.centre)};
  for (const Point& n : directions) {
    for (const long double sign : {1.0L, -1.0L}) {
      const Point x = support_point(body, n, sign);
      if (level(other, x) > 10 * kDrawnIn) return x;
    }
  }
  return std::nullopt;
}

}  // namespace tangency::inline v0::verify
