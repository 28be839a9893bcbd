// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/exact_quadric_type.hpp>

#include <cassert>
#include <cstdlib>
#include <utility>

namespace tangency::inline v0::exact {
namespace {

struct Row {
  int positive3, negative3;  ///< of Q_s
  int positive4, negative4;  ///< of Q
  QuadricType type;
};

using enum QuadricType;

/// Each type up to the sign of Q: more positive than negative eigenvalues of Q_s, or as many and
/// then at least as many of Q.
constexpr Row kDiagram[] = {
    {3, 0, 3, 1, real_ellipsoid},
    {3, 0, 4, 0, imaginary_ellipsoid},
    {3, 0, 3, 0, imaginary_elliptic_cone},
    {2, 1, 2, 2, hyperboloid_one_sheet},
    {2, 1, 3, 1, hyperboloid_two_sheets},
    {2, 1, 2, 1, real_elliptic_cone},
    {2, 0, 3, 1, elliptic_paraboloid},
    {2, 0, 2, 1, real_elliptic_cylinder},
    {2, 0, 3, 0, imaginary_elliptic_cylinder},
    {2, 0, 2, 0, imaginary_intersecting_planes},
    {1, 1, 2, 2, hyperbolic_paraboloid},
    {1, 1, 2, 1, hyperbolic_cylinder},
    {1, 1, 1, 1, real_intersecting_planes},
    {1, 0, 2, 1, parabolic_cylinder},
    {1, 0, 1, 1, real_parallel_planes},
    {1, 0, 2, 0, imaginary_parallel_planes},
    {1, 0, 1, 0, coincident_planes},
    {0, 0, 1, 1, plane},
    {0, 0, 1, 0, no_points},
    {0, 0, 0, 0, all_space},
};

}  // namespace

QuadricType type_of(Inertia q, Inertia s) noexcept {
  const auto excess = [](const Inertia& i) { return i.positive - i.negative; };
  if (std::pair(excess(s), excess(q)) < std::pair(0, 0)) {
    q = q.negated();
    s = s.negated();
  }
  for (const Row& row : kDiagram) {
    if (row.positive3 == s.positive && row.negative3 == s.negative && row.positive4 == q.positive &&
        row.negative4 == q.negative) {
      return row.type;
    }
  }
  assert(false && "inertias of a quadric");
  std::abort();
}

Classification classify_form(const IntegerForm<4>& form) {
  const Inertia q = inertia(form);
  const Inertia s = inertia(sub_form(form));
  return {type_of(q, s), q.rank(), s.rank(), Tier::exact};
}

}  // namespace tangency::inline v0::exact
