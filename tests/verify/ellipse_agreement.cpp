// SPDX-License-Identifier: GPL-3.0-or-later
// Holds what the kernel says of two ellipses against the oracles, family by family: relation,
// crossings and their multiplicities exactly; their places, the common area and the gap in numbers;
// and everything against the same pair exchanged. The merge gate runs a part of it; docs/testing.md
// names the whole.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/oracles/ellipse.hpp>

namespace {

using tangency::Crossings;
using tangency::Ellipse;
using tangency::EllipseRelation;
using tangency::GapStatus;
using tangency::PlaneGap;
using tangency::Vec2;
using tangency::verify::EllipsePair;
using tangency::verify::RawEllipse;
using tangency::verify::Real;
using tangency::verify::Real2;

constexpr double kU = tangency::kUnitRoundoff;
constexpr double kOracle = 1e-40;  // of the size: where the oracle's ascents end

Ellipse to_ellipse(const RawEllipse& e) {
  return {{e.centre[0], e.centre[1]},
          {e.semi_axes[0], e.semi_axes[1]},
          {e.direction[0], e.direction[1]}};
}

using Family = tangency::verify::InputFamily<EllipsePair>;

constexpr double kAreaError = 1e-13;    // promised, relative
constexpr double kExtremeAspect = 1e8;  // beyond the corpus
constexpr double kPairs = 10'000;       // of each family for the exact answers
constexpr double kPairsOfRandom = 100'000;

struct Tally {
  long pairs = 0, wrong = 0, filtered = 0, numbers = 0, unequal = 0, local = 0, violated = 0;
  long gsl = 0, gsl_wrong = 0;
  std::array<long, 6> crossings{};  ///< of 0 to 4, and equal
  double place = 0, area = 0, gap = 0, gap_error = 0;
};

void print(const char* what, const EllipsePair& pair) {
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

double length(const EllipsePair& p) {
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
void compare_with_gsl(const EllipsePair& pair, const Crossings& found, Tally& tally) {
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

void compare_numbers(const EllipsePair& pair, Tally& tally) {
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
  if (!(relative <= kAreaError)) ++tally.violated, print("AREA", pair);

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

void compare(const EllipsePair& pair, Tally& tally) {
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
  const auto next = family.sequence(seed);
  const double whole = family.name == "random" ? kPairsOfRandom : kPairs;
  const long count = std::max(1L, std::lround(whole * share));
  for (long i = 0; i < count; ++i) {
    const EllipsePair pair = next();
    compare(pair, tally);
    if (i < numbers) compare_numbers(pair, tally);
  }
  return tally;
}

bool agree(std::uint64_t seed, double share, long numbers) {
  std::printf("%-17s %7s %5s %8s %-33s %5s %7s %8s %8s %8s %8s %5s %8s %9s\n", "family", "pairs",
              "wrong", "filter %", "crossings 0 1 2 3 4 and equal", "exch.", "numbers", "place/uL",
              "area", "gap/uL", "bound/uL", "local", "violated", "GSL wrong");
  bool fine = true;
  for (const Family& family : tangency::verify::ellipse_families(kExtremeAspect)) {
    const Tally t = run(family, seed, share, numbers);
    const auto& c = t.crossings;
    std::printf(
        "%-17s %7ld %5ld %8.3f %5ld %5ld %5ld %5ld %5ld %5ld %5ld %7ld %8.2g %8.2g %8.2g "
        "%8.2g %5ld %8ld %4ld/%ld\n",
        family.name.c_str(), t.pairs, t.wrong,
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
