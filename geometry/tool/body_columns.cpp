// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/body_columns.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace tangency::tool {
namespace {

constexpr std::array<std::string_view, 6> kPlaceAndAxesFields{"x", "y", "z", "r1", "r2", "r3"};
constexpr std::array<std::string_view, 4> kOrientationFields{"qw", "qx", "qy", "qz"};

std::string column_name(std::string_view body, std::string_view field) {
  return std::string(body) + '.' + std::string(field);
}

/// The columns that were found; the names of the others are added to `missing`.
template <std::size_t N>
std::array<csv::Column, N> find_columns(const csv::Header& header, std::string_view body,
                                        const std::array<std::string_view, N>& fields,
                                        std::vector<std::string>& missing) {
  std::array<csv::Column, N> columns{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::string name = column_name(body, fields[i]);
    if (const auto column = header.find(name)) {
      columns[i] = *column;
    } else {
      missing.push_back(name);
    }
  }
  return columns;
}

csv::Error lacking(const csv::Header& header, std::string_view body,
                   const std::vector<std::string>& missing, std::string_view rule) {
  std::string what = "body " + std::string(body) + " without ";
  for (const std::string& name : missing) what += (&name == &missing.front() ? "" : ", ") + name;
  return csv::Error(
      {.file = header.file(), .line = header.line(), .value = what, .rule = std::string(rule)});
}

}  // namespace

BodyColumns::BodyColumns(const csv::Header& header, std::string_view body) {
  std::vector<std::string> missing;
  place_and_axes_ = find_columns(header, body, kPlaceAndAxesFields, missing);
  if (!missing.empty()) {
    throw lacking(header, body, missing, "a body has the columns x, y, z, r1, r2 and r3");
  }
  const auto orientation = find_columns(header, body, kOrientationFields, missing);
  if (missing.empty()) {
    orientation_ = orientation;
  } else if (missing.size() < kOrientationFields.size()) {
    throw lacking(header, body, missing,
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
