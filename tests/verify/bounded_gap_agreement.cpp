// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the enclosure of bounded_gap() against signed_gap() on as many deep pairs as asked for, and
// against the 100-digit oracle on some of them. The merge gate runs a part of it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <thread>
#include <vector>

#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace {

using tangency::BoundedGap;
using tangency::Ellipsoid;
using tangency::Gap;
using tangency::GapStatus;
using tangency::verify::DeepFamily;
using tangency::verify::EllipsoidPair;
using tangency::verify::Real;

constexpr long kChunk = 1000;  // pairs of one seed

struct Tally {
  long pairs = 0, ok = 0, broken = 0, judged = 0, missed = 0;
  double share = 0;  // of `above` in the depth, summed

  void add(const Tally& other) {
    pairs += other.pairs, ok += other.ok, broken += other.broken, judged += other.judged;
    missed += other.missed, share += other.share;
  }
};

void print_row(const EllipsoidPair& pair) {
  for (const auto* body : {&pair.a, &pair.b}) {
    for (const auto* numbers : {body->centre.data(), body->semi_axes.data()})
      std::printf("%a,%a,%a,", numbers[0], numbers[1], numbers[2]);
    for (const double x : body->orientation) std::printf("%a,", x);
  }
  std::printf("\n");
}

void judge(const EllipsoidPair& pair, bool by_oracle, Tally& tally) {
  const Ellipsoid a = tangency::verify::to_ellipsoid(pair.a);
  const Ellipsoid b = tangency::verify::to_ellipsoid(pair.b);
  const BoundedGap found = bounded_gap(a, b);
  const Gap searched = signed_gap(a, b);
  const Real low = Real(found.gap) - found.gap_error, high = Real(found.gap) + found.above;
  const Real least = Real(searched.gap) - searched.gap_error;  // of any branch
  bool broken = !(least <= high);                              // also of a NaN
  if (searched.status == GapStatus::ok)
    broken = broken || !(Real(searched.gap) + searched.gap_error >= low);
  if (by_oracle) {
    const auto truth = tangency::verify::signed_gap(pair.a, pair.b);
    broken = broken || !(truth.gap <= high && truth.gap + Real(truth.unproven) >= low);
    ++tally.judged;
  }
  ++tally.pairs;
  tally.ok += found.status == GapStatus::ok;
  tally.missed += searched.gap - searched.gap_error > found.gap + 1e-9 * std::abs(found.gap);
  tally.share += found.above / std::max(std::abs(found.gap), 1e-300);
  if (!broken) return;
  if (++tally.broken <= 5) print_row(pair);
}

bool agree(std::uint64_t seed, long count, long judged) {
  std::printf("%-32s %9s %9s %7s %9s %8s %10s\n", "family", "pairs", "by oracle", "ok %",
              "missed %", "broken", "mean above");
  bool kept = true;
  for (const DeepFamily& family : tangency::verify::deep_families()) {
    Tally all;
    std::mutex adding;
    const auto parts = static_cast<std::size_t>((count + kChunk - 1) / kChunk);
    tangency::testing::for_each_part(
        std::max(1U, std::thread::hardware_concurrency()), parts, [&](std::size_t part) {
          tangency::verify::DeepPairs source(family, seed + part);
          Tally some;
          const long first = static_cast<long>(part) * kChunk;
          for (long i = first; i < std::min(count, first + kChunk); ++i)
            judge(source.next(), i < judged, some);
          const std::scoped_lock lock(adding);
          all.add(some);
        });
    const auto pairs = static_cast<double>(all.pairs);
    std::printf("%-32s %9ld %9ld %7.2f %9.2f %8ld %10.2e\n", family.name.c_str(), all.pairs,
                all.judged, 100.0 * static_cast<double>(all.ok) / pairs,
                100.0 * static_cast<double>(all.missed) / pairs, all.broken, all.share / pairs);
    std::fflush(stdout);
    kept = kept && all.broken == 0;
  }
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "bounded_gap_agreement",
      "Hold the enclosure of bounded_gap against the search and the oracle");
  long count = 100'000, judged = 500;
  program.option("--count", count, "pairs of each family");
  program.option("--judged", judged, "of them by the oracle too");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, count, judged); });
}
