// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/neighbour_truth.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::inline v0::verify {
namespace {

// Images of b whose bounding sphere comes near that of a: a range in each direction.
struct Images {
  std::array<int, 3> low{}, high{};
};

double reach(const RawEllipsoid& a, const RawEllipsoid& b) {
  constexpr double kMore = 1.001;  // chosen: far above rounding
  return kMore * (std::ranges::max(a.semi_axes) + std::ranges::max(b.semi_axes));
}

Images images(const RawEllipsoid& a, const RawEllipsoid& b, const std::array<double, 3>& cell) {
  Images range;
  for (std::size_t k = 0; k < 3; ++k) {
    if (cell[k] == 0) continue;
    const double d = b.centre[k] - a.centre[k], most = reach(a, b);
    range.low[k] = static_cast<int>(std::ceil((-most - d) / cell[k]));
    range.high[k] = static_cast<int>(std::floor((most - d) / cell[k]));
  }
  return range;
}

template <class Use>
void for_each_image(const Images& range, const Use& use) {
  std::array<int, 3> image{};
  for (image[0] = range.low[0]; image[0] <= range.high[0]; ++image[0]) {
    for (image[1] = range.low[1]; image[1] <= range.high[1]; ++image[1]) {
      for (image[2] = range.low[2]; image[2] <= range.high[2]; ++image[2]) use(image);
    }
  }
}

}  // namespace

std::vector<TruePair> true_pairs(std::span<const RawEllipsoid> bodies,
                                 const std::array<double, 3>& cell) {
  std::vector<TruePair> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i; j < bodies.size(); ++j) {
      for_each_image(images(bodies[i], bodies[j], cell), [&](const std::array<int, 3>& image) {
        if (i == j && image <= std::array<int, 3>{}) return;
        RawEllipsoid moved = bodies[j];
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          moved.centre[k] += image[k] * cell[k];
          const double d = moved.centre[k] - bodies[i].centre[k];
          square += d * d;
        }
        if (square > reach(bodies[i], bodies[j]) * reach(bodies[i], bodies[j])) return;
        const Relation relation = exact_relation(bodies[i], moved).relation;
        if (relation != Relation::separate) pairs.push_back({i, j, image, relation});
      });
    }
  }
  return pairs;
}

}  // namespace tangency::inline v0::verify
