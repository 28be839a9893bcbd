// SPDX-License-Identifier: GPL-3.0-or-later
// Time of contact of 10,000 pairs for one frame of 1/60 s: times_of_contact beside the single
// calls, by turns, on one thread. Before that every answer is held against the single call: the
// same status, never later than its latest time, and never earlier by more than the tolerance.
//
// Bodies of aspect to 5 fly at up to 5 sizes a second and spin at up to 10 rad/s. "apart": pairs
// whose boxes meet at the start and which do not; "boxes": all pairs whose boxes meet; "spheres":
// all whose bounding spheres meet during the frame.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/geometry/near_pairs.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/time_batch.hpp>

namespace {

using namespace tangency;
using Status = ContactTimeStatus;

constexpr std::size_t kPairs = 10'000;
constexpr double kFrame = 1.0 / 60.0, kTolerance = 1e-3 * kFrame;

class Draw {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }

 private:
  std::mt19937_64 random_{20261130};
};

struct Scene {
  std::string name;
  std::vector<Ellipsoid> bodies;
  std::vector<Motion> motions;
  std::vector<IndexedPair> pairs;
  std::unique_ptr<BodyArray> array;
};

/// Do the two count for a scene of that name?
bool counts(const std::string& name, const Ellipsoid& a, const Ellipsoid& b) {
  if (name == "spheres") return true;
  if (!a.bounding_box().intersects(b.bounding_box())) return false;
  return name == "boxes" || !overlaps(a, b);
}

std::unique_ptr<Scene> scene(const std::string& name) {
  Draw draw;
  auto made = std::make_unique<Scene>();
  made->name = name;
  constexpr int kBodies = 6000;
  std::vector<Vec3> centres;
  std::vector<double> reaches;
  for (int i = 0; i < kBodies; ++i) {
    const double longest = draw.uniform(0.5, 1.0);
    const double second = std::pow(5.0, -draw.uniform(0.0, 1.0));
    const double third = std::pow(5.0, -draw.uniform(0.0, 1.0));
    const Vec3 centre = draw.in_cube(10.0), turn = draw.in_cube(1.0);
    made->bodies.emplace_back(centre, longest * Vec3(1.0, second, third),
                              Quaternion(draw.uniform(0.1, 1.0), turn.x(), turn.y(), turn.z()));
    const Vec3 velocity = draw.in_cube(5.0);
    made->motions.push_back({velocity, draw.in_cube(10.0), Vec3::Zero()});
    centres.push_back(centre);
    reaches.push_back(longest + 5.0 * std::sqrt(3.0) * kFrame);
  }
  for (const NearPair& pair : near_pairs(centres, reaches)) {
    const IndexedPair indexed{static_cast<std::uint32_t>(pair.a),
                              static_cast<std::uint32_t>(pair.b)};
    if (!counts(name, made->bodies[indexed.a], made->bodies[indexed.b])) continue;
    made->pairs.push_back(indexed);
    if (made->pairs.size() == kPairs) break;
  }
  if (made->pairs.size() != kPairs) {
    std::fprintf(stderr, "%s: %zu pairs\n", name.c_str(), made->pairs.size());
    std::exit(1);
  }
  made->array = std::make_unique<BodyArray>(std::span<const Ellipsoid>(made->bodies));
  return made;
}

TimeOfContact single(const Scene& s, std::size_t i) {
  const auto [a, b] = s.pairs[i];
  return time_of_contact(s.bodies[a], s.motions[a], s.bodies[b], s.motions[b], kFrame, kTolerance);
}

struct Answers {
  std::vector<Status> status = std::vector<Status>(kPairs);
  std::vector<double> time = std::vector<double>(kPairs), latest = std::vector<double>(kPairs);
  std::vector<Vec3> normal = std::vector<Vec3>(kPairs);
  TimeColumns columns() {
    return {.status = status, .time = time, .latest = latest, .normal = normal};
  }
};

void ask(const Scene& s, Answers& answers, int threads) {
  times_of_contact(*s.array, s.motions, {s.pairs, {}}, kFrame, kTolerance, answers.columns(),
                   threads);
}

void require_right(const Scene& s, const Answers& answers) {
  std::size_t counts[5] = {};
  for (std::size_t i = 0; i < kPairs; ++i) {
    const TimeOfContact one = single(s, i);
    const bool same = answers.status[i] == one.status;
    const bool late = answers.time[i] > one.latest;
    const bool early =
        answers.time[i] < one.time - kTolerance || answers.latest[i] > answers.time[i] + kTolerance;
    if (!same || late || early) {
      std::fprintf(stderr, "%s: pair %zu: %d at %.17g, by the single call %d at %.17g: no timing\n",
                   s.name.c_str(), i, static_cast<int>(answers.status[i]), answers.time[i],
                   static_cast<int>(one.status), one.time);
      std::exit(1);
    }
    ++counts[static_cast<std::size_t>(one.status)];
  }
  std::printf("%-8s none %zu, contact %zu, touching at the start %zu, other %zu\n", s.name.c_str(),
              counts[0], counts[1], counts[2], counts[3] + counts[4]);
}

}  // namespace

int main() {
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<bench::Job> jobs;
  for (const char* name : {"apart", "boxes", "spheres"}) {
    const Scene& s = *scenes.emplace_back(scene(name));
    const auto answers = std::make_shared<Answers>();
    ask(s, *answers, 1);
    require_right(s, *answers);
    jobs.push_back({[&s, answers] { ask(s, *answers, 1); }, kPairs});
    jobs.push_back({[&s] {
                      for (std::size_t i = 0; i < kPairs; ++i)
                        benchmark::DoNotOptimize(single(s, i));
                    },
                    kPairs});
  }
  bench::time_by_turns(jobs, {.rounds = 15, .shortest = 0.02, .enough = 2.0});
  std::printf("%zu pairs, one frame, ms of processor time\n", kPairs);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double batch = jobs[2 * i].least, calls = jobs[2 * i + 1].least;
    std::printf("%-8s batch %7.2f   single calls %7.2f   ratio %5.1f\n", scenes[i]->name.c_str(),
                1e-6 * batch * kPairs, 1e-6 * calls * kPairs, calls / batch);
  }
  return 0;
}
