// SPDX-License-Identifier: GPL-3.0-or-later
// Holds neighbours() against all images of all pairs, each asked of the exact oracle (of exact
// rational numbers where an image's centre is no triple of doubles): sizes to 1:1000, needles and
// plates of 100:1, cells thinner than a body, bodies that just touch, bodies on the border, 0 to
// 5000 bodies, any periodic axes. The merge gate runs a part of it; docs/testing.md names the
// whole.
#include <Eigen/LU>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <tangency/geometry/image_gap.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace {

using namespace tangency;
using verify::Draw;

struct Scene {
  std::vector<Ellipsoid> bodies;
  Lattice lattice = Lattice::open();
  /// Are centres and edges multiples of 2^-16, so that every image's centre is a triple of doubles?
  bool on_grid = true;
};

double on_grid(double x) { return std::round(x * 0x1p16) * 0x1p-16; }
Vec3 on_grid(const Vec3& v) { return {on_grid(v[0]), on_grid(v[1]), on_grid(v[2])}; }

Vec3 anywhere(Draw& draw) {
  const double x = draw.real(-0.5, 1.5), y = draw.real(-0.5, 1.5);
  return {x, y, draw.real(-0.5, 1.5)};
}
Quaternion turned(Draw& draw) {
  const std::array<double, 4> q = draw.orientation();
  return {q[0], q[1], q[2], q[3]};
}
std::array<bool, 3> some_axes(Draw& draw) {
  const bool x = draw.coin(), y = draw.coin();
  return {x, y, draw.coin()};
}
/// Edges of about this length, on the grid; skewed in half of the cases.
Mat3 cell(Draw& draw, double length) {
  Mat3 edges = Mat3::Zero();
  const bool skewed = draw.coin();
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k) {
      const double share = i == k ? draw.real(0.8, 1.25) : draw.real(-0.7, 0.7);
      if (i == k || skewed) edges(i, k) = on_grid(share * length);
    }
  return edges;
}

/// In and around a cell of which a share is filled, by bodies of the axes that are drawn.
template <class Axes>
Scene filled(Draw& draw, std::size_t count, double share, const Axes& axes) {
  std::vector<Vec3> all;
  double volume = 0.0;
  for (std::size_t i = 0; i < count; ++i) all.push_back(axes());
  for (const Vec3& a : all) volume += 4.2 * a.prod();
  Scene scene;
  scene.lattice = {cell(draw, std::cbrt((volume + 1e-6) / share)), some_axes(draw)};
  for (const Vec3& a : all) {
    const Vec3 at = scene.lattice.edges * anywhere(draw);
    scene.bodies.emplace_back(on_grid(at), a, turned(draw));
  }
  return scene;
}

