// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the batch calls against the single calls on as many pairs as asked for, and against the
// 100-digit oracle on some of them: every instruction set, every Accuracy, cold and followed, in
// every form of the bodies. The merge gate runs a part of it.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <tangency/tests/support/instruction_sets.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/tests/verify/batch_climb.hpp>
#include <tangency/tests/verify/batch_part.hpp>

namespace {

using tangency::testing::batch_families;
using tangency::testing::BatchFamily;
using tangency::testing::Breach;
using tangency::testing::kBreaches;
using tangency::testing::LaneForm;
using tangency::testing::Part;
using tangency::testing::Tally;

// Pairs of one seed: several blocks of the batch, so that parts at a time fit into memory.
constexpr std::size_t kChunk = 500, kPartsAtATime = 64;
// Of families of which only a share is asked for; chosen.
constexpr std::size_t kLeast = 20;

struct Options {
  std::size_t count = 1'000'000, judged = 1000;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string only;
  int steps = 200, sets = 0;
};

class Totals {
 public:
  void add(const Tally& some) {
    const std::scoped_lock lock(adding_);
    all_.add(some);
  }
  const Tally& all() const { return all_; }

 private:
  std::mutex adding_;
  Tally all_;
};

// Parts first to before last: made and asked of single calls once, then of every instruction set.
void run_parts(const BatchFamily& family, std::uint64_t seed, std::size_t first, std::size_t last,
               std::size_t pairs, const Options& options, Totals& totals) {
  std::vector<Part> parts(last - first);
  const auto for_all = [&](const std::function<void(std::size_t, Tally&)>& part) {
    tangency::testing::for_each_part(options.threads, parts.size(), [&](std::size_t k) {
      Tally some;
      part(k, some);
      totals.add(some);
    });
  };
  for_all([&](std::size_t k, Tally& some) {
    const std::size_t begin = (first + k) * kChunk, end = std::min(begin + kChunk, pairs);
    const std::size_t judged = options.judged > begin ? options.judged - begin : 0;
    parts[k] = made_part(family, seed + first + k, end - begin, judged);
    check_singles(parts[k], some);
  });
  int asked = 0;
  tangency::testing::for_each_instruction_set([&](const char* level) {
    if (options.sets > 0 && asked++ >= options.sets) return;
    for_all([&](std::size_t k, Tally& some) { check_part(parts[k], level, first + k, some); });
  });
}

Tally run_family(const BatchFamily& family, std::uint64_t seed, const Options& options) {
  const auto share = static_cast<std::size_t>(family.share * static_cast<double>(options.count));
  const std::size_t pairs = std::max(share, std::min(options.count, kLeast));
  const std::size_t parts = (pairs + kChunk - 1) / kChunk;
  Totals totals;
  for (std::size_t first = 0; first < parts && totals.all().kept(); first += kPartsAtATime) {
    run_parts(family, seed, first, std::min(first + kPartsAtATime, parts), pairs, options, totals);
    std::fprintf(stderr, "%s: %ld of %zu pairs\n", family.name.c_str(), totals.all().pairs, pairs);
  }
  return totals.all();
}

void print_head() {
  std::printf("%-28s %8s %10s %7s", "family", "pairs", "answers", "judged");
  for (std::size_t k = 0; k < kBreaches; ++k)
    std::printf(" %9s", to_string(static_cast<Breach>(k)));
  std::printf(" %7s %8s %9s %7s  %s\n", "branch", "rounding", "tolerance", "single%", "tiers %");
}

void print(const BatchFamily& family, const Tally& t) {
  std::printf("%-28s %8ld %10ld %7ld", family.name.c_str(), t.pairs, t.answers, t.judged);
  for (const long broken : t.breaches) std::printf(" %9ld", broken);
  long all = 0;
  for (const long tier : t.tiers) all += tier;
  const double percent = 100.0 / static_cast<double>(std::max(1L, all));
  std::printf(" %7ld %8.3f %9.3f %7.2f ", t.other_branch, t.rounding.ratio, t.tolerance.ratio,
              percent * static_cast<double>(t.of_single_calls));
  for (const long tier : t.tiers) std::printf(" %.2f", percent * static_cast<double>(tier));
  std::printf("\n");
  std::fflush(stdout);
}

// How near the error comes to gap_error uphill from the pair where it came nearest.
bool climbs(const Tally& tally, std::uint64_t seed, int steps) {
  bool kept = true;
  for (const LaneForm form : {LaneForm::ellipsoids, LaneForm::moving}) {
    const auto top = tangency::testing::climb(tally.rounding.pair, form, steps, seed);
    std::printf("  %s, uphill: %.3f of gap_error at %s\n",
                form == LaneForm::moving ? "moving" : "array", top.ratio,
                tangency::testing::printed(top.pair).c_str());
    kept = kept && top.ratio <= 1;
  }
  return kept;
}

bool agree(std::uint64_t seed, const Options& options) {
  print_head();
  std::uint64_t index = 0;
  for (const BatchFamily& family : batch_families()) {
    const std::uint64_t seed_of_family = seed + 1'000'000'007ULL * ++index;
    if (family.name.find(options.only) == std::string::npos) continue;
    const Tally tally = run_family(family, seed_of_family, options);
    print(family, tally);
    const bool below = options.steps == 0 || tally.rounding.ratio == 0 ||
                       climbs(tally, seed_of_family, options.steps);
    if (tally.kept() && below) continue;
    std::printf("%s: %s\n", family.name.c_str(), tally.first.c_str());
    return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "batch_agreement", "Hold the batch calls against the single calls and the oracle");
  Options options;
  program.option("--per-family", options.count, "pairs of each family, of some a share");
  program.option("--with-oracle", options.judged, "of them by the oracle too");
  program.option("--climb", options.steps, "steps uphill to where gap_error is used most");
  program.option("--sets", options.sets,
                 "instruction sets that are asked, the widest first; 0: all");
  program.option("--threads", options.threads);
  program.option("--only", options.only, "families whose name contains this");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, options); });
}
