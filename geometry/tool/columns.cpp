// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/columns.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace tangency::tool {
namespace {

constexpr std::array<std::string_view, 4> kEllipseFields{"x", "y", "r1", "r2"};
constexpr std::array<std::string_view, 2> kDirectionFields{"ux", "uy"};
constexpr std::string_view kDirectionRule =
    "the direction of the first axis is given by both ux and uy, or by angle, not by both";

}  // namespace

tables::Error lacking(const tables::Header& header, std::string_view who,
                      const std::vector<std::string>& missing, std::string_view rule) {
  std::string what = std::string(who) + " without ";
  for (const std::string& name : missing) what += (&name == &missing.front() ? "" : ", ") + name;
  return tables::Error(
      {.file = header.file(), .line = header.line(), .value = what, .rule = std::string(rule)});
}

EllipseColumns::EllipseColumns(const tables::Header& header, std::string_view body) {
  const std::string prefix = std::string(body) + '.', who = "body " + std::string(body);
  std::vector<std::string> missing;
  place_and_axes_ = find_columns(header, prefix, kEllipseFields, missing);
  if (!missing.empty()) {
    throw lacking(header, who, missing, "an ellipse has the columns x, y, r1 and r2");
  }
  const auto direction = find_columns(header, prefix, kDirectionFields, missing);
  const auto angle = header.find(prefix + "angle");
  if (angle && missing.size() < kDirectionFields.size()) {
    throw tables::Error({.file = header.file(),
                         .line = header.line(),
                         .value = who + " with " + header.name(*angle) + " and ux or uy",
                         .rule = std::string(kDirectionRule)});
  }
  if (angle) {
    direction_ = *angle;
  } else if (missing.empty()) {
    direction_ = direction;
  } else {
    throw lacking(header, who, missing, kDirectionRule);
  }
}

tables::Column EllipseColumns::column_of(std::string_view field) const {
  const auto place = std::ranges::find(kEllipseFields, field);
  if (place != kEllipseFields.end()) {
    return place_and_axes_[static_cast<std::size_t>(place - kEllipseFields.begin())];
  }
  if (const auto* angle = std::get_if<tables::Column>(&direction_)) return *angle;
  return std::get<Direction>(direction_)[field == kDirectionFields[0] ? 0 : 1];
}

Ellipse EllipseColumns::read(const tables::RowCursor& row) const {
  std::array<double, 4> p{};
  std::ranges::transform(place_and_axes_, p.begin(),
                         [&](tables::Column column) { return row.number(column); });
  const Vec2 centre(p[0], p[1]), semi_axes(p[2], p[3]);
  try {
    if (const auto* angle = std::get_if<tables::Column>(&direction_)) {
      return Ellipse::at_angle(centre, semi_axes, row.number(*angle));
    }
    const auto& [ux, uy] = std::get<Direction>(direction_);
    const double x = row.number(ux);
    return Ellipse(centre, semi_axes, Vec2(x, row.number(uy)));
  } catch (const InvalidEllipse& invalid) {
    throw row.error(column_of(invalid.fault().field), invalid.fault().rule);
  }
}

}  // namespace tangency::tool
