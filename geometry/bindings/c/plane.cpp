// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/ellipse_closest_point.hpp>
#include <tangency/geometry/ellipse_containment.hpp>
#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>

namespace tangency::inline v0::c {
namespace {

using Columns = tangency_plane_contact_columns;

constexpr std::array<const char*, 2> kComponents{"x", "y"};

void put_crossings(const Columns& to, std::size_t k, const Crossings& found) {
  for (std::size_t i = 0; i < 4; ++i) {
    const bool is_one = static_cast<int>(i) < found.count;
    put(to.crossing_arms, 4 * k + i, is_one ? found.at[i].arm_a : Vec2(Vec2::Zero()));
    put(to.multiplicities, 4 * k + i, is_one ? found.at[i].multiplicity : 0);
  }
}

/// What is exact for ellipses in any form.
template <class Body>
void ask_any(const Columns& to, std::size_t k, const Body& a, const Body& b) {
  if (to.relation || to.inner || to.crossings) {
    const EllipseRelation found = relation(a, b);
    put(to.relation, k, found.relation);
    put(to.inner, k, found.inner);
    put(to.crossings, k, found.crossings.value_or(-1));
  }
  if (to.gap || to.gap_error || to.normal || to.arm_a || to.arm_b || to.status) {
    put_gap(to, k, signed_gap(a, b));
  }
  if (to.crossing_arms || to.multiplicities) put_crossings(to, k, crossings(a, b));
  if (to.clearance || to.clearance_error) {
    const PlaneClearance found = clearance(a, b);
    put(to.clearance, k, found.clearance);
    put(to.clearance_error, k, found.clearance_error);
  }
  if (to.margin || to.margin_error) {
    const ContainmentMargin found = containment_margin(a, b);
    put(to.margin, k, found.margin);
    put(to.margin_error, k, found.margin_error);
  }
}

/// What is a number of the nearest ellipses by semi-axes.
void ask_nearest(const Columns& to, std::size_t k, const Ellipse& a, const Ellipse& b) {
  if (to.area) put(to.area, k, common_area(a, b));
  if (to.chord_status || to.chord_depth || to.chord_normal || to.chord_point) {
    const ChordContact found = chord_contact(a, b);
    const bool ok = found.status == ChordStatus::ok;
    put(to.chord_status, k, found.status);
    put(to.chord_depth, k, ok ? found.depth : 0.0);
    put(to.chord_normal, k, ok ? found.normal : Vec2(Vec2::Zero()));
    put(to.chord_point, k, ok ? found.point : Vec2(Vec2::Zero()));
  }
}

std::vector<IndexedPair> pairs_of(const std::vector<MatrixEllipse>& all, const unsigned* pairs,
                                  std::size_t count) {
  if (pairs != nullptr) {
    const Pairs checked(all.size(), all.size(), "ellipses", pairs, count);
    return {checked.list().pairs.begin(), checked.list().pairs.end()};
  }
  require_half(count, all.size(), "ellipses");
  std::vector<IndexedPair> own;
  own.reserve(count);
  for (std::size_t k = 0; k < count; ++k) own.push_back(indexed_pair(k, count + k));
  return own;
}

const std::vector<MatrixEllipse>& all_of(const tangency_ellipses* ellipses) {
  if (ellipses == nullptr) refuse("ellipses", "must not be NULL");
  return ellipses->all;
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

int tangency_plane_contacts(const tangency_ellipses* ellipses, const unsigned* pairs, size_t count,
                            const tangency_plane_contact_columns* answers, int threads) {
  return guarded([&] {
    const Columns to = known(answers, "answers");
    const std::vector<MatrixEllipse>& all = all_of(ellipses);
    const std::vector<IndexedPair> list = pairs_of(all, pairs, count);
    each(count, threads, [&](std::size_t k) {
      const MatrixEllipse &a = all[list[k].a], &b = all[list[k].b];
      if (a.exact() == nullptr && b.exact() == nullptr) {
        ask_any(to, k, a.ellipse(), b.ellipse());
      } else {
        ask_any(to, k, a, b);
      }
      ask_nearest(to, k, a.ellipse(), b.ellipse());
    });
  });
}

int tangency_plane_points(const tangency_ellipses* ellipses, const double* points,
                          size_t points_count, const unsigned* pairs, size_t count,
                          const tangency_plane_point_columns* answers, int threads) {
  return guarded([&] {
    const tangency_plane_point_columns to = known(answers, "answers");
    const std::vector<MatrixEllipse>& all = all_of(ellipses);
    const Pairs list(all.size(), points_count, "points", pairs, count);
    require_finite_rows("points", points, 2, points_count, kComponents.data());
    each(count, threads, [&](std::size_t k) {
      const double* const p = points + 2 * list[k].b;
      const PlaneClosestPoint found = closest_point(all[list[k].a], Vec2(p[0], p[1]));
      put(to.distance, k, found.distance);
      put(to.distance_error, k, found.distance_error);
      put(to.normal, k, found.normal);
      put(to.arm, k, found.arm);
      put(to.status, k, found.status);
    });
  });
}

}  // extern "C"
