// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/verify/oracles/ellipse.hpp>

namespace tangency::inline v0::verify {
namespace {

// Support function of one body, its derivative along the tangent, and its radius of curvature.
template <class T>
struct Side {
  T h, slope, radius;
};

template <class T>
Side<T> side(const std::array<T, 4>& body, const T& x, const T& y) {
  using std::sqrt;
  const auto& [ux, uy, p, q] = body;
  const T c = ux * x + uy * y, s = ux * y - uy * x;
  const T h = sqrt(p * p * c * c + q * q * s * s);
  return {h, (q * q - p * p) * c * s / h, p * p * q * q / (h * h * h)};
}

template <class T>
struct Gap {
  std::array<T, 4> a, b;
  T dx, dy;

  T value(const T& x, const T& y) const {
    return x * dx + y * dy - side<T>(a, x, y).h - side<T>(b, x, y).h;
  }
};

// Unit direction and semi-axes.
std::array<Real, 4> body_of(const RawEllipse& e) {
  const Real x = e.direction[0], y = e.direction[1], n = sqrt(x * x + y * y);
  if (!(e.semi_axes[0] > 0 && e.semi_axes[1] > 0 && n > 0)) {
    throw std::invalid_argument("oracle: semi-axes must be > 0 and a direction must not be zero");
  }
  return {x / n, y / n, e.semi_axes[0], e.semi_axes[1]};
}

Gap<Real> gap_of(const RawEllipse& a, const RawEllipse& b) {
  return {body_of(a), body_of(b), Real(b.centre[0]) - Real(a.centre[0]),
          Real(b.centre[1]) - Real(a.centre[1])};
}

struct Peak {
  Real value, x, y;

  void turn(const Real& by) {
    const Real tx = x - by * y, ty = y + by * x, n = sqrt(tx * tx + ty * ty);
    x = tx / n, y = ty / n;
  }
};

// Newton's step on the circle, as a turn; uphill where f is convex.
Real newton_turn(const Gap<Real>& f, const Peak& at) {
  const auto a = side<Real>(f.a, at.x, at.y), b = side<Real>(f.b, at.x, at.y);
  const Real slope = at.x * f.dy - at.y * f.dx - a.slope - b.slope;
  const Real bend = at.value + a.radius + b.radius;
  return bend > 0 ? Real(slope / bend) : Real(slope > 0 ? 0.01 : -0.01);
}

// At a maximum of higher order the steps shrink by a third only, and the value no longer tells.
void polish(const Gap<Real>& f, Peak& at) {
  for (int step = 0; step < 400; ++step) {
    const Real turn = newton_turn(f, at);
    if (abs(turn) > 1e-20) return;
    at.turn(turn);
    at.value = f.value(at.x, at.y);
    if (abs(turn) < Real("1e-65")) return;
  }
}

// Ascent by Newton's method on the circle, steps that do not help halved.
Peak ascend(const Gap<Real>& f, const Real& x, const Real& y) {
  Peak at{f.value(x, y), x, y};
  for (int step = 0; step < 400; ++step) {
    Real turn = newton_turn(f, at);
    if (abs(turn) > 0.1) turn = turn > 0 ? 0.1 : -0.1;
    bool moved = false;
    for (int half = 0; half < 60 && !moved; ++half, turn /= 2) {
      Peak next = at;
      next.turn(turn);
      next.value = f.value(next.x, next.y);
      if (next.value > at.value) at = next, moved = true;
    }
    if (!moved || abs(turn) < 1e-40) break;
  }
  polish(f, at);
  return at;
}

// Mirror images of a normal in d and in the axes of both bodies.
std::vector<Real2> mirror_images(const Gap<Real>& f, const Peak& at) {
  const Real d = sqrt(f.dx * f.dx + f.dy * f.dy);
  std::vector<Real2> mirrors{{f.a[0], f.a[1]}, {f.b[0], f.b[1]}};
  if (d > 0) mirrors.push_back({f.dx / d, f.dy / d});
  std::vector<Real2> images;
  for (const auto& [ux, uy] : mirrors) {
    const Real along = 2 * (ux * at.x + uy * at.y);
    images.push_back({along * ux - at.x, along * uy - at.y});
    images.push_back({at.x - along * ux, at.y - along * uy});
  }
  return images;
}

// Components as near to each other as the ascents leave equal ones are equal.
bool descending(const Real2& m, const Real2& n) {
  const bool level = abs(m[0] - n[0]) < Real("1e-40");
  return level ? m[1] > n[1] : m[0] > n[0];
}

// All that reach the greatest value, each once.
std::vector<Peak> highest(const Gap<Real>& f, std::vector<Peak> peaks, const Real& size) {
  const Real best = std::ranges::max_element(peaks, {}, &Peak::value)->value;
  std::vector<Peak> kept;
  const auto keep = [&](const Peak& peak) {
    const bool seen = std::ranges::any_of(
        kept, [&](const Peak& k) { return abs(k.x - peak.x) + abs(k.y - peak.y) < Real("1e-30"); });
    if (best - peak.value <= Real("1e-60") * size && !seen) kept.push_back(peak);
  };
  for (const Peak& peak : peaks) keep(peak);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (const auto& [x, y] : mirror_images(f, Peak(kept[i]))) keep(ascend(f, x, y));
  }
  return kept;
}

// Angles: all round, and crowding towards the axes of both bodies, where thin ones bend.
std::vector<double> sample_angles(const RawEllipse& a, const RawEllipse& b) {
  constexpr double kPi = 0x1.921fb54442d18p+1;
  std::vector<double> angles;
  for (int i = 0; i < 1024; ++i) angles.push_back(i * (2 * kPi / 1024));
  for (const RawEllipse* body : {&a, &b}) {
    const double axis = std::atan2(body->direction[1], body->direction[0]);
    for (int quarter = 0; quarter < 4; ++quarter) {
      for (int k = 0; k < 60; ++k) {
        const double off = std::exp2(-0.6 * k - 2);
        for (const double sign : {-1.0, 1.0}) {
          const double t = axis + quarter * (kPi / 2) + sign * off;
          angles.push_back(t - 2 * kPi * std::floor(t / (2 * kPi)));
        }
      }
    }
  }
  std::ranges::sort(angles);
  return angles;
}

}  // namespace

