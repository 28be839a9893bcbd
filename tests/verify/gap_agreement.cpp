// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the kernel's gap, its certificate and its bounds on normal and points against the 100-digit
// oracle, family by family. The merge gate runs a part of it; docs/testing.md names the whole.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <tangency/geometry/gap.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/primitives.hpp>

namespace {

using tangency::ContactBounds;
using tangency::Ellipsoid;
using tangency::Gap;
using tangency::GapStatus;
using tangency::Vec3;
using tangency::verify::Draw;
using tangency::verify::EllipsoidPair;
using tangency::verify::GapTruth;
using tangency::verify::Real;
using tangency::verify::Real3;
using tangency::verify::Sequence;

constexpr double kU = tangency::kUnitRoundoff;

/// What is promised of a family.
struct Limits {
  double error_near = 4, error_far = 8;  ///< of gap, in u L
  double gap_error = 100;                ///< in u L, on every `ok`
  double local_share = 0;
};

struct Tally {
  long pairs = 0, ok = 0, local = 0, failed = 0;
  long wrong_local = 0;  ///< `local` answers that were not the global one
  long violated = 0;     ///< certificates, signs, and `ok` that is not global
  long outside = 0;      ///< normals and points beyond their bounds
  long open = 0;         ///< pairs whose truth the oracle does not prove
  double error_near = 0, error_far = 0, gap_error = 0;
  long tiers[5] = {};

  void add(const Tally& other) {
    pairs += other.pairs, ok += other.ok, local += other.local, failed += other.failed;
    wrong_local += other.wrong_local, violated += other.violated, outside += other.outside;
    open += other.open;
    error_near = std::max(error_near, other.error_near);
    error_far = std::max(error_far, other.error_far);
    gap_error = std::max(gap_error, other.gap_error);
    for (std::size_t i = 0; i < 5; ++i) tiers[i] += other.tiers[i];
  }
};

std::mutex printing;

void print_pair(const char* what, const std::string& family, const EllipsoidPair& pair,
                const Gap& gap, const GapTruth& truth) {
  const std::lock_guard lock(printing);
  std::printf("%s, %s: gap %a +- %a, true %.17g: ", what, family.c_str(), gap.gap, gap.gap_error,
              truth.gap.convert_to<double>());
  for (const auto* e : {&pair.a, &pair.b}) {
    for (const double x : e->centre) std::printf("%a,", x);
    for (const double x : e->semi_axes) std::printf("%a,", x);
    for (const double x : e->orientation) std::printf("%a,", x);
  }
  std::printf("\n");
}

double distance(const Vec3& v, const Real3& w) {
  Real square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real c = Real(v[static_cast<int>(i)]) - w[i];
    square += c * c;
  }
  return sqrt(square).convert_to<double>();
}

void compare(const EllipsoidPair& pair, const GapTruth& truth, const std::string& family,
             const Limits& limits, Tally& tally) {
  const Ellipsoid a = tangency::verify::to_ellipsoid(pair.a);
  const Ellipsoid b = tangency::verify::to_ellipsoid(pair.b);
  const Gap gap = signed_gap(a, b);
  const double axes = a.largest_semi_axis() + b.largest_semi_axis();
  const double size = (b.centre() - a.centre()).stableNorm() + axes;
  ++tally.pairs;
  ++tally.tiers[static_cast<int>(gap.tier)];
  tally.failed += !std::isfinite(gap.gap) || !std::isfinite(gap.gap_error);
  const double error = abs(truth.gap - Real(gap.gap)).convert_to<double>();
  const bool same_sign = (gap.gap > 0) == (truth.gap > 0) && (gap.gap < 0) == (truth.gap < 0);
  bool holds = same_sign && Real(gap.gap) - Real(gap.gap_error) <= truth.gap;
  if (!truth.global) ++tally.open;
  if (gap.status == GapStatus::local) {
    ++tally.local;
    tally.wrong_local += error > 100 * kU * size;
  } else {
    ++tally.ok;
    // Where the oracle has proven less than the kernel, it still knows an upper bound.
    const Real above = Real(gap.gap) - truth.gap;
    holds = holds && (truth.global ? error <= gap.gap_error
                                   : above <= Real(truth.unproven) + Real(gap.gap_error));
    const bool far = gap.gap > axes;
    double& worst = far ? tally.error_far : tally.error_near;
    if (truth.global) {
      worst = std::max(worst, error / (kU * size));
      if (error > (far ? limits.error_far : limits.error_near) * kU * size)
        print_pair("INACCURATE", family, pair, gap, truth);
    }
    tally.gap_error = std::max(tally.gap_error, gap.gap_error / (kU * size));
    const ContactBounds bounds = contact_bounds(a, b, gap);
    const bool inside = distance(gap.normal, truth.normal) <= bounds.normal &&
                        distance(gap.arm_a, truth.arm_a) <= bounds.arm_a &&
                        distance(gap.arm_b, truth.arm_b) <= bounds.arm_b;
    // Where two normals tie there is no one true normal: gap.hpp.
    const bool tie =
        truth.gap < 0 && truth.global && !inside && !a.is_sphere() && !b.is_sphere() &&
        tangency::verify::highest_gaps(tangency::verify::real(pair.a),
                                       tangency::verify::real(pair.b), 2 * gap.gap_error)
                .size() > 1;
    if (!inside && !tie) ++tally.outside, print_pair("OUTSIDE", family, pair, gap, truth);
  }
  if (!holds) ++tally.violated, print_pair("VIOLATED", family, pair, gap, truth);
}

