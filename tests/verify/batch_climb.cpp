// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/verify/batch_climb.hpp>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/support/same_bits.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency::testing {
namespace {

using verify::Draw;
using verify::EllipsoidPair;
using verify::RawEllipsoid;
using verify::Real;

struct Answer {
  double gap, gap_error;
  GapStatus status;
};

Answer answer(const Ellipsoid& a, const Ellipsoid& b, LaneForm form) {
  const std::vector<Ellipsoid> two{a, b};
  const std::vector<Vec3> axes{a.semi_axes(), b.semi_axes()}, centres{a.centre(), b.centre()};
  const std::vector<Quaternion> turns{a.orientation(), b.orientation()};
  const IndexedPair pair{0, 1};
  const PairList list{std::span(&pair, 1), {}};
  Answer found{};
  const GapColumns columns{.gap = std::span(&found.gap, 1),
                           .gap_error = std::span(&found.gap_error, 1),
                           .status = std::span(&found.status, 1)};
  if (form == LaneForm::ellipsoids)
    signed_gaps(BodyArray(two), list, columns, Accuracy::certified());
  else
    signed_gaps(MovingBodies(axes, PoseColumns{turns, centres}), list, columns,
                Accuracy::certified());
  return found;
}

double ratio_of(const EllipsoidPair& pair, LaneForm form) {
  const Ellipsoid a = verify::to_ellipsoid(pair.a), b = verify::to_ellipsoid(pair.b);
  const Answer of_lane = answer(a, b, form);
  if (of_lane.status != GapStatus::ok || !(of_lane.gap_error > 0)) return 0;
  const Gap single = signed_gap(a, b);
  if (same_bits(of_lane.gap, single.gap) && same_bits(of_lane.gap_error, single.gap_error))
    return 0;
  const auto truth = verify::signed_gap(pair.a, pair.b);
  if (!truth.global) return 0;
  return (abs(Real(of_lane.gap) - truth.gap) / of_lane.gap_error).convert_to<double>();
}

// One number somewhere else; semi-axes stay above 0, orientations other than 0.
EllipsoidPair nudged(Draw& draw, EllipsoidPair pair) {
  RawEllipsoid& body = draw.coin() ? pair.a : pair.b;
  const int which = draw.integer(0, 9);
  double& x = which < 3   ? body.centre[static_cast<std::size_t>(which)]
              : which < 6 ? body.semi_axes[static_cast<std::size_t>(which - 3)]
                          : body.orientation[static_cast<std::size_t>(which - 6)];
  if (draw.integer(0, 3) > 0) {
    const double way = draw.coin() ? 1 : -1;
    const int units = draw.integer(1, 16);
    for (int i = 0; i < units; ++i) x = std::nextafter(x, way * std::numeric_limits<double>::max());
  } else {
    x *= 1 + (draw.coin() ? 1 : -1) * draw.log_uniform(1e-12, 0.1);
  }
  return pair;
}

}  // namespace

Climbed climb(const EllipsoidPair& start, LaneForm form, int steps, std::uint64_t seed) {
  Draw draw(seed);
  Climbed best{start, ratio_of(start, form)};
  for (int i = 0; i < steps; ++i) {
    const EllipsoidPair pair = nudged(draw, best.pair);
    const double ratio = ratio_of(pair, form);
    if (ratio > best.ratio) best = {pair, ratio};
  }
  return best;
}

}  // namespace tangency::testing
