// SPDX-License-Identifier: GPL-3.0-or-later
// A plug-in whose own names are hidden, with what loader.cpp asks it by.
#include <tangency/geometry/gap.hpp>

using tangency::Ellipsoid;

extern "C" __attribute__((visibility("default"))) double plugin_gap(double semi_axis) {
  return tangency::signed_gap(Ellipsoid({0, 0, 0}, {semi_axis, 2, 3}),
                              Ellipsoid({0, 0, 7}, {3, 2, 1}))
      .gap;
}

/// Does what the library throws arrive here as what its header says?
extern "C" __attribute__((visibility("default"))) bool plugin_catches() {
  try {
    plugin_gap(-1);
    return false;
  } catch (const tangency::InvalidEllipsoid& error) {
    return error.fault().value == -1;
  }
}
