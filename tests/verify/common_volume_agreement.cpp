// SPDX-License-Identifier: GPL-3.0-or-later
// Holds common volumes and their gradients against the oracle, family by family, with the bounds
// that the answers give for themselves. The merge gate runs a part of it.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <ratio>
#include <string>
#include <thread>
#include <vector>

#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/common_volume.hpp>

namespace {

using namespace tangency;
using verify::Draw;
using verify::EllipsoidPair;
using verify::RawEllipsoid;
using verify::Real;

std::array<double, 3> axes(Draw& draw, double aspect) {
  const double size = draw.log_uniform(0.5, 2);
  const double ratio = aspect > 1 ? draw.log_uniform(1, aspect) : 1;
  std::array<double, 3> a{size, ratio > 1 ? size / draw.log_uniform(1, ratio) : size, size / ratio};
  const int kind = draw.integer(0, 5);
  if (kind == 0) a[1] = a[0];
  if (kind == 1) a[1] = a[2];
  if (kind == 2) a[1] = a[2] * (1 + 0x1p-40);
  draw.shuffle(a);
  return a;
}

Vec3 direction(Draw& draw) {
  for (;;) {
    Vec3 n;
    for (int k = 0; k < 3; ++k) n[k] = draw.real(-1, 1);
    if (draw.integer(0, 7) == 0) n = Vec3::Unit(draw.integer(0, 2));
    if (n.norm() > 0.01) return n.normalized();
  }
}

/// How bodies of a family are drawn, and how deep they lie in each other.
struct Family {
  const char* name;
  double aspect;
  enum Place { any, thin, nested, coaxial, concentric } place;
  double scale = 1, origin = 0, size_ratio = 1;
};
constexpr std::array<Family, 13> kFamilies{{
    {"spheres", 1, Family::any},
    {"moderate", 5, Family::any},
    {"size ratio 1e4", 5, Family::any, 1, 0, 1e4},
    {"aspect 1e4", 1e4, Family::any},
    {"aspect 1e8", 1e8, Family::any},
    {"lenses to 1e-12", 10, Family::thin},
    {"nearly nested", 10, Family::nested},
    {"coaxial", 20, Family::coaxial},
    {"concentric", 20, Family::concentric},
    {"scale 1e100", 5, Family::any, 1e100},
    {"scale 1e-100", 5, Family::any, 1e-100},
    {"far origin", 5, Family::any, 1, 1e9},
    {"nested, far, size ratio", 5, Family::nested, 1, 1e3, 30},
}};

EllipsoidPair drawn(Draw& draw, const Family& f) {
  std::array<double, 3> a = axes(draw, f.aspect), b = axes(draw, f.aspect);
  const double ratio = f.size_ratio > 1 ? draw.log_uniform(1 / f.size_ratio, f.size_ratio) : 1;
  for (double& axis : b) axis *= ratio;
  std::array<double, 4> qa = draw.orientation(), qb = draw.orientation();
  if (f.place == Family::coaxial) {
    qa = qb = {1, 0, 0, 0};
    if (draw.coin()) a[0] = a[1];
    if (draw.coin()) b[0] = b[1];
  }
  const int turn = draw.integer(0, 9);
  if (turn == 0) qb = qa;
  const Vec3 n = direction(draw);
  const Ellipsoid at_a = verify::to_ellipsoid({{0, 0, 0}, a, qa});
  Ellipsoid at_b = verify::to_ellipsoid({{0, 0, 0}, b, qb});
  Vec3 d = Vec3::Zero();
  double away = draw.real(0, 1);
  if (f.place == Family::thin) away = 1 - draw.log_uniform(1e-12, 1e-1);
  d = away * (at_a.support_point(n) + at_b.support_point(n));
  if (f.place == Family::coaxial) d = away * Vec3(0, 0, a[2] + b[2]);
  if (f.place == Family::concentric) {
    d = Vec3::Zero();
    if (draw.coin()) d = draw.log_uniform(1e-18, 1e-2) * n;
    // A common axis of one length: the surfaces touch where they cross.
    const auto same = static_cast<std::size_t>(draw.integer(0, 2));
    if (draw.coin()) qb = qa, b[same] = a[same];
    if (draw.integer(0, 3) == 0) b = a;
  }
  if (f.place == Family::nested) {
    // B fills A up to a hair and sticks out by one, on the side of n.
    const double fill = draw.real(0.05, 0.98), out = draw.log_uniform(1e-15, 1e-2);
    double most = 1e300;
    for (int k = 0; k < 3; ++k) most = std::min(most, a[static_cast<std::size_t>(k)]);
    const double largest = *std::max_element(b.begin(), b.end());
    for (double& axis : b) axis *= fill * most * most / largest / at_a.largest_semi_axis();
    at_b = verify::to_ellipsoid({{0, 0, 0}, b, qb});
    d = (1 + out) * at_a.support_point(n) - at_b.support_point(n);
  }
  EllipsoidPair pair{{{0, 0, 0}, a, qa}, {{0, 0, 0}, b, qb}};
  const Vec3 from = f.origin * direction(draw);
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    pair.a.centre[i] = f.scale * from[k], pair.b.centre[i] = f.scale * (from[k] + d[k]);
    pair.a.semi_axes[i] *= f.scale, pair.b.semi_axes[i] *= f.scale;
  }
  return pair;
}

struct Tally {
  long pairs = 0, overlaps = 0, wrong = 0, not_reached = 0;
  double share_volume = 0, share_gradient = 0;  ///< error over its bound, at most
  double volume_error = 0;                      ///< bound over the smaller volume, at most
  double relative = 0;                          ///< bound over the common volume, at most
  double gradient_error = 0;
  std::vector<double> microseconds;
};

