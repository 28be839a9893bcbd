// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/pair_checks.hpp>
#include <tangency/tests/fuzz/pair_input.hpp>
#include <tangency/verify/hunt/moves.hpp>

namespace tangency::testing::fuzz {
namespace {

// One input in so many is asked of the oracle; in the others every call but the slow ones.
constexpr std::uint64_t kOracleOneIn = 1000, kFurtherOneIn = 8;

void run_calls(Bytes input) {
  static const std::string name = "calls";
  const verify::EllipsoidPair raw = pair_of(input);
  const std::optional<Bodies> bodies = bodies_of(raw);
  if (!bodies) return count("refused");
  const std::uint64_t hash = hash_of(input);
  count("pairs");
  check_pair(name, raw, *bodies, hash / kOracleOneIn);
  if (hash / kOracleOneIn % kFurtherOneIn == 0) check_further(name, raw, *bodies, hash >> 20);
  if (hash % kOracleOneIn == 0) check_by_oracle(name, raw, *bodies);
}

std::size_t mutate_calls(std::uint8_t* data, std::size_t size, std::size_t most,
                         std::uint64_t seed) {
  if (most < kPairBytes) return mutate_bytes(data, size, most, seed);
  verify::EllipsoidPair pair = pair_of({data, size});
  mutate_pair(pair, seed);
  write_pair(pair, data);
  return kPairBytes;
}

// An input of `batch` is a number, which stands for all draws, and some pairs. Of them a pack of
// many is made: each moved by moves of the hunt, again and again, until it is no fair pair any
// longer (verify/hunt/moves.hpp), which takes it back to one of the input's. Pairs that are deeper
// than -rho (gap.hpp) are searched, which takes as long as a hundred others: one in kDeepOneIn of
// them stays.
constexpr std::size_t kPack = 512, kMostPairs = 6, kNumberBytes = sizeof(std::uint64_t);
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

struct Pack {
  std::vector<verify::EllipsoidPair> raw;
  std::vector<Ellipsoid> bodies;  ///< A and B in turn
  std::vector<IndexedPair> pairs;
};

void add(Pack& pack, const verify::EllipsoidPair& raw) {
  const std::optional<Bodies> bodies = bodies_of(raw);
  if (!bodies) return;
  const auto first = static_cast<std::uint32_t>(pack.bodies.size());
  pack.raw.push_back(raw);
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
  bounded_gaps(array, {pack.pairs, {}}, columns, Accuracy::fast());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const IndexedPair pair = pack.pairs[i];
    const double rho = pack.bodies[pair.a].least_radius() + pack.bodies[pair.b].least_radius();
    if (gaps[i] < -rho && below(state, kDeepOneIn) != 0) continue;
    pack.raw[kept] = pack.raw[i];
    pack.pairs[kept++] = pair;
  }
  pack.raw.resize(kept);
  pack.pairs.resize(kept);
}

Pack pack_of(Bytes input, std::uint64_t seed) {
  const Bytes rest = input.subspan(std::min(input.size(), kNumberBytes));
  std::vector<verify::EllipsoidPair> given;
  for (std::size_t at = 0; at + kPairBytes <= rest.size() && given.size() < kMostPairs;
       at += kPairBytes)
    given.push_back(pair_of(rest.subspan(at)));
  Pack pack;
  if (given.empty()) return pack;
  for (const verify::EllipsoidPair& pair : given) add(pack, pair);
  verify::Draw draw(seed);
  std::uint64_t state = seed;
  std::vector<verify::EllipsoidPair> moving = given;
  for (std::size_t k = 0; pack.raw.size() < kPack && k < 2 * kPack; ++k) {
    verify::EllipsoidPair& pair = moving[k % moving.size()];
    if (!verify::is_fair(pair)) pair = given[k % given.size()];
    if (below(state, kMoveOneIn) == 0) move_pair(pair, draw);
    distort(pair, state);
    if (verify::is_fair(pair)) add(pack, pair);
  }
  drop_deep(pack, state);
  return pack;
}

/// What a batch says of a pack, held against itself, and of one pair against the single calls.
class PackChecks {
 public:
  PackChecks(const Pack& pack, std::uint64_t choice)
      : pack_(pack), array_(pack.bodies), choice_(choice), gaps_(pack.pairs.size()) {}

  void run() {
    count("pairs", pack_.pairs.size());
    yes_no();
    gaps();
    follow();
    if (choice_ % 4 == 0) exchanged();
    single(choice_ / 4 % pack_.pairs.size());
  }

 private:
  void hold(bool holds, const char* what, std::size_t i) const {
    if (!holds) broken("batch", std::string(what) + ": " + row_of(pack_.raw[i]));
  }

  void yes_no() {
    overlapping_.resize(pack_.pairs.size());
    overlaps(array_, {pack_.pairs, {}}, overlapping_);
  }

  void gaps() {
    static constexpr std::array kTiers{"tier fast", "tier safeguarded", "tier factored",
                                       "tier search", "tier exact"};
    std::array<std::uint64_t, kTiers.size()> tiers{};
    const std::array accuracies{Accuracy::standard(), Accuracy::fast(), Accuracy::certified()};
    signed_gaps(array_, {pack_.pairs, {}}, gaps_, accuracies[choice_ / 16 % accuracies.size()]);
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
      hold((gaps_[i].gap < 0) == static_cast<bool>(overlapping_[i]), "overlaps and sign", i);
      hold(gaps_[i].gap_error >= 0, "gap_error", i);
      ++tiers[static_cast<std::size_t>(gaps_[i].tier)];
    }
    for (std::size_t k = 0; k < tiers.size(); ++k) {
      if (tiers[k] > 0) count(kTiers[k], tiers[k]);
    }
  }

