// SPDX-License-Identifier: MIT
#include <tangency/geometry/question_batch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

using detail::kBlock;
using detail::LaneBlock;
using detail::LaneBody;

// (X), (H) of docs/derivations/primitives.md, section 6, over u.
constexpr double kOfTerms = 6.0, kOfHeight = 6.0, kOfSupport = 16.0, kOfWallGap = 2.0;
// Of the length of a wall's normal and of what is far away: no square over- or underflows. Chosen.
constexpr double kLeastNormal = 0x1p-100, kMostNormal = 0x1p100;

/// The bodies of a call, and of what they are asked.
struct Asked {
  const char* call;
  const BodyArray* array;      ///< null: moving bodies
  const MovingBodies* moving;  ///< null: the array
  const LaneBody* rows;
  std::size_t body_count;
  const char* other;  ///< "walls"
  std::size_t other_count;
  PairList list;

  Asked(const char* of_call, const BodyArray& bodies, const char* of_other, std::size_t others,
        const PairList& of_list)
      : Asked(of_call, &bodies, nullptr, bodies.lanes(), bodies.size(), of_other, others, of_list) {
  }
  Asked(const char* of_call, const MovingBodies& bodies, const char* of_other, std::size_t others,
        const PairList& of_list)
      : Asked(of_call, nullptr, &bodies, bodies.lanes(), bodies.size(), of_other, others, of_list) {
  }

  double factor_error() const { return moving != nullptr ? detail::kOfRotation : 0.0; }
  const Vec3* separation(std::size_t i) const {
    return list.separations.empty() ? nullptr : &list.separations[i];
  }
  Ellipsoid body(std::size_t i) const {
    const std::size_t index = list.pairs[i].a;
    return array != nullptr ? (*array)[index] : detail::made_body(call, *moving, index);
  }
  void require_pair(std::size_t i) const {
    const auto [a, b] = list.pairs[i];
    if (a >= body_count) contract::outside(call, i, 'a', a, body_count);
    if (b >= other_count) contract::outside(call, i, 'b', b, other_count, other);
    if (const Vec3* d = separation(i)) contract::require_finite(call, "separation", *d);
  }

 private:
  Asked(const char* of_call, const BodyArray* of_array, const MovingBodies* of_moving,
        const LaneBody* of_rows, std::size_t bodies, const char* of_other, std::size_t others,
        const PairList& of_list)
      : call(of_call),
        array(of_array),
        moving(of_moving),
        rows(of_rows),
        body_count(bodies),
        other(of_other),
        other_count(others),
        list(of_list) {
    detail::require_separations(call, list, moving == nullptr || moving->has_centres());
  }
};

template <class Column>
void require_column(const Asked& asked, const char* name, const Column& column) {
  if (!column.empty())
    contract::require_length(asked.call, name, column.size(), asked.list.pairs.size());
}

template <class Column, class Value>
void put(const Column& column, std::size_t i, const Value& value) {
  if (!column.empty()) column[i] = value;
}

/// work(first, last) in the default environment, on so many threads.
template <class Work>
void share(const Asked& asked, int threads, const Work& work) {
  detail::in_ranges(asked.list.pairs.size(), threads, kBlock,
                    [&](std::size_t first, std::size_t last) {
                      in_default_environment([&] { work(first, last); });
                    });
}

// ---- walls

constexpr bool is_sheet(const Plane&) { return false; }
constexpr bool is_sheet(const Sheet&) { return true; }

