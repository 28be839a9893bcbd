// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/body_columns.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <tangency/geometry/tables/columns.hpp>

namespace tangency::tool {
namespace {

constexpr std::array<std::string_view, 6> kPlaceAndAxesFields{"x", "y", "z", "r1", "r2", "r3"};
constexpr std::array<std::string_view, 4> kOrientationFields{"qw", "qx", "qy", "qz"};

}  // namespace

BodyColumns::BodyColumns(const csv::Header& header, std::string_view body) {
  const std::string prefix = std::string(body) + '.', who = "body " + std::string(body);
  std::vector<std::string> missing;
  place_and_axes_ = find_columns(header, prefix, kPlaceAndAxesFields, missing);
  if (!missing.empty()) {
    throw lacking(header, who, missing, "a body has the columns x, y, z, r1, r2 and r3");
  }
  const auto orientation = find_columns(header, prefix, kOrientationFields, missing);
  if (missing.empty()) {
    orientation_ = orientation;
  } else if (missing.size() < kOrientationFields.size()) {
    throw lacking(header, who, missing,
                  "the orientation columns qw, qx, qy and qz come all four or not at all");
  }
}

Ellipsoid BodyColumns::read(const csv::RowCursor& row) const {
  std::array<double, 6> p{};
  std::transform(place_and_axes_.begin(), place_and_axes_.end(), p.begin(),
                 [&](csv::Column column) { return row.number(column); });
  std::array<double, 4> q{1, 0, 0, 0};
  if (orientation_) {
    std::transform(orientation_->begin(), orientation_->end(), q.begin(),
                   [&](csv::Column column) { return row.number(column); });
  }
  try {
    return Ellipsoid(Vec3(p[0], p[1], p[2]), Vec3(p[3], p[4], p[5]),
                     Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  } catch (const InvalidEllipsoid& invalid) {
    const EllipsoidFault& fault = invalid.fault();
    const auto place = std::find(kPlaceAndAxesFields.begin(), kPlaceAndAxesFields.end(),
                                 std::string_view(fault.field));
    const auto turn = std::find(kOrientationFields.begin(), kOrientationFields.end(),
                                std::string_view(fault.field));
    const csv::Column column =
        place != kPlaceAndAxesFields.end()
            ? place_and_axes_[static_cast<std::size_t>(place - kPlaceAndAxesFields.begin())]
            : orientation_.value()[static_cast<std::size_t>(turn - kOrientationFields.begin())];
    throw row.error(column, fault.rule);
  }
}

}  // namespace tangency::tool
