// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/verify/agreement.hpp>

#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

namespace tangency::testing {

int AgreementProgram::run(int argc, const char* const* argv,
                          const std::function<bool(std::uint64_t seed)>& kept) {
  std::uint64_t seed = 20261122;
  option("--seed", seed);
  program_.runs([&] {
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    const bool agrees = kept(seed);
    std::puts(agrees ? "agrees" : "DISAGREES");
    return agrees ? 0 : 1;
  });
  return program_.run(argc, argv);
}

void for_each_part(unsigned threads, std::size_t parts,
                   const std::function<void(std::size_t)>& part) {
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < parts; i = next++) {
      part(i);
      if (++done % 64 == 0) std::fprintf(stderr, "%zu of %zu parts\n", done.load(), parts);
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
}

}  // namespace tangency::testing
