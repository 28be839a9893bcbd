// SPDX-License-Identifier: MIT
#include <tangency/geometry/volume/slice_integrals.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <tangency/geometry/numbers/arc_tangent.hpp>
#include <tangency/geometry/numbers/wide_float.hpp>
#include <tangency/geometry/volume/slice_area.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr double kU = kUnitRoundoff;
// Chosen: so many times as small as what is asked for is the share of a range whose area is known
// by quadrature, and of one that stays open.
constexpr double kOfQuadrature = 0x1p-5, kOfOpen = 0x1p-7;
constexpr int kMostHalvings = 64;
constexpr int kMostRanges = 4000;  // 300 seen

/// Heights; an end may be a root of P.
struct Range {
  DoubleDouble low, high;
  bool touch_low, touch_high;
  int halvings;
};

/// Of the sum of two heights: of it and its rounding to double-double.
constexpr double kOfHeight = 0x1p-98;
template <class T>
DoubleDouble rounded_height(const T& z) {
  const double high = static_cast<double>(z);
  return {high, static_cast<double>(z - T(high))};
}

/// Which circle holds the other where they do not cross.
enum class Inside { none, ball, second };
/// Nothing where rounding hides a sign.
std::optional<Inside> inside_at(const SliceExpansion& e, double v) {
  const double q1 = e.q1(v), q2 = e.q2(v);
  const double off = e.of_square + 16.0 * kU * std::max(e.q1.most(1.0), e.q2.most(1.0));
  if (!(std::min(std::abs(q1), std::abs(q2)) > off)) return std::nullopt;
  if (q1 < 0.0) return Inside::ball;
  return q2 < 0.0 ? Inside::second : Inside::none;
}

template <class T>
class SliceSum {
 public:
  SliceSum(const CircularSections<T>& bodies, double volume_tolerance, double area_tolerance)
      : bodies_(bodies),
        level_error_(bodies.level_error()),
        volume_tolerance_(volume_tolerance),
        area_tolerance_(area_tolerance) {}

  SliceIntegrals run() {
    DoubleDouble low(-1.0), high(1.0);
    const DoubleDouble below = rounded_height(bodies_.z0 - bodies_.half_height);
    const DoubleDouble above = rounded_height(bodies_.z0 + bodies_.half_height);
    if ((below - low).high > 0.0) low = below;
    if ((high - above).high > 0.0) high = above;
    // By so much the second body may end above or below, and then the true one.
    const double half = static_cast<double>(bodies_.half_height);
    const double off = kOfHeight * (std::abs(static_cast<double>(bodies_.z0)) + half);
    sum_.volume_error = 8.0 * kPi * static_cast<double>(bodies_.mu) * (half + off) * off * off;
    strip_ = 8.0 * kPi * (bodies_.layer() + bodies_.distortion * half + off);
    if ((high - low).high > 0.0) push({low, high, false, false, 0});
    while (count_ > 0) {
      const Range next = open_[--count_];
      look_at(next);
    }
    return result();
  }

 private:
  void push(const Range& range) { open_[count_++] = range; }

  void add(const SliceShare& share) {
    volume_ = volume_ + DoubleDouble(share.volume), sum_.volume_error += share.volume_error;
    gradient_ = gradient_ + exactly(share.gradient), sum_.gradient_error += share.gradient_error;
    sum_.surface += share.surface, sum_.slices += share.slices;
  }

  /// With what the bodies' own errors make of volume and gradient: section 7.
  SliceIntegrals result() const {
    SliceIntegrals sum;
    sum.volume = volume_.high, sum.gradient = bodies_.frame * rounded(gradient_);
    sum.volume_error = 1.01 * (sum_.volume_error + bodies_.layer() * (sum_.surface + strip_)) +
                       (4.0 * kU + 3.1 * bodies_.distortion) * std::abs(sum.volume);
    sum.gradient_error = 1.01 * (sum_.gradient_error + strip_) +
                         (16.0 * kU + 4.0 * bodies_.distortion) * sum.gradient.norm();
    sum.slices = sum_.slices, sum.ranges = ranges_;
    return sum;
  }

