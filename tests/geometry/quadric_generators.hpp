// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Quadrics whose type is known by construction: a normal form of each type, taken through affine
/// maps with integer coefficients. All entries stay small integers, so nothing rounds.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cstdint>
#include <iosfwd>
#include <ostream>

#include <tangency/geometry/classify.hpp>

namespace tangency::testing {

/// A B C D E F G H J K
using IntegerQuadric = std::array<std::int64_t, 10>;

struct NormalForm {
  QuadricType type;
  int rank4;
  int rank3;
  IntegerQuadric quadric;
};

/// From the textbook equations, one for each type.
inline constexpr std::array<NormalForm, 20> kNormalForms{{
    {QuadricType::real_ellipsoid, 4, 3, {1, 1, 1, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::imaginary_ellipsoid, 4, 3, {1, 1, 1, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::hyperboloid_one_sheet, 4, 3, {1, 1, -1, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::hyperboloid_two_sheets, 4, 3, {1, 1, -1, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::elliptic_paraboloid, 4, 2, {1, 1, 0, 0, 0, 0, 0, 0, 1, 0}},
    {QuadricType::hyperbolic_paraboloid, 4, 2, {1, -1, 0, 0, 0, 0, 0, 0, 1, 0}},
    {QuadricType::real_elliptic_cone, 3, 3, {1, 1, -1, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::imaginary_elliptic_cone, 3, 3, {1, 1, 1, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::real_elliptic_cylinder, 3, 2, {1, 1, 0, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::imaginary_elliptic_cylinder, 3, 2, {1, 1, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::hyperbolic_cylinder, 3, 2, {1, -1, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::parabolic_cylinder, 3, 1, {1, 0, 0, 0, 0, 0, 0, 1, 0, 0}},
    {QuadricType::real_intersecting_planes, 2, 2, {1, -1, 0, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::imaginary_intersecting_planes, 2, 2, {1, 1, 0, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::real_parallel_planes, 2, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0, -1}},
    {QuadricType::imaginary_parallel_planes, 2, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::coincident_planes, 1, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {QuadricType::plane, 2, 0, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0}},
    {QuadricType::no_points, 1, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {QuadricType::all_space, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
}};

/// Affine map x -> L x + t, L regular.
struct IntegerMap {
  std::array<std::array<std::int64_t, 3>, 3> l;
  std::array<std::int64_t, 3> t;

  std::int64_t determinant() const {
    return l[0][0] * (l[1][1] * l[2][2] - l[1][2] * l[2][1]) -
           l[0][1] * (l[1][0] * l[2][2] - l[1][2] * l[2][0]) +
           l[0][2] * (l[1][0] * l[2][1] - l[1][1] * l[2][0]);
  }
};

/// S' Q S, S = [L t; 0 1]: the surface of all x whose image lies on the given one.
IntegerQuadric pulled_back(const IntegerQuadric& c, const IntegerMap& map);

rc::Gen<IntegerMap> integer_map();

/// factor times the integers: exact where the factor is a power of two in a moderate range.
Quadric to_quadric(const IntegerQuadric& integers, double factor = 1.0);

}  // namespace tangency::testing

namespace rc {
void showValue(const tangency::Quadric& q, std::ostream& os);
}  // namespace rc
