// SPDX-License-Identifier: MIT
#include <tangency/dem/contacts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/hertz_lanes.hpp>
#include <tangency/dem/parallel.hpp>

namespace tangency::inline v0::dem {
namespace {

static_assert(ContactBlock::kPairs == kPairBlock);

std::size_t blocks_of(std::size_t pairs) { return (pairs + kPairBlock - 1) / kPairBlock; }

template <class T>
using BlockColumn = BlockGeometry::Column<T>;

/// The laws of a block's pairs.
struct BlockLaws {
  BlockColumn<const ContactLaw*> law;
  BlockColumn<double> normal_stiffness, shear_stiffness, friction_coefficient, cohesion;
  BlockColumn<double> half_compliance;

  BlockLaws(const ContactLaws& laws, const Particles& particles, const BlockGeometry& block) {
    const std::size_t walls = laws.types - 1;
    const auto type_of = [&](std::uint32_t body) {
      return body < particles.size() ? static_cast<std::size_t>(particles.type[body]) : walls;
    };
    const ContactLaw* last = nullptr;
    double compliance = 0.0;
    for (std::size_t k = 0; k < kPairBlock; ++k) {
      const ContactLaw& one =
          laws.types == 1 ? laws.law.front()
                          : laws.between(type_of(block.pairs[k].a), type_of(block.pairs[k].b));
      if (&one != last) compliance = one.bears_shear() ? 0.5 / one.shear_stiffness : 0.0;
      law[k] = last = &one;
      half_compliance[k] = compliance;
      normal_stiffness[k] = one.normal_stiffness;
      shear_stiffness[k] = one.shear_stiffness;
      friction_coefficient[k] = one.friction_coefficient;
      cohesion[k] = one.cohesion;
    }
  }

  LawColumns columns() const {
    return {normal_stiffness.data(), shear_stiffness.data(), friction_coefficient.data(),
            cohesion.data(), half_compliance.data()};
  }
};

/// What Hertz's law makes of a block's pairs that touch.
class BlockHertz {
 public:
  BlockHertz(const BlockLaws& laws, const NarrowPhase& narrow_phase, const BlockGeometry& block,
             std::size_t count) {
    direction_.fill(Vec3::Zero());
    BlockColumn<double> overlap{}, contact_modulus, shear_modulus, poisson_ratio;
    for (std::size_t k = 0; k < count; ++k) overlap[k] = block.gap[k] < 0.0 ? -block.gap[k] : 0.0;
    const ContactLaw* last = nullptr;
    double of_contact = 0.0, of_shear = 0.0;
    for (std::size_t k = 0; k < kPairBlock; ++k) {
      const Material& material = *laws.law[k]->hertz;
      if (laws.law[k] != last) {
        of_contact = material.contact_modulus();
        of_shear = material.shear_modulus();
        last = laws.law[k];
      }
      contact_modulus[k] = of_contact;
      shear_modulus[k] = of_shear;
      poisson_ratio[k] = material.poisson_ratio;
    }
    BlockColumn<IndexedPair> pairs = block.pairs;
    const std::size_t bodies = narrow_phase.rows().size();
    for (IndexedPair& pair : pairs)
      if (pair.b >= bodies) pair.b = kFlatBody;
    const std::uint64_t answered =
        bodies == 0
            ? 0
            : hertz_lanes({narrow_phase.rows().data(), pairs.data(), static_cast<int>(count),
                           block.normal[0].data(), overlap.data(), contact_modulus.data(),
                           shear_modulus.data(), poisson_ratio.data(), force_.data(),
                           stiffness_.data(), energy_.data(), along_.data(), across_.data(),
                           direction_[0].data()});
    for (std::size_t k = 0; k < count; ++k)
      if ((answered >> k & 1) == 0)
        answer(k, *laws.law[k], overlap[k],
               narrow_phase.relative_curvature(block.pairs[k], block.normal[k]));
  }

  HertzColumns columns() const {
    return {force_.data(), stiffness_.data(), energy_.data(),
            along_.data(), across_.data(),    direction_[0].data()};
  }

 private:
  void answer(std::size_t k, const ContactLaw& law, double overlap,
              const PrincipalCurvatures& curvatures) {
    direction_[k].setZero();
    force_[k] = stiffness_[k] = energy_[k] = along_[k] = across_[k] = 0.0;
    if (!(overlap > 0.0)) return;
    const NormalResponse response = law.hertz_response(overlap, curvatures);
    force_[k] = response.force;
    stiffness_[k] = response.stiffness;
    energy_[k] = response.energy;
    along_[k] = response.shear.along;
    across_[k] = response.shear.across;
    direction_[k] = response.shear.direction;
  }

