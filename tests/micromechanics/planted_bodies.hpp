// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Spheroids whose axes and contact vectors are drawn from planted laws, and integrals by GSL.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/harmonics.hpp>
#include <tangency/dem/micromechanics/spheroid.hpp>
#include <tangency/geometry/vectors.hpp>

#include "fields.hpp"

namespace tangency::testing {

/// By adaptive quadrature, to 1e-13 of its value or 1e-15.
double integral(const std::function<double(double)>& f, double from, double to);

/// What std::invalid_argument says that a call throws; empty where it throws none.
template <typename Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// A packing with its bodies.
struct BodyPacking {
  Packing packing;
  std::vector<Quaternion> orientation;
  std::vector<Vec3> semi_axes;

  micromechanics::ContactArrays contacts() const { return packing.arrays(); }
  micromechanics::BodyArrays bodies() const { return {orientation, semi_axes}; }
};

/// a1 of the local law of a body, by its axis of symmetry.
using LocalLaw = std::function<double(const Vec3& axis)>;
inline LocalLaw everywhere(double a1) {
  return [a1](const Vec3&) { return a1; };
}

/// How far a random law of directions is from the isotropic one, order by order.
struct HarmonicSpread {
  double second, fourth;
};
/// A random law of axes.
micromechanics::ScalarHarmonics planted_axes(Random& random, const HarmonicSpread& spread);

/// Each spheroid touches `each` spheres: its sides alone are of its shape, and independent.
BodyPacking draw_among_spheres(Random& random, const micromechanics::Spheroid& s,
                               const micromechanics::ScalarHarmonics& axes, const LocalLaw& law,
                               std::size_t count, std::size_t each);
/// Contacts between spheroids, the contact vectors of both sides independent; the normal is that of
/// the side of a.
BodyPacking draw_pairs(Random& random, const micromechanics::Spheroid& s,
                       const micromechanics::ScalarHarmonics& axes, const LocalLaw& law,
                       std::size_t count, std::size_t contacts);
/// The same in the plane, among disks; a_l of the local law by the long axis.
BodyPacking draw_plane(Random& random, const micromechanics::Spheroid& s, double a_e,
                       const LocalLaw& law, std::size_t count, std::size_t each);

}  // namespace tangency::testing
