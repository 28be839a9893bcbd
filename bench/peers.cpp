// SPDX-License-Identifier: GPL-3.0-or-later
// signed_gap and overlaps beside other codes: wrong answers, errors against the manufactured truth
// and times, in one run and on the same pairs. Every code is asked for its answers, in a process of
// its own, before anything is timed; ours have to be right, those of others are reported.
//
// bench_peers            Google Benchmark's report, then the comparison with Simbody
// bench_peers --table    the tables of docs/peers.md instead
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/bench/instruction_set.hpp>
#include <tangency/bench/peers/isolate.hpp>
#include <tangency/bench/peers/report.hpp>
#include <tangency/bench/yardstick.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace {

using namespace tangency::peers;
using tangency::Ellipsoid;
using tangency::bench::force_level;
using tangency::bench::kInCache;

constexpr std::uint64_t kSeed = 20261122;  // the pairs of bench_gap

struct Family {
  std::string name;
  std::vector<RawEllipsoid> raw_a, raw_b;
  std::vector<Ellipsoid> a, b;
  std::vector<Truth> truth;
  std::vector<Ellipsoid> bodies;  ///< A and B of every pair in turn
  std::vector<tangency::IndexedPair> indices;
  tangency::BodyArray array{{}};  ///< of bodies, whose memory moves with them
};

Family make_family(const tangency::verify::ContactFamily& shape) {
  Family f;
  f.name = shape.name;
  tangency::verify::ManufacturedContacts contacts(shape, kSeed);
  for (std::size_t i = 0; i < kInCache; ++i) {
    const auto c = contacts.next();
    f.raw_a.push_back(c.a);
    f.raw_b.push_back(c.b);
    f.a.push_back(tangency::verify::to_ellipsoid(c.a));
    f.b.push_back(tangency::verify::to_ellipsoid(c.b));
    f.truth.push_back({c.gap, c.smallest_semi_axis});
    f.bodies.insert(f.bodies.end(), {f.a.back(), f.b.back()});
    const auto first = static_cast<std::uint32_t>(2 * i);
    f.indices.push_back({first, first + 1});
  }
  f.array = tangency::BodyArray(f.bodies);
  return f;
}

using Answers = std::vector<std::optional<PeerContact>>;

/// A row, and the names of the two benchmarks that fill in its times.
struct Entry {
  Row row;
  std::string timed, signed_gap;
};

/// Registers a benchmark whose one iteration goes through all pairs, so that the slow ones count
/// in each repetition: the times of a code differ between pairs by more than between codes.
template <class Call>
void add_sweep(const std::string& name, const std::vector<std::size_t>& pairs, const Call& call) {
  tangency::bench::least_of_repetitions(
      benchmark::RegisterBenchmark(name.c_str(), [pairs, call](benchmark::State& state) {
        for (auto _ : state) {
          for (const std::size_t i : pairs) benchmark::DoNotOptimize(call(i));
        }
        state.counters["pairs"] = static_cast<double>(pairs.size());
      })->Unit(benchmark::kNanosecond));
}

void add_signed_gap(const std::string& name, const Family& f,
                    const std::vector<std::size_t>& pairs) {
  add_sweep(name, pairs, [&f](std::size_t i) { return signed_gap(f.a[i], f.b[i]); });
}

std::vector<std::size_t> every_pair() {
  std::vector<std::size_t> pairs(kInCache);
  for (std::size_t i = 0; i < kInCache; ++i) pairs[i] = i;
  return pairs;
}

/// Ends the program where an answer of this library is wrong, by the bounds of bench_gap.
void require_right(const Entry& entry) {
  const Score& s = entry.row.score;
  const double bound = entry.row.family.find('3') == std::string::npos ? 5e-15 : 1e-9;
  if (s.wrong == 0 && s.unanswered == 0 && s.largest < bound) return;
  std::fprintf(stderr, "%s: wrong: no timing\n", entry.timed.c_str());
  std::exit(1);
}

/// @param own  filled with the answers of signed_gap
void add_ours(const Family& f, std::vector<Entry>& entries, Answers& own) {
  Answers yes_or_no;
  for (std::size_t i = 0; i < kInCache; ++i) {
    const auto gap = signed_gap(f.a[i], f.b[i]);
    const bool certain = gap.status == tangency::GapStatus::ok;
    own.push_back(certain ? std::optional(PeerContact{gap.gap < 0, gap.gap, {}, {}})
                          : std::nullopt);
    yes_or_no.push_back(PeerContact{overlaps(f.a[i], f.b[i]), {}, {}, {}});
  }
  const auto add = [&](const char* call, GapOf gap_of, const Answers& answers) {
    Entry entry;
    entry.row.family = f.name;
    entry.row.peer = {"Tangency",   TANGENCY_VERSION,          call,
                      "no options", Definition::common_normal, gap_of};
    entry.row.ours = true;
    entry.row.score = score(answers, f.truth);
    entry.row.ours_there = entry.row.score.largest;
    entry.timed = f.name + "/" + call;
    entry.signed_gap = f.name + "/signed_gap";
    require_right(entry);
    entries.push_back(entry);
  };
  add("signed_gap", GapOf::all, own);
  add("overlaps", GapOf::none, yes_or_no);
  add_signed_gap(f.name + "/signed_gap", f, every_pair());
  add_sweep(f.name + "/overlaps", every_pair(),
            [&f](std::size_t i) { return overlaps(f.a[i], f.b[i]); });
}

