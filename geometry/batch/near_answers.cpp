// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/near_answers.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/image_gap.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0::detail {
namespace {

/// How two bodies lie, exactly; or that it is not known yet.
enum class Known : std::uint8_t { apart, touching, meet, nothing };

Known known(Relation relation) {
  if (relation == Relation::separate) return Known::apart;
  return relation == Relation::external_touch ? Known::touching : Known::meet;
}

/// Do A and B meet at every separation that is no more than `off` from d? B, smaller by the share
/// off / b_min, lies in B moved by as much: where it meets A, B does.
bool meet_wherever(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, double off) {
  const double share = off / b.smallest_semi_axis() * (1.0 + 0x1p-40) + 0x1p-50;
  const Vec3 axes = (1.0 - share) * b.semi_axes();
  if (!(share < 1.0) || !(axes.minCoeff() > 0.0)) return false;
  return overlaps_by_filter(a, Ellipsoid(Vec3::Zero(), axes, b.orientation()), d) == true;
}

/// Candidates that are asked about by their centres, or all by separations.
template <class Bodies>
class Candidates {
 public:
  Candidates(const Bodies& bodies, const NeighbourQuestion& question, bool by_centres)
      : bodies_(bodies), question_(question), by_centres_(by_centres) {}

  void add(const NearPair& pair) {
    const bool wanted = question_.answers == NeighbourAnswers::contacts;
    work_.pairs.push_back(pair);
    indexed_.push_back({pair.a, pair.b});
    if (by_centres_ && !wanted) return;
    const ImageSeparation d = separation(bodies_.centre(pair.a), bodies_.centre(pair.b),
                                         question_.lattice.edges, pair.image);
    work_.separation.push_back(d.vector);
    if (!by_centres_) off_.push_back(d.error);
  }

  void answer(Neighbours& found) {
    if (work_.pairs.empty()) return;
    const bool gaps_wanted = question_.answers >= NeighbourAnswers::gaps;
    const bool exact = question_.reach == 0.0;
    if constexpr (std::is_same_v<Bodies, NearEllipsoids>) {
      if (exact || !gaps_wanted) {
        relate(exact);
        if (exact) {
          keep_if([&](std::size_t i) { return known_[i] != Known::apart; });
          if (gaps_wanted) find_gaps(std::numeric_limits<double>::infinity());
          return hand_over(found, [&](std::size_t i) { return known_[i] == Known::meet; });
        }
        hand_over_those_that_meet(found);
      }
    }
    find_gaps(cutoff());
    keep_if([&](std::size_t i) {
      if (work_.status[i] == GapStatus::beyond) return false;
      return exact ? work_.gap[i] <= 0.0 : work_.gap[i] - work_.gap_error[i] <= question_.reach;
    });
    hand_over(found, [&](std::size_t i) { return work_.gap[i] < 0.0; });
  }

 private:
  PairList list() const {
    if (by_centres_) return {indexed_, {}};
    return {indexed_, work_.separation};
  }
  double off(std::size_t i) const { return by_centres_ ? 0.0 : off_[i]; }
  Known exactly(std::size_t i) const {
    const NearPair& pair = work_.pairs[i];
    return known(
        relation(bodies_[pair.a], bodies_[pair.b], question_.lattice.edges, pair.image).relation);
  }

  /// Fills known_: exactly, but that with `all` false `nothing` may be said of what does not meet.
  void relate(bool all) {
    const std::size_t count = indexed_.size();
    const auto filtered = std::make_unique<std::optional<bool>[]>(count);
    overlaps_by_filter(bodies_.batch(), list(), std::span(filtered.get(), count));
    known_.assign(count, Known::nothing);
    for (std::size_t i = 0; i < count; ++i) {
      if (filtered[i] == false) {
        if (off(i) == 0.0) known_[i] = Known::apart;
      } else if (filtered[i] == true && (off(i) == 0.0 || meets_as_rounded(i))) {
        known_[i] = Known::meet;
      } else {
        known_[i] = exactly(i);
      }
    }
    if (all && !by_centres_) settle_by_gaps();
  }
  bool meets_as_rounded(std::size_t i) const {
    const NearPair& pair = work_.pairs[i];
    return meet_wherever(bodies_[pair.a], bodies_[pair.b], work_.separation[i], off_[i]);
  }
  /// Those that are apart at a rounded separation: by more than it is rounded?
  void settle_by_gaps() {
    const std::size_t count = indexed_.size();
    std::vector<IndexedPair> open;
    std::vector<Vec3> separations;
    for (std::size_t i = 0; i < count; ++i) {
      if (known_[i] != Known::nothing) continue;
      open.push_back(indexed_[i]);
      separations.push_back(work_.separation[i]);
    }
    std::vector<double> gap(open.size()), error(open.size());
    signed_gaps(bodies_.batch(), {open, separations}, {.gap = gap, .gap_error = error});
    for (std::size_t i = 0, k = 0; i < count; ++i) {
      if (known_[i] != Known::nothing) continue;
      known_[i] = gap[k] - error[k] > off_[i] ? Known::apart : exactly(i);
      ++k;
    }
  }