Scene of_many_sizes(Draw& draw) {
  const auto count = static_cast<std::size_t>(draw.log_uniform(1.0, 5001.0)) - 1;
  const double ratio = draw.log_uniform(1.0, 1000.0);
  return filled(draw, count, draw.real(0.05, 0.5), [&] {
    const double size = draw.log_uniform(1.0 / ratio, 1.0);
    const double x = draw.real(0.5, 1.0), y = draw.real(0.5, 1.0);
    return Vec3(size * x, size * y, size);
  });
}
Scene of_needles_and_plates(Draw& draw) {
  const auto count = static_cast<std::size_t>(draw.integer(0, 120));
  const double aspect = draw.log_uniform(10.0, 100.0);
  return filled(draw, count, draw.log_uniform(1e-3, 0.3), [&] {
    const double other = draw.coin() ? 1.0 : aspect;
    return draw.coin() ? Vec3(1.0, other, aspect) : Vec3(aspect, 1.0, other);
  });
}
Scene of_thin_cells(Draw& draw) {
  Scene scene;
  scene.lattice = {cell(draw, draw.real(0.6, 1.5)), some_axes(draw)};
  scene.lattice.periodic[static_cast<std::size_t>(draw.integer(0, 2))] = true;
  const int count = draw.integer(1, 5);
  for (int i = 0; i < count; ++i) {
    const double x = draw.log_uniform(0.1, 2.0), y = draw.log_uniform(0.1, 2.0);
    const Vec3 at = scene.lattice.edges * anywhere(draw), axes(x, y, draw.log_uniform(0.1, 2.0));
    scene.bodies.emplace_back(on_grid(at), axes, turned(draw));
  }
  return scene;
}
/// Of equal axes that are multiples of 1/8, in rows that fill the cell: neighbours just touch.
Scene of_touching_rows(Draw& draw) {
  Scene scene;
  Vec3 axes, start;
  std::array<int, 3> count{};
  Mat3 edges = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    axes[k] = 0.125 * draw.integer(1, 12);
    start[k] = on_grid(draw.real(-3.0, 3.0));
    count[static_cast<std::size_t>(k)] = draw.integer(1, 5);
    edges(k, k) = 2.0 * axes[k] * count[static_cast<std::size_t>(k)];
  }
  scene.lattice = {edges, some_axes(draw)};
  for (int x = 0; x < count[0]; ++x)
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < count[2]; ++z) {
        const Vec3 at = start + 2.0 * axes.cwiseProduct(Vec3(x, y, z));
        scene.bodies.emplace_back(at, axes);
      }
  draw.shuffle(scene.bodies);
  return scene;
}
/// Centres on faces, edges and corners of the cell, and a step of the grid beside them.
Scene of_border(Draw& draw) {
  const auto count = static_cast<std::size_t>(draw.integer(2, 150));
  Scene scene = filled(draw, count, 0.2, [&] {
    const double x = draw.real(0.3, 1.0), y = draw.real(0.3, 1.0);
    return Vec3(x, y, draw.real(0.3, 1.0));
  });
  scene.lattice.periodic = {true, true, true};
  for (Ellipsoid& body : scene.bodies) {
    Vec3 share;
    for (int k = 0; k < 3; ++k)
      share[k] = draw.integer(0, 2) == 0 ? draw.real(0.0, 1.0) : draw.integer(-2, 2);
    Vec3 at = on_grid(scene.lattice.edges * share);
    at[draw.integer(0, 2)] += 0x1p-16 * draw.integer(-1, 1);
    body = body.moved_to(at);
  }
  return scene;
}
/// Balls that just touch an image, of edges whose multiples are no doubles: n L away less or more
/// than a diameter, which are doubles.
Scene of_unrounded_touches(Draw& draw) {
  Scene scene;
  scene.on_grid = false;
  const double length = draw.real(6.0, 7.0);
  scene.lattice.edges = Vec3(length, draw.real(3.0, 9.0), draw.real(3.0, 9.0)).asDiagonal();
  scene.lattice.periodic = {true, draw.coin(), draw.coin()};
  const int count = draw.integer(1, 6);
  for (int i = 0; i < count; ++i) {
    const double y = draw.real(0.0, 20.0);
    const double times = draw.one_of(std::array{1.0, 2.0, 4.0, 8.0});
    const double other = draw.coin() ? 1.0 : -1.0, step = draw.integer(-1, 1) * 0x1p-50;
    scene.bodies.emplace_back(Vec3(times * length + other + step, y, 0.0), Vec3::Constant(0.5));
    scene.bodies.emplace_back(Vec3(0.0, y, 0.0), Vec3::Constant(0.5));
  }
  return scene;
}

using Kind = Scene (*)(Draw&);
constexpr std::array<Kind, 6> kKinds{of_many_sizes, of_needles_and_plates,
                                     of_thin_cells, of_touching_rows,
                                     of_border,     of_unrounded_touches};

using Rational3 = std::array<mpq_class, 3>;
Rational3 exactly(const Vec3& v) { return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])}; }

/// The balls share a point; centres and radii meant exactly.
bool balls_meet(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
                const LatticeImage& image) {
  Rational3 d = exactly(b.centre());
  const Rational3 from = exactly(a.centre());
  mpq_class square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] -= from[i];
    for (std::size_t k = 0; k < 3; ++k)
      d[i] += mpq_class(edges(static_cast<int>(i), static_cast<int>(k))) * image[k];
    square += d[i] * d[i];
  }
  const mpq_class sum = mpq_class(a.semi_axes()[0]) + mpq_class(b.semi_axes()[0]);
  return square <= sum * sum;
}

