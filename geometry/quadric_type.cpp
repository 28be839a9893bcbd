// SPDX-License-Identifier: MIT
#include <tangency/geometry/quadric_type.hpp>

#include <cstddef>

namespace tangency::inline v0 {

std::string_view to_string(QuadricType type) noexcept {
  static constexpr std::array<std::string_view, 20> kNames{
      "real_ellipsoid",
      "imaginary_ellipsoid",
      "hyperboloid_one_sheet",
      "hyperboloid_two_sheets",
      "elliptic_paraboloid",
      "hyperbolic_paraboloid",
      "real_elliptic_cone",
      "imaginary_elliptic_cone",
      "real_elliptic_cylinder",
      "imaginary_elliptic_cylinder",
      "hyperbolic_cylinder",
      "parabolic_cylinder",
      "real_intersecting_planes",
      "imaginary_intersecting_planes",
      "real_parallel_planes",
      "imaginary_parallel_planes",
      "coincident_planes",
      "plane",
      "no_points",
      "all_space",
  };
  return kNames[static_cast<std::size_t>(type)];
}

bool is_empty(QuadricType type) noexcept {
  return type == QuadricType::imaginary_ellipsoid ||
         type == QuadricType::imaginary_elliptic_cylinder ||
         type == QuadricType::imaginary_parallel_planes || type == QuadricType::no_points;
}

}  // namespace tangency::inline v0
