// SPDX-License-Identifier: GPL-3.0-or-later
/// Every call of the kernel on pairs: on an input's own, and on many that are made of its bodies.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/pair_checks.hpp>
#include <tangency/tests/fuzz/pair_input.hpp>
#include <tangency/tests/fuzz/placed_pairs.hpp>
#include <tangency/verify/families/conversions.hpp>

namespace tangency::testing::fuzz {
namespace {

// Of an input's own pair, one in so many is asked the oracle and the further calls: it may be
// one that takes ms. Of the pairs that are placed every one is asked further calls, and one in so
// many the oracle.
constexpr std::uint64_t kOracleOneIn = 1000, kFurtherOneIn = 8, kPlacedOracleOneIn = 100'000;
constexpr std::size_t kPlacedPairs = 512, kMovedBodies = 4;  // chosen
// Of those that are deep, or may be, one in so many: it is searched six times, some ms each.
constexpr std::uint64_t kDeepOneIn = 16;

/// A pair where it stands, and what is known of it as it was made.
void check_placed(const std::string& target, const Bodies& bodies, const Enclosure& known,
                  std::uint64_t choice) {
  const verify::EllipsoidPair raw{verify::to_raw(bodies.a), verify::to_raw(bodies.b)};
  count("pairs");
  check_known(target, raw, bodies, known);
  check_pair(target, raw, bodies, choice);
  check_further(target, raw, bodies, choice >> 20);
  if (choice % kPlacedOracleOneIn == 0) check_by_oracle(target, raw, bodies);
}

/// Of the bodies, and of others that moves make of them.
void check_placed_pairs(const std::string& target, verify::EllipsoidPair raw, std::uint64_t seed) {
  std::vector<Ellipsoid> some;
  verify::Draw draw(seed);
  for (std::size_t k = 0; k <= kMovedBodies; ++k) {
    if (const std::optional<Bodies> bodies = bodies_of(raw)) {
      for (const Ellipsoid& body : {bodies->a, bodies->b}) {
        if (PlacedPairs::takes(body)) some.push_back(body);
      }
    }
    move_pair(raw, draw);
  }
  if (some.empty()) return;
  PlacedPairs placed(some, seed);
  std::uint64_t state = ~seed;  // not the sequence of the pairs
  for (std::size_t k = 0; k < kPlacedPairs; ++k) {
    const PlacedPair pair = placed.draw();
    if (std::isinf(pair.gap.high) && below(state, kDeepOneIn) != 0) continue;
    const Bodies bodies{some[pair.bodies.a].moved_to(Vec3::Zero()),
                        some[pair.bodies.b].moved_to(pair.separation)};
    check_placed(target, bodies, pair.gap, next(state));
  }
}

void run_calls(Bytes input) {
  static const std::string name = "calls";
  const verify::EllipsoidPair raw = pair_of(input);
  const std::optional<Bodies> bodies = bodies_of(raw);
  if (!bodies) return count("refused");
  const std::uint64_t hash = hash_of(input);
  count("own pairs");
  check_pair(name, raw, *bodies, hash / kOracleOneIn);
  if (hash / kOracleOneIn % kFurtherOneIn == 0) check_further(name, raw, *bodies, hash >> 20);
  if (hash % kOracleOneIn == 0) check_by_oracle(name, raw, *bodies);
  check_placed_pairs(name, raw, hash);
}

std::size_t mutate_calls(std::uint8_t* data, std::size_t size, std::size_t most,
                         std::uint64_t seed) {
  if (most < kPairBytes) return mutate_bytes(data, size, most, seed);
  verify::EllipsoidPair pair = pair_of({data, size});
  mutate_pair(pair, seed);
  write_pair(pair, data);
  return kPairBytes;
}

std::vector<std::string> call_seeds() {
  std::vector<std::string> seeds;
  for (const verify::EllipsoidPair& pair : seed_pairs()) {
    seeds.emplace_back(kPairBytes, '\0');
    write_pair(pair, reinterpret_cast<std::uint8_t*>(seeds.back().data()));
  }
  return seeds;
}

}  // namespace

std::vector<Target> pair_targets() {
  return {{"calls", "every call on any 20 doubles, held against each other", kPairBytes, call_seeds,
           run_calls, mutate_calls}};
}

}  // namespace tangency::testing::fuzz
