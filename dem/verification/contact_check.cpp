// SPDX-License-Identifier: MIT
#include <tangency/dem/verification/contact_check.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <tangency/dem/bodies.hpp>
#include <tangency/dem/chunks.hpp>
#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/overlap_batch.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Of L, the distance of two centres and their largest semi-axes: how far from a touch the sign of
/// a gap by a formula in double may be either. Derived: a difference of three lengths, each within
/// two roundings, in 2^-53 L.
constexpr double kFormulaRounding = 8 * 0x1p-53;

/// Of L: how far from a touch the overlap may leave a pair that is moved apart by it. Chosen: five
/// times the largest gap_error of any answer that is `ok` (100 u L).
constexpr double kDepthError = 512 * 0x1p-53;

/// What rounding may take from a distance that bounding spheres are held against, relatively.
constexpr double kReachRounding = 0x1p-40;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

std::string text(double x) { return tables::to_text(x); }

void note(CheckCounts& counts, const Pair& pair, std::string what) {
  CheckCounts one;
  one.first = Disagreement{pair, std::move(what)};
  counts += one;
}

/// The wall of a pair as the body's centre sees it.
Plane wall_of(const State& state, const Pair& pair) {
  const std::size_t wall = at(pair.b) - state.particles.size();
  const WallFace face(wall, state.particles.position[at(pair.a)], state.cell);
  return {face.normal, -face.height};
}

bool is_wall(const State& state, const Pair& pair) { return at(pair.b) >= state.particles.size(); }

/// From a's centre to that of b's image; to a wall 0.
Vec3 separation_of(const State& state, const Pair& pair) {
  if (is_wall(state, pair)) return Vec3::Zero();
  return branch_vector(pair, state.particles, state.cell);
}

}  // namespace

CheckCounts& CheckCounts::operator+=(const CheckCounts& other) {
  for (const auto count :
       {&CheckCounts::contacts, &CheckCounts::apart, &CheckCounts::rounded, &CheckCounts::depths,
        &CheckCounts::followed, &CheckCounts::searched, &CheckCounts::wrong, &CheckCounts::missed})
    this->*count += other.*count;
  if (other.first && (!first || other.first->pair < first->pair)) first = other.first;
  return *this;
}

void ContactCheck::aim(const Particles& particles) {
  const std::size_t count = particles.size();
  const bool plane = particles.dimensions == 2;
  by_formula_ = plane || are_round(particles);
  radii_.resize(count);
  if (plane) ellipses_.resize(count, Ellipse(Vec2::Zero(), Vec2::Ones()));
  if (ellipsoids_.size() != count) {
    ellipsoids_.assign(count, Ellipsoid(Vec3::Zero(), Vec3::Ones()));
    array_.emplace(ellipsoids_);
  }
  for_ranges(count, kParallelThreshold, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      radii_[i] = particles.semi_axes[i].maxCoeff();
      ellipsoids_[i] = ellipsoid_of(particles, i);
      if (plane)
        ellipses_[i] = ellipse_of(particles, i);
      else
        array_->refresh(i);
    }
  });
}

bool ContactCheck::meet(const State& state, const Pair& pair, const Vec3& separation) const {
  const std::size_t a = at(pair.a), b = at(pair.b);
  if (is_wall(state, pair)) {
    const Relation found = relation(MatrixEllipsoid(ellipsoids_[a]), wall_of(state, pair)).relation;
    return found != Relation::separate && found != Relation::external_touch;
  }
  if (state.particles.dimensions == 2)
    return overlaps(ellipses_[a], ellipses_[b], separation.head<2>());
  return overlaps(ellipsoids_[a], ellipsoids_[b], separation);
}

double ContactCheck::gap(const State& state, const Pair& pair, const Vec3& separation) const {
  const std::size_t a = at(pair.a), b = at(pair.b);
  if (is_wall(state, pair)) return signed_gap(ellipsoids_[a], wall_of(state, pair)).gap;
  if (state.particles.dimensions == 2)
    return signed_gap(ellipses_[a], ellipses_[b], separation.head<2>()).gap;
  return signed_gap(ellipsoids_[a], ellipsoids_[b], separation).gap;
}

