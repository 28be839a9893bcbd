// SPDX-License-Identifier: GPL-3.0-or-later
// What it takes to find all neighbours of many bodies: ns per body, from 10^4 to 10^6 of them in
// random order, as ratios to the throughput of Eigen's 3x3 inverse timed by turns with it.
//
//     bench_neighbours [MOST]        # bodies of the largest scene; 1000000
//
// A scene is as full as a packing: spheroids of aspect 1.43, long and flat ones by turns, turned at
// random, about the points of a face-centred cubic lattice, moved from there by up to a fifth of
// the distance of neighbours, at a volume fraction of 0.6. Before anything is timed, the pairs of
// some bodies are held against the exact relation of each with all others, and their gaps against
// signed_gap().
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/relation.hpp>

namespace {

using namespace tangency;

constexpr std::uint64_t kSeed = 20261130;
constexpr double kVolumeFraction = 0.6, kAspect = 1.43;
constexpr double kJitter = 0.2;  // of the distance of neighbours; chosen
constexpr double kPi = 3.14159265358979323846;

class Draw {
 public:
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

 private:
  std::mt19937_64 random_{kSeed};
};

/// Some `count` bodies and more, of volume 4/3 pi.
std::vector<Ellipsoid> packing(std::size_t count) {
  Draw draw;
  const auto side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count) / 4.0)));
  const double edge = std::cbrt(4.0 * (4.0 / 3.0 * kPi) / kVolumeFraction);  // four bodies a cube
  const double jitter = kJitter * edge / std::sqrt(2.0);
  const Vec3 corners[] = {{0, 0, 0}, {0, .5, .5}, {.5, 0, .5}, {.5, .5, 0}};
  const double wide = std::cbrt(kAspect);
  std::vector<Ellipsoid> bodies;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        for (const Vec3& corner : corners) {
          const Vec3 off(draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1));
          const Quaternion turn(draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1), 1.0);
          const Vec3 axes = bodies.size() % 2 == 0 ? Vec3(1 / wide, 1 / wide, kAspect / wide)
                                                   : Vec3(wide, wide, wide / kAspect);
          bodies.emplace_back(edge * (Vec3(x, y, z) + corner) + jitter * off, axes, turn);
        }
  for (std::size_t i = bodies.size(); i-- > 1;) std::swap(bodies[i], bodies[draw.below(i + 1)]);
  bodies.resize(std::min(bodies.size(), count), bodies.front());
  return bodies;
}

struct Scene {
  std::vector<Ellipsoid> bodies;
  std::size_t pairs = 0;
};

/// Ends the program unless the gap of each pair of body i is that of the single call.
void require_gaps(const Scene& scene, const Neighbours& found, std::uint32_t i) {
  for (std::size_t k = 0; k < found.size(); ++k) {
    const NearPair& pair = found.pairs[k];
    if (pair.a != i && pair.b != i) continue;
    const Gap one = signed_gap(scene.bodies[pair.a], scene.bodies[pair.b]);
    const double bound = (found.gap_error[k] + one.gap_error) * (1 + 1e-12);
    if (found.gap[k] <= 0 && std::abs(found.gap[k] - one.gap) <= bound) continue;
    std::fprintf(stderr, "bodies %u and %u: gap %.17g, by the single call %.17g: no timing\n",
                 pair.a, pair.b, found.gap[k], one.gap);
    std::exit(1);
  }
}

/// Ends the program unless the pairs of some bodies are those of the exact relation, with their
/// gaps.
void require_right(Scene& scene) {
  const Neighbours found = neighbours(scene.bodies, {.answers = NeighbourAnswers::contacts});
  scene.pairs = found.size();
  const std::size_t count = scene.bodies.size(), checked = 40;
  for (std::size_t k = 0; k < checked; ++k) {
    const auto i = static_cast<std::uint32_t>(k * count / checked);
    std::vector<NearPair> expected, listed;
    for (std::uint32_t j = 0; j < count; ++j) {
      if (j == i) continue;
      if (relation(scene.bodies[i], scene.bodies[j]).relation != Relation::separate)
        expected.push_back({std::min(i, j), std::max(i, j), {}});
    }
    std::copy_if(found.pairs.begin(), found.pairs.end(), std::back_inserter(listed),
                 [&](const NearPair& pair) { return pair.a == i || pair.b == i; });
    require_gaps(scene, found, i);
    if (listed == expected) continue;
    std::fprintf(stderr, "%zu bodies: body %u has %zu neighbours and not %zu: no timing\n", count,
                 i, expected.size(), listed.size());
    std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t most = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1000000;
  if (most < 10000 || argc > 2) {
    std::fprintf(stderr, "bench_neighbours: MOST must be at least 10000\n");
    return 2;
  }
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<bench::Job> jobs{bench::inverse_job()};
  std::vector<std::string> names{"inverse"};
  const auto add = [&](const std::string& name, const Scene& scene, std::function<void()> run) {
    names.push_back(name);
    jobs.push_back({std::move(run), scene.bodies.size()});
  };
  for (std::size_t count = 10000; count <= most; count *= 10) {
    scenes.push_back(std::make_unique<Scene>(Scene{packing(count)}));
    Scene& scene = *scenes.back();
    require_right(scene);
    std::printf("%8zu bodies, %.2f pairs each\n", count,
                static_cast<double>(scene.pairs) / static_cast<double>(count));
    const std::string of = " of " + std::to_string(count);
    add("touching" + of, scene, [&] { neighbours(scene.bodies); });
    add("within a tenth of the radius" + of, scene,
        [&] { neighbours(scene.bodies, {.reach = 0.1}); });
    add("contacts" + of, scene,
        [&] { neighbours(scene.bodies, {.answers = NeighbourAnswers::contacts}); });
    add("contacts handed over" + of, scene, [&] {
      for_each_neighbours(scene.bodies, {.answers = NeighbourAnswers::contacts},
                          [](const NeighbourBlock&) {});
    });
  }
  bench::time_by_turns(jobs, {.rounds = 5, .shortest = 0.02, .enough = 12.0});
  std::printf("%-44s %10s %10s %10s\n", "", "ns a body", "s in all", "inverses");
  for (std::size_t k = 0; k < jobs.size(); ++k)
    std::printf("%-44s %10.1f %10.3f %10.1f\n", names[k].c_str(), jobs[k].least,
                1e-9 * jobs[k].least * static_cast<double>(jobs[k].pairs),
                jobs[k].least / jobs[0].least);
  return 0;
}