double over(const Real& error, double bound) {
  if (error == 0) return 0.0;
  return bound > 0.0 ? static_cast<double>(Real(error / bound))
                     : std::numeric_limits<double>::infinity();
}

void see(Tally& tally, const EllipsoidPair& pair, double tolerance) {
  const Ellipsoid a = verify::to_ellipsoid(pair.a), b = verify::to_ellipsoid(pair.b);
  const auto start = std::chrono::steady_clock::now();
  const CommonVolume found = common_volume(a, b, tolerance);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  ++tally.pairs;
  const verify::CommonVolumeTruth truth = verify::common_volume(pair.a, pair.b);
  Real square = 0, size = 1, other = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real off = found.gradient[static_cast<int>(k)] - truth.gradient[k];
    square += off * off, size *= pair.a.semi_axes[k], other *= pair.b.semi_axes[k];
  }
  const Ellipsoid& smaller = size < other ? a : b;
  const Real volume = std::min(size, other) * Real(4) / 3 * acos(Real(-1));
  // Of the oracle itself.
  const Real of_oracle = Real(1e-19) * volume;
  const double share = over(abs(Real(found.volume) - truth.volume), found.volume_error);
  const double share_gradient = over(Real(sqrt(square)), found.gradient_error);
  const bool overlap = found.volume_error > 0 && found.gradient_error > 0;
  const bool kept = (share <= 1.0 || abs(Real(found.volume) - truth.volume) <= of_oracle) &&
                    (share_gradient <= 1.0 || (!overlap && square <= of_oracle * of_oracle));
  if (!kept && tally.wrong < 3) {
    std::printf("  wrong: %.17g +- %.3g is %.17g, gradient off by %.3g +- %.3g\n", found.volume,
                found.volume_error, static_cast<double>(truth.volume),
                static_cast<double>(Real(sqrt(square))), found.gradient_error);
  }
  tally.wrong += !kept;
  if (!overlap) return;
  ++tally.overlaps;
  tally.not_reached += found.status != CommonVolumeStatus::ok;
  tally.share_volume = std::max(tally.share_volume, share);
  tally.share_gradient = std::max(tally.share_gradient, share_gradient);
  tally.volume_error =
      std::max(tally.volume_error, over(Real(found.volume_error), static_cast<double>(volume)));
  if (found.volume > 0.0)
    tally.relative = std::max(tally.relative, found.volume_error / found.volume);
  const Vec3& r = smaller.semi_axes();
  const double face = 3.14159 * std::max({r[0] * r[1], r[1] * r[2], r[2] * r[0]});
  tally.gradient_error = std::max(tally.gradient_error, found.gradient_error / face);
  tally.microseconds.push_back(took.count());
}

bool agree(std::uint64_t seed, long count, double tolerance, const std::string& only) {
  std::printf("%-24s %7s %8s %6s %8s %9s %9s %9s %9s %9s %7s %7s\n", "family", "pairs", "overlaps",
              "wrong", "not ok", "err/bound", "grad./b.", "bound/V_s", "bound/V", "grad.b.", "us",
              "us max");
  bool kept = true;
  for (const Family& family : kFamilies) {
    if (!only.empty() && only != family.name) continue;
    constexpr unsigned parts = 2;  // of one seed each, whatever the machine has
    const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    std::vector<Tally> tallies(parts);
    tangency::testing::for_each_part(threads, parts, [&](std::size_t part) {
      Draw draw(seed * 1000 + static_cast<std::uint64_t>(&family - kFamilies.data()) * 10 + part);
      const long share = count / parts + (part == 0 ? count % parts : 0);
      for (long i = 0; i < share; ++i) see(tallies[part], drawn(draw, family), tolerance);
    });
    Tally all;
    for (const Tally& t : tallies) {
      all.pairs += t.pairs, all.overlaps += t.overlaps, all.wrong += t.wrong;
      all.not_reached += t.not_reached;
      all.share_volume = std::max(all.share_volume, t.share_volume);
      all.share_gradient = std::max(all.share_gradient, t.share_gradient);
      all.volume_error = std::max(all.volume_error, t.volume_error);
      all.relative = std::max(all.relative, t.relative);
      all.gradient_error = std::max(all.gradient_error, t.gradient_error);
      all.microseconds.insert(all.microseconds.end(), t.microseconds.begin(), t.microseconds.end());
    }
    std::sort(all.microseconds.begin(), all.microseconds.end());
    const double median =
        all.microseconds.empty() ? 0 : all.microseconds[all.microseconds.size() / 2];
    const double most = all.microseconds.empty() ? 0 : all.microseconds.back();
    std::printf("%-24s %7ld %8ld %6ld %8ld %9.2g %9.2g %9.2g %9.2g %9.2g %7.1f %7.0f\n",
                family.name, all.pairs, all.overlaps, all.wrong, all.not_reached, all.share_volume,
                all.share_gradient, all.volume_error, all.relative, all.gradient_error, median,
                most);
    std::fflush(stdout);
    kept = kept && all.wrong == 0 && all.overlaps > 0;
  }
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "common_volume_agreement",
      "Hold common volumes and their gradients against the oracle, within the bounds they give");
  long count = 5'000;
  double tolerance = kCommonVolumeTolerance;
  std::string only;
  program.option("--count", count, "pairs of each family");
  program.option("--tolerance", tolerance, "asked of the volumes");
  program.option("--only", only, "one family");
  return program.run(argc, argv,
                     [&](std::uint64_t seed) { return agree(seed, count, tolerance, only); });
}
