// SPDX-License-Identifier: GPL-3.0-or-later
// One frame of a simulation that others step: 2500 moving bodies of aspect ratios to 3, whose poses
// come as columns of floats, and 6000 pairs within reach. Timed are the refresh of the bodies, the
// gaps with their normals, what the arms and the contact points add, and the whole frame, on one
// thread, at the best instruction sets; as ratios to the throughput of Eigen's 3x3 inverse too.
// Where it was built with TANGENCY_BUILD_PEERS, Simbody, FCL and MuJoCo are asked for the same
// contacts beside it.
//
// Before anything is timed, every contact is held against the single call.
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/neighbours.hpp>
#ifdef TANGENCY_BENCH_PEERS
#include <tangency/bench/peers/isolate.hpp>
#include <tangency/bench/peers/peer.hpp>
#endif

namespace {

using namespace tangency;
using bench::Job;

constexpr std::uint64_t kSeed = 20261130;
constexpr std::size_t kBodies = 2500, kPairs = 6000;
constexpr double kMostAspect = 3.0;
constexpr std::size_t kSide = 14;  // bodies along an edge of the grid about which they lie
constexpr double kSpacing = 2.0;   // of that grid, for bodies of volume 4/3 pi; chosen: half full
constexpr double kJitter = 0.5;    // of bodies along each axis; chosen
constexpr double kDeepest = 0.02;  // by which two of them overlap at most; chosen: a stiff contact
constexpr double kLooked = 0.6;    // reach within which the nearest pairs are looked for; chosen
// Of the largest semi-axis of a pair. Chosen: normals of Accuracy::standard() are within some 1e-8
// rad, radii of curvature at most kMostAspect times that axis; a wrong point is off by more.
constexpr double kPointError = 1e-6;

/// As an engine has them: seven floats a body, x y z and w x y z.
using Pose = std::array<float, 7>;

struct Frame {
  Frame() {
    for (std::size_t k = 0; k < kBodies; ++k) place(k);
    bodies.assign(semi_axes, columns());
    find_pairs();
  }

  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  }

  /// A body that overlaps none of those before by more than kDeepest: of some that are drawn, or
  /// smaller than they are.
  void place(std::size_t k) {
    const double aspect = between(1.0, kMostAspect), middle = between(1.0, aspect);
    const double size = 1.0 / std::cbrt(aspect * middle);
    semi_axes.emplace_back(size, size * middle, size * aspect);
    poses.emplace_back();
    for (int tries = 1;; ++tries) {
      draw_pose(k);
      if (is_free(k)) return;
      if (tries % 200 == 0) semi_axes[k] *= 0.95;
    }
  }
  void draw_pose(std::size_t k) {
    const std::array<std::size_t, 3> at{k % kSide, k / kSide % kSide, k / (kSide * kSide)};
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = kSpacing * static_cast<double>(at[i]) + between(-kJitter, kJitter);
      poses[k][i] = static_cast<float>(x);
    }
    const double w = between(0.5, 1.0), x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    const std::array<double, 4> turn{w, x, y, z};
    for (std::size_t i = 0; i < 4; ++i) poses[k][3 + i] = static_cast<float>(turn[i] / length);
  }
  Ellipsoid body(std::size_t k) const {
    const Pose& p = poses[k];
    return {Vec3(p[0], p[1], p[2]), semi_axes[k], Quaternion(p[3], p[4], p[5], p[6])};
  }
  bool is_free(std::size_t k) const {
    const Ellipsoid one = body(k);
    const std::size_t looked_back = kSide * kSide + kSide + 1;  // one layer, row and place
    for (std::size_t j = k > looked_back ? k - looked_back : 0; j < k; ++j) {
      const Ellipsoid other = body(j);
      const double radii = one.largest_semi_axis() + other.largest_semi_axis();
      if ((one.centre() - other.centre()).squaredNorm() > radii * radii) continue;
      if (signed_gap(one, other).gap < -kDeepest) return false;
    }
    return true;
  }

  PoseColumns columns() const {
    const auto column = [&](std::size_t first) {
      return Strided<float>{poses[0].data() + first, poses.size(),
                            static_cast<std::ptrdiff_t>(sizeof(Pose))};
    };
    return {{column(3), QuaternionOrder::wxyz}, column(0)};
  }

  /// The pairs that are nearest, so many of them.
  void find_pairs() {
    const Neighbours found =
        neighbours(bodies, {.reach = kLooked, .answers = NeighbourAnswers::gaps});
    if (found.size() < kPairs) {
      std::fprintf(stderr, "%zu pairs within %g, not %zu: no timing\n", found.size(), kLooked,
                   kPairs);
      std::exit(1);
    }
    std::vector<double> gaps = found.gap;
    std::nth_element(gaps.begin(), gaps.begin() + (kPairs - 1), gaps.end());
    reach = gaps[kPairs - 1];
    for (std::size_t k = 0; k < found.size() && pairs.size() < kPairs; ++k)
      if (found.gap[k] <= reach) pairs.push_back({found.pairs[k].a, found.pairs[k].b});
  }

  std::mt19937_64 random{kSeed};
  std::vector<Vec3> semi_axes;
  std::vector<Pose> poses;
  MovingBodies bodies;
  double reach = 0.0;
  std::vector<IndexedPair> pairs;
};

