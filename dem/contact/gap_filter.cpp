// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/gap_filter.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <tangency/dem/bodies.hpp>
#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Pairs that one thread looks at at a time. Chosen: their columns stay near the processor.
constexpr std::size_t kBlock = 512;

/// Relative rounding of the quick looks below, and more: they keep what is in doubt.
constexpr double kRounding = 0x1p-40;

struct Candidate {
  Vec3 branch;  ///< from a's centre to that of b's image
  double skin;  ///< of the pair

  /// Are the bounding spheres apart by more than their skins? True also of what is not finite.
  bool is_far(double radius_a, double radius_b) const {
    const double reach = radius_a + radius_b + skin;
    return !(branch.squaredNorm() <= (1.0 + kRounding) * reach * reach);
  }
};

/// An ellipsoid with its row in the batch, whose support function takes a part of the time of
/// Ellipsoid::support() and errs by some roundings where the body is moderate().
struct RowBody {
  const Ellipsoid& body;
  const tangency::detail::LaneBody& row;

  double largest_semi_axis() const { return body.largest_semi_axis(); }
  double smallest_semi_axis() const { return body.smallest_semi_axis(); }
};

double support(const RowBody& body, const Vec3& n) {
  if (!body.body.moderate()) return body.body.support(n);
  return (Eigen::Map<const Mat3>(body.row.factor).transpose() * n).norm();
}
double support(const Ellipse& body, const Vec3& n) { return body.support(n.head<2>()); }

/// Does the plane across n, of any length, part two bodies by more than their skins?
template <class Body>
bool is_parted(const Body& a, const Body& b, const Candidate& candidate, const Vec3& across) {
  const Vec3 n = across / across.norm();  // not finite: compares false
  const double needed = support(a, n) + support(b, n) + candidate.skin;
  return n.dot(candidate.branch) > (1.0 + kRounding) * needed;
}

enum class Look { near, apart, doubtful };

/// A quick look at a candidate by the balls inside the bodies and the direction of the centres:
/// docs/derivations/neighbour-list.md.
template <class Body>
Look quick_look(const Body& a, const Body& b, const Candidate& candidate) {
  if (candidate.is_far(a.largest_semi_axis(), b.largest_semi_axis())) return Look::apart;
  const double inside = a.smallest_semi_axis() + b.smallest_semi_axis() + candidate.skin;
  if (candidate.branch.squaredNorm() <= inside * inside) return Look::near;
  return is_parted(a, b, candidate, candidate.branch) ? Look::apart : Look::doubtful;
}

struct Assembly {
  const Particles& particles;
  const Cell& cell;
  std::span<const double> skins;

  Candidate candidate(const NearPair& pair) const {
    const auto& [a, b, image] = pair;
    return {particles.position[b] + cell.translation(image) - particles.position[a],
            skins[a] + skins[b]};
  }
};

struct Spheres {};

void look_at(std::span<const NearPair> pairs, const Assembly& assembly, Spheres,
             std::span<std::uint8_t> keep) {
  const std::vector<Vec3>& axes = assembly.particles.semi_axes;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    keep[k] = assembly.candidate(pairs[k]).is_far(axes[pairs[k].a][0], axes[pairs[k].b][0]) ? 0 : 1;
}

void look_at(std::span<const NearPair> pairs, const Assembly& assembly,
             std::span<const Ellipse> ellipses, std::span<std::uint8_t> keep) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Candidate candidate = assembly.candidate(pairs[k]);
    const Ellipse &a = ellipses[pairs[k].a], &b = ellipses[pairs[k].b];
    const Look look = quick_look(a, b, candidate);
    keep[k] = look == Look::apart ? 0 : 1;
    if (look != Look::doubtful) continue;
    const PlaneGap found = signed_gap(a, b, Vec2(candidate.branch.head<2>()));
    keep[k] = found.gap - found.gap_error > candidate.skin ? 0 : 1;
  }
}

