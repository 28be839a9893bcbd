// SPDX-License-Identifier: GPL-3.0-or-later
// What bindings/python_speed.py compares Python with: the C++ batch on the same memory, called by
// the same process.
#include <cstddef>
#include <span>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>

namespace {

using tangency::GapStatus;
using tangency::GapTier;
using tangency::IndexedPair;
using tangency::MovingBodies;
using tangency::Strided;
using tangency::Vec3;

MovingBodies& bodies() {
  static MovingBodies all;
  return all;
}

std::span<Vec3> vectors(double* numbers, std::size_t count) {
  return {reinterpret_cast<Vec3*>(numbers), count};
}

}  // namespace

/// Bodies of rows of ten.
extern "C" void take_bodies(const double* rows, std::size_t count) {
  const auto column = [&](std::size_t from) {
    return Strided<double>{rows + from, count, 10 * sizeof(double)};
  };
  bodies().assign(tangency::VectorColumn(column(3)),
                  {tangency::QuaternionColumn(tangency::NumberColumn<4>(column(6)),
                                              tangency::QuaternionOrder::wxyz),
                   tangency::VectorColumn(column(0))});
}

/// All columns of the pairs.
extern "C" void ask_pairs(const unsigned* pairs, std::size_t count, double* gap, double* gap_error,
                          double* normal, double* arm_a, double* arm_b, int* status, int* tier,
                          double* point, int threads) {
  signed_gaps(bodies(), {{reinterpret_cast<const IndexedPair*>(pairs), count}},
              {.gap = {gap, count},
               .gap_error = {gap_error, count},
               .normal = vectors(normal, count),
               .arm_a = vectors(arm_a, count),
               .arm_b = vectors(arm_b, count),
               .status = {reinterpret_cast<GapStatus*>(status), count},
               .tier = {reinterpret_cast<GapTier*>(tier), count},
               .point = vectors(point, count)},
              {}, threads);
}