PlaneGapTruth plane_gap_truth(const RawEllipse& a, const RawEllipse& b) {
  const Gap<Real> exact = gap_of(a, b);
  const bool circles = a.semi_axes[0] == a.semi_axes[1] && b.semi_axes[0] == b.semi_axes[1];
  if (circles && exact.dx == 0 && exact.dy == 0) {
    return {-(Real(a.semi_axes[0]) + b.semi_axes[0]), true, {}};
  }
  const auto rough = [](const Real& v) { return static_cast<long double>(v); };
  const auto body = [&](const std::array<Real, 4>& s) {
    return std::array<long double, 4>{rough(s[0]), rough(s[1]), rough(s[2]), rough(s[3])};
  };
  const Gap<long double> f{body(exact.a), body(exact.b), rough(exact.dx), rough(exact.dy)};
  const std::vector<double> angles = sample_angles(a, b);
  std::vector<long double> values;
  for (const double t : angles) values.push_back(f.value(std::cos(t), std::sin(t)));
  const std::size_t n = angles.size();
  const long double best = *std::ranges::max_element(values);
  const long double size = std::hypot(f.dx, f.dy) + f.a[2] + f.a[3] + f.b[2] + f.b[3];
  std::vector<Peak> peaks;
  for (std::size_t i = 0; i < n; ++i) {
    // A maximum that the sample stands on is not more than a hundredth of the size below its top.
    const bool peak = values[i] >= values[(i + 1) % n] && values[i] >= values[(i + n - 1) % n];
    if (!peak || values[i] < best - 0.02L * size) continue;
    peaks.push_back(ascend(exact, cos(Real(angles[i])), sin(Real(angles[i]))));
  }
  PlaneGapTruth truth{0, false, {}};
  for (const Peak& peak : highest(exact, std::move(peaks), Real(size))) {
    truth.gap = peak.value;
    truth.normals.push_back({peak.x, peak.y});
  }
  std::ranges::sort(truth.normals, descending);
  return truth;
}

Real plane_gap(const RawEllipse& a, const RawEllipse& b) { return plane_gap_truth(a, b).gap; }

}  // namespace tangency::inline v0::verify
