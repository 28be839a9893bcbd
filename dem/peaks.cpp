// SPDX-License-Identifier: MIT
#include <algorithm>
#include <tangency/dem/peaks.hpp>
#include <vector>

namespace tangency::dem {
namespace {

/// Relative slack of a window's width: rows at equal steps of strain lie on its end.
constexpr double rounding = 1e-9;

struct Slope {
  double rate, strain;
};

/// Least squares; nothing where the strains are all the same.
std::optional<Slope> slope_of(std::span<const ShearRow> rows) {
  const auto count = static_cast<double>(rows.size());
  double strain = 0.0, volume = 0.0;
  for (const ShearRow& row : rows) {
    strain += row.axial_strain / count;
    volume += row.volumetric_strain / count;
  }
  double square = 0.0, product = 0.0;
  for (const ShearRow& row : rows) {
    const double off = row.axial_strain - strain;
    square += off * off;
    product += off * (row.volumetric_strain - volume);
  }
  if (!(square > 0.0)) return std::nullopt;
  return Slope{product / square, strain};
}

}  // namespace

std::optional<ShearPeaks> shear_peaks(std::span<const ShearRow> rows) {
  if (rows.empty()) return std::nullopt;
  const auto highest = std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.friction_angle_deg < b.friction_angle_deg;
  });
  ShearPeaks peaks{highest->friction_angle_deg, highest->axial_strain, 0.0, 0.0};

  std::vector<ShearRow> all{{0.0, 0.0, 0.0}};
  all.insert(all.end(), rows.begin(), rows.end());
  const std::span<const ShearRow> points = all;
  constexpr std::size_t fewest = 3;
  bool found = false;
  for (std::size_t first = 0, end = 0; first < points.size(); ++first) {
    const double reach = points[first].axial_strain + dilation_window * (1.0 + rounding);
    end = std::max(end, first);
    while (end < points.size() && points[end].axial_strain <= reach) ++end;
    const std::size_t last = std::min(std::max(end, first + fewest), points.size());
    // What is left at the end is part of the windows before.
    const bool is_short = points.back().axial_strain < reach - 2.0 * rounding * dilation_window;
    if (first > 0 && (is_short || last - first < fewest)) break;
    const auto slope = slope_of(points.subspan(first, last - first));
    if (!slope || (found && slope->rate <= peaks.dilation_rate)) continue;
    found = true;
    peaks.dilation_rate = slope->rate;
    peaks.strain_at_dilation = slope->strain;
  }
  return peaks;
}

}  // namespace tangency::dem
