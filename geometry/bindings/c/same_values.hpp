// SPDX-License-Identifier: MIT
// Made by geometry/bindings/generate.py of table.py. Change those.
/// @file
/// The numbers of tangency.h are those of the C++ library, and the names of all.
#pragma once

#include <array>
#include <string_view>

#include <tangency/geometry/bindings/c/tangency.h>
#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/neighbour_columns.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/time_of_contact.hpp>

namespace tangency::inline v0::c {

static_assert(static_cast<int>(Relation::separate) == TANGENCY_RELATION_SEPARATE);
static_assert(static_cast<int>(Relation::external_touch) == TANGENCY_RELATION_EXTERNAL_TOUCH);
static_assert(static_cast<int>(Relation::overlap) == TANGENCY_RELATION_OVERLAP);
static_assert(static_cast<int>(Relation::internal_touch) == TANGENCY_RELATION_INTERNAL_TOUCH);
static_assert(static_cast<int>(Relation::a_in_b) == TANGENCY_RELATION_A_IN_B);
static_assert(static_cast<int>(Relation::b_in_a) == TANGENCY_RELATION_B_IN_A);
static_assert(static_cast<int>(Relation::equal) == TANGENCY_RELATION_EQUAL);
static_assert(static_cast<int>(Inner::none) == TANGENCY_INNER_NONE);
static_assert(static_cast<int>(Inner::a) == TANGENCY_INNER_A);
static_assert(static_cast<int>(Inner::b) == TANGENCY_INNER_B);
static_assert(static_cast<int>(Tier::filter) == TANGENCY_TIER_FILTER);
static_assert(static_cast<int>(Tier::exact) == TANGENCY_TIER_EXACT);
static_assert(static_cast<int>(GapStatus::ok) == TANGENCY_STATUS_OK);
static_assert(static_cast<int>(GapStatus::local) == TANGENCY_STATUS_LOCAL);
static_assert(static_cast<int>(GapStatus::beyond) == TANGENCY_STATUS_BEYOND);
static_assert(static_cast<int>(GapTier::fast) == TANGENCY_GAP_TIER_FAST);
static_assert(static_cast<int>(GapTier::safeguarded) == TANGENCY_GAP_TIER_SAFEGUARDED);
static_assert(static_cast<int>(GapTier::factored) == TANGENCY_GAP_TIER_FACTORED);
static_assert(static_cast<int>(GapTier::search) == TANGENCY_GAP_TIER_SEARCH);
static_assert(static_cast<int>(GapTier::exact) == TANGENCY_GAP_TIER_EXACT);
static_assert(static_cast<int>(OtherGapStatus::ok) == TANGENCY_OTHER_STATUS_OK);
static_assert(static_cast<int>(OtherGapStatus::not_applicable) ==
              TANGENCY_OTHER_STATUS_NOT_APPLICABLE);
static_assert(static_cast<int>(OtherGapStatus::not_converged) ==
              TANGENCY_OTHER_STATUS_NOT_CONVERGED);
static_assert(static_cast<int>(DerivativeStatus::ok) == TANGENCY_DERIVATIVE_STATUS_OK);
static_assert(static_cast<int>(DerivativeStatus::local) == TANGENCY_DERIVATIVE_STATUS_LOCAL);
static_assert(static_cast<int>(DerivativeStatus::tie) == TANGENCY_DERIVATIVE_STATUS_TIE);
static_assert(static_cast<int>(DerivativeStatus::degenerate) ==
              TANGENCY_DERIVATIVE_STATUS_DEGENERATE);
static_assert(static_cast<int>(CommonVolumeStatus::ok) == TANGENCY_VOLUME_STATUS_OK);
static_assert(static_cast<int>(CommonVolumeStatus::tolerance_not_reached) ==
              TANGENCY_VOLUME_STATUS_TOLERANCE_NOT_REACHED);
static_assert(static_cast<int>(RayStatus::miss) == TANGENCY_RAY_STATUS_MISS);
static_assert(static_cast<int>(RayStatus::hit) == TANGENCY_RAY_STATUS_HIT);
static_assert(static_cast<int>(RayStatus::grazing) == TANGENCY_RAY_STATUS_GRAZING);
static_assert(static_cast<int>(ContactTimeStatus::none) == TANGENCY_TIME_STATUS_NONE);
static_assert(static_cast<int>(ContactTimeStatus::contact) == TANGENCY_TIME_STATUS_CONTACT);
static_assert(static_cast<int>(ContactTimeStatus::touching_at_start) ==
              TANGENCY_TIME_STATUS_TOUCHING_AT_START);
static_assert(static_cast<int>(ContactTimeStatus::grazing) == TANGENCY_TIME_STATUS_GRAZING);
static_assert(static_cast<int>(ContactTimeStatus::not_converged) ==
              TANGENCY_TIME_STATUS_NOT_CONVERGED);
static_assert(static_cast<int>(NeighbourAnswers::pairs) == TANGENCY_NEIGHBOUR_ANSWERS_PAIRS);
static_assert(static_cast<int>(NeighbourAnswers::overlaps) == TANGENCY_NEIGHBOUR_ANSWERS_OVERLAPS);
static_assert(static_cast<int>(NeighbourAnswers::gaps) == TANGENCY_NEIGHBOUR_ANSWERS_GAPS);
static_assert(static_cast<int>(NeighbourAnswers::contacts) == TANGENCY_NEIGHBOUR_ANSWERS_CONTACTS);
static_assert(static_cast<int>(ChordStatus::ok) == TANGENCY_CHORD_STATUS_OK);
static_assert(static_cast<int>(ChordStatus::not_applicable) ==
              TANGENCY_CHORD_STATUS_NOT_APPLICABLE);
static_assert(static_cast<int>(QuadricType::real_ellipsoid) ==
              TANGENCY_QUADRIC_TYPE_REAL_ELLIPSOID);
static_assert(static_cast<int>(QuadricType::imaginary_ellipsoid) ==
              TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPSOID);
static_assert(static_cast<int>(QuadricType::hyperboloid_one_sheet) ==
              TANGENCY_QUADRIC_TYPE_HYPERBOLOID_ONE_SHEET);
static_assert(static_cast<int>(QuadricType::hyperboloid_two_sheets) ==
              TANGENCY_QUADRIC_TYPE_HYPERBOLOID_TWO_SHEETS);
static_assert(static_cast<int>(QuadricType::elliptic_paraboloid) ==
              TANGENCY_QUADRIC_TYPE_ELLIPTIC_PARABOLOID);
static_assert(static_cast<int>(QuadricType::hyperbolic_paraboloid) ==
              TANGENCY_QUADRIC_TYPE_HYPERBOLIC_PARABOLOID);
static_assert(static_cast<int>(QuadricType::real_elliptic_cone) ==
              TANGENCY_QUADRIC_TYPE_REAL_ELLIPTIC_CONE);
static_assert(static_cast<int>(QuadricType::imaginary_elliptic_cone) ==
              TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPTIC_CONE);
static_assert(static_cast<int>(QuadricType::real_elliptic_cylinder) ==
              TANGENCY_QUADRIC_TYPE_REAL_ELLIPTIC_CYLINDER);
static_assert(static_cast<int>(QuadricType::imaginary_elliptic_cylinder) ==
              TANGENCY_QUADRIC_TYPE_IMAGINARY_ELLIPTIC_CYLINDER);
static_assert(static_cast<int>(QuadricType::hyperbolic_cylinder) ==
              TANGENCY_QUADRIC_TYPE_HYPERBOLIC_CYLINDER);
static_assert(static_cast<int>(QuadricType::parabolic_cylinder) ==
              TANGENCY_QUADRIC_TYPE_PARABOLIC_CYLINDER);
static_assert(static_cast<int>(QuadricType::real_intersecting_planes) ==
              TANGENCY_QUADRIC_TYPE_REAL_INTERSECTING_PLANES);
static_assert(static_cast<int>(QuadricType::imaginary_intersecting_planes) ==
              TANGENCY_QUADRIC_TYPE_IMAGINARY_INTERSECTING_PLANES);
static_assert(static_cast<int>(QuadricType::real_parallel_planes) ==
              TANGENCY_QUADRIC_TYPE_REAL_PARALLEL_PLANES);
static_assert(static_cast<int>(QuadricType::imaginary_parallel_planes) ==
              TANGENCY_QUADRIC_TYPE_IMAGINARY_PARALLEL_PLANES);
static_assert(static_cast<int>(QuadricType::coincident_planes) ==
              TANGENCY_QUADRIC_TYPE_COINCIDENT_PLANES);
static_assert(static_cast<int>(QuadricType::plane) == TANGENCY_QUADRIC_TYPE_PLANE);
static_assert(static_cast<int>(QuadricType::no_points) == TANGENCY_QUADRIC_TYPE_NO_POINTS);
static_assert(static_cast<int>(QuadricType::all_space) == TANGENCY_QUADRIC_TYPE_ALL_SPACE);

struct EnumerationName {
  std::string_view enumeration;
  int value;
  const char* name;
};

inline constexpr std::array<EnumerationName, 83> kNames{{
    {"code", 0, "ok"},
    {"code", 1, "bad_row"},
    {"code", 2, "bad_argument"},
    {"code", 3, "out_of_memory"},
    {"code", 4, "internal"},
    {"number", 0, "double"},
    {"number", 1, "float"},
    {"form", 0, "axes"},
    {"form", 1, "shape"},
    {"form", 2, "precision"},
    {"form", 3, "vectors"},
    {"form", 4, "quadric"},
    {"plane_form", 0, "direction"},
    {"plane_form", 1, "angle"},
    {"plane_form", 2, "shape"},
    {"plane_form", 3, "precision"},
    {"plane_form", 4, "conic"},
    {"relation", 0, "separate"},
    {"relation", 1, "external_touch"},
    {"relation", 2, "overlap"},
    {"relation", 3, "internal_touch"},
    {"relation", 4, "a_in_b"},
    {"relation", 5, "b_in_a"},
    {"relation", 6, "equal"},
    {"inner", 0, "none"},
    {"inner", 1, "a"},
    {"inner", 2, "b"},
    {"tier", 0, "filter"},
    {"tier", 1, "exact"},
    {"status", 0, "ok"},
    {"status", 1, "local"},
    {"status", 2, "beyond"},
    {"gap_tier", 0, "fast"},
    {"gap_tier", 1, "safeguarded"},
    {"gap_tier", 2, "factored"},
    {"gap_tier", 3, "search"},
    {"gap_tier", 4, "exact"},
    {"definition", 0, "perram_wertheim"},
    {"definition", 1, "midpoint_potential"},
    {"definition", 2, "trace"},
    {"other_status", 0, "ok"},
    {"other_status", 1, "not_applicable"},
    {"other_status", 2, "not_converged"},
    {"derivative_status", 0, "ok"},
    {"derivative_status", 1, "local"},
    {"derivative_status", 2, "tie"},
    {"derivative_status", 3, "degenerate"},
    {"volume_status", 0, "ok"},
    {"volume_status", 1, "tolerance_not_reached"},
    {"ray_status", 0, "miss"},
    {"ray_status", 1, "hit"},
    {"ray_status", 2, "grazing"},
    {"time_status", 0, "none"},
    {"time_status", 1, "contact"},
    {"time_status", 2, "touching_at_start"},
    {"time_status", 3, "grazing"},
    {"time_status", 4, "not_converged"},
    {"neighbour_answers", 0, "pairs"},
    {"neighbour_answers", 1, "overlaps"},
    {"neighbour_answers", 2, "gaps"},
    {"neighbour_answers", 3, "contacts"},
    {"chord_status", 0, "ok"},
    {"chord_status", 1, "not_applicable"},
    {"quadric_type", 0, "real_ellipsoid"},
    {"quadric_type", 1, "imaginary_ellipsoid"},
    {"quadric_type", 2, "hyperboloid_one_sheet"},
    {"quadric_type", 3, "hyperboloid_two_sheets"},
    {"quadric_type", 4, "elliptic_paraboloid"},
    {"quadric_type", 5, "hyperbolic_paraboloid"},
    {"quadric_type", 6, "real_elliptic_cone"},
    {"quadric_type", 7, "imaginary_elliptic_cone"},
    {"quadric_type", 8, "real_elliptic_cylinder"},
    {"quadric_type", 9, "imaginary_elliptic_cylinder"},
    {"quadric_type", 10, "hyperbolic_cylinder"},
    {"quadric_type", 11, "parabolic_cylinder"},
    {"quadric_type", 12, "real_intersecting_planes"},
    {"quadric_type", 13, "imaginary_intersecting_planes"},
    {"quadric_type", 14, "real_parallel_planes"},
    {"quadric_type", 15, "imaginary_parallel_planes"},
    {"quadric_type", 16, "coincident_planes"},
    {"quadric_type", 17, "plane"},
    {"quadric_type", 18, "no_points"},
    {"quadric_type", 19, "all_space"},
}};

}  // namespace tangency::inline v0::c
