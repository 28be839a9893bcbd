// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the signed gap of one pair at a time, as ratios to Eigen's 3x3 inverse. Answers are
// checked against the manufactured truth before anything is timed.
//
// By class: cold with the certificate (signed_gap), and warm (follow_gap from the normal of a
// moment ago, when B was 1e-4 of the smallest semi-axis away and turned by as much in rad).
#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/timing.hpp>
#include <tangency/geometry/gap.hpp>

namespace {

using namespace tangency::bench;
using tangency::Gap;

template <class Call>
void add(const std::string& name, const Pairs& pairs, const Call& call) {
  std::vector<std::optional<tangency::verify::CallAnswer>> answers;
  std::map<int, int> tiers;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Gap gap = call(i);
    answers.push_back(to_answer(gap));
    ++tiers[static_cast<int>(gap.tier)];
  }
  std::printf("%s; answers by tier:", require_right(name, pairs, answers).c_str());
  for (const auto& [tier, count] : tiers) std::printf(" %d: %d", tier, count);
  std::printf("\n");
  add_calls(name, pairs.size(), call);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::vector<std::unique_ptr<Pairs>> families;
  add_inverse();
  for (const auto& kind : tangency::verify::contact_classes()) {
    const Pairs& p = *families.emplace_back(contacts_of(kind, kInCache));
    add("cold/" + p.name, p, [&p](std::size_t i) { return signed_gap(p.a(i), p.b(i)); });
    add("warm/" + p.name, p, [&p](std::size_t i) {
      return follow_gap(p.a(i), p.b(i), p.b(i).centre() - p.a(i).centre(), p.previous_normal[i]);
    });
  }
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