  BlockColumn<double> force_{}, stiffness_{}, energy_{}, along_{}, across_{};
  BlockColumn<Vec3> direction_;
};

/// How the approach of a block's pairs that touch is damped.
class BlockDashpots {
 public:
  BlockDashpots(const BlockLaws& laws, const Particles& particles, const BlockGeometry& block,
                std::size_t count, bool turns) {
    // Of a Hertz contact: with it the damping has the same shape as the linear one
    // (docs/derivations/restitution.md).
    const double of_law = 2.0 * (laws.law[0]->hertz ? std::sqrt(5.0 / 6.0) : 1.0);
    for (std::size_t k = 0; k < count; ++k) {
      if (!(block.gap[k] < 0.0) || !laws.law[k]->dissipates()) continue;
      const IndexedPair& pair = block.pairs[k];
      const Vec3 &normal = block.normal[k], &arm = block.arm[k];
      double inverse = inverse_mass(particles, pair.a, arm, normal, turns);
      if (pair.b < particles.size())
        inverse += inverse_mass(particles, pair.b, arm - block.branch[k], normal, turns);
      inverse_mass_[k] = inverse;
      viscosity_[k] = of_law * laws.law[k]->damping_ratio / std::sqrt(inverse);
    }
  }

  DashpotColumns columns() const { return {viscosity_.data(), inverse_mass_.data()}; }

 private:
  /// Velocity along the normal that an impulse of 1 along it gives to a body where it acts.
  static double inverse_mass(const Particles& particles, std::size_t i, const Vec3& arm,
                             const Vec3& normal, bool turns) {
    const double mass = particles.mass[i];
    const Vec3& axes = particles.semi_axes[i];
    if (!turns || (axes[0] == axes[1] && axes[1] == axes[2])) return 1.0 / mass;
    const Vec3 moment = particles.orientation[i].conjugate() * arm.cross(normal);
    const Vec3 inertia = principal_inertia(mass, axes, particles.dimensions);
    return 1.0 / mass + moment.cwiseAbs2().cwiseQuotient(inertia).sum();
  }

  BlockColumn<double> viscosity_{}, inverse_mass_{};
};

}  // namespace

void ContactColumns::resize(std::size_t entries) {
  for (const auto column : kVectors) (this->*column).resize(entries, Vec3::Zero());
  for (const auto column : kNumbers) (this->*column).resize(entries, 0.0);
}

double ContactLaws::largest_stiffness() const {
  double largest = 0.0;
  for (const ContactLaw& one : law)
    largest = std::max({largest, one.normal_stiffness, one.shear_stiffness});
  return largest;
}

bool ContactLaws::bear_shear() const {
  return std::any_of(law.begin(), law.end(),
                     [](const ContactLaw& one) { return one.bears_shear(); });
}

bool ContactLaws::dissipate() const {
  return std::any_of(law.begin(), law.end(),
                     [](const ContactLaw& one) { return one.dissipates(); });
}

bool ContactLaws::are_hertz() const { return law.front().hertz.has_value(); }

std::size_t ContactRecords::size() const { return contacts_->size(); }

Contact ContactRecords::operator[](std::size_t pair) const {
  const ContactColumns& columns = contacts_->columns();
  return {columns.normal[pair],
          columns.branch[pair],
          columns.arm[pair],
          contacts_->force(pair),
          {columns.shear_force[pair], columns.shear_stiffness[pair], columns.shear_energy[pair]},
          columns.overlap[pair],
          columns.normal_force[pair],
          columns.normal_stiffness[pair],
          columns.normal_energy[pair]};
}

struct Contacts::Step {
  const Particles& particles;
  const Cell& cell;
  const std::vector<Pair>& pairs;
  const ContactLaws& laws;
  double dt;
  Branch branch;
  bool bears_shear, hertz, damped;
};

/// What a block took, in seconds, and which of its pairs took another way than most.
struct Contacts::BlockTimes {
  double gaps = 0.0, law = 0.0;
  MeasuredPairs pairs;

