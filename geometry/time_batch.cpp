// SPDX-License-Identifier: MIT
#include <tangency/geometry/time_batch.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/bodies/moving_pair.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0 {
namespace {

using detail::kBlock;
using detail::LaneBlock;
using detail::LaneBody;
using detail::MotionBounds;
using detail::PairMoment;
using Status = ContactTimeStatus;

constexpr const char* kCall = "times_of_contact";
// Of L, of the gap at the start, whose normal alone is asked for. Chosen: a normal to 1e-3 rad
// separates a pair for a frame as well as a better one does.
constexpr double kRough = Accuracy::fast().of_size;
constexpr int kMostRounds = 64;  // chosen: contacts of a frame need 3 to 6, grazing passes 20 to 30

/// The pairs of one call, wherever their bodies are.
struct Asked {
  const BodyArray* bodies;     ///< null: moving bodies
  const MovingBodies* moving;  ///< null: the bodies above
  const LaneBody* rows;        ///< of the bodies
  std::size_t body_count;
  std::span<const Motion> motions;
  PairList list;
  double horizon, tolerance;
  TimeColumns to;

  const Vec3* separation(std::size_t i) const {
    return list.separations.empty() ? nullptr : &list.separations[i];
  }
  Ellipsoid body(std::size_t index) const {
    return bodies != nullptr ? (*bodies)[index] : detail::made_body(kCall, *moving, index);
  }
  void require_pair(std::size_t i) const {
    const auto [a, b] = list.pairs[i];
    if (a >= body_count) contract::outside(kCall, i, 'a', a, body_count);
    if (b >= body_count) contract::outside(kCall, i, 'b', b, body_count);
    if (const Vec3* d = separation(i)) contract::require_finite(kCall, "separation", *d);
  }

  void write(std::size_t i, Status status, double time, double latest, double resolution,
             const Vec3& normal) const {
    if (!to.status.empty()) to.status[i] = status;
    if (!to.time.empty()) to.time[i] = time;
    if (!to.latest.empty()) to.latest[i] = latest;
    if (!to.resolution.empty()) to.resolution[i] = resolution;
    if (!to.normal.empty()) to.normal[i] = normal;
  }
  void write_none(std::size_t i, const MotionBounds& bounds) const {
    write(i, Status::none, horizon, horizon, 2.0 * bounds.rounding(horizon), Vec3::Zero());
  }
  void write_touching(std::size_t i, const MotionBounds& bounds) const {
    write(i, Status::touching_at_start, 0.0, 0.0, 2.0 * bounds.rounding(0.0), Vec3::Zero());
  }

  /// What the steps side by side do not prove.
  void ask_single(std::size_t i) const {
    const auto [index_a, index_b] = list.pairs[i];
    const Ellipsoid a = body(index_a), b = body(index_b);
    const Motion &motion_a = motions[index_a], &motion_b = motions[index_b];
    const Vec3* const d = separation(i);
    const TimeOfContact found =
        d != nullptr ? time_of_contact(a, motion_a, b, motion_b, *d, horizon, tolerance)
                     : time_of_contact(a, motion_a, b, motion_b, horizon, tolerance);
    const bool without = found.status == Status::none || found.status == Status::touching_at_start;
    write(i, found.status, found.time, found.latest, found.resolution,
          without ? Vec3(Vec3::Zero()) : found.gap.normal);
  }
  /// Deep pairs of flat bodies, whose gap lanes leave open: do they overlap as they stand?
  bool overlap_at_start(std::size_t i) const {
    const auto [index_a, index_b] = list.pairs[i];
    const Ellipsoid a = body(index_a), b = body(index_b);
    const Vec3* const d = separation(i);
    return (d != nullptr ? overlaps_by_filter(a, b, *d) : overlaps_by_filter(a, b)) == true;
  }
};

detail::ShapeReach reach(const LaneBody& row) {
  return {row.largest, row.largest * (row.largest - row.least_radius)};
}

Mat3 factor(const LaneBody& row) { return Eigen::Map<const Mat3>(row.factor); }

/// Lengths, and turning, that the bounds may square.
bool in_range(const Motion& motion) {
  const double most = std::max({motion.velocity.cwiseAbs().maxCoeff(),
                                motion.angular_velocity.cwiseAbs().maxCoeff(),
                                motion.pivot_arm.cwiseAbs().maxCoeff()});
  return most <= 0x1p100;
}

/// A pair that is apart up to `time`, and what is to be looked at next.
struct Open {
  std::size_t pair;
  double time;
  double look;   ///< the moment to look at
  bool proving;  ///< for an overlap there? Else for a step from there
  bool lost;     ///< is the gap at the last step down to rounding?
  int rounds;
  Vec3 normal;
  MotionBounds bounds;
  const LaneBody *a, *b;
};

/// The pairs of one part of the list.
class Sweep {
 public:
  explicit Sweep(const Asked& asked) : asked_(asked) {
    block_.next_pairs = nullptr;
    block_.polish = block_.branches = false;
    block_.tolerance = 0.0;
    block_.gap = gap_;
    block_.gap_error = gap_error_;
    block_.normal = normal_[0].data();
    block_.arm_a = block_.arm_b = nullptr;
  }