struct Family {
  std::string name;
  std::uint64_t index = 0;  ///< among all, so that a family's pairs do not depend on --only
  Limits limits;
  std::function<void(std::uint64_t seed, long count, Tally& tally)> run;
};

/// The pairs of a kind, held against `truth_of` each.
template <class Kind>
Family make_family(const Kind& kind, const Limits& limits,
                   const std::function<GapTruth(const EllipsoidPair&)>& truth_of) {
  return {kind.name, 0, limits,
          [kind, limits, truth_of](std::uint64_t seed, long count, Tally& tally) {
            Sequence pairs(kind, seed);
            for (long i = 0; i < count; ++i) {
              const EllipsoidPair pair = pairs.next();
              compare(pair, truth_of(pair), kind.name, limits, tally);
            }
          }};
}

GapTruth truth_of_any(const EllipsoidPair& pair) {
  return tangency::verify::signed_gap(pair.a, pair.b);
}

/// A thin body whose flat face a round body touches, lies in or is inside of: where rounding the
/// normal moves a support point most, and curvatures are products of a small and a large number.
struct FaceFamily {
  std::string name;
  double least_aspect, largest_aspect;
  bool sphere;  ///< is the round body one?
};

EllipsoidPair drawn(Draw& draw, const FaceFamily& family) {
  EllipsoidPair pair{};
  const double thin = 1 / draw.log_uniform(family.least_aspect, family.largest_aspect);
  const auto across = static_cast<std::size_t>(draw.integer(0, 2));
  for (std::size_t k = 0; k < 3; ++k) pair.a.semi_axes[k] = k == across ? thin : draw.real(0.3, 1);
  for (auto* body : {&pair.a, &pair.b}) {
    for (double& q : body->orientation) q = draw.real(-1, 1);
  }
  pair.a.centre = {0, 0, 0};
  const double radius = draw.log_uniform(1e-3, 10);
  pair.b.semi_axes = {radius, radius, radius};
  if (!family.sphere) {
    // From the neighbouring double to twice as long.
    const double longer = draw.coin() ? draw.real(1, 2) : 1 + draw.log_uniform(0x1p-52, 0.1);
    for (int i = 0; i < 2; ++i) {
      pair.b.semi_axes[static_cast<std::size_t>(draw.integer(0, 2))] *= longer;
    }
  }
  const Ellipsoid a = tangency::verify::to_ellipsoid(pair.a);
  const Vec3 n = a.rotation().col(static_cast<int>(across));
  const double reach = tangency::verify::to_ellipsoid(pair.b).support(n);
  // Apart or overlapping by 1e-18 to 0.1 of the radius; a sphere at any depth as well.
  const double off = radius * draw.log_uniform(1e-18, 0.1);
  double height = draw.coin() ? reach + off : reach - off;
  if (family.sphere && draw.integer(0, 3) == 0) height = reach * draw.real(-1, 1);
  Vec3 centre = height * n;
  for (int k = 0; k < 3; ++k) {
    if (k != static_cast<int>(across))
      centre += 0.7 * draw.real(-1, 1) * a.semi_axes()[k] * a.rotation().col(k);
  }
  pair.b.centre = {centre[0], centre[1], centre[2]};
  if (draw.coin()) std::swap(pair.a, pair.b);
  return pair;
}

/// By the oracle of closest points, at any aspect.
GapTruth truth_of_sphere(const EllipsoidPair& pair) {
  const auto is_sphere = [](const tangency::verify::RawEllipsoid& e) {
    return e.semi_axes[0] == e.semi_axes[1] && e.semi_axes[1] == e.semi_axes[2];
  };
  const bool sphere_is_a = is_sphere(pair.a);
  const auto &sphere = sphere_is_a ? pair.a : pair.b, &body = sphere_is_a ? pair.b : pair.a;
  const auto found =
      tangency::verify::nearest(body, tangency::verify::from_centre(body, sphere.centre));
  GapTruth truth{Real(found.distance) - sphere.semi_axes[0], {}, {}, {}, true, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Real n = sphere_is_a ? -Real(found.normal[i]) : Real(found.normal[i]);
    const Real round = (sphere_is_a ? 1 : -1) * (sphere.semi_axes[0] * n);
    truth.normal[i] = n;
    truth.arm_a[i] = sphere_is_a ? round : Real(found.point[i]);
    truth.arm_b[i] = sphere_is_a ? Real(found.point[i]) : round;
  }
  return truth;
}