/// signed_gaps at each instruction set of the machine that has lanes.
void add_batch(const Family& f, std::vector<Entry>& entries) {
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    if (level == HWY_SCALAR || level == HWY_EMU128) continue;
    const auto gaps = std::make_shared<std::vector<tangency::Gap>>(kInCache);
    force_level(level);
    signed_gaps(f.array, {f.indices, {}}, *gaps);
    force_level(0);
    Answers answers;
    for (const tangency::Gap& gap : *gaps)
      answers.push_back(PeerContact{gap.gap < 0, gap.gap, {}, {}});
    Entry entry;
    entry.row.family = f.name;
    const std::string name = level == HWY_AVX3 ? "AVX-512" : hwy::TargetName(level);
    entry.row.peer = {"Tangency", TANGENCY_VERSION,          kBatchCall,
                      name,       Definition::common_normal, GapOf::all};
    entry.row.ours = true;
    entry.row.score = score(answers, f.truth);
    entry.row.ours_there = entry.row.score.largest;
    entry.timed = f.name + "/" + kBatchCall + "/" + name;
    entry.signed_gap = f.name + "/signed_gap";
    require_right(entry);
    entries.push_back(entry);
    tangency::bench::least_of_repetitions(
        benchmark::RegisterBenchmark(entry.timed.c_str(), [&f, level,
                                                           gaps](benchmark::State& state) {
          force_level(level);
          for (auto _ : state) {
            signed_gaps(f.array, {f.indices, {}}, *gaps);
            benchmark::ClobberMemory();
          }
          force_level(0);
          state.counters["pairs"] = static_cast<double>(kInCache);
        })->Unit(benchmark::kNanosecond));
  }
}

/// @param pairs  filled with what has to live while the benchmarks run
void add_peer(const Family& f, const Peer& peer, const Answers& own, std::vector<Entry>& entries,
              std::vector<std::unique_ptr<PeerPair>>& pairs) {
  for (std::size_t i = 0; i < kInCache; ++i) pairs.push_back(peer.prepare(f.raw_a[i], f.raw_b[i]));
  Entry entry;
  entry.row.family = f.name;
  entry.row.peer = peer.description();
  Answers answers, own_there;
  std::vector<std::size_t> safe;
  const auto isolated = ask_isolated(pairs);
  for (std::size_t i = 0; i < kInCache; ++i) {
    answers.push_back(isolated[i].contact);
    const bool has_gap = answers[i] && answers[i]->gap;
    own_there.push_back(has_gap ? own[i] : std::nullopt);
    const Outcome outcome = isolated[i].outcome;
    if (outcome == Outcome::aborted || outcome == Outcome::hung)
      ++entry.row.ended;
    else
      safe.push_back(i);
  }
  entry.row.score = score(answers, f.truth);
  entry.row.ours_there = score(own_there, f.truth).largest;
  const auto& d = entry.row.peer;
  entry.timed = f.name + "/" + d.name + "/" + d.call + "/" + d.options;
  entry.signed_gap = f.name + "/signed_gap";
  if (safe.size() < kInCache) {
    entry.signed_gap = entry.timed + "/signed_gap there";
    add_signed_gap(entry.signed_gap, f, safe);
  }
  add_sweep(entry.timed, safe, [&pairs](std::size_t i) { return pairs[i]->contact(); });
  entries.push_back(entry);
}

/// Keeps the least time of each benchmark, in ns a pair.
class Collector : public benchmark::ConsoleReporter {
 public:
  explicit Collector(bool quiet) : quiet_(quiet) {}
  bool ReportContext(const Context& context) override {
    return quiet_ || ConsoleReporter::ReportContext(context);
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    if (!quiet_) ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "min") continue;
      const auto pairs = run.counters.find("pairs");
      times_[run.run_name.function_name] =
          run.GetAdjustedCPUTime() / (pairs == run.counters.end() ? 1.0 : pairs->second.value);
    }
  }
  double time(const std::string& name) const {
    const auto found = times_.find(name);
    return found == times_.end() ? 0 : found->second;
  }

 private:
  bool quiet_;
  std::map<std::string, double> times_;
};

/// The arguments without --table, and with the repetitions interleaved.
std::vector<char*> arguments(int argc, char** argv, bool& table) {
  static std::string interleaved = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> kept;
  for (int i = 0; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--table")
      table = true;
    else
      kept.push_back(argv[i]);
  }
  kept.insert(kept.begin() + 1, interleaved.data());
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  bool table = false;
  std::vector<char*> kept = arguments(argc, argv, table);
  int count = static_cast<int>(kept.size());
  benchmark::Initialize(&count, kept.data());
  if (benchmark::ReportUnrecognizedArguments(count, kept.data())) return 2;

  const auto peers = all_peers();
  std::vector<Family> families;
  for (const auto& shape : tangency::verify::contact_classes())
    families.push_back(make_family(shape));
  std::vector<Entry> entries;
  std::vector<std::vector<std::unique_ptr<PeerPair>>> pairs(families.size() * peers.size());
  auto next_pairs = pairs.begin();
  tangency::bench::add_inverse();
  for (const Family& f : families) {
    Answers own;
    add_ours(f, entries, own);
    add_batch(f, entries);
    for (const auto& peer : peers) add_peer(f, *peer, own, entries, *next_pairs++);
  }

  Collector collector(table);
  benchmark::RunSpecifiedBenchmarks(&collector);
  std::vector<Row> rows;
  for (Entry& entry : entries) {
    entry.row.time = collector.time(entry.timed);
    entry.row.signed_gap = collector.time(entry.signed_gap);
    rows.push_back(entry.row);
  }
  if (table) std::cout << tables(rows, collector.time("inverse")) << '\n';
  std::cout << against_simbody(rows);
  return 0;
}
