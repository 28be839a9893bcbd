// SPDX-License-Identifier: MIT
#include <tangency/geometry/neighbours.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/batch/near_answers.hpp>
#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/image_gap.hpp>
#include <tangency/geometry/near/sorted_by_pair.hpp>
#include <tangency/geometry/near_pairs.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0 {
namespace {

/// Bodies that are searched around in one go. Chosen: their pairs stay in the processor's cache,
/// and many such parts are there to be shared among threads.
constexpr std::size_t kPart = 512;

/// Parts that a thread does before blocks are handed over. Chosen: a thread takes 20 us to start.
constexpr std::size_t kPartsAtOnce = 8;

/// The radius within which a body looks for others, half of the reach of each: not below the exact
/// sum, and as much above as the gap_error of what lies at the reach.
double searched_radius(double semi_axis, double reach) {
  if (reach == 0.0) return semi_axis;
  return (semi_axis + 0.5 * reach) * (1.0 + 0x1p-40) + 0x1p-1074;
}

/// What is asked, ready to be asked part by part. Parts may be asked by different threads.
template <class Bodies>
class Search {
 public:
  Search(const Bodies& bodies, const NeighbourQuestion& question)
      : bodies_(bodies), question_(question), search_(searched(bodies, question)) {}

  std::size_t parts() const { return (search_.size() + kPart - 1) / kPart; }

  /// What the bodies of one part find, in no order.
  Neighbours find(std::size_t part) const {
    return in_default_environment([&] {
      Neighbours found;
      std::vector<NearPair> candidates;
      search_.find(part * kPart, (part + 1) * kPart, candidates);
      detail::answer_candidates(bodies_, question_, candidates, found);
      return found;
    });
  }

 private:
  static NearPairSearch searched(const Bodies& bodies, const NeighbourQuestion& question) {
    const double reach = question.reach;
    if (!(reach >= 0.0) || !std::isfinite(reach))
      throw std::invalid_argument("reach = " + tables::to_text(reach) +
                                  ": must be finite and >= 0");
    std::vector<Vec3> centres(bodies.size());
    std::vector<double> radii(bodies.size());
    return in_default_environment([&] {
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        centres[i] = bodies.centre(i);
        radii[i] = searched_radius(bodies.largest_semi_axis(i), reach);
        if (!std::isfinite(radii[i]))
          throw std::invalid_argument("reach = " + tables::to_text(reach) +
                                      ": that and a semi-axis of body " + std::to_string(i) +
                                      " are beyond the range of doubles");
      }
      return NearPairSearch(centres, radii, question.lattice);
    });
  }

  const Bodies& bodies_;
  const NeighbourQuestion& question_;
  NearPairSearch search_;
};

/// One more pair, with the answers that are asked for. The sign of its gap is the exact one.
void append(Neighbours& to, NeighbourAnswers answers, const NearPair& pair, const Gap& gap,
            const Vec3& separation) {
  to.pairs.push_back(pair);
  if (answers >= NeighbourAnswers::overlaps) to.overlaps.push_back(gap.gap < 0.0 ? 1 : 0);
  if (answers >= NeighbourAnswers::gaps) {
    to.gap.push_back(gap.gap);
    to.gap_error.push_back(gap.gap_error);
    to.status.push_back(gap.status);
  }
  if (answers >= NeighbourAnswers::contacts) {
    to.normal.push_back(gap.normal);
    to.arm_a.push_back(gap.arm_a);
    to.arm_b.push_back(gap.arm_b);
    to.separation.push_back(separation);
  }
}

/// Where a pair stands among what the parts found.
struct Place {
  NearPair pair;
  std::uint32_t part, at;
};

bool before(const Place& x, const Place& y) { return x.pair < y.pair; }

/// All places in ascending order of their pairs.
std::vector<Place> sorted_places(std::span<const Neighbours> parts, std::size_t bodies) {
  const auto for_each = [&](const auto& use) {
    for (std::uint32_t k = 0; k < parts.size(); ++k)
      for (std::uint32_t i = 0; i < parts[k].size(); ++i) use(Place{parts[k].pairs[i], k, i});
  };
  return detail::sorted_by_pair<Place>(bodies, for_each, std::mem_fn(&Place::pair));
}

/// The columns of all parts in the order of `places`, and those of the parts freed.
Neighbours gathered(std::span<Neighbours> parts, std::span<const Place> places) {
  Neighbours all;
  detail::for_each_column([&](auto column) {
    const auto asked_for = [&](const Neighbours& part) { return !(part.*column).empty(); };
    if (std::none_of(parts.begin(), parts.end(), asked_for)) return;
    (all.*column).resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      (all.*column)[i] = (parts[places[i].part].*column)[places[i].at];
    for (Neighbours& part : parts) part.*column = {};
  });
  return all;
}