std::vector<Family> make_families() {
  std::vector<Family> families;
  for (const auto& kind : tangency::verify::extreme_families()) {
    Limits limits;
    if (kind.aspect <= 100) limits.gap_error = tangency::kOrdinaryGapErrorBound;
    // Rounding a centre may push bodies of aspect 1e8 deep into each other, deeper the further away
    // it is; measured: the search over all normals does not finish for so many of them.
    if (kind.aspect > 1e6) limits.local_share = kind.origin > 0 ? 0.15 : 0.02;
    families.push_back(make_family(kind, limits, truth_of_any));
  }
  for (const auto& kind : tangency::verify::deep_families()) {
    Limits limits;
    if (kind.aspect <= 100) limits.gap_error = tangency::kOrdinaryGapErrorBound;
    if (kind.aspect > 5 || kind.within == 0) limits.local_share = 0.01;
    if (kind.aspect > 20) limits.local_share = 1;
    families.push_back(make_family(kind, limits, truth_of_any));
  }
  const FaceFamily faces[] = {{"faces on spheres, to 1e15", 1e9, 1e15, true},
                              {"faces on spheres, 1e15 to 1e18", 1e15, 1e18, true},
                              {"faces on spheres, 1e18 to 1e300", 1e18, 1e300, true},
                              {"faces on round bodies, to 1e15", 1e9, 1e15, false},
                              {"faces on round bodies, to 1e18", 1e15, 1e18, false}};
  for (const FaceFamily& kind : faces) {
    Limits limits;
    if (!kind.sphere) limits.local_share = kind.largest_aspect > 1e15 ? 1 : 0.02;
    families.push_back(make_family(kind, limits, kind.sphere ? truth_of_sphere : truth_of_any));
  }
  return families;
}

bool keeps(const Family& family, const Tally& t) {
  const Limits& limits = family.limits;
  return t.failed == 0 && t.violated == 0 && t.outside == 0 && t.error_near <= limits.error_near &&
         t.error_far <= limits.error_far && t.gap_error <= limits.gap_error &&
         static_cast<double>(t.local) <= limits.local_share * static_cast<double>(t.pairs);
}

void print(const Family& family, const Tally& t) {
  std::printf(
      "%-34s %6ld %5ld %5ld %4ld %4ld %4ld %4ld %8.2f %8.2f %9.2f   %ld/%ld/%ld/%ld/%ld%s\n",
      family.name.c_str(), t.pairs, t.local, t.wrong_local, t.failed, t.violated, t.outside, t.open,
      t.error_near, t.error_far, t.gap_error, t.tiers[0], t.tiers[1], t.tiers[2], t.tiers[3],
      t.tiers[4], keeps(family, t) ? "" : "   BROKEN");
}

bool agree(std::uint64_t seed, long count, unsigned threads, const std::string& only) {
  std::vector<Family> families = make_families();
  for (std::uint64_t i = 0; Family & family : families) family.index = i++;
  std::erase_if(families, [&](const Family& f) { return f.name.find(only) == std::string::npos; });
  constexpr long kPart = 100;
  const long parts = (count + kPart - 1) / kPart;
  std::vector<Tally> total(families.size());
  std::mutex adding;
  const std::size_t jobs = families.size() * static_cast<std::size_t>(parts);
  tangency::testing::for_each_part(threads, jobs, [&](std::size_t job) {
    const std::size_t f = job / static_cast<std::size_t>(parts);
    const long part = static_cast<long>(job % static_cast<std::size_t>(parts));
    Tally tally;
    families[f].run(seed + 1'000'000 * families[f].index + static_cast<std::uint64_t>(part),
                    std::min(kPart, count - part * kPart), tally);
    const std::lock_guard lock(adding);
    total[f].add(tally);
  });

  std::printf(
      "errors in u L; tiers fast/safeguarded/factored/search/exact\n%-34s %6s %5s %5s "
      "%4s %4s %4s %4s %8s %8s %9s   tiers\n",
      "family", "pairs", "local", "wrong", "fail", "viol", "outs", "open", "near", "far",
      "gap_error");
  bool all = !families.empty();
  for (std::size_t f = 0; f < families.size(); ++f) {
    print(families[f], total[f]);
    all = all && keeps(families[f], total[f]) && total[f].pairs == count;
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program("gap_agreement",
                                              "Holds signed_gap against the 100-digit oracle");
  long count = 5000;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string only;
  program.option("--per-family", count, "pairs of each family");
  program.option("--threads", threads);
  program.option("--only", only, "families whose name contains this");
  return program.run(argc, argv,
                     [&](std::uint64_t seed) { return agree(seed, count, threads, only); });
}
