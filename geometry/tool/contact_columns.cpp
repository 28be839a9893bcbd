// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/contact_columns.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/ellipse_containment.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>

namespace tangency::inline v0::tool {
namespace {

void sizes(const ContactRow& row, Cells cells) {
  const PerramWertheimFactor found = perram_wertheim_factor(row.a, row.b);
  if (found.status != OtherGapStatus::ok) return;
  cells[0] = found.factor, cells[1] = found.scale, cells[2] = found.factor_error;
}

void curvatures(const ContactRow& row, Cells cells) {
  if (row.normal == nullptr) return;
  const PrincipalCurvatures found =
      contact_curvature(row.a.ellipsoid(), row.b.ellipsoid(), *row.normal).relative;
  cells[0] = found.curvature[1], cells[1] = found.curvature[0];
}

void derivatives(const ContactRow& row, Cells cells) {
  const Ellipsoid &a = row.a.ellipsoid(), &b = row.b.ellipsoid();
  const GapDerivatives found =
      gap_derivatives(a, b, row.gap != nullptr ? *row.gap : signed_gap(a, b));
  if (found.status != DerivativeStatus::ok && found.status != DerivativeStatus::local) return;
  for (int i = 0; i < 18; ++i) {
    const MatrixEllipsoid& owner = i < kOfBodyB ? row.a : row.b;
    const bool by_axes = owner.exact() == nullptr;
    if (i % kOfBodyB < kSemiAxes || by_axes) cells[static_cast<std::size_t>(i)] = found.gradient[i];
  }
}

/// Which body lies in the other, touching its boundary or not? Of equal ones a.
template <class Row>
std::optional<Inner> nested(const Row& row) {
  switch (row.relation.relation) {
    case Relation::a_in_b:
    case Relation::equal:
      return Inner::a;
    case Relation::b_in_a:
      return Inner::b;
    case Relation::internal_touch:
      return row.relation.inner;
    default:
      return std::nullopt;
  }
}

template <class Row>
void clearances(const Row& row, Cells cells) {
  const std::optional<Inner> inner = nested(row);
  if (!inner) return;
  const auto found = *inner == Inner::a ? clearance(row.a, row.b) : clearance(row.b, row.a);
  cells[0] = found.clearance, cells[1] = found.clearance_error;
}

template <class Row>
void margins(const Row& row, Cells cells) {
  const std::optional<Inner> inner = nested(row);
  if (!inner) return;
  const ContainmentMargin found =
      *inner == Inner::a ? containment_margin(row.a, row.b) : containment_margin(row.b, row.a);
  cells[0] = found.margin, cells[1] = found.margin_error;
}

void volumes(const ContactRow& row, Cells cells) {
  const CommonVolume found = common_volume(row.a, row.b);
  cells[0] = found.volume, cells[1] = found.volume_error;
}

constexpr std::array<std::string_view, 3> kSizes{"F", "mu", "F_error"};
constexpr std::array<std::string_view, 2> kClearances{"clearance", "clearance_error"};
constexpr std::array<std::string_view, 2> kMargins{"margin", "margin_error"};
constexpr std::array<std::string_view, 2> kVolumes{"volume", "volume_error"};
constexpr std::array<std::string_view, 2> kCurvatures{"curvature_min", "curvature_max"};
// In the order of GapGradient.
constexpr std::array<std::string_view, 18> kDerivatives{
    "dgap.a.x",  "dgap.a.y",  "dgap.a.z",  "dgap.a.wx", "dgap.a.wy", "dgap.a.wz",
    "dgap.a.r1", "dgap.a.r2", "dgap.a.r3", "dgap.b.x",  "dgap.b.y",  "dgap.b.z",
    "dgap.b.wx", "dgap.b.wy", "dgap.b.wz", "dgap.b.r1", "dgap.b.r2", "dgap.b.r3"};

/// In space and in the plane.
template <class Row>
constexpr ColumnGroup<Row> clearance_group() {
  return {
      kClearances,
      "  clearance        of a body that lies in the other, by the relation: the least distance\n"
      "                   between the boundaries\n"
      "  clearance_error  proven: the true clearance is this near\n",
      clearances<Row>};
}
template <class Row>
constexpr ColumnGroup<Row> margin_group() {
  return {
      kMargins,
      "  margin           of a body that lies in the other: the largest factor, >= 1, by which\n"
      "                   it can be scaled about its centre and still lies there\n"
      "  margin_error     proven: the true margin is this near\n",
      margins<Row>};
}

constexpr std::array<ColumnGroup<ContactRow>, 6> kContactGroups{{
    {kSizes,
     "  F                the greatest s (1-s) d'((1-s) Ma + s Mb)^-1 d over s: > 1 apart, < 1\n"
     "                   overlapping, 0 where the centres coincide\n"
     "  mu               its root: bodies that are scaled by it about their centres touch\n"
     "  F_error          proven: the true F is this near\n",
     sizes},
    {kCurvatures,
     "  curvature_min curvature_max\n"
     "                   of the distance between the surfaces where their normals are n, the\n"
     "                   sums of both bodies' curvatures: 1/length\n",
     curvatures},
    {kDerivatives,
     "  dgap.a.x dgap.a.y dgap.a.z dgap.b.x dgap.b.y dgap.b.z\n"
     "                   derivatives of the gap as defined above by the centres,\n"
     "  dgap.a.wx dgap.a.wy dgap.a.wz dgap.b.wx dgap.b.wy dgap.b.wz\n"
     "                   by turns about the centres: in space, radians; and\n"
     "  dgap.a.r1 dgap.a.r2 dgap.a.r3 dgap.b.r1 dgap.b.r2 dgap.b.r3\n"
     "                   by semi-axes, of bodies that are given by them. All empty where\n"
     "                   normals tie, so that the gap has no derivative\n",
     derivatives},
    clearance_group<ContactRow>(),
    margin_group<ContactRow>(),
    {kVolumes,
     "  volume           that the bodies have in common: length^3\n"
     "  volume_error     proven: the true volume is this near\n",
     volumes},
}};

constexpr std::array<ColumnGroup<EllipseRow>, 2> kEllipseGroups{
    {clearance_group<EllipseRow>(), margin_group<EllipseRow>()}};

}  // namespace

std::span<const ColumnGroup<ContactRow>> contact_column_groups() { return kContactGroups; }
std::span<const ColumnGroup<EllipseRow>> ellipse_column_groups() { return kEllipseGroups; }

}  // namespace tangency::inline v0::tool
