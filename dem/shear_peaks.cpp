// SPDX-License-Identifier: MIT
#include <tangency/dem/shear_peaks.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tangency::dem {
namespace {

/// Relative slack of a window's width: rows at equal steps of strain lie on its end.
constexpr double kWindowSlack = 1e-9;

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

double mean_of(std::span<const ShearRow> rows, double ShearRow::*value) {
  double sum = 0.0;
  for (const ShearRow& row : rows) sum += row.*value;
  return sum / static_cast<double>(rows.size());
}

/// Shows `look` the rows within kPeakWindow from each row on, or three where they are further
/// apart.
template <class Look>
void for_each_window(std::span<const ShearRow> rows, Look&& look) {
  constexpr std::size_t fewest = 3;
  for (std::size_t first = 0, end = 0; first < rows.size(); ++first) {
    const double reach = rows[first].axial_strain + kPeakWindow * (1.0 + kWindowSlack);
    end = std::max(end, first);
    while (end < rows.size() && rows[end].axial_strain <= reach) ++end;
    const std::size_t last = std::min(std::max(end, first + fewest), rows.size());
    // What is left at the end is part of the windows before.
    const bool is_short = rows.back().axial_strain < reach - 2.0 * kWindowSlack * kPeakWindow;
    if (first > 0 && (is_short || last - first < fewest)) break;
    look(rows.subspan(first, last - first));
  }
}

}  // namespace

std::optional<ShearPeaks> shear_peaks(std::span<const ShearRow> rows) {
  if (rows.empty()) return std::nullopt;
  std::optional<double> angle;
  ShearPeaks peaks{};
  for_each_window(rows, [&](std::span<const ShearRow> window) {
    const double mean = mean_of(window, &ShearRow::friction_angle_deg);
    if (angle && mean <= *angle) return;
    angle = peaks.friction_angle_deg = mean;
    peaks.strain_at_friction = mean_of(window, &ShearRow::axial_strain);
  });
  std::vector<ShearRow> all{{0.0, 0.0, 0.0}};
  all.insert(all.end(), rows.begin(), rows.end());
  std::optional<double> rate;
  for_each_window(std::span<const ShearRow>(all), [&](std::span<const ShearRow> window) {
    const auto slope = slope_of(window);
    if (!slope || (rate && slope->rate <= *rate)) return;
    rate = peaks.dilation_rate = slope->rate;
    peaks.strain_at_dilation = slope->strain;
  });
  return peaks;
}

}  // namespace tangency::dem