/// In double; nothing where that leaves a doubt about a sign, or numbers are out of range.
template <class Wall>
std::optional<WallGap> quick_wall_gap(const LaneBody& row, const Wall& wall, const Vec3* separation,
                                      double factor_error) {
  const double length2 = wall.normal.squaredNorm();
  if (!(length2 >= kLeastNormal * kLeastNormal && length2 <= kMostNormal * kMostNormal))
    return std::nullopt;
  const double inverse = 1.0 / std::sqrt(length2);
  const Vec3 centre = Vec3::Map(row.centre);
  const Vec3 from = separation != nullptr ? Vec3(-*separation) : centre;
  const double offset = separation != nullptr ? 0.0 : wall.offset;
  const Vec3 terms = wall.normal.cwiseProduct(from);
  double height = (terms.sum() - offset) * inverse;
  const double of_terms =
      kUnitRoundoff * (kOfTerms * (terms.cwiseAbs().sum() + std::abs(offset)) * inverse +
                       kOfHeight * std::abs(height));
  if (is_sheet(wall) && !(std::abs(height) > of_terms)) return std::nullopt;
  const bool reversed = is_sheet(wall) && height < 0.0;
  if (reversed) height = -height;
  const Vec3 normal = (reversed ? inverse : -inverse) * wall.normal;
  const Eigen::Map<const Mat3> factor(row.factor);
  const Vec3 y = factor.transpose() * normal;
  const double support = y.norm(), gap = height - support;
  const double error = of_terms + kUnitRoundoff * ((kOfSupport + factor_error) * row.largest +
                                                   kOfWallGap * std::abs(gap));
  // False for NaN, which is how bodies that are not moderate() stay out.
  if (!(std::abs(gap) > error) || !(height <= detail::kLargestModerate)) return std::nullopt;
  const Vec3 arm = factor * (y / support);
  return WallGap{gap, normal, arm, arm + gap * normal, error, GapStatus::ok};
}

template <class Wall>
WallGap wall_gap(const Asked& asked, const Wall& wall, std::size_t i) {
  const Vec3* const separation = asked.separation(i);
  if (const auto quick =
          quick_wall_gap(asked.rows[asked.list.pairs[i].a], wall, separation, asked.factor_error()))
    return *quick;
  const Ellipsoid body = asked.body(i);
  return separation != nullptr ? signed_gap(body, wall, *separation) : signed_gap(body, wall);
}

template <class Bodies, class Wall>
void gaps_to_walls(const Bodies& bodies, std::span<const Wall> walls, const PairList& list,
                   const WallColumns& to, int threads) {
  const Asked asked("signed_gaps", bodies, "walls", walls.size(), list);
  require_column(asked, "gap", to.gap);
  require_column(asked, "gap_error", to.gap_error);
  require_column(asked, "normal", to.normal);
  require_column(asked, "arm_body", to.arm_body);
  require_column(asked, "arm_wall", to.arm_wall);
  require_column(asked, "status", to.status);
  share(asked, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      asked.require_pair(i);
      const WallGap found = wall_gap(asked, walls[list.pairs[i].b], i);
      put(to.gap, i, found.gap);
      put(to.gap_error, i, found.gap_error);
      put(to.normal, i, found.normal);
      put(to.arm_body, i, found.arm_body);
      put(to.arm_wall, i, found.arm_wall);
      put(to.status, i, found.status);
    }
  });
}

// ---- balls and points

/// A ball as a body of the lanes: one too small for them, or a point, by a ball of the other body's
/// size about it, whose gap is less by the difference of the radii.
struct Ball {
  double radius, instead;

  Ball(double given, double other_size)
      : radius(given), instead(given >= detail::kSmallestModerate ? given : other_size) {}
  bool replaced() const { return instead != radius; }
};

void fill(LaneBody& row, const Vec3& centre, double radius) {
  Vec3::Map(row.centre) = centre;
  const bool moderate = radius <= detail::kLargestModerate;
  row.largest = moderate ? radius : std::numeric_limits<double>::quiet_NaN();
  row.least_radius = (1.0 - 0x1p-40) * radius;
  Eigen::Map<Mat3>(row.factor) = radius * Mat3::Identity();
}

