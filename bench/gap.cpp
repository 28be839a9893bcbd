// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the signed gap of one pair at a time, as ratios to Eigen's 3x3 inverse. Answers are
// checked against the manufactured truth before anything is timed.
//
// By class: cold with the certificate (signed_gap), and warm (follow_gap from the normal of a
// moment ago, when B was 1e-4 of the smallest semi-axis away and turned by as much in rad). And
// bounding boxes, beside the centre and the roots of the shape's diagonal that are no more than
// that: rounded as it comes, so that they need not enclose.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
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

using Box = Eigen::AlignedBox3d;

Box plain_box(const tangency::Ellipsoid& e) {
  const tangency::Symmetric3& m = e.shape();
  const tangency::Vec3 half(std::sqrt(m.xx), std::sqrt(m.yy), std::sqrt(m.zz));
  return {e.centre() - half, e.centre() + half};
}

/// Ends the program where a box does not enclose the plain one but for its rounding, or is larger
/// than Ellipsoid promises.
void require_right(const Box& box, const Box& plain) {
  constexpr double u = tangency::kUnitRoundoff;
  for (int i = 0; i < 3; ++i) {
    const double reach = plain.max().cwiseAbs().cwiseMax(plain.min().cwiseAbs())[i];
    const double above = box.max()[i] - plain.max()[i], below = plain.min()[i] - box.min()[i];
    if (std::min(above, below) >= 0 && std::max(above, below) <= 64 * u * reach) continue;
    std::printf("bounding box: %g and %g beyond the plain one\n", above, below);
    std::exit(1);
  }
}

void add_boxes(const Pairs& pairs) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    require_right(pairs.a(i).bounding_box(), plain_box(pairs.a(i)));
  }
  add_calls("box/" + pairs.name, pairs.size(),
            [&](std::size_t i) { return pairs.a(i).bounding_box(); });
  add_calls("plain box/" + pairs.name, pairs.size(),
            [&](std::size_t i) { return plain_box(pairs.a(i)); });
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
  add_boxes(*families.front());
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
