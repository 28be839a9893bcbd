// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the time of first contact, of the single call and of the batch, against the interval oracle
// on as many motions as asked for, by family, and the tolerance of many more that spin, exactly.
// The merge gate runs a part of it; docs/testing.md names the whole.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/time_batch.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/conversions.hpp>
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

enum class Family { meeting, passing, grazing_apart, grazing_overlap, overlapping_start, spinning };
constexpr Family kFamilies[] = {Family::meeting,           Family::passing,
                                Family::grazing_apart,     Family::grazing_overlap,
                                Family::overlapping_start, Family::spinning};
constexpr const char* kNames[] = {"meeting",           "passing",
                                  "grazing, apart",    "grazing, overlapping",
                                  "overlapping start", "spinning"};

class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  Case next(Family family) {
    if (family == Family::spinning) return spinning(30, 30);
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

  /// A body at rest or nearly so, large or small beside the other, which spins as it comes near: by
  /// up to `turns` radians in the horizon.
  Case spinning(double most_aspect, double turns) {
    const double aspect = log_uniform(1, most_aspect), horizon = log_uniform(0.1, 10);
    Moving one{body(aspect), {}}, other{body(log_uniform(1, most_aspect)), {}};
    const double ratio = log_uniform(1e-4, 1);
    other.body = Ellipsoid(Vec3::Zero(), ratio * other.body.semi_axes(), other.body.orientation());
    const double size = one.body.largest_semi_axis() + other.body.largest_semi_axis();
    const Vec3 n = direction();
    other.body = other.body.moved_to(one.body.centre() + one.body.support_point(n) +
                                     size * log_uniform(1e-3, 2) * n + other.body.support_point(n));
    const auto spin = [&] { return Vec3(direction() * log_uniform(0.1, turns) / horizon); };
    other.motion.angular_velocity = spin();
    if (below(3) == 0) one.motion.angular_velocity = spin();
    other.motion.velocity = -n * size * log_uniform(0.1, 3) / horizon;
    if (below(2) == 0) one.motion.velocity = in_ball() * size / horizon;
    if (below(4) == 0) other.motion.pivot_arm = in_ball() * size;
    if (below(2) == 0) std::swap(one, other);
    return {one, other, horizon, horizon * log_uniform(1e-9, 1e-3)};
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
      tangency::verify::to_raw(m.body),
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

template <class Found>
bool exceeds(const Found& found, double tolerance) {
  return mpq_class(found.latest) - mpq_class(found.time) > mpq_class(tolerance);
}

/// The tolerance alone, of motions that spin too fast for the oracle.
bool check_spins(long count, std::uint64_t seed) {
  bool kept = true;
  for (const auto& [aspect, turns] :
       {std::pair(30.0, 30.0), {30.0, 1e3}, {1e6, 30.0}, {1e6, 1e3}}) {
    Source source(seed);
    std::vector<int> steps;
    long contacts = 0, beyond = 0, open = 0;
    for (long i = 0; i < count / 4; ++i) {
      const Case c = source.spinning(aspect, turns);
      const auto found =
          time_of_contact(c.a.body, c.a.motion, c.b.body, c.b.motion, c.horizon, c.tolerance);
      steps.push_back(found.steps);
      contacts += found.status == ContactTimeStatus::contact;
      open += found.status == ContactTimeStatus::not_converged;
      if (!exceeds(found, c.tolerance)) continue;
      if (++beyond <= 5) print_row(c);
    }
    if (steps.empty()) continue;
    std::sort(steps.begin(), steps.end());
    const auto part = [&](double p) {
      return steps[static_cast<std::size_t>(p * static_cast<double>(steps.size() - 1))];
    };
    std::printf(
        "aspect to %g, turns to %g rad: %zu motions, %ld contacts, %ld beyond the tolerance, "
        "%ld open; steps: median %d, 99 %% below %d, 99.9 %% below %d, most %d\n",
        aspect, turns, steps.size(), contacts, beyond, open, part(0.5), part(0.99), part(0.999),
        steps.back());
    std::fflush(stdout);
    kept = kept && beyond == 0;
  }
  return kept;
}

/// An answer by either call.
struct Answer {
  ContactTimeStatus status;
  double time, latest;
  bool hidden;  ///< is the gap at `time` within the resolution?
  int steps;
};

Answer single(const Case& c) {
  const auto found =
      time_of_contact(c.a.body, c.a.motion, c.b.body, c.b.motion, c.horizon, c.tolerance);
  return {found.status, found.time, found.latest, found.gap.gap <= found.resolution, found.steps};
}

/// By the batch, which may say `grazing` only where the single call does: `hidden` is for agree().
Answer of_many(const Case& c) {
  const std::array bodies{c.a.body, c.b.body};
  const std::array motions{c.a.motion, c.b.motion};
  const std::array pairs{tangency::IndexedPair{0, 1}};
  const tangency::BodyArray array{std::span<const Ellipsoid>(bodies)};
  ContactTimeStatus status{};
  double time = 0, latest = 0;
  times_of_contact(array, motions, {pairs, {}}, c.horizon, c.tolerance,
                   {.status = {&status, 1}, .time = {&time, 1}, .latest = {&latest, 1}});
  return {status, time, latest, false, 0};
}

void compare(const Case& c, const FirstContact& truth, const Answer& found, Tally& tally) {
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
  const bool early = (claims && apart) || exceeds(found, c.tolerance) ||
                     (found.status == ContactTimeStatus::grazing && !found.hidden);
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

void print(const std::string& name, const Tally& t) {
  std::printf("%-22s %8ld %8ld %8ld %8ld %5ld %5ld %9ld %6ld %9ld %5ld %9.3g %6.1f (%5ld) %8.1f\n",
              name.c_str(), t.motions, t.contacts, t.none, t.at_start, t.late, t.early, t.too_close,
              t.not_converged, t.undecided, t.wide, t.earliest,
              static_cast<double>(t.steps) / static_cast<double>(t.motions), t.most_steps,
              1e6 * t.seconds / static_cast<double>(t.motions));
  std::fflush(stdout);
}

template <class Ask>
Answer timed(const Case& c, Tally& tally, const Ask& ask) {
  const auto clock = std::chrono::steady_clock::now();
  const Answer found = ask(c);
  tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  return found;
}

bool agree(std::uint64_t seed, long count, long spins) {
  std::printf("%-22s %8s %8s %8s %8s %5s %5s %9s %6s %9s %5s %9s %14s %8s\n", "family", "motions",
              "contact", "none", "at start", "late", "early", "too close", "open", "undecided",
              "wide", "earliest", "steps (most)", "us each");
  bool kept = true;
  for (const Family family : kFamilies) {
    Source source(seed + static_cast<std::uint64_t>(family));
    Tally one, many;
    for (long i = 0; i < count / 6; ++i) {
      const Case c = source.next(family);
      const FirstContact truth =
          first_contact(raw(c.a), raw(c.b), c.horizon, 0x1p-10 * c.tolerance);
      const Answer alone = timed(c, one, single);
      Answer of_batch = timed(c, many, of_many);
      of_batch.hidden = alone.status == ContactTimeStatus::grazing && alone.hidden;
      compare(c, truth, alone, one);
      compare(c, truth, of_batch, many);
    }
    print(kNames[static_cast<int>(family)], one);
    print("  by the batch", many);
    kept = kept && one.kept() && many.kept();
  }
  kept = check_spins(spins, seed) && kept;
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "time_of_contact_agreement", "Hold the time of first contact against the interval oracle");
  long count = 120'000, spins = 1'000'000;
  program.option("--count", count, "motions in all");
  program.option("--spins", spins, "motions that spin, without the oracle");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, count, spins); });
}