/// Blocks of pairs of a body and a ball: hard(i) where no lane settles one.
class BallBlocks {
 public:
  explicit BallBlocks(const Asked& asked) : asked_(asked) {
    block_.bodies_a = asked.rows;
    block_.bodies_b = balls_;
    block_.pairs = pairs_;
    block_.centres_are_exact = asked.list.separations.empty();
    block_.factor_error = asked.factor_error();
    block_.polish = true;  // arms as good as doubles allow
    block_.gap = gap_;
    block_.gap_error = gap_error_;
    block_.normal = normal_[0].data();
    block_.arm_a = arm_[0].data();
  }

  /// @param ball  the centre and radius of ball j
  /// @param write(i, gap, hard)  hard: the gap is not there
  template <class GetBall, class Write>
  void run(std::size_t first, std::size_t last, const GetBall& ball, const Write& write) {
    for (std::size_t begin = first; begin < last; begin += kBlock) {
      const std::size_t count = std::min(kBlock, last - begin);
      for (std::size_t k = 0; k < kBlock; ++k) place(begin + (k < count ? k : 0), k, ball);
      block_.count = static_cast<int>(count);
      block_.separations = asked_.list.separations.empty() ? nullptr : separations_[0].data();
      const std::uint64_t settled = detail::gap_lanes(block_);
      for (std::size_t k = 0; k < count; ++k) {
        Gap found{};
        const bool known = (settled >> k & 1) != 0 && finish(k, found);
        write(begin + k, known ? &found : nullptr);
      }
    }
  }

 private:
  template <class GetBall>
  void place(std::size_t i, std::size_t k, const GetBall& ball) {
    asked_.require_pair(i);
    const auto [a, b] = asked_.list.pairs[i];
    const Sphere given = ball(b);
    radius_[k] = Ball(given.radius, asked_.rows[a].largest);
    fill(balls_[k], given.centre, radius_[k]->instead);
    pairs_[k] = {a, static_cast<std::uint32_t>(k)};
    if (const Vec3* d = asked_.separation(i)) separations_[k] = *d;
  }

  /// From the ball that stood in for it. False where the sign is in doubt.
  bool finish(std::size_t k, Gap& found) const {
    const Ball& ball = *radius_[k];
    double gap = gap_[k], error = gap_error_[k];
    if (ball.replaced()) {
      const double distance = gap + ball.instead;
      gap = distance - ball.radius;
      error = (error + kUnitRoundoff * (std::abs(distance) + std::abs(gap))) * (1.0 + 0x1p-50);
      if (!(std::abs(gap) > error)) return false;
    }
    found = {gap,   normal_[k],    arm_[k],      Vec3(-ball.radius * normal_[k]),
             error, GapStatus::ok, GapTier::fast};
    return true;
  }

  const Asked& asked_;
  LaneBlock block_{};
  LaneBody balls_[kBlock];
  std::optional<Ball> radius_[kBlock];
  IndexedPair pairs_[kBlock];
  Vec3 separations_[kBlock];
  double gap_[kBlock], gap_error_[kBlock];
  Vec3 normal_[kBlock], arm_[kBlock];
};

template <class Bodies>
void gaps_to_balls(const Bodies& bodies, std::span<const Sphere> balls, const PairList& list,
                   const GapColumns& to, int threads) {
  const Asked asked("signed_gaps", bodies, "balls", balls.size(), list);
  require_column(asked, "gap", to.gap);
  require_column(asked, "gap_error", to.gap_error);
  require_column(asked, "normal", to.normal);
  require_column(asked, "arm_a", to.arm_a);
  require_column(asked, "arm_b", to.arm_b);
  require_column(asked, "status", to.status);
  require_column(asked, "tier", to.tier);
  require_column(asked, "point", to.point);
  const auto write = [&](std::size_t i, const Gap* quick) {
    const Sphere& ball = balls[list.pairs[i].b];
    const Vec3* const d = asked.separation(i);
    const auto single = [&] {
      return d != nullptr ? signed_gap(asked.body(i), ball, *d) : signed_gap(asked.body(i), ball);
    };
    const Gap found = quick != nullptr ? *quick : single();
    put(to.gap, i, found.gap);
    put(to.gap_error, i, found.gap_error);
    put(to.normal, i, found.normal);
    put(to.arm_a, i, found.arm_a);
    put(to.arm_b, i, found.arm_b);
    put(to.status, i, found.status);
    put(to.tier, i, found.tier);
    if (to.point.empty()) return;
    const Vec3 apart =
        d != nullptr ? *d : Vec3(ball.centre - Vec3::Map(asked.rows[list.pairs[i].a].centre));
    to.point[i] = found.arm_a + 0.5 * ((apart + found.arm_b) - found.arm_a);
  };
  share(asked, threads, [&](std::size_t first, std::size_t last) {
    BallBlocks(asked).run(
        first, last, [&](std::size_t j) { return balls[j]; }, write);
  });
}

