// SPDX-License-Identifier: GPL-3.0-or-later
// Holds what the kernel says of two ellipses against the oracles, family by family: relation,
// crossings and their multiplicities exactly; their places, the common area and the gap in numbers;
// and everything against the same pair exchanged. The merge gate runs a part of it; docs/guide.md
// names the whole.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/oracles/ellipse.hpp>

namespace {

using tangency::Crossings;
using tangency::Ellipse;
using tangency::EllipseRelation;
using tangency::GapStatus;
using tangency::PlaneGap;
using tangency::Vec2;
using tangency::verify::RawEllipse;
using tangency::verify::Real;
using tangency::verify::Real2;

constexpr double kU = 0x1p-53;
constexpr double kOracle = 1e-40;  // of the size: where the oracle's ascents end

struct RawPair {
  RawEllipse a, b;
};

Ellipse to_ellipse(const RawEllipse& e) {
  return {{e.centre[0], e.centre[1]},
          {e.semi_axes[0], e.semi_axes[1]},
          {e.direction[0], e.direction[1]}};
}

/// Random ellipses and pairs of them.
class Sampler {
 public:
  explicit Sampler(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * unit_(engine_); }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  std::array<double, 2> direction() {
    const double t = uniform(0, 6.283185307179586), length = log_uniform(0.1, 10);
    return {length * std::cos(t), length * std::sin(t)};
  }
  RawEllipse body(double aspect, double size = 1) {
    const double half = std::sqrt(aspect);
    return {{uniform(-1, 1), uniform(-1, 1)},
            {size * log_uniform(1 / half, half), size * log_uniform(1 / half, half)},
            direction()};
  }
  /// Centres `fraction` times as far apart as where the pair touches with a random normal.
  RawPair at(RawEllipse a, RawEllipse b, double fraction) {
    const auto n = direction();
    const Vec2 normal(n[0], n[1]);
    const Vec2 reach = to_ellipse(a).support_point(normal) + to_ellipse(b).support_point(normal);
    for (std::size_t i = 0; i < 2; ++i) {
      b.centre[i] = a.centre[i] + fraction * reach[static_cast<int>(i)];
    }
    return {a, b};
  }
  RawPair exchanged_now_and_then(const RawPair& p) {
    return integer(0, 1) == 0 ? p : RawPair{p.b, p.a};
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_;
};

RawPair random_pair(Sampler& s) {
  const double aspect = s.log_uniform(1, 100);
  return s.at(s.body(aspect), s.body(aspect, s.log_uniform(0.3, 3)), s.uniform(0, 1.5));
}

/// Ellipses about one line of direction (3, 4), sizes multiples of 5, so that vertices are exact:
/// external and internal touches of every order, and touches beside two crossings.
RawPair tangent_pair(Sampler& s) {
  const double m = s.integer(1, 6), p = s.integer(1, 6), scale = std::exp2(s.integer(-3, 3));
  const auto width = [&](double along) {
    // Every fourth time the radius of curvature at the vertex is 5, whatever the length.
    return s.integer(0, 3) == 0 && (along == 1 || along == 4) ? 5 * std::sqrt(along)
                                                              : s.integer(1, 30);
  };
  RawPair pair{{{0, 0}, {5 * m, width(m)}, {3, 4}}, {{0, 0}, {5 * p, width(p)}, {-0.75, -1}}};
  const double apart = s.integer(0, 1) == 0 ? m + p : m - p;
  pair.b.centre = {3 * apart, 4 * apart};
  for (RawEllipse* e : {&pair.a, &pair.b}) {
    for (double& v : e->centre) v *= scale;
    for (double& v : e->semi_axes) v *= scale;
  }
  return s.exchanged_now_and_then(pair);
}

/// The circle of curvature where (cos, sin) = (3, 4) / 5 on the ellipse of 45 and 80: a crossing of
/// multiplicity 3 and one more.
RawPair osculating_pair(Sampler& s) {
  const double scale = std::exp2(s.integer(-20, 20)) * s.integer(1, 1000);
  const double sx = s.integer(0, 1) == 0 ? -1 : 1, sy = s.integer(0, 1) == 0 ? -1 : 1;
  const RawEllipse ellipse{{0, 0}, {45 * scale, 80 * scale}, {1, 0}};
  const RawEllipse circle{{-21 * sx * scale, 28 * sy * scale}, {60 * scale, 60 * scale}, {1, 2}};
  return s.exchanged_now_and_then({ellipse, circle});
}

RawPair four_crossing_pair(Sampler& s) {
  const double aspect = s.log_uniform(1.05, 1000), turn = s.uniform(0.2, 1.5);
  RawEllipse a = s.body(1), b = a;
  a.semi_axes = {aspect, 1};
  b.semi_axes = {aspect * s.uniform(0.9, 1.1), s.uniform(0.9, 1.1)};
  const auto [x, y] = a.direction;
  b.direction = {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y};
  b.centre[0] += s.uniform(-0.1, 0.1), b.centre[1] += s.uniform(-0.1, 0.1);
  return {a, b};
}

RawPair concentric_pair(Sampler& s) {
  RawPair pair{s.body(10), s.body(10)};
  pair.b.centre = pair.a.centre;
  const int kind = s.integer(0, 3);
  if (kind == 0) pair.b.direction = pair.a.direction;
  if (kind == 1) {  // two touches, or homothetic
    pair.b.direction = {-2 * pair.a.direction[1], 2 * pair.a.direction[0]};
    pair.b.semi_axes[1] = pair.a.semi_axes[0];
    if (s.integer(0, 1) == 0) pair.b.semi_axes[0] = 2 * pair.a.semi_axes[1];
  }
  if (kind == 2) {
    pair.b.direction = pair.a.direction;
    pair.b.semi_axes = {2 * pair.a.semi_axes[0], 2 * pair.a.semi_axes[1]};
  }
  return s.exchanged_now_and_then(pair);
}

RawPair equal_pair(Sampler& s) {
  RawPair pair{s.body(100), {}};
  pair.b = pair.a;
  const double stretch = std::exp2(s.integer(-9, 9));
  auto& u = pair.b.direction;
  u = {stretch * u[0], stretch * u[1]};
  if (s.integer(0, 1) == 0) {
    std::swap(pair.b.semi_axes[0], pair.b.semi_axes[1]);
    u = {-u[1], u[0]};
  }
  // Half of them just not equal.
  if (s.integer(0, 1) == 0) {
    double& v = s.integer(0, 1) == 0 ? pair.b.semi_axes[0] : pair.b.centre[1];
    v = std::nextafter(v, 1e9);
  }
  return pair;
}

RawPair circle_pair(Sampler& s) {
  const auto circle = [&] {
    const bool whole = s.integer(0, 1) == 0;
    const double r = whole ? s.integer(1, 6) : s.log_uniform(0.1, 10);
    return RawEllipse{{0, 0}, {r, r}, s.direction()};
  };
  RawPair pair{circle(), circle()};
  if (s.integer(0, 1) == 0) {
    pair.b.centre = {3.0 * s.integer(-2, 2), 4.0 * s.integer(-2, 2)};
  } else {
    pair = s.at(pair.a, pair.b, s.uniform(0, 1.5));
  }
  return pair;
}

RawPair near_touch_pair(Sampler& s) {
  const double off = s.log_uniform(1e-16, 1e-3), sign = s.integer(0, 1) == 0 ? -1 : 1;
  const double aspect = s.log_uniform(1, 1000);
  return s.at(s.body(aspect), s.body(aspect), 1 + sign * off);
}

RawPair extreme_pair(Sampler& s) {
  const double aspect = s.log_uniform(1, 1e8), fraction = s.uniform(0, 1.3);
  RawPair pair = s.at(s.body(aspect), s.body(aspect, s.log_uniform(1e-3, 1e3)), fraction);
  const int kind = s.integer(0, 2);
  const double scale = kind == 0 ? std::exp2(500) : kind == 1 ? std::exp2(-500) : 1;
  for (RawEllipse* e : {&pair.a, &pair.b}) {
    for (double& v : e->semi_axes) v *= scale;
    for (double& v : e->centre) v = v * scale + (kind == 2 ? std::exp2(20) : 0.0);
  }
  return pair;
}

struct Family {
  const char* name;
  std::function<RawPair(Sampler&)> next;
  long count;         ///< pairs for the exact answers
  double area_error;  ///< promised, relative
};

struct Tally {
  long pairs = 0, wrong = 0, filtered = 0, numbers = 0, unequal = 0, local = 0, violated = 0;
  long gsl = 0, gsl_wrong = 0;
  std::array<long, 6> crossings{};  ///< of 0 to 4, and equal
  double place = 0, area = 0, gap = 0, gap_error = 0;
};

void print(const char* what, const RawPair& pair) {
  std::printf("%s:", what);
  for (const RawEllipse& e : {pair.a, pair.b}) {
    std::printf(" %a,%a,%a,%a,%a,%a", e.centre[0], e.centre[1], e.semi_axes[0], e.semi_axes[1],
                e.direction[0], e.direction[1]);
  }
  std::printf("\n");
}

tangency::verify::ExactRelation kernel_relation(const EllipseRelation& r) {
  using From = tangency::Relation;
  using To = tangency::verify::Relation;
  const auto relation = [&] {
    switch (r.relation) {
      case From::separate:
        return To::separate;
      case From::external_touch:
        return To::external_touch;
      case From::overlap:
        return To::overlap;
      case From::internal_touch:
        return To::internal_touch;
      case From::a_in_b:
        return To::a_in_b;
      case From::b_in_a:
        return To::b_in_a;
      case From::equal:
        break;
    }
    return To::equal;
  };
  using Inner = tangency::verify::Inner;
  const Inner inner = r.inner == tangency::Inner::none ? Inner::none
                      : r.inner == tangency::Inner::a  ? Inner::a
                                                       : Inner::b;
  return {relation(), inner};
}

/// Do the exact answers agree?
bool agrees(const Ellipse& a, const Ellipse& b, const EllipseRelation& found,
            const tangency::verify::EllipseTruth& truth) {
  if (kernel_relation(found) != truth.relation) return false;
  if (found.crossings.value_or(-1) != truth.crossings) return false;
  const Crossings points = crossings(a, b);
  std::vector<int> multiplicities;
  for (int i = 0; i < points.count; ++i) {
    multiplicities.push_back(points.at[static_cast<std::size_t>(i)].multiplicity);
  }
  std::ranges::sort(multiplicities);
  return multiplicities == truth.multiplicities && points.equal == (truth.crossings == -1);
}

double length(const RawPair& p) {
  return std::hypot(p.b.centre[0] - p.a.centre[0], p.b.centre[1] - p.a.centre[1]) +
         std::max(p.a.semi_axes[0], p.a.semi_axes[1]) +
         std::max(p.b.semi_axes[0], p.b.semi_axes[1]);
}

/// The largest distance of a computed crossing from the nearest true one.
double distance(const Crossings& found, const std::vector<Real2>& truth) {
  double most = 0;
  for (int i = 0; i < found.count; ++i) {
    const Vec2& p = found.at[static_cast<std::size_t>(i)].arm_a;
    double least = std::numeric_limits<double>::infinity();
    for (const Real2& t : truth) {
      const Real x = t[0] - p[0], y = t[1] - p[1];
      least = std::min(least, static_cast<double>(sqrt(x * x + y * y)));
    }
    most = std::max(most, least);
  }
  return most;
}

/// Does exchanging the bodies change anything but what it should?
bool exchange_changes(const Ellipse& a, const Ellipse& b) {
  const EllipseRelation r = relation(a, b), s = relation(b, a);
  if (r.crossings != s.crossings || overlaps(a, b) != overlaps(b, a)) return true;
  if (common_area(a, b) != common_area(b, a)) return true;
  const Crossings c = crossings(a, b), d = crossings(b, a);
  if (c.count != d.count) return true;
  for (std::size_t i = 0; i < 4; ++i) {
    bool there = c.at[i].multiplicity == 0;
    for (const auto& other : d.at) {
      there = there || (other.arm_a == c.at[i].arm_b && other.arm_b == c.at[i].arm_a &&
                        other.multiplicity == c.at[i].multiplicity);
    }
    if (!there) return true;
  }
  const auto chord = chord_contact(a, b), back = chord_contact(b, a);
  if (chord.status != back.status || chord.depth != back.depth) return true;
  if (chord.normal != -back.normal || chord.arm_a != back.arm_b) return true;
  const PlaneGap g = signed_gap(a, b), h = signed_gap(b, a);
  return std::abs(g.gap - h.gap) > g.gap_error + h.gap_error;
}

/// The outer normal of a body's boundary at a point, from the centre.
Vec2 normal_at(const Ellipse& e, const Vec2& arm) {
  const Vec2 local = tangency::turned_back(e.axis(), arm);
  return tangency::turned(e.axis(), local.cwiseQuotient(e.semi_axes()).cwiseQuotient(e.semi_axes()))
      .normalized();
}

/// Crossings at an angle and well apart, which double precision can find?
bool plain(const Ellipse& a, const Ellipse& b, const Crossings& found, double size) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(found.count); ++i) {
    const Vec2 n = normal_at(a, found.at[i].arm_a), m = normal_at(b, found.at[i].arm_b);
    if (std::abs(n[0] * m[1] - n[1] * m[0]) < 0.01) return false;
    for (std::size_t k = 0; k < i; ++k) {
      if ((found.at[i].arm_a - found.at[k].arm_a).norm() < 0.01 * size) return false;
    }
  }
  return found.count > 0;
}

