// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/parts.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tangency::inline v0::detail {

void in_parts(std::size_t parts, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto do_some = [&]() noexcept {
    for (std::size_t k = next++; k < parts; k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = parts;
      }
    }
  };
  const std::size_t helpers = std::min(static_cast<std::size_t>(std::max(threads, 1)), parts);
  {
    std::vector<std::jthread> others;
    try {
      others.reserve(helpers);
      for (std::size_t k = 1; k < helpers; ++k) others.emplace_back(do_some);
    } catch (const std::exception&) {
      // The system gives no more threads, or no memory for them: those there are do the work.
    }
    do_some();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tangency::inline v0::detail
