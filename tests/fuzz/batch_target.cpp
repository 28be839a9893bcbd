// SPDX-License-Identifier: GPL-3.0-or-later
/// What batches say of packs of pairs, held against each other, against what is known of the
/// pairs, and of some of them against the single calls.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/pack.hpp>
#include <tangency/tests/fuzz/pair_checks.hpp>
#include <tangency/tests/fuzz/pair_input.hpp>
#include <tangency/tests/support/instruction_sets.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency::testing::fuzz {
namespace {

// Of packs one in so many is moved, not placed: they take forty times as long. Of pairs one in
// some is asked of single calls, and of packs one in so many has a pair asked of the oracle.
constexpr std::uint64_t kMovedOneIn = 64, kExchangedOneIn = 8, kOtherSetsOneIn = 64,
                        kFloatsOneIn = 16, kOracleOneIn = 64;
constexpr std::size_t kSinglesOneIn = 2048, kNumberBytes = sizeof(std::uint64_t);

class PackChecks {
 public:
  PackChecks(const Pack& pack, std::uint64_t choice)
      : pack_(pack), array_(pack.bodies), choice_(choice), gaps_(pack.pairs.size()) {
    const std::array accuracies{Accuracy::standard(), Accuracy::fast(), Accuracy::certified()};
    accuracy_ = accuracies[drawn(accuracies.size())];
  }

  void run() {
    count("pairs", pack_.pairs.size());
    overlapping_.resize(pack_.pairs.size());
    overlaps(array_, pack_.list(), overlapping_);
    signed_gaps(array_, pack_.list(), gaps_, accuracy_);
    known();
    tiers();
    follow(array_);
    if (drawn(kExchangedOneIn) == 0) exchanged();
    if (drawn(kFloatsOneIn) == 0) floats();
    if (drawn(kOtherSetsOneIn) == 0) other_sets();
    for (std::size_t i = drawn(kSinglesOneIn); i < pack_.pairs.size(); i += kSinglesOneIn)
      single(i);
    if (drawn(kOracleOneIn) == 0) by_oracle(drawn(pack_.pairs.size()));
  }

 private:
  void hold(bool holds, const char* what, std::size_t i) const {
    if (!holds) broken("batch", std::string(what) + ": " + row_of(pack_.raw(i)));
  }

  std::size_t drawn(std::size_t limit) { return below(choice_, limit); }

  void known() const {
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
      hold((gaps_[i].gap < 0) == static_cast<bool>(overlapping_[i]), "overlaps and sign", i);
      hold(gaps_[i].gap_error >= 0, "gap_error", i);
      if (pack_.known.empty()) continue;
      hold(meet(enclosure_of(gaps_[i]), pack_.known[i]), "the gap as the pair was made", i);
      hold(overlapping_[i] != 0 || pack_.known[i].high >= 0, "overlaps as the pair was made", i);
      hold(overlapping_[i] == 0 || pack_.known[i].low <= 0, "overlaps as the pair was made", i);
    }
    if (!pack_.known.empty()) count("known", gaps_.size());
  }

  void tiers() const {
    static constexpr std::array kTiers{"tier fast", "tier safeguarded", "tier factored",
                                       "tier search", "tier exact"};
    std::array<std::uint64_t, kTiers.size()> tiers{};
    for (const Gap& gap : gaps_) ++tiers[static_cast<std::size_t>(gap.tier)];
    for (std::size_t k = 0; k < kTiers.size(); ++k) {
      if (tiers[k] > 0) count(kTiers[k], tiers[k]);
    }
  }

  // From the normals of the pairs, or else of the answers; every other one is turned a little.
  void follow(const BodyArray& array) const {
    std::vector<Vec3> normals = pack_.normals;
    if (normals.empty()) {
      for (const Gap& gap : gaps_) normals.push_back(gap.normal);
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const bool is_normal = normals[i].cwiseAbs().maxCoeff() > 0.5;
      if (!is_normal) normals[i] = Vec3::Zero();
      if (is_normal && i % 2 == 1) normals[i] += 0x1p-6 * Vec3(normals[i][1], normals[i][2], 0.5);
    }
    std::vector<Gap> followed(gaps_.size());
    follow_gaps(array, pack_.list(), normals, followed);
    for (std::size_t i = 0; i < followed.size(); ++i) {
      // By the rounded separation: what it may be off by is allowed for.
      const long double rounded = pack_.separations.empty() ? rounding(i) : 0;
      Enclosure one = enclosure_of(followed[i]);
      one.low -= rounded;
      one.high += rounded;
      hold(meet(one, enclosure_of(gaps_[i])), "signed_gaps and follow_gaps", i);
      if (!pack_.known.empty()) hold(meet(one, pack_.known[i]), "a followed gap as made", i);
    }
    count("followed", followed.size());
  }

  long double rounding(std::size_t i) const {
    const verify::EllipsoidPair raw = pack_.raw(i);
    long double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::abs(static_cast<long double>(raw.b.centre[k]) -
                      static_cast<long double>(raw.a.centre[k]));
    return sum * 0x1p-52L;
  }