  void run(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      meet(i);
      if (fresh_count_ < kBlock) continue;
      look_at_starts();
      while (open_count_ >= kBlock) look_again(kBlock);
    }
    if (fresh_count_ > 0) look_at_starts();
    while (open_count_ > 0) look_again(std::min(open_count_, kBlock));
  }

 private:
  /// Balls first.
  void meet(std::size_t i) {
    asked_.require_pair(i);
    const auto [a, b] = asked_.list.pairs[i];
    const LaneBody &row_a = asked_.rows[a], &row_b = asked_.rows[b];
    const Motion &motion_a = asked_.motions[a], &motion_b = asked_.motions[b];
    const Vec3* const given = asked_.separation(i);
    const Vec3 d =
        given != nullptr ? *given : Vec3(Vec3::Map(row_b.centre) - Vec3::Map(row_a.centre));
    // False for NaN, which is how bodies that are not moderate() stay out.
    const bool moderate = row_a.largest + row_b.largest > 0.0 &&
                          d.cwiseAbs().maxCoeff() <= detail::kLargestModerate &&
                          in_range(motion_a) && in_range(motion_b) && asked_.horizon <= 0x1p100;
    if (!moderate) return asked_.ask_single(i);
    Open& fresh = fresh_[fresh_count_];
    fresh.bounds = MotionBounds(reach(row_a), motion_a, reach(row_b), motion_b, d);
    if (fresh.bounds.balls_apart_throughout(asked_.horizon))
      return asked_.write_none(i, fresh.bounds);
    fresh.pair = i;
    fresh.time = 0.0;
    fresh.rounds = 0;
    fresh.a = &row_a, fresh.b = &row_b;
    pairs_[fresh_count_] = {a, b};
    separations_[fresh_count_] = d;
    ++fresh_count_;
  }

  std::uint64_t lanes(std::size_t count) {
    block_.count = static_cast<int>(count);
    block_.pairs = pairs_;
    block_.separations = separations_[0].data();
    // Entries beyond the last have to be pairs.
    std::fill(pairs_ + count, pairs_ + kBlock, pairs_[0]);
    std::fill(separations_ + count, separations_ + kBlock, separations_[0]);
    return detail::gap_lanes(block_);
  }

  /// The gaps as the bodies stand.
  void look_at_starts() {
    block_.bodies_a = block_.bodies_b = asked_.rows;
    block_.normals = nullptr;
    block_.centres_are_exact = asked_.list.separations.empty();
    block_.factor_error = asked_.moving != nullptr ? detail::kOfRotation : 0.0;
    block_.tolerance_of_size = kRough;
    const std::uint64_t settled = lanes(fresh_count_);
    for (std::size_t k = 0; k < fresh_count_; ++k) {
      Open& fresh = fresh_[k];
      const std::size_t i = fresh.pair;
      if ((settled >> k & 1) == 0) {
        asked_.overlap_at_start(i) ? asked_.write_touching(i, fresh.bounds) : asked_.ask_single(i);
      } else if (gap_[k] < 0.0) {
        asked_.write_touching(i, fresh.bounds);
      } else {
        const PairMoment now = fresh.bounds.at(0.0, factor(*fresh.a), factor(*fresh.b));
        if (!step_from(fresh, now, gap_[k], normal_[k])) continue;
        fresh.time > 0.0 ? keep(fresh) : asked_.ask_single(i);
      }
    }
    fresh_count_ = 0;
  }