  void hand_over_those_that_meet(Neighbours& found) {
    for (std::size_t i = 0; i < work_.pairs.size(); ++i) {
      if (known_[i] != Known::meet) continue;
      found.pairs.push_back(work_.pairs[i]);
      if (question_.answers == NeighbourAnswers::overlaps) found.overlaps.push_back(1);
    }
    keep_if([&](std::size_t i) { return known_[i] != Known::meet; });
  }

  /// Pairs beyond are no neighbours, whatever their separation is rounded by.
  double cutoff() const {
    double most = 0.0;
    for (const double off : off_) most = std::max(most, off);
    return (question_.reach + most) * (1.0 + 0x1p-50);
  }

  /// The gaps of all that are left, and the rest of a contact where it is wanted.
  void find_gaps(double cutoff) {
    const std::size_t count = indexed_.size();
    work_.gap.resize(count), work_.gap_error.resize(count), work_.status.resize(count);
    std::vector<GapTier> tier(count);
    GapColumns columns{
        .gap = work_.gap, .gap_error = work_.gap_error, .status = work_.status, .tier = tier};
    if (question_.answers == NeighbourAnswers::contacts) {
      work_.normal.resize(count), work_.arm_a.resize(count), work_.arm_b.resize(count);
      columns.normal = work_.normal, columns.arm_a = work_.arm_a, columns.arm_b = work_.arm_b;
    }
    signed_gaps(bodies_.batch(), list(), columns, question_.accuracy.up_to(cutoff));
    for (std::size_t i = 0; i < count; ++i)
      if (off(i) != 0.0 && work_.status[i] != GapStatus::beyond) widen(i, tier[i]);
  }
  void widen(std::size_t i, GapTier tier) {
    double &gap = work_.gap[i], &error = work_.gap_error[i];
    const double wide = (error + off_[i]) * (1.0 + 0x1p-50);
    const bool ok = work_.status[i] == GapStatus::ok;
    if (gap > wide || (ok && gap < -wide)) {
      error = wide;
      return;
    }
    const NearPair& pair = work_.pairs[i];
    const Gap rounded{gap, Vec3::UnitX(), Vec3::Zero(), Vec3::Zero(), error, work_.status[i], tier};
    const Gap widened = widened_gap(rounded, off_[i], bodies_[pair.a], bodies_[pair.b],
                                    question_.lattice.edges, pair.image);
    gap = widened.gap;
    error = widened.gap_error;
  }

  template <class Keep>
  void keep_if(const Keep& keep) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < indexed_.size(); ++i)
      if (keep(i)) kept.push_back(i);
    const auto compact = [&](auto& column) {
      if (column.empty()) return;
      for (std::size_t k = 0; k < kept.size(); ++k) column[k] = column[kept[k]];
      column.resize(kept.size());
    };
    for_each_column([&](auto column) { compact(work_.*column); });
    compact(indexed_);
    compact(known_);
    compact(off_);
  }

  template <class Meet>
  void hand_over(Neighbours& found, const Meet& meet) {
    const NeighbourAnswers wanted = question_.answers;
    if (wanted >= NeighbourAnswers::overlaps)
      for (std::size_t i = 0; i < indexed_.size(); ++i) work_.overlaps.push_back(meet(i) ? 1 : 0);
    if (wanted < NeighbourAnswers::gaps)
      work_.gap.clear(), work_.gap_error.clear(), work_.status.clear();
    if (wanted < NeighbourAnswers::contacts) work_.separation.clear();
    for_each_column([&](auto column) {
      (found.*column).insert((found.*column).end(), (work_.*column).begin(), (work_.*column).end());
    });
  }

  const Bodies& bodies_;
  const NeighbourQuestion& question_;
  const bool by_centres_;
  Neighbours work_;  ///< columns of what is left; separations of all where not by_centres_
  std::vector<IndexedPair> indexed_;
  std::vector<Known> known_;
  std::vector<double> off_;  ///< what separations are rounded by, where not by_centres_
};

template <class Bodies>
void answer(const Bodies& bodies, const NeighbourQuestion& question,
            std::span<const NearPair> candidates, Neighbours& found) {
  Candidates<Bodies> here(bodies, question, true), moved(bodies, question, false);
  for (const NearPair& pair : candidates) (pair.image == LatticeImage{} ? here : moved).add(pair);
  here.answer(found);
  moved.answer(found);
}

}  // namespace

NearMovingBodies::NearMovingBodies(const MovingBodies& bodies) : batch_(bodies) {
  if (!bodies.has_centres() && bodies.size() > 0)
    throw std::invalid_argument("bodies: without centres nothing is near");
}

double NearMovingBodies::largest_semi_axis(std::size_t i) const {
  const double largest = batch_.lanes()[i].largest;
  if (!std::isnan(largest)) return largest;
  try {
    return batch_[i].largest_semi_axis();
  } catch (const InvalidEllipsoid& none) {
    throw std::invalid_argument("bodies[" + std::to_string(i) + "]: " + none.what());
  }
}

void answer_candidates(const NearEllipsoids& bodies, const NeighbourQuestion& question,
                       std::span<const NearPair> candidates, Neighbours& found) {
  answer(bodies, question, candidates, found);
}
void answer_candidates(const NearMovingBodies& bodies, const NeighbourQuestion& question,
                       std::span<const NearPair> candidates, Neighbours& found) {
  answer(bodies, question, candidates, found);
}

}  // namespace tangency::inline v0::detail
