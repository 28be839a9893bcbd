// SPDX-License-Identifier: MIT
#include <tangency/dem/spatial_order.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Steps of the curve along the cell's longest height: 21 bits of each coordinate fill a key.
constexpr double kSteps = 0x1p21;

/// The lowest 21 bits, two zeros between each and the next.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

struct Entry {
  std::uint64_t key;
  std::int32_t id;
  std::uint32_t index;

  bool operator<(const Entry& other) const {
    return std::tie(key, id) < std::tie(other.key, other.id);
  }
};

}  // namespace

std::vector<std::uint32_t> spatial_order(const Particles& particles, const Cell& cell) {
  const Vec3 heights = cell.heights();
  // One step is as long along each axis, so that boxes of the curve are not flat in a flat cell.
  const Vec3 steps = kSteps / heights.head(cell.dimensions).maxCoeff() * heights;
  std::vector<Entry> entries(particles.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Vec3 reduced = cell.reduced(particles.position[i]);
    std::uint64_t key = 0;
    for (int k = 0; k < cell.dimensions; ++k) {
      const bool walled = cell.walled[static_cast<std::size_t>(k)];
      const double within = walled ? reduced[k] : reduced[k] - std::floor(reduced[k]);
      const double step = std::clamp(within * steps[k], 0.0, kSteps - 1.0);
      key |= spread(static_cast<std::uint64_t>(step)) << k;
    }
    entries[i] = {key, particles.id[i], static_cast<std::uint32_t>(i)};
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::uint32_t> order(entries.size());
  std::transform(entries.begin(), entries.end(), order.begin(),
                 [](const Entry& entry) { return entry.index; });
  return order;
}

}  // namespace tangency::inline v0::dem
