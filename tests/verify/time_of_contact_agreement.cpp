// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the time of first contact against the interval oracle on as many motions as asked for, by
// family. The merge gate runs a part of it; docs/guide.md names the whole.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/tests/support/conversions.hpp>
#include <tangency/verify/oracles/time_of_contact.hpp>

namespace {

using tangency::ContactTimeStatus;
using tangency::Ellipsoid;
using tangency::Motion;
using tangency::Vec3;
using tangency::verify::FirstContact;
using tangency::verify::MovingBody;

struct Moving {
  Ellipsoid body;
  Motion motion;
};
struct Case {
  Moving a, b;
  double horizon, tolerance;
};

enum class Family { meeting, passing, grazing_apart, grazing_overlap, overlapping_start };
constexpr Family kFamilies[] = {Family::meeting, Family::passing, Family::grazing_apart,
                                Family::grazing_overlap, Family::overlapping_start};
constexpr const char* kNames[] = {"meeting", "passing", "grazing, apart", "grazing, overlapping",
                                  "overlapping start"};

class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  Case next(Family family) {
    const double aspect = log_uniform(1, below(8) == 0 ? 1e3 : 30);
    // The state at a moment `when`, then taken back to 0.
    Ellipsoid a = body(aspect), b = body(aspect);
    const double horizon = log_uniform(0.1, 10), when = horizon * uniform(0.1, 0.9);
    const double size = a.largest_semi_axis() + b.largest_semi_axis();
    Motion ma = motion(a, horizon), mb = motion(b, horizon);
    // Two bodies at rest that all but touch are neither apart nor in contact for doubles.
    if (ma.velocity == mb.velocity) mb.velocity = size * in_ball();
    const Vec3 n = direction();
    const double gap = gap_of(family, a, b, size);
    b = b.moved_to(a.centre() + a.support_point(n) + gap * n + b.support_point(n));
    const auto speed_at = [&](const Motion& m, const Ellipsoid& e, const Vec3& point) -> Vec3 {
      return m.velocity + m.angular_velocity.cross(m.pivot_arm + point - e.centre());
    };
    const Vec3 pa = a.centre() + a.support_point(n), pb = b.centre() - b.support_point(n);
    const double closing = n.dot(speed_at(ma, a, pa) - speed_at(mb, b, pb));
    // Grazing: the points move past each other; meeting: towards each other.
    if (family == Family::grazing_apart || family == Family::grazing_overlap)
      mb.velocity += closing * n;
    if (family == Family::meeting && closing < 0) mb.velocity += 2 * closing * n;
    const double back = family == Family::overlapping_start ? 0 : when;
    const double tolerance = horizon * log_uniform(1e-9, 1e-3);
    return {earlier(a, ma, back), earlier(b, mb, back), horizon, tolerance};
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  Vec3 in_ball() {
    for (;;) {
      const Vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (v.norm() <= 1 && v.norm() > 0.01) return v;
    }
  }
  Vec3 direction() { return in_ball().normalized(); }

  Ellipsoid body(double aspect) {
    const double size = log_uniform(0.3, 3);
    Vec3 a(size, size * log_uniform(1 / aspect, 1), size / aspect);
    if (below(6) == 0) a[1] = a[below(2) * 2];
    if (below(12) == 0) a = Vec3::Constant(size);
    const Eigen::Quaterniond q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1));
    return {in_ball() * log_uniform(0.1, 100), a, q};
  }

  /// At rest, straight, spinning, on a screw, or on a wide turn.
  Motion motion(const Ellipsoid& e, double horizon) {
    const double size = e.largest_semi_axis();
    Motion m;
    const int kind = below(6);
    if (kind > 0) m.velocity = in_ball() * size * 5 / horizon;
    if (kind > 1) m.angular_velocity = in_ball() * log_uniform(0.1, 10) / horizon;
    if (kind == 4) {
      m = tangency::screw(e, e.centre() + in_ball() * 2 * size, m.angular_velocity,
                          m.velocity.norm());
    }
    if (kind == 5) m.pivot_arm = in_ball() * 10 * size;
    return m;
  }

  double gap_of(Family family, const Ellipsoid& a, const Ellipsoid& b, double size) {
    const auto rho = [](const Ellipsoid& e) {
      return e.smallest_semi_axis() * e.smallest_semi_axis() / e.largest_semi_axis();
    };
    switch (family) {
      case Family::grazing_apart:
        return size * log_uniform(1e-11, 1e-2);
      case Family::grazing_overlap:
        return -(rho(a) + rho(b)) * log_uniform(1e-7, 0.5);
      case Family::overlapping_start:
        return -(rho(a) + rho(b)) * log_uniform(1e-10, 0.9);
      case Family::passing:
        return size * uniform(0, 2);
      default:
        return 0;
    }
  }

  static Moving earlier(const Ellipsoid& e, const Motion& m, double by) {
    const Motion reverse{-m.velocity, -m.angular_velocity, m.pivot_arm};
    Motion start = m;
    const double angle = m.angular_velocity.norm() * by;
    if (angle > 0) {
      start.pivot_arm = Eigen::AngleAxisd(-angle, m.angular_velocity.normalized()) * m.pivot_arm;
    }
    return {tangency::moved(e, reverse, by), start};
  }

  std::mt19937_64 random_;
};