  BlockTimes& operator+=(const BlockTimes& other) {
    gaps += other.gaps;
    law += other.law;
    pairs.slow += other.pairs.slow;
    pairs.unanswered += other.pairs.unanswered;
    return *this;
  }
};

ContactWork Contacts::update(const Particles& particles, const Cell& cell,
                             const NeighbourList& list, const ContactLaws& laws, double dt,
                             Branch branch, Profile* profile) {
  const bool bear_shear = laws.bear_shear();
  const Step step{particles,
                  cell,
                  list.pairs(),
                  laws,
                  dt,
                  branch,
                  bear_shear || may_have_shear_,
                  laws.are_hertz(),
                  laws.dissipate()};
  may_have_shear_ = bear_shear;
  if (count_ != step.pairs.size()) resize(step.pairs.size());
  refresh(particles, cell, profile);
  update_blocks(step, profile);
  const PhaseTimer timer(profile, Phase::sums);
  add_up_particles(list, particles.size());
  if (profile != nullptr) profile->touching_pairs += totals().contacts;
  return add_up_blocks();
}

void Contacts::update_blocks(const Step& step, Profile* profile) {
  const bool is_timed = profile != nullptr;
  const auto start = Clock::now();
  std::vector<BlockTimes> times(is_timed ? block_sums_.size() : 0);
  for_ranges(block_sums_.size(), kParallelThreshold / kPairBlock,
             [&](std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) {
                 const BlockTimes one = update_block(k, step, is_timed);
                 if (is_timed) times[k] = one;
               }
             });
  if (times.empty()) return;
  // Blocks take turns on all threads: their time on the clock is shared as the times of blocks are.
  BlockTimes all;
  for (const BlockTimes& one : times) all += one;
  const double seconds = seconds_since(start), share = all.gaps / (all.gaps + all.law);
  (*profile)[Phase::gaps] += share * seconds;
  (*profile)[Phase::law] += (1.0 - share) * seconds;
  profile->slow_pairs += all.pairs.slow;
  profile->unanswered_contacts += all.pairs.unanswered;
}

void Contacts::resize(std::size_t pairs) {
  count_ = pairs;
  const std::size_t blocks = blocks_of(pairs), padded = blocks * kPairBlock;
  columns_.resize(padded);
  for (auto* column : {&force_, &moment_a_, &moment_b_}) column->resize(padded);
  block_sums_.resize(blocks);
}

void Contacts::refresh(const Particles& particles, const Cell& cell, Profile* profile) {
  const PhaseTimer timer(profile, Phase::bodies);
  const std::size_t count = particles.size();
  narrow_phase_.aim(particles);
  // Walls stand after the particles; the faces of the cell move with its strain.
  motion_.resize(count + kCellFaces + cell.planes.size(), {});
  for (std::size_t k = 0; k < cell.planes.size(); ++k) {
    const Vec3& v = cell.planes[k].velocity;
    motion_[count + kCellFaces + k] = {{v[0], v[1], v[2]}, 0.0, {0.0, 0.0, 0.0}, 0.0};
  }
  for_ranges(count, kParallelThreshold, [&](std::size_t first, std::size_t last) {
    narrow_phase_.refresh(particles, first, last);
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 &v = particles.velocity[i], &w = particles.angular_velocity[i];
      motion_[i] = {{v[0], v[1], v[2]}, 0.0, {w[0], w[1], w[2]}, 0.0};
    }
  });
}

/// Contacts as they are saved, and where a block's results go.
ContactBlock Contacts::block_at(std::size_t index) {
  const std::size_t first = index * kPairBlock;
  ContactColumns& c = columns_;
  ContactBlock block{};
  block.count = std::min(kPairBlock, count_ - first);
  block.state = {c.normal[first].data(),      c.branch[first].data(),  c.arm[first].data(),
                 c.shear_force[first].data(), &c.overlap[first],       &c.normal_force[first],
                 &c.normal_stiffness[first],  &c.normal_energy[first], &c.shear_stiffness[first],
                 &c.shear_energy[first]};
  block.force = force_[first].data();
  block.moment_a = moment_a_[first].data();
  block.moment_b = moment_b_[first].data();
  block.sums = &block_sums_[index];
  return block;
}

