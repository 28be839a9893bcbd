// SPDX-License-Identifier: MIT
/// @file
/// Memory for arrays that are read in random order. In pages of 4 KiB more time goes into finding
/// the page of a body than into reading it (measured: 100,000 bodies, bench_batch, "scattered").
#pragma once

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdlib>
#include <new>

namespace tangency::inline v0 {

/// Allocates cache-line-aligned memory, and where it is long enough asks for pages of 2 MiB;
/// whether it gets them is up to the system.
template <class T>
struct LargePages {
  /// what is allocated
  using value_type = T;

  LargePages() = default;
  template <class U>
  /// Of any type to any other: it has no state.
  LargePages(const LargePages<U>&) noexcept {}  // NOLINT: as allocators convert

  /// Memory for count values. @throws std::bad_alloc
  T* allocate(std::size_t count) {
    constexpr std::size_t kPage = std::size_t{1} << 21, kLine = 64;
    const std::size_t step = count * sizeof(T) >= kPage ? kPage : kLine;
    const std::size_t bytes = (count * sizeof(T) + step - 1) / step * step;
    void* memory = std::aligned_alloc(step, bytes);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
    if (step == kPage)
      madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: what it returns is no matter
#endif
    return static_cast<T*>(memory);
  }
  /// What allocate() gave.
  void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }

  /// Always: it has no state.
  bool operator==(const LargePages&) const noexcept { return true; }
};

}  // namespace tangency::inline v0
