// SPDX-License-Identifier: GPL-3.0-or-later
// signed_gap and overlaps beside other codes: wrong answers, errors against the manufactured truth
// and times, in one run and on the same pairs. Every code is asked for its answers, in a process of
// its own, before anything is timed; ours have to be right, those of others are reported.
//
// bench_peers            the time of each, then the comparison with Simbody
// bench_peers --table    the tables of docs/peers.md instead
#include <hwy/targets.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/peers/isolate.hpp>
#include <tangency/bench/peers/report.hpp>
#include <tangency/bench/timing.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/relation.hpp>

namespace {

using namespace tangency::peers;
using namespace tangency::bench;
using tangency::verify::CallAnswer;

using Answers = std::vector<std::optional<CallAnswer>>;
using PeerPairs = std::vector<std::unique_ptr<PeerPair>>;

/// Each turn goes through all pairs, so that the slow ones count: the times of a code differ
/// between pairs by more than between codes.
constexpr Effort kEffort{15, 0.05, std::numeric_limits<double>::infinity()};

/// A row, and the jobs that give its times.
struct Entry {
  Row row;
  std::size_t timed, signed_gap;
};

class Comparison {
 public:
  void add_family(const Pairs& pairs, std::span<const std::unique_ptr<Peer>> peers) {
    Answers gaps, yes_or_no;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      gaps.push_back(to_answer(signed_gap(pairs.a(i), pairs.b(i))));
      yes_or_no.push_back(CallAnswer{.overlaps = overlaps(pairs.a(i), pairs.b(i))});
    }
    std::vector<std::size_t> every(pairs.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    signed_gap_ = add_signed_gap(pairs, every);
    add_ours(pairs, "signed_gap", "no options", GapOf::all, gaps, signed_gap_);
    add_ours(pairs, "overlaps", "no options", GapOf::none, yes_or_no,
             add_job(every, [&](std::size_t i) { return overlaps(pairs.a(i), pairs.b(i)); }));
    for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
      if (level != HWY_SCALAR && level != HWY_EMU128) add_batch(pairs, level);
    }
    for (const auto& peer : peers) add_peer(pairs, *peer, gaps);
  }

  std::vector<Row> rows() {
    time_by_turns(jobs_, kEffort);
    std::vector<Row> rows;
    for (Entry& entry : entries_) {
      entry.row.time = jobs_[entry.timed].least;
      entry.row.signed_gap = jobs_[entry.signed_gap].least;
      rows.push_back(entry.row);
    }
    return rows;
  }
  double inverse() const { return jobs_.front().least; }

 private:
  template <class Call>
  std::size_t add_job(const std::vector<std::size_t>& pairs, const Call& call) {
    const auto run = [pairs, call] {
      for (const std::size_t i : pairs) benchmark::DoNotOptimize(call(i));
    };
    jobs_.push_back({run, pairs.size()});
    return jobs_.size() - 1;
  }

  std::size_t add_signed_gap(const Pairs& pairs, const std::vector<std::size_t>& which) {
    return add_job(which, [&pairs](std::size_t i) { return signed_gap(pairs.a(i), pairs.b(i)); });
  }

  /// Ends the program where an answer is wrong.
  void add_ours(const Pairs& pairs, const char* call, const std::string& options, GapOf gap_of,
                const Answers& answers, std::size_t job) {
    require_right(pairs.name + "/" + call + "/" + options, pairs, answers);
    Row row;
    row.family = pairs.name;
    row.peer = {"Tangency", TANGENCY_VERSION, call, options, Definition::common_normal, gap_of};
    row.ours = true;
    row.grade = grade_without_bounds(pairs, answers);
    row.ours_there = row.grade.gap.largest;
    entries_.push_back({row, job, signed_gap_});
  }

  void add_batch(const Pairs& pairs, std::int64_t level) {
    const auto gaps = std::make_shared<std::vector<tangency::Gap>>(pairs.size());
    Job job{[&pairs, gaps] {
              signed_gaps(*pairs.array, {pairs.list, {}}, *gaps);
            },
            pairs.size(), level};
    force_level(level);
    job.run();
    force_level(0);
    Answers answers;
    for (const tangency::Gap& gap : *gaps) answers.push_back(to_answer(gap));
    jobs_.push_back(std::move(job));
    add_ours(pairs, kBatchCall, level == HWY_AVX3 ? "AVX-512" : hwy::TargetName(level), GapOf::all,
             answers, jobs_.size() - 1);
  }

  /// @param own  the answers of signed_gap
  void add_peer(const Pairs& pairs, const Peer& peer, const Answers& own) {
    const auto prepared = std::make_shared<PeerPairs>();
    for (std::size_t i = 0; i < pairs.size(); ++i)
      prepared->push_back(peer.prepare(pairs.raw[2 * i], pairs.raw[2 * i + 1]));
    Row row;
    row.family = pairs.name;
    row.peer = peer.description();
    Answers answers, own_there;
    std::vector<std::size_t> safe;
    for (const Isolated& seen : ask_isolated(*prepared)) {
      const std::size_t i = answers.size();
      answers.push_back(std::nullopt);
      if (seen.contact)
        answers.back() = CallAnswer{.overlaps = seen.contact->overlap, .gap = seen.contact->gap};
      own_there.push_back(seen.contact && seen.contact->gap ? own[i] : std::nullopt);
      if (seen.outcome == Outcome::aborted || seen.outcome == Outcome::hung)
        ++row.ended;
      else
        safe.push_back(i);
    }
    row.grade = grade_without_bounds(pairs, answers);
    row.ours_there = grade_without_bounds(pairs, own_there).gap.largest;
    const std::size_t ours = row.ended == 0 ? signed_gap_ : add_signed_gap(pairs, safe);
    const std::size_t job =
        add_job(safe, [prepared](std::size_t i) { return (*prepared)[i]->contact(); });
    entries_.push_back({row, job, ours});
  }

  std::vector<Job> jobs_ = {inverse_job()};
  std::vector<Entry> entries_;
  std::size_t signed_gap_ = 0;  ///< the job of all pairs of this family
};

}  // namespace

int main(int argc, char** argv) {
  const bool table = argc == 2 && std::string_view(argv[1]) == "--table";
  if (argc > 1 && !table) {
    std::fputs("usage: bench_peers [--table]\n", stderr);
    return 2;
  }
  const auto peers = all_peers();
  std::vector<std::unique_ptr<Pairs>> families;
  Comparison comparison;
  for (const auto& kind : tangency::verify::contact_classes())
    comparison.add_family(*families.emplace_back(contacts_of(kind, kInCache)), peers);
  const std::vector<Row> rows = comparison.rows();
  std::cout << (table ? tables(rows, comparison.inverse()) + '\n' : times(rows))
            << against_simbody(rows);
  return 0;
}