  /// The other order of the bodies and of the pairs, so that a pair has other neighbours too.
  void exchanged() const {
    Pack other;
    for (std::size_t k = pack_.pairs.size(); k-- > 0;) {
      other.pairs.push_back({pack_.pairs[k].b, pack_.pairs[k].a});
      if (!pack_.separations.empty()) other.separations.push_back(-pack_.separations[k]);
    }
    std::vector<Gap> gaps(gaps_.size());
    std::vector<std::uint8_t> overlapping(gaps_.size());
    signed_gaps(array_, other.list(), gaps);
    overlaps(array_, other.list(), overlapping);
    std::ranges::reverse(gaps);
    std::ranges::reverse(overlapping);
    hold_all(gaps, overlapping, "exchange");
    count("exchanged", gaps.size());
  }

  void hold_all(const std::vector<Gap>& gaps, const std::vector<std::uint8_t>& overlapping,
                const char* what) const {
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      hold(overlapping[i] == overlapping_[i], what, i);
      hold(meet(enclosure_of(gaps[i]), enclosure_of(gaps_[i])), what, i);
    }
  }

  void floats() const {
    std::vector<float> gaps(gaps_.size()), errors(gaps_.size());
    std::vector<GapStatus> status(gaps_.size());
    FloatGapColumns columns;
    columns.gap = gaps;
    columns.gap_error = errors;
    columns.status = status;
    signed_gaps(array_, pack_.list(), columns, accuracy_);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const auto error = static_cast<double>(errors[i]);
      const double above = status[i] == GapStatus::ok ? error : HUGE_VAL;
      hold((gaps[i] < 0) == static_cast<bool>(overlapping_[i]), "overlaps and the sign in float",
           i);
      hold(meet(enclosure_of(static_cast<double>(gaps[i]), error, above), enclosure_of(gaps_[i])),
           "gaps and float columns", i);
    }
    count("in float", gaps.size());
  }

  void other_sets() const {
    std::vector<Gap> gaps(gaps_.size());
    std::vector<std::uint8_t> overlapping(gaps_.size());
    for_each_instruction_set([&](const char* name) {
      const BodyArray array(pack_.bodies);
      overlaps(array, pack_.list(), overlapping);
      signed_gaps(array, pack_.list(), gaps, accuracy_);
      hold_all(gaps, overlapping, name);
      follow(array);
    });
    count("by other instruction sets", gaps_.size());
  }

  void single(std::size_t i) const {
    const Ellipsoid &a = pack_.bodies[pack_.pairs[i].a], &b = pack_.bodies[pack_.pairs[i].b];
    const bool has_centres = pack_.separations.empty();
    const Gap gap = has_centres ? signed_gap(a, b) : signed_gap(a, b, pack_.separations[i]);
    const bool overlap = has_centres ? overlaps(a, b) : overlaps(a, b, pack_.separations[i]);
    hold(meet(enclosure_of(gap), enclosure_of(gaps_[i])), "single call and batch", i);
    hold(gap.status == gaps_[i].status, "status of the single call and the batch", i);
    hold(overlap == static_cast<bool>(overlapping_[i]), "single overlaps and batch", i);
    count("single calls");
  }

  void by_oracle(std::size_t i) const {
    const verify::EllipsoidPair raw = pack_.raw(i);
    const Bodies bodies{verify::to_ellipsoid(raw.a), verify::to_ellipsoid(raw.b)};
    check_by_oracle("batch", raw, bodies);
    hold(overlaps(bodies.a, bodies.b) == static_cast<bool>(overlapping_[i]), "oracle and batch", i);
    if (pack_.known.empty() || std::isinf(pack_.known[i].high)) return;
    const auto gap = static_cast<long double>(verify::signed_gap(raw.a, raw.b).gap);
    const Enclosure truth{gap, gap};
    hold(meet(truth, pack_.known[i]), "oracle and the gap as the pair was made", i);
    hold(meet(truth, enclosure_of(gaps_[i])), "oracle and gap", i);
    count("gaps by the oracle");
  }

  const Pack& pack_;
  BodyArray array_;
  std::uint64_t choice_;
  Accuracy accuracy_;
  std::vector<Gap> gaps_;
  std::vector<std::uint8_t> overlapping_;
};

void run_batch(Bytes input) {
  std::uint64_t seed = 0;
  std::memcpy(&seed, input.data(), std::min(input.size(), kNumberBytes));
  const Bytes rest = input.subspan(std::min(input.size(), kNumberBytes));
  std::vector<verify::EllipsoidPair> given;
  for (std::size_t at = 0; at + kPairBytes <= rest.size() && given.size() < kMostPairs;
       at += kPairBytes)
    given.push_back(pair_of(rest.subspan(at)));
  if (given.empty()) return count("refused");
  const bool moves = hash_of(input) % kMovedOneIn == 0;
  const Pack pack = moves ? moved_pack(given, seed) : placed_pack(given, seed);
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

// kMostPairs at a time.
std::vector<std::string> batch_seeds() {
  std::vector<std::string> seeds;
  for (const verify::EllipsoidPair& pair : seed_pairs()) {
    if (seeds.empty() || seeds.back().size() >= kNumberBytes + kMostPairs * kPairBytes)
      seeds.emplace_back(kNumberBytes, static_cast<char>(seeds.size()));
    const std::size_t at = seeds.back().size();
    seeds.back().resize(at + kPairBytes);
    write_pair(pair, reinterpret_cast<std::uint8_t*>(seeds.back().data()) + at);
  }
  return seeds;
}

}  // namespace

std::vector<Target> batch_targets() {
  return {{"batch", "packs of pairs in batches: yes/no, gaps and following",
           kNumberBytes + kMostPairs * kPairBytes, batch_seeds, run_batch, mutate_batch}};
}

}  // namespace tangency::testing::fuzz