/// Answers, and what is done to get them.
struct Contacts {
  explicit Contacts(Frame& of) : frame(of) {}

  void refresh() const { frame.bodies.set_poses(0, frame.columns()); }
  void find_gaps() {
    signed_gaps(frame.bodies, {frame.pairs, {}},
                {.gap = gap, .gap_error = gap_error, .normal = normal});
  }
  void find_gaps_and_arms() {
    signed_gaps(frame.bodies, {frame.pairs, {}},
                {.gap = gap, .gap_error = gap_error, .normal = normal, .arm_a = arm_a});
  }
  void find_points() {
    const std::span<const Vec3> centres = frame.bodies.centres();
    for (std::size_t k = 0; k < kPairs; ++k)
      point[k] = centres[frame.pairs[k].a] + arm_a[k] + (0.5 * gap[k]) * normal[k];
  }
  void step() {
    refresh();
    find_gaps_and_arms();
    find_points();
  }
  void follow() {
    refresh();
    follow_gaps(frame.bodies, {frame.pairs, {}}, normal,
                {.gap = gap, .gap_error = gap_error, .normal = normal, .arm_a = arm_a});
    find_points();
  }

  /// Ends the program unless every contact is that of the single call.
  void require_right(const std::string& when) const {
    for (std::size_t k = 0; k < kPairs; ++k) {
      const Ellipsoid a = frame.bodies[frame.pairs[k].a], b = frame.bodies[frame.pairs[k].b];
      const Gap alone = signed_gap(a, b);
      const Vec3 middle = 0.5 * (a.centre() + alone.arm_a + b.centre() + alone.arm_b);
      const double largest = std::max(a.largest_semi_axis(), b.largest_semi_axis());
      const bool right = std::abs(gap[k] - alone.gap) <= gap_error[k] + alone.gap_error &&
                         (gap[k] > 0.0) == (alone.gap > 0.0) &&
                         (point[k] - middle).norm() < kPointError * largest;
      if (right) continue;
      std::fprintf(stderr, "%s: pair %zu is answered wrongly: no timing\n", when.c_str(), k);
      std::exit(1);
    }
  }

  Frame& frame;
  std::vector<double> gap = std::vector<double>(kPairs), gap_error = gap;
  std::vector<Vec3> normal = std::vector<Vec3>(kPairs), arm_a = normal, point = normal;
};

struct Row {
  std::string name;
  std::size_t job;
  std::size_t answers;  ///< bodies or pairs
};

class Table {
 public:
  Table() : jobs_{bench::inverse_job()} {}