Neighbours merged(std::span<Neighbours> parts, std::size_t bodies, NeighbourAnswers answers) {
  if (answers != NeighbourAnswers::pairs) return gathered(parts, sorted_places(parts, bodies));
  std::vector<std::vector<NearPair>> pairs(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) pairs[k] = std::move(parts[k].pairs);
  Neighbours all;
  all.pairs = sorted_pairs(pairs, bodies);
  return all;
}

/// One part's pairs in ascending order.
Neighbours sorted(Neighbours part) {
  std::vector<Place> places(part.size());
  for (std::uint32_t i = 0; i < part.size(); ++i) places[i] = {part.pairs[i], 0, i};
  std::sort(places.begin(), places.end(), before);
  return gathered(std::span(&part, 1), places);
}

template <class Bodies>
Neighbours listed(const Bodies& bodies, const NeighbourQuestion& question) {
  const Search<Bodies> search(bodies, question);
  std::vector<Neighbours> parts(search.parts());
  detail::in_parts(parts.size(), question.threads,
                   [&](std::size_t k) { parts[k] = search.find(k); });
  return merged(parts, bodies.size(), question.answers);
}

template <class Bodies>
void handed_over(const Bodies& bodies, const NeighbourQuestion& question,
                 const std::function<void(const NeighbourBlock&)>& take) {
  const Search<Bodies> search(bodies, question);
  const auto threads = static_cast<std::size_t>(std::max(question.threads, 1));
  std::vector<Neighbours> blocks(
      std::min(threads > 1 ? kPartsAtOnce * threads : 1, search.parts()));
  for (std::size_t first = 0; first < search.parts(); first += blocks.size()) {
    const std::size_t count = std::min(blocks.size(), search.parts() - first);
    detail::in_parts(count, question.threads,
                     [&](std::size_t k) { blocks[k] = sorted(search.find(first + k)); });
    for (std::size_t k = 0; k < count; ++k) take(blocks[k].all());
  }
}

}  // namespace

Neighbours neighbours(std::span<const MatrixEllipsoid> bodies, const NeighbourQuestion& question) {
  std::vector<Ellipsoid> rounded;
  rounded.reserve(bodies.size());
  double rounding = 0.0;
  for (const MatrixEllipsoid& body : bodies) {
    rounded.push_back(body.ellipsoid());
    rounding = std::max(rounding, body.rounding());
  }
  NeighbourQuestion wider = question;  // all whose true bodies may be within the reach
  wider.answers = NeighbourAnswers::pairs;
  if (wider.reach >= 0.0) wider.reach = (wider.reach + 2.0 * rounding) * (1.0 + 0x1p-50);
  const std::vector<NearPair> candidates = neighbours(rounded, wider).pairs;

  const Mat3& edges = question.lattice.edges;
  std::vector<Gap> gaps(candidates.size());
  detail::in_ranges(candidates.size(), question.threads, 1,
                    [&](std::size_t first, std::size_t last) {
                      for (std::size_t k = first; k < last; ++k) {
                        const auto& [a, b, image] = candidates[k];
                        gaps[k] = signed_gap(bodies[a], bodies[b], edges, image);
                      }
                    });
  Neighbours found;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Gap& gap = gaps[k];
    const double nearest = question.reach == 0.0 ? gap.gap : gap.gap - gap.gap_error;
    if (!(nearest <= question.reach)) continue;
    const NearPair& pair = candidates[k];
    const Vec3& centre_a = rounded[pair.a].centre();
    append(found, question.answers, pair, gap,
           separation(centre_a, rounded[pair.b].centre(), edges, pair.image).vector);
  }
  return found;
}

Neighbours neighbours(std::span<const Ellipsoid> bodies, const NeighbourQuestion& question) {
  return listed(detail::NearEllipsoids(bodies), question);
}

Neighbours neighbours(const MovingBodies& bodies, const NeighbourQuestion& question) {
  return listed(detail::NearMovingBodies(bodies), question);
}

void for_each_neighbours(std::span<const Ellipsoid> bodies, const NeighbourQuestion& question,
                         const std::function<void(const NeighbourBlock&)>& take) {
  handed_over(detail::NearEllipsoids(bodies), question, take);
}

void for_each_neighbours(const MovingBodies& bodies, const NeighbourQuestion& question,
                         const std::function<void(const NeighbourBlock&)>& take) {
  handed_over(detail::NearMovingBodies(bodies), question, take);
}

}  // namespace tangency::inline v0
