// SPDX-License-Identifier: GPL-3.0-or-later
/// The targets as libFuzzer runs them: TANGENCY_FUZZ_TARGET names which. Where
/// TANGENCY_FUZZ_SEEDS names a folder its seeds are written there first; what was counted goes to
/// the file TANGENCY_FUZZ_COUNTS at the end. tests/fuzz/run sets them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/target.hpp>

// Names that libFuzzer calls, and one of its own.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed);

namespace tangency::testing::fuzz {
namespace {

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

const Target& chosen() {
  static const Target& target = [&]() -> const Target& {
    const std::string name = environment("TANGENCY_FUZZ_TARGET");
    const Target* const named = target_named(name);
    if (named == nullptr) {
      std::fprintf(stderr, "TANGENCY_FUZZ_TARGET = %s: one of the targets:", name.c_str());
      for (const Target& one : targets()) std::fprintf(stderr, " %s", one.name.c_str());
      std::fprintf(stderr, "\n");
      std::exit(2);
    }
    return *named;
  }();
  return target;
}

void write_counts() {
  std::ofstream file(environment("TANGENCY_FUZZ_COUNTS"));
  for (const auto& [name, number] : counts()) file << number << ' ' << name << '\n';
}

void write_seeds(const std::string& folder) {
  std::size_t number = 0;
  for (const std::string& seed : chosen().seeds())
    std::ofstream(folder + "/seed-" + std::to_string(number++), std::ios::binary) << seed;
}

}  // namespace
}  // namespace tangency::testing::fuzz

int LLVMFuzzerInitialize(int*, char***) {
  using namespace tangency::testing::fuzz;
  chosen();
  if (const std::string folder = environment("TANGENCY_FUZZ_SEEDS"); !folder.empty())
    write_seeds(folder);
  counts();  // made before, so that they are there when they are written
  if (!environment("TANGENCY_FUZZ_COUNTS").empty()) std::atexit(write_counts);
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tangency::testing::fuzz;
  if (size > chosen().most_bytes) return 0;
  count("runs");
  chosen().run({data, size});
  return 0;
}

// Every fourth time its own mutations, which know where the program branched.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned seed) {
  using namespace tangency::testing::fuzz;
  const std::size_t room = std::min(most, chosen().most_bytes), used = std::min(size, room);
  if (seed % 4 == 0) return LLVMFuzzerMutate(data, used, room);
  return chosen().mutate(data, used, room, seed);
}
// NOLINTEND(readability-identifier-naming)