template <class Bodies>
void points_closest(const Bodies& bodies, std::span<const Vec3> points, const PairList& list,
                    const PointColumns& to, int threads) {
  const Asked asked("closest_points", bodies, "points", points.size(), list);
  require_column(asked, "distance", to.distance);
  require_column(asked, "distance_error", to.distance_error);
  require_column(asked, "normal", to.normal);
  require_column(asked, "arm", to.arm);
  require_column(asked, "status", to.status);
  const auto write = [&](std::size_t i, const Gap* quick) {
    ClosestPoint found{};
    if (quick != nullptr) {
      found = {quick->gap, quick->normal, quick->arm_a, quick->gap_error, quick->status};
    } else if (const Vec3* d = asked.separation(i)) {
      found = closest_point_from_centre(asked.body(i), *d);
    } else {
      found = closest_point(asked.body(i), points[list.pairs[i].b]);
    }
    put(to.distance, i, found.distance);
    put(to.distance_error, i, found.distance_error);
    put(to.normal, i, found.normal);
    put(to.arm, i, found.arm);
    put(to.status, i, found.status);
  };
  share(asked, threads, [&](std::size_t first, std::size_t last) {
    BallBlocks(asked).run(
        first, last,
        [&](std::size_t j) {
          return Sphere{points[j], 0.0};
        },
        write);
  });
}

}  // namespace

void signed_gaps(const BodyArray& bodies, std::span<const Plane> walls, const PairList& list,
                 const WallColumns& answers, int threads) noexcept {
  gaps_to_walls(bodies, walls, list, answers, threads);
}
void signed_gaps(const MovingBodies& bodies, std::span<const Plane> walls, const PairList& list,
                 const WallColumns& answers, int threads) noexcept {
  gaps_to_walls(bodies, walls, list, answers, threads);
}
void signed_gaps(const BodyArray& bodies, std::span<const Sheet> sheets, const PairList& list,
                 const WallColumns& answers, int threads) noexcept {
  gaps_to_walls(bodies, sheets, list, answers, threads);
}
void signed_gaps(const MovingBodies& bodies, std::span<const Sheet> sheets, const PairList& list,
                 const WallColumns& answers, int threads) noexcept {
  gaps_to_walls(bodies, sheets, list, answers, threads);
}

void signed_gaps(const BodyArray& bodies, std::span<const Sphere> balls, const PairList& list,
                 const GapColumns& answers, int threads) noexcept {
  gaps_to_balls(bodies, balls, list, answers, threads);
}
void signed_gaps(const MovingBodies& bodies, std::span<const Sphere> balls, const PairList& list,
                 const GapColumns& answers, int threads) noexcept {
  gaps_to_balls(bodies, balls, list, answers, threads);
}

void closest_points(const BodyArray& bodies, std::span<const Vec3> points, const PairList& list,
                    const PointColumns& answers, int threads) noexcept {
  points_closest(bodies, points, list, answers, threads);
}
void closest_points(const MovingBodies& bodies, std::span<const Vec3> points, const PairList& list,
                    const PointColumns& answers, int threads) noexcept {
  points_closest(bodies, points, list, answers, threads);
}

}  // namespace tangency::inline v0