  void look_at(const Range& range) {
    ++ranges_;
    if (range.touch_low || range.touch_high) {
      if (range.touch_low && range.touch_high) return halve(range);
      if (!add_from_touch(range)) leave_or_halve(range);
      return;
    }
    const SliceExpansion e = about_middle(range);
    const double known = e.p.least(1.0) - e.of_p - 24.0 * kU * e.p.most(1.0);
    if (known > 0.0) {
      if (e.p.c[0] < 0.0) {
        if (add_closed(e, SliceRange::about_middle, known)) return;
      } else if (add_crossing(e, SliceRange::about_middle)) {
        return;
      }
    } else if (split_at_touch(range, e)) {
      return;
    }
    leave_or_halve(range);
  }

  SliceExpansion about_middle(const Range& range) const {
    const DoubleDouble half(0.5);
    return {bodies_, half * (range.low + range.high), (half * (range.high - range.low)).high};
  }

  bool add_from_touch(const Range& range) {
    const double length = (range.high - range.low).high;
    const SliceExpansion e(bodies_, range.touch_low ? range.low : range.high,
                           range.touch_low ? length : -length);
    const double known = e.p.deflated().least(1.0) - 24.0 * kU * e.p.most(1.0);
    if (!(known > 0.0)) return false;
    if (e.p.c[1] > 0.0) return add_crossing(e, SliceRange::from_touch);
    return add_closed(e, SliceRange::from_touch, known);
  }

  bool add_crossing(const SliceExpansion& e, SliceRange range) {
    const auto share = crossing_share(e, range, kOfQuadrature * volume_tolerance_,
                                      kOfQuadrature * area_tolerance_);
    if (!share) return false;
    add(*share);
    const SliceBounds b(e, range, 1.0);
    add_strip(e, range, b.least_p, b.q1);
    return true;
  }

  /// What the bodies' own errors make of the part of the ball's surface that is in the second body,
  /// where P >= least_p, or >= v least_p: section 7.
  void add_strip(const SliceExpansion& e, SliceRange range, double least_p, double q1) {
    const double length = std::abs(e.step) * (range == SliceRange::about_middle ? 2.0 : 1.0);
    const double margin = 2.0 * level_error_ * (2.0 * q1 + level_error_);
    double unknown = 1.0;  // of the length
    if (range == SliceRange::from_touch) {
      unknown = std::min(1.0, (discriminant_error(e, range) + margin) / least_p);
    } else if (least_p > margin) {
      unknown = 0.0;
    }
    strip_ += 2.0 * kPi * length * unknown;
    if (unknown < 1.0) strip_ += 12.0 * level_error_ * length / std::sqrt(least_p);
  }

  /// Where one circle holds the other, or none meets the other.
  /// @param known  P <= -known, or <= -|v| known
  bool add_closed(const SliceExpansion& e, SliceRange range, double known) {
    const bool middle = range == SliceRange::about_middle;
    const std::optional<Inside> inside = inside_at(e, middle ? 0.0 : 0.5);
    if (!inside) return false;
    const double length = std::abs(e.step) * (middle ? 2.0 : 1.0);
    SliceShare share;
    if (inside != Inside::none) {
      const SlicePolynomial<3>& r2 = inside == Inside::ball ? e.ball : e.second;
      const double mean =
          middle ? r2.c[0] + r2.c[2] / 3.0 : r2.c[0] + r2.c[1] / 2.0 + r2.c[2] / 3.0;
      share.volume = kPi * length * mean;
      share.volume_error = kPi * length * (16.0 * kU * r2.most(1.0) + e.of_square);
    }
    if (inside == Inside::ball) {
      const double middle_z = middle ? e.base : e.base + 0.5 * e.step;
      share.gradient.z() = -2.0 * kPi * length * middle_z;
      share.surface = 2.0 * kPi * length;
      share.gradient_error = 2.0 * kPi * length * 8.0 * kU * (std::abs(e.base) + std::abs(e.step));
    }
    if (!middle) {
      // Up to so far from the root of the polynomial P may be of the other sign.
      const double off = discriminant_error(e, range);
      share.volume_error += std::min(1.0, off / known) * length * nearly_closed(e, off);
    }
    add(share);
    add_strip_of_closed(e, range, known);
    return true;
  }

