// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/thin_cell.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Keeps the two largest values, the larger first.
void keep(std::array<double, 2>& two, double value) {
  if (value > two[0])
    two = {value, two[0]};
  else
    two[1] = std::max(two[1], value);
}

std::string length_text(double x) { return tables::rounded_text(x, 5) + " m"; }

/// "along z", or along how many of each edge.
std::string direction_text(const Image& image, const Cell& cell) {
  if (cell.is_box())
    for (std::size_t k = 0; k < 3; ++k)
      if (image[k] != 0) return std::string("along ") + "xyz"[k];
  std::string text;
  for (const std::int32_t part : image) text += (text.empty() ? "" : ", ") + std::to_string(part);
  return "along (" + text + ") of its edges";
}

}  // namespace

void LeastCell::add(const Vec3& semi_axes, std::size_t count) {
  for (std::size_t k = 0; k < std::min<std::size_t>(count, 2); ++k) {
    keep(largest_, semi_axes.maxCoeff());
    keep(smallest_, semi_axes.minCoeff());
  }
}

double LeastCell::period() const {
  const bool alone = largest_[1] == 0.0;
  return 2.0 * (alone ? largest_[0] : std::max(largest_[0], smallest_[0] + smallest_[1]));
}

double LeastCell::free_period() const { return 2.0 * (largest_[0] + largest_[1]); }

LeastCell least_cell_of(const Particles& particles) {
  LeastCell least;
  for (const Vec3& axes : particles.semi_axes) least.add(axes);
  return least;
}

std::optional<ThinPlace> thin_place(const Cell& cell, const LeastCell& least, double squeezed) {
  const double apart = squeezed * least.wall_distance();
  for (int axis = 0; axis < cell.dimensions; ++axis)
    if (cell.walled[static_cast<std::size_t>(axis)] && !(cell.edges(axis, axis) >= apart))
      return ThinPlace{std::string("the walls along ") + "xyz"[axis] + ", " +
                           length_text(cell.edges(axis, axis)) + " apart, are nearer than " +
                           length_text(apart) + ", where the thickest particle has no place",
                       cell.edges(axis, axis), apart};
  const Image period = cell.shortest_period();
  const double length = cell.translation(period).norm();
  if (period == Image{} || length >= least.period()) return std::nullopt;
  return ThinPlace{"the cell's period " + direction_text(period, cell) + ", " +
                       length_text(length) + ", is below " + length_text(least.period()) +
                       ", where a particle could touch " +
                       (least.is_of_one() ? "an image of its own" : "two images of another"),
                   length, least.period()};
}

std::optional<ThinPlace> doubled_contact(const Particles& particles, const Contacts& contacts,
                                         const NeighbourList& list, const Cell& cell,
                                         const LeastCell& least) {
  const auto name = [&](std::int32_t index) {
    return "particle " + std::to_string(particles.id[static_cast<std::size_t>(index)]);
  };
  const Image shortest = cell.shortest_period();
  if (shortest == Image{} || cell.translation(shortest).norm() >= least.free_period())
    return std::nullopt;
  const auto& pairs = list.pairs();
  const Pair* last = nullptr;  // that touches: images of one pair follow each other
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Pair& pair = pairs[k];
    if (!contacts.touches(k) || static_cast<std::size_t>(pair.b) >= particles.size())
      continue;  // apart, or a wall
    const bool its_own = pair.a == pair.b;
    if (its_own || (last && last->a == pair.a && last->b == pair.b)) {
      Image period = pair.image;
      if (!its_own)
        for (std::size_t axis = 0; axis < 3; ++axis) period[axis] -= last->image[axis];
      const double length = cell.translation(period).norm();
      return ThinPlace{name(pair.a) + " touches " +
                           (its_own ? std::string("an image of its own, ")
                                    : "two images of " + name(pair.b) + ", ") +
                           length_text(length) + " from " + (its_own ? "it" : "each other"),
                       length, least.free_period()};
    }
    last = &pair;
  }
  return std::nullopt;
}

}  // namespace tangency::inline v0::dem
