// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/pack.hpp>

#include <cmath>
#include <optional>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/pair_input.hpp>
#include <tangency/tests/fuzz/placed_pairs.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/hunt/moves.hpp>

namespace tangency::testing::fuzz {
namespace {

constexpr std::size_t kMovedPairs = 512, kPlacedPairs = 8192, kPlacedBodies = 32;  // chosen
constexpr std::uint64_t kDeepOneIn = 1024, kMoveOneIn = 8;
constexpr int kDistortions = 2;  // chosen: a move takes as long as ten of them

/// A small turn and shift, cheaper than a move.
void distort(verify::EllipsoidPair& pair, std::uint64_t& state) {
  const double size = pair.b.semi_axes[0];
  for (int k = 0; k < kDistortions; ++k) {
    const double part = std::ldexp(static_cast<double>(next(state) >> 11), -56);
    pair.b.centre[below(state, 3)] += (part - 0.0625) * size;
    pair.b.orientation[below(state, 4)] += part - 0.0625;
  }
}

void add(Pack& pack, const verify::EllipsoidPair& raw) {
  const std::optional<Bodies> bodies = bodies_of(raw);
  if (!bodies) return;
  const auto first = static_cast<std::uint32_t>(pack.bodies.size());
  pack.bodies.push_back(bodies->a);
  pack.bodies.push_back(bodies->b);
  pack.pairs.push_back({first, first + 1});
}

/// By enclosures, which need no search.
void drop_deep(Pack& pack, std::uint64_t& state) {
  const BodyArray array(pack.bodies);
  std::vector<double> gaps(pack.pairs.size());
  BoundedColumns columns;
  columns.answers.gap = gaps;
  bounded_gaps(array, pack.list(), columns, Accuracy::fast());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const IndexedPair pair = pack.pairs[i];
    const double rho = pack.bodies[pair.a].least_radius() + pack.bodies[pair.b].least_radius();
    if (gaps[i] < -rho && below(state, kDeepOneIn) != 0) continue;
    pack.pairs[kept++] = pair;
  }
  pack.pairs.resize(kept);
}

/// Goes on from pair to pair.
class Moving {
 public:
  Moving(std::span<const verify::EllipsoidPair> given, std::uint64_t seed)
      : given_(given), moving_(given.begin(), given.end()), draw_(seed) {}

  /// The next of them, a fair one or one that was given.
  verify::EllipsoidPair& pair() {
    verify::EllipsoidPair& one = moving_[at_ % moving_.size()];
    if (!verify::is_fair(one)) one = given_[at_ % given_.size()];
    ++at_;
    return one;
  }
  void move(verify::EllipsoidPair& pair) { move_pair(pair, draw_); }

 private:
  std::span<const verify::EllipsoidPair> given_;
  std::vector<verify::EllipsoidPair> moving_;
  verify::Draw draw_;
  std::size_t at_ = 0;
};

}  // namespace

verify::EllipsoidPair Pack::raw(std::size_t i) const {
  const Ellipsoid &a = bodies[pairs[i].a], &b = bodies[pairs[i].b];
  if (separations.empty()) return {verify::to_raw(a), verify::to_raw(b)};
  return {verify::to_raw(a.moved_to(Vec3::Zero())), verify::to_raw(b.moved_to(separations[i]))};
}

Pack moved_pack(std::span<const verify::EllipsoidPair> given, std::uint64_t seed) {
  Pack pack;
  for (const verify::EllipsoidPair& pair : given) add(pack, pair);
  std::uint64_t state = seed;
  Moving moving(given, seed);
  for (std::size_t k = 0; pack.pairs.size() < kMovedPairs && k < 2 * kMovedPairs; ++k) {
    verify::EllipsoidPair& pair = moving.pair();
    if (below(state, kMoveOneIn) == 0) moving.move(pair);
    distort(pair, state);
    if (verify::is_fair(pair)) add(pack, pair);
  }
  drop_deep(pack, state);
  return pack;
}

Pack placed_pack(std::span<const verify::EllipsoidPair> given, std::uint64_t seed) {
  Pack pack;
  const auto add_bodies = [&pack](const verify::EllipsoidPair& raw) {
    const std::optional<Bodies> bodies = bodies_of(raw);
    if (!bodies) return;
    for (const Ellipsoid& body : {bodies->a, bodies->b}) {
      if (PlacedPairs::takes(body)) pack.bodies.push_back(body);
    }
  };
  for (const verify::EllipsoidPair& pair : given) add_bodies(pair);
  Moving moving(given, seed);
  for (std::size_t k = 0; pack.bodies.size() < kPlacedBodies && k < kPlacedBodies; ++k) {
    verify::EllipsoidPair& pair = moving.pair();
    moving.move(pair);
    add_bodies(pair);
  }
  if (pack.bodies.empty()) return pack;
  PlacedPairs placed(pack.bodies, seed);
  for (std::size_t k = 0; k < kPlacedPairs; ++k) {
    const PlacedPair pair = placed.draw();
    pack.pairs.push_back(pair.bodies);
    pack.separations.push_back(pair.separation);
    pack.normals.push_back(pair.normal);
    pack.known.push_back(pair.gap);
  }
  return pack;
}

}  // namespace tangency::testing::fuzz
