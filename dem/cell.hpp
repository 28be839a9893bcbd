// SPDX-License-Identifier: MIT
/// @file
/// The periodic rectangular cell that an assembly lives in, straining homogeneously.
///
/// One corner stays at the origin, so that the affine velocity at x is rate * x. Inside the
/// simulator extension is positive; scenes and histories turn the sign (observe.hpp).
///
/// A plane cell has dimensions = 2: the bodies lie in the plane z = 0, its edge along z is 1, the
/// unit thickness, which does not strain, and there are no images along z.
#pragma once

#include <array>
#include <cstdint>
#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::dem {

/// Which periodic image of a particle: how many cell lengths it is moved along each axis.
using Image = std::array<std::int32_t, 3>;

struct Cell {
  Vec3 length = Vec3::Ones();            ///< edges along x, y, z; > 0
  Vec3 rate = Vec3::Zero();              ///< strain rate along x, y, z, extension > 0, 1/time
  Vec3 reference_length = Vec3::Ones();  ///< edges where strain is measured from
  int dimensions = 3;                    ///< 2 or 3: the axes that are periodic and strain

  double volume() const { return length.prod(); }

  /// The translation that takes a particle to its image.
  Vec3 translation(const Image& image) const {
    return {image[0] * length[0], image[1] * length[1], image[2] * length[2]};
  }

  /// The isotropic strain rate r: r along every axis that strains.
  Vec3 isotropic(double r) const { return {r, r, dimensions == 3 ? r : 0.0}; }

  /// The image number of the cell that holds x: floor(x / length).
  Image image_of(const Vec3& x) const;

  /// One step of the homogeneous strain, as the particles take it: length *= 1 + rate dt
  /// [Ouadfel1998, eq. 3.33].
  void strain(double dt) { length.array() *= 1.0 + rate.array() * dt; }

  /// Logarithmic strain from the reference, extension positive.
  Vec3 logarithmic_strain() const;
};

}  // namespace tangency::dem