MovingBody raw(const Moving& m) {
  const auto triple = [](const Vec3& v) { return std::array<double, 3>{v[0], v[1], v[2]}; };
  return {
      tangency::testing::to_raw(m.body),
      {triple(m.motion.velocity), triple(m.motion.angular_velocity), triple(m.motion.pivot_arm)}};
}

struct Tally {
  long motions = 0, contacts = 0, none = 0, at_start = 0, too_close = 0, not_converged = 0;
  long late = 0, early = 0, undecided = 0;
  long wide = 0;  // enclosures wider than the tolerance
  long most_steps = 0, steps = 0;
  double earliest = 0;  // of the tolerance
  double seconds = 0;

  /// Rounding may hide shallow overlaps and tolerances that are too short for a slow approach, and
  /// hides them from the oracle's intervals alike: they must stay few.
  bool kept() const {
    return late == 0 && early == 0 && not_converged == 0 && too_close <= motions / 50 &&
           undecided <= motions / 50 && wide <= motions / 20;
  }
};

void print_row(const Case& c) {
  for (const Moving* m : {&c.a, &c.b}) {
    const MovingBody r = raw(*m);
    const auto all = [](const auto& numbers) {
      for (const double x : numbers) std::printf("%a,", x);
    };
    all(r.body.centre), all(r.body.semi_axes), all(r.body.orientation);
    all(r.motion.velocity), all(r.motion.angular_velocity), all(r.motion.pivot_arm);
  }
  std::printf("%a,%a\n", c.horizon, c.tolerance);
}

void compare(const Case& c, Tally& tally) {
  const auto clock = std::chrono::steady_clock::now();
  const auto found =
      time_of_contact(c.a.body, c.a.motion, c.b.body, c.b.motion, c.horizon, c.tolerance);
  tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  const FirstContact truth = first_contact(raw(c.a), raw(c.b), c.horizon, 0x1p-10 * c.tolerance);
  ++tally.motions;
  tally.steps += found.steps;
  tally.most_steps = std::max<long>(tally.most_steps, found.steps);
  tally.contacts += found.status == ContactTimeStatus::contact;
  tally.none += found.status == ContactTimeStatus::none;
  tally.at_start += found.status == ContactTimeStatus::touching_at_start;
  tally.too_close += found.status == ContactTimeStatus::grazing;
  tally.not_converged += found.status == ContactTimeStatus::not_converged;
  if (truth.status == FirstContact::Status::undecided) ++tally.undecided;

  tally.wide +=
      truth.status == FirstContact::Status::contact && truth.to - truth.from > c.tolerance;

  const bool touches = truth.status == FirstContact::Status::contact;
  const bool late = touches && (found.time > truth.to || found.status == ContactTimeStatus::none);
  // The truth must not be proven to be apart up to the latest time that the answer names.
  const bool claims = found.status == ContactTimeStatus::contact ||
                      found.status == ContactTimeStatus::touching_at_start;
  const bool apart = truth.status == FirstContact::Status::none || truth.from > found.latest;
  // A pass too close to call is one whose gap is within the resolution.
  const bool hidden = found.gap.gap <= found.resolution;
  const bool early = (claims && apart) || found.latest > found.time + c.tolerance ||
                     (found.status == ContactTimeStatus::grazing && !hidden);
  if (touches && found.status == ContactTimeStatus::contact)
    tally.earliest = std::max(tally.earliest, (truth.from - found.time) / c.tolerance);
  tally.late += late;
  tally.early += early;
  if (late || early || found.status == ContactTimeStatus::not_converged) {
    std::printf("%s: status %d time %.17g latest %.17g, oracle %d [%.17g, %.17g]: ",
                late    ? "LATE"
                : early ? "EARLY"
                        : "OPEN",
                static_cast<int>(found.status), found.time, found.latest,
                static_cast<int>(truth.status), truth.from, truth.to);
    print_row(c);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Hold the time of first contact against the interval oracle");
  long count = 100'000;
  std::uint64_t seed = 20261122;
  app.add_option("--count", count, "motions in all")->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::printf("seed %llu\n%-22s %8s %8s %8s %8s %5s %5s %9s %6s %9s %5s %9s %14s %8s\n",
              static_cast<unsigned long long>(seed), "family", "motions", "contact", "none",
              "at start", "late", "early", "too close", "open", "undecided", "wide", "earliest",
              "steps (most)", "us each");
  bool kept = true;
  for (const Family family : kFamilies) {
    Source source(seed + static_cast<std::uint64_t>(family));
    Tally t;
    for (long i = 0; i < count / 5; ++i) compare(source.next(family), t);
    std::printf(
        "%-22s %8ld %8ld %8ld %8ld %5ld %5ld %9ld %6ld %9ld %5ld %9.3g %6.1f (%5ld) %8.1f\n",
        kNames[static_cast<int>(family)], t.motions, t.contacts, t.none, t.at_start, t.late,
        t.early, t.too_close, t.not_converged, t.undecided, t.wide, t.earliest,
        static_cast<double>(t.steps) / static_cast<double>(t.motions), t.most_steps,
        1e6 * t.seconds / static_cast<double>(t.motions));
    std::fflush(stdout);
    kept = kept && t.kept();
  }
  return kept ? 0 : 1;
}