/// By the support functions, in double.
double ContactCheck::depth_along(const State& state, const Pair& pair, const Vec3& separation,
                                 const Vec3& normal) const {
  const std::size_t a = at(pair.a), b = at(pair.b);
  const double apart = normal.dot(separation);
  if (state.particles.dimensions == 2) {
    const Vec2 n = normal.head<2>();
    return ellipses_[a].support(n) + ellipses_[b].support(n) - apart;
  }
  return ellipsoids_[a].support(normal) + ellipsoids_[b].support(normal) - apart;
}

double ContactCheck::size_of(const Pair& pair, const Vec3& separation) const {
  const double of_b = at(pair.b) < radii_.size() ? radii_[at(pair.b)] : 0.0;
  return separation.norm() + radii_[at(pair.a)] + of_b;
}

/// May a formula in double have either sign?
bool ContactCheck::is_near_a_touch(const State& state, const Pair& pair,
                                   const Vec3& separation) const {
  if (!by_formula_ && !is_wall(state, pair)) return false;
  return std::abs(gap(state, pair, separation)) <= kFormulaRounding * size_of(pair, separation);
}

CheckCounts ContactCheck::check_listed(const Simulation& simulation) {
  const std::size_t count = simulation.state().list.pairs().size();
  pairs_.resize(count);
  separations_.resize(count);
  meet_.resize(count);
  return sum_by_chunks<CheckCounts>(count, [&](std::size_t first, std::size_t last) {
    return check_chunk(simulation, first, last);
  });
}

CheckCounts ContactCheck::check_chunk(const Simulation& simulation, std::size_t first,
                                      std::size_t last) {
  const State& state = simulation.state();
  const std::vector<Pair>& pairs = state.list.pairs();
  for (std::size_t k = first; k < last; ++k) {
    const bool wall = is_wall(state, pairs[k]);
    pairs_[k] = indexed_pair(pairs[k].a, wall ? pairs[k].a : pairs[k].b);
    separations_[k] = separation_of(state, pairs[k]);
  }
  const bool plane = state.particles.dimensions == 2;
  if (!plane)
    overlaps(*array_,
             PairList{std::span(pairs_).subspan(first, last - first),
                      std::span(separations_).subspan(first, last - first)},
             std::span(meet_).subspan(first, last - first));
  CheckCounts counts;
  for (std::size_t k = first; k < last; ++k) {
    const bool asked = !plane && !is_wall(state, pairs[k]);
    check_pair(simulation, k, asked ? meet_[k] != 0 : meet(state, pairs[k], separations_[k]),
               counts);
  }
  return counts;
}

void ContactCheck::check_pair(const Simulation& simulation, std::size_t k, bool meet,
                              CheckCounts& counts) {
  const State& state = simulation.state();
  const Pair& pair = state.list.pairs()[k];
  const bool touches = state.contacts.touches(k);
  if (touches != meet && is_near_a_touch(state, pair, separations_[k])) {
    ++counts.rounded;
  } else if (touches != meet) {
    ++(touches ? counts.wrong : counts.missed);
    return note(counts, pair,
                touches
                    ? "the run has a contact, overlap " +
                          text(state.contacts.columns().overlap[k]) + "; exactly, no interiors meet"
                    : "the run has no contact; exactly, the interiors meet, gap " +
                          text(gap(state, pair, separations_[k])));
  } else {
    ++(touches ? counts.contacts : counts.apart);
  }
  if (touches && (static_cast<std::int64_t>(k) + state.cycle) % kDepthTurns == 0)
    check_depth(simulation, k, counts);
}

