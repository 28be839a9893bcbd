// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/contact_columns.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>

namespace tangency::tool {
namespace {

using Names = std::span<const std::string_view>;
/// As many as the group has columns; nothing where the row has no such number.
using Cells = std::span<std::optional<double>>;

/// Columns that are found together.
struct Group {
  Names names;
  std::string_view help;  ///< lines, each with its end
  void (*answer)(const ContactRow& row, Cells cells);
};

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
std::optional<Inner> nested(const RelationAnswer& relation) {
  switch (relation.relation) {
    case Relation::a_in_b:
    case Relation::equal:
      return Inner::a;
    case Relation::b_in_a:
      return Inner::b;
    case Relation::internal_touch:
      return relation.inner;
    default:
      return std::nullopt;
  }
}

void clearances(const ContactRow& row, Cells cells) {
  const std::optional<Inner> inner = nested(row.relation);
  if (!inner) return;
  const Clearance found = *inner == Inner::a ? clearance(row.a, row.b) : clearance(row.b, row.a);
  cells[0] = found.clearance, cells[1] = found.clearance_error;
}

void margins(const ContactRow& row, Cells cells) {
  const std::optional<Inner> inner = nested(row.relation);
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

constexpr std::array kGroups{
    Group{
        kSizes,
        "  F                the greatest s (1-s) d'((1-s) Ma + s Mb)^-1 d over s: > 1 apart, < 1\n"
        "                   overlapping, 0 where the centres coincide\n"
        "  mu               its root: bodies that are scaled by it about their centres touch\n"
        "  F_error          proven: the true F is this near\n",
        sizes},
    Group{kCurvatures,
          "  curvature_min curvature_max\n"
          "                   of the distance between the surfaces where their normals are n, the\n"
          "                   sums of both bodies' curvatures: 1/length\n",
          curvatures},
    Group{kDerivatives,
          "  dgap.a.x dgap.a.y dgap.a.z dgap.b.x dgap.b.y dgap.b.z\n"
          "                   derivatives of the gap as defined above by the centres,\n"
          "  dgap.a.wx dgap.a.wy dgap.a.wz dgap.b.wx dgap.b.wy dgap.b.wz\n"
          "                   by turns about the centres: in space, radians; and\n"
          "  dgap.a.r1 dgap.a.r2 dgap.a.r3 dgap.b.r1 dgap.b.r2 dgap.b.r3\n"
          "                   by semi-axes, of bodies that are given by them. All empty where\n"
          "                   normals tie, so that the gap has no derivative\n",
          derivatives},
    Group{
        kClearances,
        "  clearance        of a body that lies in the other, by the relation: the least distance\n"
        "                   between the two surfaces\n"
        "  clearance_error  proven: the true clearance is this near\n",
        clearances},
    Group{
        kMargins,
        "  margin           of a body that lies in the other: the largest factor, >= 1, by which\n"
        "                   it can be scaled about its centre and still lies there\n"
        "  margin_error     proven: the true margin is this near\n",
        margins},
    Group{kVolumes,
          "  volume           that the bodies have in common: length^3\n"
          "  volume_error     proven: the true volume is this near\n",
          volumes},
};

constexpr std::size_t kMostInAGroup = std::ranges::max_element(kGroups, {}, [](const Group& g) {
                                        return g.names.size();
                                      })->names.size();

/// Where a column stands in the table.
struct Found {
  std::size_t group, column;
};
std::optional<Found> find_column(std::string_view name) {
  for (std::size_t g = 0; g < kGroups.size(); ++g) {
    const Names names = kGroups[g].names;
    const auto at = std::ranges::find(names, name);
    if (at != names.end()) return Found{g, static_cast<std::size_t>(at - names.begin())};
  }
  return std::nullopt;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(',');
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// "F, mu and F_error"
std::string all_names() {
  std::vector<std::string_view> names;
  for (const Group& group : kGroups)
    names.insert(names.end(), group.names.begin(), group.names.end());
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool last = i + 1 == names.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + std::string(names[i]);
  }
  return text;
}

}  // namespace

std::string refused_columns(const std::string& names) {
  const std::vector<std::string_view> asked = split(names);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::string name(asked[i]);
    if (!find_column(name)) {
      return (name.empty() ? "an empty name" : name) + " is not a further column; " + all_names() +
             " are, separated by commas";
    }
    if (std::find(asked.begin(), asked.begin() + static_cast<std::ptrdiff_t>(i), name) !=
        asked.begin() + static_cast<std::ptrdiff_t>(i)) {
      return name + " is named twice; each column may be named once";
    }
  }
  return {};
}

std::string contact_columns_help() {
  std::string help;
  for (const Group& group : kGroups) help += group.help;
  return help;
}

ContactColumns::ContactColumns(const std::string& names) {
  if (names.empty()) return;
  for (const std::string_view name : split(names)) {
    const Found at = find_column(name).value();
    names_.push_back(kGroups[at.group].names[at.column]);
    places_.push_back({at.group, at.column});
    if (std::ranges::find(groups_, at.group) == groups_.end()) groups_.push_back(at.group);
  }
}

void ContactColumns::write(const ContactRow& row, tables::RowText& out) const {
  std::array<std::array<std::optional<double>, kMostInAGroup>, kGroups.size()> cells;
  for (const std::size_t g : groups_) {
    kGroups[g].answer(row, Cells(cells[g]).first(kGroups[g].names.size()));
  }
  for (const Place& place : places_) {
    const std::optional<double>& cell = cells[place.group][place.column];
    if (cell && std::isfinite(*cell)) {
      out.number(*cell);
    } else {
      out.empty();
    }
  }
}

}  // namespace tangency::tool