/// GSL's roots where double precision can find them: as many, and at the same places?
void compare_with_gsl(const RawPair& pair, const Crossings& found, Tally& tally) {
  const double size = length(pair);
  if (!plain(to_ellipse(pair.a), to_ellipse(pair.b), found, size)) return;
  ++tally.gsl;
  const auto roots = tangency::verify::ellipse_crossings_by_gsl(pair.a, pair.b, 1e-6);
  bool wrong = roots.size() < static_cast<std::size_t>(found.count);
  for (int i = 0; i < found.count; ++i) {
    const Vec2& p = found.at[static_cast<std::size_t>(i)].arm_a;
    const bool there = std::ranges::any_of(roots, [&](const std::array<double, 2>& r) {
      return std::hypot(r[0] - p[0], r[1] - p[1]) < 1e-6 * size;
    });
    wrong = wrong || !there;
  }
  if (wrong) ++tally.gsl_wrong, print("GSL", pair);
}

void compare_numbers(const RawPair& pair, const Family& family, Tally& tally) {
  const Ellipse a = to_ellipse(pair.a), b = to_ellipse(pair.b);
  const double size = length(pair);
  ++tally.numbers;
  const Crossings found = crossings(a, b);
  tally.place =
      std::max(tally.place, distance(found, ellipse_crossings(pair.a, pair.b)) / (kU * size));
  compare_with_gsl(pair, found, tally);

  const Real true_area = tangency::verify::common_area(pair.a, pair.b);
  const double area = common_area(a, b);
  const Real off = abs(Real(area) - true_area);
  const double relative = true_area == 0 ? area : static_cast<double>(Real(off / true_area));
  tally.area = std::max(tally.area, relative);
  if (!(relative <= family.area_error)) ++tally.violated, print("AREA", pair);

  const PlaneGap gap = signed_gap(a, b);
  const double error =
      static_cast<double>(abs(Real(gap.gap) - tangency::verify::plane_gap(pair.a, pair.b)));
  tally.gap = std::max(tally.gap, error / (kU * size));
  tally.gap_error = std::max(tally.gap_error, gap.gap_error / (kU * size));
  if (gap.status != GapStatus::ok) {
    ++tally.local;
  } else if (!(error <= gap.gap_error + kOracle * size)) {
    ++tally.violated, print("GAP", pair);
  }
}