Contacts::BlockTimes Contacts::update_block(std::size_t index, const Step& step, bool is_timed) {
  BlockTimes times;
  Clock::time_point start;
  if (is_timed) start = Clock::now();
  const std::size_t first = index * kPairBlock;
  ContactBlock block = block_at(index);
  const auto pairs = std::span(step.pairs).subspan(first, block.count);
  BlockGeometry geometry;
  times.pairs = narrow_phase_.measure(pairs, step.particles, step.cell,
                                      std::span(columns_.normal).subspan(first, block.count),
                                      step.branch, geometry);
  if (is_timed) {
    times.gaps = seconds_since(start);
    start = Clock::now();
  }
  const BlockLaws laws(step.laws, step.particles, geometry);
  block.pairs = geometry.pairs.data();
  block.motion = motion_.data();
  block.dt = step.dt;
  std::copy_n(step.cell.rate.data(), 9, block.rate);
  block.gap = geometry.gap.data();
  block.normal = geometry.normal[0].data();
  block.branch = geometry.branch[0].data();
  block.arm = geometry.arm[0].data();
  block.law = laws.columns();
  block.bears_shear = step.bears_shear;
  std::optional<BlockHertz> hertz;
  HertzColumns of_hertz;
  if (step.hertz) {
    of_hertz = hertz.emplace(laws, narrow_phase_, geometry, block.count).columns();
    block.hertz = &of_hertz;
  }
  std::optional<BlockDashpots> dashpots;
  DashpotColumns of_dashpots;
  if (step.damped) {
    const bool turns = step.laws.bodies_turn;
    of_dashpots = dashpots.emplace(laws, step.particles, geometry, block.count, turns).columns();
    block.dashpots = &of_dashpots;
  }
  const bool drives = !step.cell.planes.empty();
  const double before = drives ? power_of_planes(step, first, block.count) : 0.0;
  contact_lanes(block);
  if (drives)
    block.sums->boundary += 0.5 * step.dt * (before + power_of_planes(step, first, block.count));
  if (is_timed) times.law = seconds_since(start);
  return times;
}

/// What the planes of a block's pairs give to the bodies, by the forces as they are.
double Contacts::power_of_planes(const Step& step, std::size_t first, std::size_t count) const {
  double power = 0.0;
  const std::size_t planes = step.particles.size() + kCellFaces;
  for (std::size_t k = first; k < first + count; ++k)
    if (const auto b = static_cast<std::size_t>(step.pairs[k].b); b >= planes)
      power -= force(k).dot(step.cell.planes[b - planes].velocity);
  return power;
}

ContactWork Contacts::add_up_blocks() {
  sums_ = {};
  ContactWork work;
  for (const BlockSums& block : block_sums_) {
    sums_.force_branch += Eigen::Map<const Mat3>(block.force_branch);
    sums_.affine_stiffness += block.affine_stiffness;
    work.sliding += block.sliding;
    work.boundary += block.boundary;
    work.branch += block.branch;
    work.viscous += block.viscous;
  }
  return work;
}

Contacts::Borne Contacts::borne_by(std::int32_t body, const NeighbourList& list) const {
  Borne sum;
  for (std::size_t k = 0; k < count_; ++k) {
    if (list.pairs()[k].b != body || !touches(k)) continue;
    sum.force += columns_.normal_force[k];
    sum.stiffness += columns_.normal_stiffness[k];
  }
  return sum;
}

ContactTotals Contacts::totals() const {
  return sum_by_chunks<ContactTotals>(count_, [&](std::size_t first, std::size_t last) {
    ContactTotals some;
    for (std::size_t k = first; k < last; ++k) {
      if (!touches(k)) continue;
      ++some.contacts;
      some.force_length += force(k).norm();
      some.normal_force += columns_.normal_force[k];
      some.overlap += columns_.overlap[k];
      some.energy += columns_.normal_energy[k] + columns_.shear_energy[k];
    }
    return some;
  });
}

void Contacts::carry_over(const std::vector<Pair>& before, const std::vector<Pair>& now) {
  ContactColumns old = std::exchange(columns_, {});
  resize(now.size());
  std::vector<std::array<std::size_t, 2>> kept;  // places before and now
  auto at = before.begin();
  for (std::size_t k = 0; k < now.size(); ++k) {
    at = std::lower_bound(at, before.end(), now[k]);
    if (at == before.end()) break;
    if (*at == now[k]) kept.push_back({static_cast<std::size_t>(at - before.begin()), k});
  }
  const auto keep = [&](const auto& from, auto& to) {
    for (const auto& [was, is] : kept) to[is] = from[was];
  };
  for (const auto column : ContactColumns::kVectors) keep(old.*column, columns_.*column);
  for (const auto column : ContactColumns::kNumbers) keep(old.*column, columns_.*column);
}