bool share_a_point(const Scene& scene, const NearPair& pair, const Vec3& moved) {
  const Ellipsoid &a = scene.bodies[pair.a], &b = scene.bodies[pair.b];
  if (!scene.on_grid) return balls_meet(a, b, scene.lattice.edges, pair.image);
  const auto answer =
      verify::exact_relation(verify::to_raw(a), verify::to_raw(b.moved_to(b.centre() + moved)));
  return answer.relation != verify::Relation::separate;
}

/// use(pair, edges * image) of every pair of images whose bounding spheres, each larger by a part
/// in 10^9, come as near as `reach`.
template <class Use>
void for_each_candidate(const Scene& scene, double reach, const Use& use) {
  const Mat3& edges = scene.lattice.edges;
  const Mat3 inverse = edges.inverse();
  const auto count = static_cast<std::uint32_t>(scene.bodies.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a; b < count; ++b) {
      const double radii =
          scene.bodies[a].largest_semi_axis() + scene.bodies[b].largest_semi_axis();
      const double most = (radii + reach) * (1.0 + 1e-9) + 1e-9;
      const Vec3 d = scene.bodies[b].centre() - scene.bodies[a].centre();
      const Vec3 middle = -(inverse * d);
      LatticeImage low{}, high{}, image{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!scene.lattice.periodic[k]) continue;
        const double half = most * inverse.row(static_cast<int>(k)).norm() + 1e-3;
        low[k] = static_cast<std::int32_t>(std::ceil(middle[static_cast<int>(k)] - half));
        high[k] = static_cast<std::int32_t>(std::floor(middle[static_cast<int>(k)] + half));
      }
      for (image[0] = low[0]; image[0] <= high[0]; ++image[0])
        for (image[1] = low[1]; image[1] <= high[1]; ++image[1])
          for (image[2] = low[2]; image[2] <= high[2]; ++image[2]) {
            if (a == b && image <= LatticeImage{}) continue;
            const Vec3 moved = edges * Vec3(image[0], image[1], image[2]);
            if ((d + moved).squaredNorm() <= most * most) use(NearPair{a, b, image}, moved);
          }
    }
}

struct Tally {
  std::atomic<long> scenes{0}, bodies{0}, candidates{0}, pairs{0}, touching{0}, own{0}, moved{0};
  std::atomic<long> missed{0}, wrong{0}, differing{0}, bad_answers{0};

  bool print() const {
    std::printf(
        "%ld scenes, %ld bodies: %ld pairs of %ld that came near; %ld touch, %ld are of "
        "images, %ld of a body and its own\n",
        scenes.load(), bodies.load(), pairs.load(), candidates.load(), touching.load(),
        moved.load(), own.load());
    std::printf("%ld missed, %ld listed wrongly, %ld lists that differ, %ld answers wrong\n",
                missed.load(), wrong.load(), differing.load(), bad_answers.load());
    const bool right = missed == 0 && wrong == 0 && differing == 0 && bad_answers == 0;
    return right && touching > 0 && own > 0 && moved > 0 && pairs > scenes;
  }
};

void check_list(const Scene& scene, const std::vector<NearPair>& found, Tally& tally) {
  std::vector<NearPair> expected;
  for_each_candidate(scene, 0.0, [&](const NearPair& pair, const Vec3& moved) {
    ++tally.candidates;
    if (share_a_point(scene, pair, moved)) expected.push_back(pair);
  });
  std::vector<NearPair> difference;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(),
                      std::back_inserter(difference));
  tally.missed += static_cast<long>(difference.size());
  difference.clear();
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                      std::back_inserter(difference));
  tally.wrong += static_cast<long>(difference.size());
  if (std::adjacent_find(found.begin(), found.end(), std::greater_equal<>()) != found.end())
    ++tally.wrong;  // out of order, or twice
  tally.pairs += static_cast<long>(expected.size());
}

