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