void compare(const RawPair& pair, Tally& tally) {
  const Ellipse a = to_ellipse(pair.a), b = to_ellipse(pair.b);
  const EllipseRelation found = relation(a, b);
  const auto truth = tangency::verify::exact_ellipse_relation(pair.a, pair.b);
  ++tally.pairs;
  ++tally.crossings[static_cast<std::size_t>(found.crossings.value_or(5))];
  if (found.tier == tangency::Tier::filter) ++tally.filtered;
  if (!agrees(a, b, found, truth)) ++tally.wrong, print("DISAGREE", pair);
  if (exchange_changes(a, b)) ++tally.unequal, print("EXCHANGE", pair);
}

Tally run(const Family& family, std::uint64_t seed, double share, long numbers) {
  Tally tally;
  Sampler sampler(seed);
  const long count = std::max(1L, std::lround(static_cast<double>(family.count) * share));
  for (long i = 0; i < count; ++i) {
    const RawPair pair = family.next(sampler);
    compare(pair, tally);
    if (i < numbers) compare_numbers(pair, family, tally);
  }
  return tally;
}

bool agree(std::uint64_t seed, double share, long numbers) {
  constexpr double kPromised = 1e-13;
  const std::vector<Family> families{
      {"random", random_pair, 100'000, kPromised},
      {"tangent", tangent_pair, 10'000, kPromised},
      {"osculating", osculating_pair, 10'000, kPromised},
      {"four crossings", four_crossing_pair, 10'000, kPromised},
      {"concentric", concentric_pair, 10'000, kPromised},
      {"equal, or nearly", equal_pair, 10'000, kPromised},
      {"circles", circle_pair, 10'000, kPromised},
      {"near a touch", near_touch_pair, 10'000, kPromised},
      {"extreme", extreme_pair, 10'000, kPromised},
  };
  std::printf("%-17s %7s %5s %8s %-33s %5s %7s %8s %8s %8s %8s %5s %8s %9s\n", "family", "pairs",
              "wrong", "filter %", "crossings 0 1 2 3 4 and equal", "exch.", "numbers", "place/uL",
              "area", "gap/uL", "bound/uL", "local", "violated", "GSL wrong");
  bool fine = true;
  for (const Family& family : families) {
    const Tally t = run(family, seed, share, numbers);
    const auto& c = t.crossings;
    std::printf(
        "%-17s %7ld %5ld %8.3f %5ld %5ld %5ld %5ld %5ld %5ld %5ld %7ld %8.2g %8.2g %8.2g "
        "%8.2g %5ld %8ld %4ld/%ld\n",
        family.name, t.pairs, t.wrong,
        100.0 * static_cast<double>(t.filtered) / static_cast<double>(t.pairs), c[0], c[1], c[2],
        c[3], c[4], c[5], t.unequal, t.numbers, t.place, t.area, t.gap, t.gap_error, t.local,
        t.violated, t.gsl_wrong, t.gsl);
    std::fflush(stdout);
    fine = fine && t.wrong == 0 && t.unequal == 0 && t.violated == 0 && t.gsl_wrong == 0;
  }
  return fine;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "ellipse_agreement",
      "Hold relation, crossings, area and gap of ellipses against the oracles");
  double share = 1;
  long numbers = 1000;
  program.option("--share", share, "of 100,000 random pairs, and 10,000 of each other family");
  program.option("--numbers", numbers,
                 "pairs of each family whose area, crossings and gap are held "
                 "against high precision");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, share, numbers); });
}