/// Candidates of a block in columns.
struct Columns {
  std::array<IndexedPair, kBlock> pairs;
  std::array<Vec3, kBlock> branches;
  std::array<double, kBlock> skins;
  std::array<std::size_t, kBlock> place;  ///< in the block
  std::size_t count = 0;

  void add(const IndexedPair& pair, const Vec3& branch, double skin, std::size_t at) {
    pairs[count] = pair;
    branches[count] = branch;
    skins[count] = skin;
    place[count++] = at;
  }
  PairList list() const {
    return {std::span(pairs).first(count), std::span(branches).first(count)};
  }
};

void look_at(std::span<const NearPair> pairs, const Assembly& assembly, const BodyArray& bodies,
             std::span<std::uint8_t> keep) {
  Columns doubtful, apart;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Candidate candidate = assembly.candidate(pairs[k]);
    const auto a = pairs[k].a, b = pairs[k].b;
    const Look look = quick_look(RowBody{bodies[a], bodies.lanes()[a]},
                                 RowBody{bodies[b], bodies.lanes()[b]}, candidate);
    keep[k] = look == Look::apart ? 0 : 1;
    if (look == Look::doubtful) doubtful.add({a, b}, candidate.branch, candidate.skin, k);
  }
  // Whether two meet is told in bounded time; the gap of two that overlap deeply takes a search.
  std::array<std::optional<bool>, kBlock> meet;
  overlaps_by_filter(bodies, doubtful.list(), std::span(meet).first(doubtful.count));
  for (std::size_t k = 0; k < doubtful.count; ++k)
    if (meet[k] == false)
      apart.add(doubtful.pairs[k], doubtful.branches[k], doubtful.skins[k], doubtful.place[k]);
  std::array<double, kBlock> gaps, errors;
  GapColumns columns;
  columns.gap = std::span(gaps).first(apart.count);
  columns.gap_error = std::span(errors).first(apart.count);
  signed_gaps(bodies, apart.list(), columns, Accuracy::fast());
  for (std::size_t k = 0; k < apart.count; ++k)
    keep[apart.place[k]] = gaps[k] - errors[k] > apart.skins[k] ? 0 : 1;
}

template <class Bodies>
std::vector<std::uint8_t> looked_at(std::span<const NearPair> pairs, const Assembly& assembly,
                                    const Bodies& bodies) {
  std::vector<std::uint8_t> keep(pairs.size(), 1);
  const std::size_t blocks = (pairs.size() + kBlock - 1) / kBlock;
  for_ranges(blocks, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t first = k * kBlock, count = std::min(kBlock, pairs.size() - first);
      look_at(pairs.subspan(first, count), assembly, bodies, std::span(keep).subspan(first, count));
    }
  });
  return keep;
}

}  // namespace

std::vector<std::uint8_t> within_skins(std::span<const NearPair> pairs, const Particles& particles,
                                       const Cell& cell, std::span<const double> skins) {
  const Assembly assembly{particles, cell, skins};
  if (are_round(particles)) return looked_at(pairs, assembly, Spheres{});
  const std::size_t count = particles.size();
  if (particles.dimensions == 2) {
    std::vector<Ellipse> ellipses(count, Ellipse(Vec2::Zero(), Vec2::Ones()));
    for (std::size_t i = 0; i < count; ++i) ellipses[i] = ellipse_of(particles, i);
    return looked_at<std::span<const Ellipse>>(pairs, assembly, ellipses);
  }
  std::vector<Ellipsoid> ellipsoids(count, Ellipsoid(Vec3::Zero(), Vec3::Ones()));
  for_ranges(count, kParallelThreshold, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) ellipsoids[i] = ellipsoid_of(particles, i);
  });
  return looked_at(pairs, assembly, BodyArray(std::span<const Ellipsoid>(ellipsoids)));
}

}  // namespace tangency::inline v0::dem