  // From the normals of the answers; every other one is turned a little.
  void follow() const {
    std::vector<Vec3> normals(gaps_.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const bool is_normal = gaps_[i].normal.cwiseAbs().maxCoeff() > 0.5;
      normals[i] = is_normal ? gaps_[i].normal : Vec3(Vec3::Zero());
      if (is_normal && i % 2 == 1) normals[i] += 0x1p-6 * Vec3(normals[i][1], normals[i][2], 0.5);
    }
    std::vector<Gap> followed(gaps_.size());
    follow_gaps(array_, {pack_.pairs, {}}, normals, followed);
    for (std::size_t i = 0; i < followed.size(); ++i) {
      // By the rounded separation: what it may be off by is allowed for.
      const long double rounded = rounding(i);
      Enclosure one = enclosure_of(followed[i]);
      one.low -= rounded;
      one.high += rounded;
      hold(meet(one, enclosure_of(gaps_[i])), "signed_gaps and follow_gaps", i);
    }
    count("followed", followed.size());
  }

  long double rounding(std::size_t i) const {
    const verify::EllipsoidPair& raw = pack_.raw[i];
    long double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::abs(static_cast<long double>(raw.b.centre[k]) -
                      static_cast<long double>(raw.a.centre[k]));
    return sum * 0x1p-52L;
  }

  void exchanged() const {
    std::vector<IndexedPair> pairs = pack_.pairs;
    for (IndexedPair& pair : pairs) std::swap(pair.a, pair.b);
    std::ranges::reverse(pairs);
    std::vector<Gap> others(pairs.size());
    std::vector<std::uint8_t> overlapping(pairs.size());
    signed_gaps(array_, {pairs, {}}, others);
    overlaps(array_, {pairs, {}}, overlapping);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::size_t k = pairs.size() - 1 - i;
      hold(overlapping[k] == overlapping_[i], "overlaps and exchange", i);
      hold(meet(enclosure_of(others[k]), enclosure_of(gaps_[i])), "gaps and exchange", i);
    }
    count("exchanged", pairs.size());
  }

  void single(std::size_t i) const {
    const Ellipsoid &a = pack_.bodies[pack_.pairs[i].a], &b = pack_.bodies[pack_.pairs[i].b];
    const Gap gap = signed_gap(a, b);
    hold(meet(enclosure_of(gap), enclosure_of(gaps_[i])), "single call and batch", i);
    hold(gap.status == gaps_[i].status, "status of the single call and the batch", i);
    hold(overlaps(a, b) == static_cast<bool>(overlapping_[i]), "single overlaps and batch", i);
    count("single calls");
    if (choice_ % kOracleOneIn == 0) check_by_oracle("batch", pack_.raw[i], {a, b});
  }

  const Pack& pack_;
  BodyArray array_;
  std::uint64_t choice_;
  std::vector<Gap> gaps_;
  std::vector<std::uint8_t> overlapping_;
};

void run_batch(Bytes input) {
  std::uint64_t seed = 0;
  std::memcpy(&seed, input.data(), std::min(input.size(), kNumberBytes));
  const Pack pack = pack_of(input, seed);
  if (pack.pairs.empty()) return count("refused");
  PackChecks(pack, hash_of(input)).run();
}

std::size_t mutate_batch(std::uint8_t* data, std::size_t size, std::size_t most,
                         std::uint64_t seed) {
  std::uint64_t state = seed;
  if (size < kNumberBytes + kPairBytes) return mutate_bytes(data, size, most, seed);
  const std::uint64_t number = next(state);
  std::memcpy(data, &number, sizeof number);
  if (below(state, 2) == 0) return size;
  const std::size_t pairs = (size - kNumberBytes) / kPairBytes;
  std::uint8_t* at = data + kNumberBytes + below(state, pairs) * kPairBytes;
  verify::EllipsoidPair pair = pair_of({at, kPairBytes});
  mutate_pair(pair, next(state));
  write_pair(pair, at);
  return kNumberBytes + pairs * kPairBytes;
}

std::vector<std::string> call_seeds() {
  std::vector<std::string> seeds;
  for (const verify::EllipsoidPair& pair : seed_pairs()) {
    seeds.emplace_back(kPairBytes, '\0');
    write_pair(pair, reinterpret_cast<std::uint8_t*>(seeds.back().data()));
  }
  return seeds;
}

// The same, kMostPairs at a time.
std::vector<std::string> batch_seeds() {
  std::vector<std::string> seeds;
  for (const std::string& pair : call_seeds()) {
    if (seeds.empty() || seeds.back().size() >= kNumberBytes + kMostPairs * kPairBytes)
      seeds.emplace_back(kNumberBytes, static_cast<char>(seeds.size()));
    seeds.back() += pair;
  }
  return seeds;
}

}  // namespace

std::vector<Target> pair_targets() {
  return {{"calls", "every call on any 20 doubles, held against each other", kPairBytes, call_seeds,
           run_calls, mutate_calls},
          {"batch", "packs of pairs in batches: yes/no, gaps and following",
           kNumberBytes + kMostPairs * kPairBytes, batch_seeds, run_batch, mutate_batch}};
}

}  // namespace tangency::testing::fuzz
