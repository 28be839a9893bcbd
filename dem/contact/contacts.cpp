// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/contacts.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/contact/contact_blocks.hpp>
#include <tangency/dem/parallel.hpp>

namespace tangency::inline v0::dem {
namespace {

std::size_t blocks_of(std::size_t pairs) { return (pairs + kPairBlock - 1) / kPairBlock; }

}  // namespace

void ContactColumns::resize(std::size_t entries) {
  for (const auto column : kVectors) (this->*column).resize(entries, Vec3::Zero());
  for (const auto column : kNumbers) (this->*column).resize(entries, 0.0);
}

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
  Branch branch;
  BlockStep blocks;
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
  if (count_ != list.pairs().size()) resize(list.pairs().size());
  refresh(particles, cell, profile);
  const Step step{particles,
                  cell,
                  list.pairs(),
                  branch,
                  {particles, narrow_phase_, laws, motion_, dt, cell.rate,
                   bear_shear || may_have_shear_, laws.dissipate()}};
  may_have_shear_ = bear_shear;
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
  const bool drives = !step.cell.planes.empty();
  const double before = drives ? power_of_planes(step, first, block.count) : 0.0;
  step_block(step.blocks, geometry, block);
  if (drives)
    block.sums->boundary +=
        0.5 * step.blocks.dt * (before + power_of_planes(step, first, block.count));
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