  void add_strip_of_closed(const SliceExpansion& e, SliceRange range, double known) {
    const double length = std::abs(e.step) * (range == SliceRange::about_middle ? 2.0 : 1.0);
    const double margin = 2.0 * level_error_ * (2.0 * e.q1.most(1.0) + level_error_);
    double unknown = margin < known ? 0.0 : 1.0;
    if (range == SliceRange::from_touch)
      unknown = std::min(1.0, (discriminant_error(e, range) + margin) / known);
    strip_ += 2.0 * kPi * length * unknown;
  }

  /// How far an area can be from that of a circle, or from 0, where P <= most_p; all of it where
  /// that is not known to be little.
  static double nearly_closed(const SliceExpansion& e, double most_p) {
    const SliceBounds b(e, SliceRange::from_touch, 1.0);
    const double share_1 = most_p / b.least_1, share_2 = most_p / b.least_2;
    if (b.least_1 > 0.0 && b.least_2 > 0.0 && share_1 < 0.05 && share_2 < 0.05) {
      return 4.0 *
             (b.ball * share_1 * std::sqrt(share_1) + b.second * share_2 * std::sqrt(share_2));
    }
    return kPi * std::min(b.ball, b.second);
  }

  /// Where P has one root in the range, and changes its sign there: divides the range at it.
  bool split_at_touch(const Range& range, const SliceExpansion& e) {
    const double at_low = e.p(-1.0), at_high = e.p(1.0);
    const double off = e.of_p + 24.0 * kU * e.p.most(1.0);
    if (!(std::min(std::abs(at_low), std::abs(at_high)) > off)) return false;
    if ((at_low < 0.0) == (at_high < 0.0)) return false;
    if (!(e.p.derivative().least(1.0) > 0.0)) return false;
    const DoubleDouble root = touch(e, range);
    if (!((root - range.low).high > 0.0) || !((range.high - root).high > 0.0)) return false;
    push({range.low, root, range.touch_low, true, range.halvings});
    push({root, range.high, true, range.touch_high, range.halvings});
    return true;
  }

  /// Newton's method, of an expansion that is made anew where it has come to.
  DoubleDouble touch(const SliceExpansion& first, const Range& range) const {
    DoubleDouble at = DoubleDouble(0.5) * (range.low + range.high);
    SliceExpansion e = first;
    constexpr int kExpansions = 4, kSteps = 12;
    for (int k = 0; k < kExpansions; ++k) {
      double low = -1.0, high = 1.0, v = 0.0;
      const auto slope = e.p.derivative();
      for (int i = 0; i < kSteps; ++i) {
        const double value = e.p(v);
        if (k == 0) ((value < 0.0) == (e.p.c[1] > 0.0) ? low : high) = v;
        double next = v - value / slope(v);
        if (k == 0 && !(low <= next && next <= high)) next = 0.5 * (low + high);
        if (next == v) break;
        v = next;
      }
      at = at + DoubleDouble(v) * DoubleDouble(e.step);
      if (k + 1 < kExpansions) e = SliceExpansion(bodies_, at, e.step);
    }
    return at;
  }