/// Moved apart by a little more than the overlap the two no longer meet, whatever the normal is of;
/// by a little less they meet still, unless another way out is shorter, as a followed branch may
/// leave it.
void ContactCheck::check_depth(const Simulation& simulation, std::size_t k,
                               CheckCounts& counts) const {
  const State& state = simulation.state();
  const Pair& pair = state.list.pairs()[k];
  const Branch branch = simulation.scene().branch;
  if (is_wall(state, pair) || branch == Branch::trace) return;
  const Vec3& separation = separations_[k];
  const ContactColumns& columns = state.contacts.columns();
  const double error = kDepthError * size_of(pair, separation), overlap = columns.overlap[k];
  const auto wrong = [&](const std::string& what) {
    ++counts.wrong;
    note(counts, pair, what);
  };
  if (!((columns.branch[k] - separation).norm() <= error))
    return wrong("the run has the centres " + text(columns.branch[k].norm()) +
                 " apart in another direction or distance; their places are " +
                 text(separation.norm()) + " apart");
  const auto meet_after = [&](double way) {
    return meet(state, pair, separation + way * columns.normal[k]);
  };
  const auto claim = [&] {
    return "the run has an overlap of " + text(overlap) + " along its normal; ";
  };
  if (!(std::abs(columns.normal[k].norm() - 1.0) <= kDepthError) || meet_after(overlap + error))
    return wrong(claim() + "exactly, the two still meet after a move by it");
  if (overlap > error && !meet_after(overlap - error)) {
    const double along = depth_along(state, pair, separation, columns.normal[k]);
    if (branch == Branch::global || !(std::abs(along - overlap) <= error))
      return wrong(claim() + "exactly, they part earlier; along it they are " + text(along) +
                   " deep, at least " + text(-gap(state, pair, separation)));
    ++counts.followed;
  }
  ++counts.depths;
}

CheckCounts ContactCheck::check_unlisted(const Simulation& simulation, std::size_t first,
                                         std::size_t count) {
  const State& state = simulation.state();
  const std::size_t bodies = state.particles.size();
  reduced_.resize(bodies);
  for (std::size_t i = 0; i < bodies; ++i)
    reduced_[i] = state.cell.reduced(state.particles.position[i]);
  std::vector<CheckCounts> found(std::min(count, bodies));
  for_ranges(found.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) search_body(state, first, k, found[k]);
  });
  CheckCounts sum;
  for (const CheckCounts& one : found) sum += one;
  return sum;
}

/// All images of all bodies whose bounding spheres meet that of body first + turn, and all walls.
/// Bodies that have had their turn before have seen it.
void ContactCheck::search_body(const State& state, std::size_t first, std::size_t turn,
                               CheckCounts& counts) const {
  const Cell& cell = state.cell;
  const std::size_t bodies = radii_.size(), i = (first + turn) % bodies;
  const Vec3 heights = cell.heights();
  const auto self = static_cast<std::int32_t>(i);
  ++counts.searched;
  for (std::size_t j = 0; j < bodies; ++j) {
    if ((j + bodies - first) % bodies < turn) continue;
    const double reach = (radii_[i] + radii_[j]) * (1.0 + kReachRounding);
    const Vec3 apart = reduced_[j] - reduced_[i];
    Image low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      if (cell.walled[k] || axis >= cell.dimensions) continue;
      const double most = reach / heights[axis] + kReachRounding;
      low[k] = static_cast<std::int32_t>(std::ceil(-most - apart[axis]));
      high[k] = static_cast<std::int32_t>(std::floor(most - apart[axis]));
    }
    Image n;
    for (n[0] = low[0]; n[0] <= high[0]; ++n[0])
      for (n[1] = low[1]; n[1] <= high[1]; ++n[1])
        for (n[2] = low[2]; n[2] <= high[2]; ++n[2]) {
          if (i == j && n <= Image{}) continue;
          Pair pair{self, static_cast<std::int32_t>(j), n};
          if (i > j) pair = {pair.b, pair.a, {-n[0], -n[1], -n[2]}};
          if (branch_vector(pair, state.particles, cell).norm() <= reach)
            require_listed(state, pair, counts);
        }
  }
  for (std::size_t wall = 0; wall < kCellFaces + cell.planes.size(); ++wall)
    if (wall >= kCellFaces || cell.walled[wall / 2])
      require_listed(state, {self, static_cast<std::int32_t>(radii_.size() + wall), Image{}},
                     counts);
}

void ContactCheck::require_listed(const State& state, const Pair& pair, CheckCounts& counts) const {
  const std::vector<Pair>& pairs = state.list.pairs();
  const auto [first, last] = state.list.pairs_as_a(at(pair.a));
  const auto begin = pairs.begin();
  if (std::binary_search(begin + static_cast<std::ptrdiff_t>(first),
                         begin + static_cast<std::ptrdiff_t>(last), pair))
    return;
  const Vec3 separation = separation_of(state, pair);
  if (!meet(state, pair, separation) || is_near_a_touch(state, pair, separation)) return;
  ++counts.missed;
  note(counts, pair,
       "the run does not list them as neighbours; exactly, the interiors meet, gap " +
           text(gap(state, pair, separation)));
}

}  // namespace tangency::inline v0::dem