/// Every way to ask gives the same pairs.
void check_ways(const Scene& scene, const std::vector<NearPair>& found, Tally& tally) {
  NeighbourQuestion question{.lattice = scene.lattice, .threads = 3};
  if (neighbours(scene.bodies, question).pairs != found) ++tally.differing;
  std::vector<NearPair> handed_over;
  for_each_neighbours(scene.bodies, question, [&](const NeighbourBlock& block) {
    handed_over.insert(handed_over.end(), block.pairs.begin(), block.pairs.end());
  });
  std::sort(handed_over.begin(), handed_over.end());
  if (handed_over != found) ++tally.differing;
  std::vector<Vec3> axes, centres;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : scene.bodies) {
    axes.push_back(body.semi_axes());
    centres.push_back(body.centre());
    turns.push_back(body.orientation());
  }
  if (neighbours(MovingBodies(axes, {turns, centres}), question).pairs != found) ++tally.differing;
}

void check_answers(const Scene& scene, Tally& tally) {
  const Mat3& edges = scene.lattice.edges;
  const Neighbours touching =
      neighbours(scene.bodies, {.lattice = scene.lattice, .answers = NeighbourAnswers::contacts});
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const auto& [a, b, image] = touching.pairs[k];
    tally.own += a == b;
    tally.moved += image != LatticeImage{};
    tally.touching += touching.gap[k] == 0.0;
    const bool meet = touching.overlaps[k] == 1;
    if ((touching.gap[k] < 0.0) != meet || touching.gap[k] > 0.0) ++tally.bad_answers;
    const Gap alone = signed_gap(scene.bodies[a], scene.bodies[b], edges, image);
    const bool known = alone.status == GapStatus::ok && touching.status[k] == GapStatus::ok;
    const double apart = std::abs(alone.gap - touching.gap[k]);
    if (known && !(apart <= (alone.gap_error + touching.gap_error[k]) * (1.0 + 0x1p-40)))
      ++tally.bad_answers;
  }
}

/// With a reach: all whose gap is proven to be within it, none that is proven to be beyond.
void check_reach(const Scene& scene, double reach, Tally& tally) {
  std::vector<NearPair> within, near;
  for_each_candidate(scene, reach, [&](const NearPair& pair, const Vec3&) {
    const Gap gap =
        signed_gap(scene.bodies[pair.a], scene.bodies[pair.b], scene.lattice.edges, pair.image);
    if (gap.gap + gap.gap_error <= reach) within.push_back(pair);
    if (gap.gap - gap.gap_error <= reach) near.push_back(pair);
  });
  for (const auto answers : {NeighbourAnswers::pairs, NeighbourAnswers::gaps}) {
    const auto found = neighbours(scene.bodies, {reach, scene.lattice, answers}).pairs;
    if (!std::includes(found.begin(), found.end(), within.begin(), within.end())) ++tally.missed;
    if (!std::includes(near.begin(), near.end(), found.begin(), found.end())) ++tally.wrong;
  }
}

void check(std::uint64_t seed, std::size_t number, Tally& tally) {
  Draw draw(seed * 1'000'003 + number);
  const Scene scene = kKinds[number % kKinds.size()](draw);
  ++tally.scenes;
  tally.bodies += static_cast<long>(scene.bodies.size());
  const auto found = neighbours(scene.bodies, {.lattice = scene.lattice}).pairs;
  check_list(scene, found, tally);
  check_ways(scene, found, tally);
  check_answers(scene, tally);
  if (scene.bodies.size() <= 150) check_reach(scene, draw.log_uniform(0.01, 1.0), tally);
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "neighbour_agreement", "Hold lists of neighbours against all images of all pairs");
  std::size_t scenes = 1000;
  unsigned threads = 2;
  program.option("--scenes", scenes, "scenes, of six kinds by turns");
  program.option("--threads", threads, "threads");
  return program.run(argc, argv, [&](std::uint64_t seed) {
    Tally tally;
    tangency::testing::for_each_part(threads, scenes,
                                     [&](std::size_t k) { check(seed, k, tally); });
    return tally.print();
  });
}
