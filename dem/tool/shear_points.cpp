// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/shear_points.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <tangency/dem/tool/shear_peaks.hpp>
#include <tangency/dem/tool/strain_windows.hpp>

namespace tangency::inline v0::dem {
namespace {

using Rows = std::span<const ShearPointRow>;

/// The row of [first, end) that is nearest to a strain, the first of equally near ones.
std::size_t nearest(Rows rows, std::size_t first, std::size_t end, double strain) {
  const auto off = [&](const ShearPointRow& row) { return std::abs(row.axial_strain - strain); };
  const auto found = std::min_element(
      rows.begin() + static_cast<std::ptrdiff_t>(first),
      rows.begin() + static_cast<std::ptrdiff_t>(end),
      [&](const ShearPointRow& x, const ShearPointRow& y) { return off(x) < off(y); });
  return static_cast<std::size_t>(found - rows.begin());
}

std::size_t peak_of(Rows rows) {
  std::vector<ShearRow> strained;
  for (const ShearPointRow& row : rows.subspan(1))
    strained.push_back({row.axial_strain, row.volumetric_strain, row.friction_angle_deg});
  return nearest(rows, 1, rows.size(), shear_peaks(strained)->strain_at_friction);
}

std::size_t yield_of(Rows rows, std::size_t peak) {
  double steepest = 0.0;
  std::size_t yield = peak;
  for_each_window(rows.first(peak + 1), kYieldWindow, [&](Rows window) {
    const auto slope = slope_of(window, &ShearPointRow::stress_ratio);
    if (!slope) return;
    if (slope->rate > steepest) {
      steepest = slope->rate;
      yield = peak;
    } else if (yield == peak && slope->rate <= kYieldShare * steepest) {
      yield = nearest(rows, 0, peak + 1, slope->strain);
    }
  });
  return yield;
}

/// From the peak on; nothing where the volume goes on changing.
std::optional<std::size_t> constant_volume_of(Rows rows, std::size_t peak) {
  std::optional<double> strain;
  for_each_window(rows.subspan(peak), kConstantVolumeWindow, [&](Rows window) {
    const double width = window.back().axial_strain - window.front().axial_strain;
    const bool is_whole =
        width >= (1.0 - kWindowSlack) * kConstantVolumeWindow || &window.back() != &rows.back();
    if (strain || !is_whole) return;
    const auto slope = slope_of(window, &ShearPointRow::volumetric_strain);
    if (slope && std::abs(slope->rate) < kConstantVolumeRate) strain = slope->strain;
  });
  if (!strain) return std::nullopt;
  return nearest(rows, peak, rows.size(), *strain);
}

}  // namespace

std::optional<ShearPoints> shear_points(Rows rows) {
  if (rows.size() < 2) return std::nullopt;
  const std::size_t peak = peak_of(rows), last = rows.size() - 1;
  const auto constant = constant_volume_of(rows, peak);
  return ShearPoints{0, yield_of(rows, peak), peak, constant.value_or(last), !constant};
}

}  // namespace tangency::inline v0::dem