  /// What is known of a range whatever lies in it.
  SliceShare open_share(const SliceExpansion& e) const {
    const double length = 2.0 * std::abs(e.step);
    const SliceBounds b(e, SliceRange::about_middle, 1.0);
    const double p = e.p.most(1.0) + e.of_p, share_1 = p / b.least_1, share_2 = p / b.least_2;
    SliceShare share;
    share.surface = 2.0 * kPi * length;
    const std::optional<Inside> inside = inside_at(e, 0.0);
    if (inside && b.least_1 > 0.0 && b.least_2 > 0.0 && share_1 < 0.05 && share_2 < 0.05) {
      const SlicePolynomial<3>& r2 = inside == Inside::ball ? e.ball : e.second;
      if (inside != Inside::none) share.volume = kPi * length * (r2.c[0] + r2.c[2] / 3.0);
      share.volume_error =
          length * 4.0 *
              (b.ball * share_1 * std::sqrt(share_1) + b.second * share_2 * std::sqrt(share_2)) +
          kPi * length * (16.0 * kU * r2.most(1.0) + e.of_square);
      if (inside == Inside::ball) share.gradient.z() = -2.0 * kPi * length * e.base;
      const double margin = 2.0 * level_error_ * (2.0 * b.q1 + level_error_);
      const double z = std::abs(e.base) + std::abs(e.step);
      const double off_angle = 1.8 * std::sqrt(share_1 + margin / b.least_1);
      share.gradient_error =
          length * (4.0 * z * off_angle + 4.0 * off_angle * (level_error_ > 0.0) +
                    std::sqrt(p / b.least_distance) + 16.0 * kPi * kU * z);
      return share;
    }
    const double off = e.of_square + 16.0 * kU * (b.ball + b.second);
    const double smaller = std::min(b.ball, b.second);
    const double moved = 2.0 * std::sqrt((smaller + off) * (b.distance + off));
    // Either circles of any radii of the range, or of about the ball's.
    const double radii = std::min(2.0 * e.ball.c[0] - b.ball, 2.0 * e.second.c[0] - b.second) - off;
    const double most = kPi * (smaller + off), least = std::max(0.0, kPi * radii - moved);
    const double of_radii = 0.5 * (most - least) + 8.0 * kU * most;
    const double of_ball = kPi * (0.5 * (b.q1 + b.q2) + off) + moved;
    share.volume = length * (of_radii < of_ball ? 0.5 * (most + least)
                                                : kPi * (e.ball.c[0] + e.ball.c[2] / 3.0));
    share.volume_error = length * std::min(of_radii, of_ball);
    share.gradient_error = length * 2.0 * kPi;
    return share;
  }

  void leave_or_halve(const Range& range) {
    const SliceShare share = open_share(about_middle(range));
    const bool little = share.volume_error <= kOfOpen * volume_tolerance_ &&
                        share.gradient_error <= kOfOpen * area_tolerance_;
    const bool room =
        range.halvings < kMostHalvings && ranges_ < kMostRanges && count_ + 2 <= open_.size();
    if (little || !room) return add(share);
    halve(range);
  }
  void halve(const Range& range) {
    DoubleDouble middle((DoubleDouble(0.5) * (range.low + range.high)).high);
    if (!((middle - range.low).high > 0.0) || !((range.high - middle).high > 0.0))
      middle = DoubleDouble(0.5) * (range.low + range.high);
    push({range.low, middle, range.touch_low, false, range.halvings + 1});
    push({middle, range.high, false, range.touch_high, range.halvings + 1});
  }

  const CircularSections<T>& bodies_;
  const double level_error_, volume_tolerance_, area_tolerance_;
  std::array<Range, 2 * kMostHalvings + 8> open_;
  std::size_t count_ = 0;
  int ranges_ = 0;
  SliceShare sum_;  ///< but for volume and gradient
  DoubleDouble volume_;
  DoubleDoubleVector gradient_{0.0, 0.0, 0.0};
  double strip_ = 0.0;  ///< of the ball's surface that may be in the true second body or not
};

}  // namespace

template <class T>
SliceIntegrals slice_integrals(const CircularSections<T>& bodies, double volume_tolerance,
                               double area_tolerance) noexcept {
  return SliceSum<T>(bodies, volume_tolerance, area_tolerance).run();
}

template SliceIntegrals slice_integrals(const CircularSections<DoubleDouble>&, double,
                                        double) noexcept;
template SliceIntegrals slice_integrals(const CircularSections<WideFloat>&, double,
                                        double) noexcept;

}  // namespace tangency::inline v0::detail
