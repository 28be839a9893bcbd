// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/shear_peaks.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tangency/dem/tool/strain_windows.hpp>

namespace tangency::inline v0::dem {
namespace {

double mean_of(std::span<const ShearRow> rows, double ShearRow::*value) {
  double sum = 0.0;
  for (const ShearRow& row : rows) sum += row.*value;
  return sum / static_cast<double>(rows.size());
}

}  // namespace

std::optional<ShearPeaks> shear_peaks(std::span<const ShearRow> rows) {
  if (rows.empty()) return std::nullopt;
  std::optional<double> angle;
  ShearPeaks peaks{};
  for_each_window(rows, kPeakWindow, [&](std::span<const ShearRow> window) {
    const double mean = mean_of(window, &ShearRow::friction_angle_deg);
    if (angle && mean <= *angle) return;
    angle = peaks.friction_angle_deg = mean;
    peaks.strain_at_friction = mean_of(window, &ShearRow::axial_strain);
  });
  std::vector<ShearRow> all{{0.0, 0.0, 0.0}};
  all.insert(all.end(), rows.begin(), rows.end());
  std::optional<double> rate;
  for_each_window(std::span<const ShearRow>(all), kPeakWindow,
                  [&](std::span<const ShearRow> window) {
                    const auto slope = slope_of(window, &ShearRow::volumetric_strain);
                    if (!slope || (rate && slope->rate <= *rate)) return;
                    rate = peaks.dilation_rate = slope->rate;
                    peaks.strain_at_dilation = slope->strain;
                  });
  return peaks;
}

}  // namespace tangency::inline v0::dem