  /// One step of the first `count` that are open.
  void look_again(std::size_t count) {
    PairMoment moments[kBlock];
    for (std::size_t k = 0; k < count; ++k) {
      const Open& open = open_[k];
      moments[k] = open.bounds.at(open.look, factor(*open.a), factor(*open.b));
      const double off = open.bounds.rounding(open.look);
      fill(rows_a_[k], moments[k].factor_a, *open.a, off);
      fill(rows_b_[k], moments[k].factor_b, *open.b, off);
      pairs_[k] = {static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k)};
      separations_[k] = moments[k].d;
      starts_[k] = open.normal;
    }
    std::fill(starts_ + count, starts_ + kBlock, starts_[0]);
    block_.bodies_a = rows_a_, block_.bodies_b = rows_b_;
    block_.normals = starts_[0].data();
    block_.centres_are_exact = false;
    block_.factor_error = detail::kOfRotation;
    block_.tolerance_of_size = 0.0;
    const std::uint64_t settled = lanes(count);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < open_count_; ++k) {
      if (k < count && !goes_on(open_[k], moments[k], (settled >> k & 1) != 0, k)) continue;
      if (kept != k) open_[kept] = open_[k];
      ++kept;
    }
    open_count_ = kept;
  }

  /// The row at a moment. (B) of docs/derivations/gap-batch.md needs the least radius of the body
  /// that the rounded factor is exactly, which `off` bounds the difference to.
  static void fill(LaneBody& row, const Mat3& turned, const LaneBody& start, double off) {
    Vec3::Map(row.centre) = Vec3::Zero();
    Eigen::Map<Mat3>(row.factor) = turned;
    row.largest = start.largest;
    const double smallest = std::max(0.0, std::sqrt(start.least_radius * start.largest) - off);
    row.least_radius = (1.0 - 0x1p-40) * smallest * (smallest / (start.largest + off));
  }

  /// What the lane says of an open pair. False where that is answered.
  bool goes_on(Open& open, const PairMoment& now, bool settled, std::size_t k) {
    open.normal = normal_[k];
    if (open.proving) {
      const double off = open.bounds.rounding(open.look);
      if (settled && gap_[k] + gap_error_[k] < -off) {
        asked_.write(open.pair, Status::contact, open.time, open.look,
                     2.0 * open.bounds.rounding(open.time), normal_[k]);
        return false;
      }
      open.proving = false;
      open.look = open.time;
      settled = !open.lost;
    } else if (settled && !step_from(open, now, gap_[k], normal_[k])) {
      return false;
    }
    if (!settled && !open.lost && starts_[k] != Vec3::Zero()) {
      // In a long step the normal may have turned too far to be followed: once more, afresh.
      open.normal = Vec3::Zero();
      settled = true;
    }
    if (settled && ++open.rounds < kMostRounds) return true;
    asked_.ask_single(open.pair);
    return false;
  }

  /// A step along the normal from a moment at which the gap is known. False where none is needed
  /// any more.
  bool step_from(Open& open, const PairMoment& now, double gap, const Vec3& normal) {
    const double move = open.bounds.safe_step(now, normal, asked_.horizon - now.t);
    if (move > 0.0 && now.t + move >= asked_.horizon) {
      asked_.write_none(open.pair, open.bounds);
      return false;
    }
    open.normal = normal;
    open.lost = gap <= 2.0 * open.bounds.rounding(now.t) || now.t + move == now.t;
    open.look = open.time = now.t + move;
    open.proving = move <= detail::kNearContact * asked_.tolerance;
    if (open.proving)
      open.look = std::min(detail::at_most_after(open.time, asked_.tolerance), asked_.horizon);
    return true;
  }

  void keep(const Open& open) { open_[open_count_++] = open; }

  const Asked& asked_;
  LaneBlock block_{};
  IndexedPair pairs_[kBlock];
  Vec3 separations_[kBlock], starts_[kBlock];
  LaneBody rows_a_[kBlock], rows_b_[kBlock];
  double gap_[kBlock], gap_error_[kBlock];
  Vec3 normal_[kBlock];
  Open fresh_[kBlock];
  std::size_t fresh_count_ = 0;
  Open open_[2 * kBlock];
  std::size_t open_count_ = 0;
};

void require_columns(const TimeColumns& columns, std::size_t count) {
  const auto require = [&](const char* name, const auto& column) {
    if (!column.empty()) contract::require_length(kCall, name, column.size(), count);
  };
  require("status", columns.status);
  require("time", columns.time);
  require("latest", columns.latest);
  require("resolution", columns.resolution);
  require("normal", columns.normal);
}

void run(const Asked& asked, int threads) {
  assert(std::isfinite(asked.horizon) && asked.horizon >= 0.0 && asked.tolerance > 0.0);
  const std::size_t count = asked.list.pairs.size();
  detail::require_separations(kCall, asked.list,
                              asked.moving == nullptr || asked.moving->has_centres());
  if (asked.motions.size() != asked.body_count)
    contract::wrong_column(kCall, "motions", asked.motions.size(), asked.body_count);
  require_columns(asked.to, count);
  detail::in_ranges(count, threads, kBlock, [&](std::size_t first, std::size_t last) {
    in_default_environment([&] { Sweep(asked).run(first, last); });
  });
}

}  // namespace

void times_of_contact(const BodyArray& bodies, std::span<const Motion> motions,
                      const PairList& list, double horizon, double tolerance,
                      const TimeColumns& answers, int threads) noexcept {
  run({&bodies, nullptr, bodies.lanes(), bodies.size(), motions, list, horizon, tolerance, answers},
      threads);
}

void times_of_contact(const MovingBodies& bodies, std::span<const Motion> motions,
                      const PairList& list, double horizon, double tolerance,
                      const TimeColumns& answers, int threads) noexcept {
  run({nullptr, &bodies, bodies.lanes(), bodies.size(), motions, list, horizon, tolerance, answers},
      threads);
}

}  // namespace tangency::inline v0
