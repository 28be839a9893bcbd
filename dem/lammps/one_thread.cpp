// SPDX-License-Identifier: GPL-2.0-or-later
// In place of dem/parallel.cpp, which brings TBB: a rank of LAMMPS is one thread, and a cluster
// need not have TBB. The linker takes what stands here before it looks into the library.
#include <cstddef>

#include <tangency/dem/parallel.hpp>

namespace tangency::inline v0::dem {

void set_threads(int) {}

int threads() { return 1; }

void share_range(std::size_t count, void (*call)(const void*, std::size_t, std::size_t),
                 const void* what) {
  call(what, 0, count);
}

}  // namespace tangency::inline v0::dem