/// A pair under its new name, and where its contact is.
struct Contacts::MovedPair {
  Pair pair;
  std::size_t from;
  bool turned;  ///< its bodies have changed their places

  bool operator<(const MovedPair& other) const { return pair < other.pair; }
};

std::vector<Pair> Contacts::renumber(const std::vector<Pair>& pairs,
                                     std::span<const std::uint32_t> place) {
  std::vector<MovedPair> moved;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Pair pair = pairs[k];
    const bool wall = static_cast<std::size_t>(pair.b) >= place.size();
    pair.a = static_cast<std::int32_t>(place[static_cast<std::size_t>(pair.a)]);
    if (!wall) pair.b = static_cast<std::int32_t>(place[static_cast<std::size_t>(pair.b)]);
    const bool turned = pair.a > pair.b;
    if (turned) {
      std::swap(pair.a, pair.b);
      for (std::int32_t& edges : pair.image) edges = -edges;
    }
    moved.push_back({pair, k, turned});
  }
  return reorder(std::move(moved));
}

std::vector<Pair> Contacts::follow(const std::vector<Pair>& pairs, const Reset& reset) {
  std::vector<MovedPair> moved;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Pair pair = pairs[k];
    pair.image = reset.image(pair.image);
    const bool turned = pair.a == pair.b && pair.image < Image{};
    if (turned)
      for (std::int32_t& edges : pair.image) edges = -edges;
    moved.push_back({pair, k, turned});
  }
  return reorder(std::move(moved));
}

std::vector<Pair> Contacts::reorder(std::vector<MovedPair> moved) {
  std::sort(moved.begin(), moved.end());
  const ContactColumns old = columns_;
  std::vector<Pair> now;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const auto& [pair, from, turned] = moved[k];
    now.push_back(pair);
    for (const auto column : ContactColumns::kVectors)
      (columns_.*column)[k] = turned ? Vec3(-(old.*column)[from]) : (old.*column)[from];
    if (turned) columns_.arm[k] = old.arm[from] - old.branch[from];
    for (const auto column : ContactColumns::kNumbers) (columns_.*column)[k] = (old.*column)[from];
  }
  return now;
}

void Contacts::restore(ContactColumns columns, const Particles& particles,
                       const NeighbourList& list) {
  columns_ = std::move(columns);
  may_have_shear_ = true;
  resize(list.pairs().size());
  add_up(particles, list);
}

std::int64_t Contacts::unanswered(const Particles& particles, const Cell& cell,
                                  const NeighbourList& list) const {
  NarrowPhase narrow_phase;
  narrow_phase.aim(particles);
  narrow_phase.refresh(particles, 0, particles.size());
  std::int64_t count = 0;
  for (std::size_t first = 0; first < count_; first += kPairBlock) {
    const std::size_t size = std::min(kPairBlock, count_ - first);
    BlockGeometry geometry;
    count += narrow_phase
                 .measure(std::span(list.pairs()).subspan(first, size), particles, cell,
                          std::span(columns_.normal).subspan(first, size), Branch::trace, geometry)
                 .unanswered;
  }
  return count;
}

void Contacts::add_up(const Particles& particles, const NeighbourList& list) {
  for_ranges(block_sums_.size(), kParallelThreshold / kPairBlock,
             [&](std::size_t first, std::size_t last) {
               for (std::size_t k = first; k < last; ++k) restored_lanes(block_at(k));
             });
  add_up_particles(list, particles.size());
  add_up_blocks();
}

void Contacts::add_up_particles(const NeighbourList& list, std::size_t particles) {
  resultants_.force.resize(particles);
  resultants_.moment.resize(particles);
  resultants_.contacts.resize(particles);
  for_ranges(particles, kParallelThreshold, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      std::int32_t contacts = 0;
      for (const std::uint32_t index : list.pairs_as_b(i)) {
        contacts += touches(index) ? 1 : 0;
        force += force_[index];
        moment += moment_b_[index];
      }
      const auto [first, last] = list.pairs_as_a(i);
      for (std::size_t index = first; index < last; ++index) {
        contacts += touches(index) ? 1 : 0;
        force -= force_[index];
        moment += moment_a_[index];
      }
      resultants_.force[i] = force;
      resultants_.moment[i] = moment;
      resultants_.contacts[i] = contacts;
    }
  });
}

}  // namespace tangency::inline v0::dem
