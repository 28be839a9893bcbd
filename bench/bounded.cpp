// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of bounded_gap() on deep pairs, pair by pair: the mean, and the slowest of all once each has
// had its chance on a busy machine: the 1,000 slowest are timed again 20 times, and the least is
// taken. Beside it how much shallower the true depth may be, as a share of the depth said, and how
// many answers are `ok`. signed_gap() is timed on some of the same pairs, each once and right after
// bounded_gap(): `ratio` is the mean of the one by that of the other, of these pairs.
//
// Every enclosure is held against signed_gap() on some pairs before a time is believed: where that
// is `ok`, the two have to meet.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ratio>
#include <string>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/timing.hpp>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>

namespace {

using namespace tangency;

constexpr std::size_t kSlowest = 1000;
constexpr int kAgain = 20;
constexpr std::size_t kChecked = 2000;  // of each family, by signed_gap() too

struct Two {
  Ellipsoid a, b;
};

double timed(const Two& pair, BoundedGap& answer) {
  const auto begin = std::chrono::steady_clock::now();
  answer = bounded_gap(pair.a, pair.b);
  benchmark::DoNotOptimize(answer);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

double of_signed_gap(const Two& pair, Gap& answer) {
  const auto begin = std::chrono::steady_clock::now();
  answer = signed_gap(pair.a, pair.b);
  benchmark::DoNotOptimize(answer);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

void require_enclosed(const std::string& family, std::size_t i, const BoundedGap& one,
                      const Gap& other) {
  const double low = one.gap - one.gap_error, high = one.gap + one.above;
  const bool known = other.status == GapStatus::ok;
  // The true gap is at least that of any branch.
  if (other.gap - other.gap_error <= high && (!known || other.gap + other.gap_error >= low)) return;
  std::fprintf(stderr, "%s: pair %zu: [%.17g, %.17g], and signed_gap() says %.17g: no timing\n",
               family.c_str(), i, low, high, other.gap);
  std::exit(1);
}

struct Row {
  double mean = 0, slowest = 0, signed_mean = 0, signed_slowest = 0;
  double checked_mean = 0;  ///< of the pairs that signed_gap() is timed on
  std::size_t ok = 0;
  std::vector<double> shares;
  double share(double part) {
    const auto at = shares.begin() + std::ptrdiff_t(part * static_cast<double>(shares.size() - 1));
    std::nth_element(shares.begin(), at, shares.end());
    return *at;
  }
};

Row measured(const verify::DeepFamily& family, std::size_t count) {
  verify::DeepPairs source(family, bench::kSeed);
  std::vector<Two> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const verify::EllipsoidPair drawn = source.next();
    pairs.push_back({verify::to_ellipsoid(drawn.a), verify::to_ellipsoid(drawn.b)});
  }
  Row row;
  std::vector<double> times(count);
  BoundedGap answer;
  for (std::size_t i = 0; i < count; ++i) {
    times[i] = timed(pairs[i], answer);
    row.mean += times[i] / static_cast<double>(count);
    row.ok += answer.status == GapStatus::ok;
    row.shares.push_back(answer.above / std::max(std::abs(answer.gap), 1e-300));
    if (i >= kChecked) continue;
    Gap other;
    const double taken = of_signed_gap(pairs[i], other);
    const auto checked = static_cast<double>(std::min(count, kChecked));
    row.signed_mean += taken / checked;
    row.checked_mean += times[i] / checked;
    row.signed_slowest = std::max(row.signed_slowest, taken);
    require_enclosed(family.name, i, answer, other);
  }
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  const std::size_t again = std::min(kSlowest, count);
  std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(again), order.end(),
                    [&](std::size_t i, std::size_t j) { return times[i] > times[j]; });
  for (std::size_t k = 0; k < again; ++k) {
    const std::size_t i = order[k];
    for (int n = 0; n < kAgain; ++n) times[i] = std::min(times[i], timed(pairs[i], answer));
    row.slowest = std::max(row.slowest, times[i]);
  }
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::tables::Program program("bench_bounded", "Time bounded_gap() on deep pairs");
  std::size_t asked = 100'000;
  program.option("--count", asked, "pairs of each family")
      .shows_default()
      .between(std::size_t{1}, std::size_t{10'000'000});
  program.runs([&] {
    std::printf("%-32s %9s %9s %9s %9s %7s %7s %9s %9s %9s\n", "ns each, least of the slowest",
                "mean", "slowest", "signed", "slowest", "ratio", "ok %", "above 50%", "90%", "99%");
    for (const verify::DeepFamily& family : verify::deep_families()) {
      Row row = measured(family, asked);
      std::printf("%-32s %9.0f %9.0f %9.0f %9.0f %7.1f %7.2f %9.2e %9.2e %9.2e\n",
                  family.name.c_str(), row.mean, row.slowest, row.signed_mean, row.signed_slowest,
                  row.signed_mean / row.checked_mean,
                  100.0 * static_cast<double>(row.ok) / static_cast<double>(asked), row.share(0.5),
                  row.share(0.9), row.share(0.99));
      std::fflush(stdout);
    }
    return 0;
  });
  return program.run(argc, argv);
}