  /// @param times  how often it stands for what is named: pairs or bodies of a frame
  void add(const std::string& name, std::int64_t level, std::size_t times,
           std::function<void()> run) {
    rows_.push_back({name, jobs_.size(), times});
    jobs_.push_back({std::move(run), times, level});
  }
  void print() {
    bench::time_by_turns(jobs_, {.rounds = 15, .shortest = 0.02, .enough = 20.0});
    std::printf("%-52s %10s %10s %10s\n", "", "ms a frame", "ns each", "inverses");
    for (const Row& row : rows_) {
      const double each = jobs_[row.job].least;
      std::printf("%-52s %10.4f %10.1f %10.1f\n", row.name.c_str(),
                  1e-6 * each * static_cast<double>(row.answers), each, each / jobs_[0].least);
    }
  }

 private:
  std::vector<Job> jobs_;
  std::vector<Row> rows_;
};

void add_ours(Contacts& contacts, std::int64_t level, Table& table) {
  const std::string end = std::string(", ") + hwy::TargetName(level);
  bench::force_level(level);
  contacts.step();
  contacts.require_right("step" + end);
  contacts.follow();
  contacts.require_right("follow" + end);
  bench::force_level(0);
  table.add("refresh" + end, level, kBodies, [&] { contacts.refresh(); });
  table.add("gaps and normals" + end, level, kPairs, [&] { contacts.find_gaps(); });
  table.add("gaps, normals and arms" + end, level, kPairs, [&] { contacts.find_gaps_and_arms(); });
  table.add("points from them" + end, level, kPairs, [&] { contacts.find_points(); });
  table.add("frame" + end, level, kPairs, [&] { contacts.step(); });
  table.add("frame, normals followed" + end, level, kPairs, [&] { contacts.follow(); });
}

#ifdef TANGENCY_BENCH_PEERS
using PeerPairs = std::vector<std::unique_ptr<peers::PeerPair>>;

verify::RawEllipsoid raw(const Ellipsoid& body) {
  const Vec3 &c = body.centre(), &r = body.semi_axes();
  const Quaternion q = body.orientation();
  return {{c[0], c[1], c[2]}, {r[0], r[1], r[2]}, {q.w(), q.x(), q.y(), q.z()}};
}

/// The contacts alone: shapes and poses are prepared before.
void add_peers(const Frame& frame, std::span<const std::unique_ptr<peers::Peer>> all,
               Table& table) {
  for (const auto& peer : all) {
    PeerPairs pairs;
    for (const IndexedPair& pair : frame.pairs)
      pairs.push_back(peer->prepare(raw(frame.bodies[pair.a]), raw(frame.bodies[pair.b])));
    const auto safe = std::make_shared<PeerPairs>();
    std::size_t ended = 0, k = 0;
    for (const peers::Isolated& seen : peers::ask_isolated(pairs)) {
      const bool stays =
          seen.outcome == peers::Outcome::answered || seen.outcome == peers::Outcome::failed;
      if (stays) safe->push_back(std::move(pairs[k]));
      ended += stays ? 0 : 1;
      ++k;
    }
    if (safe->empty()) continue;
    const peers::PeerDescription what = peer->description();
    std::string name = what.name + " " + what.call + ", " + what.options;
    if (ended > 0) name += " (" + std::to_string(ended) + " pairs end it)";
    table.add(name, 0, safe->size(), [safe] {
      for (const auto& pair : *safe) benchmark::DoNotOptimize(pair->contact());
    });
  }
}
#endif

}  // namespace

int main() {
  Frame frame;
  Contacts contacts(frame);
  Table table;
  std::size_t meet = 0;
  for (const std::int64_t level : bench::best_levels()) add_ours(contacts, level, table);
  for (const double gap : contacts.gap) meet += gap < 0.0 ? 1 : 0;
  std::printf("%zu bodies, %zu pairs within %.3f of a radius, %zu of them overlap\n", kBodies,
              kPairs, frame.reach, meet);
#ifdef TANGENCY_BENCH_PEERS
  const auto all = peers::all_peers();
  add_peers(frame, all, table);
#endif
  table.print();
  return 0;
}
