// SPDX-License-Identifier: MIT
#include <tangency/geometry/near_pairs.hpp>

#include <algorithm>
#include <functional>

#include <tangency/geometry/near/near_grids.hpp>
#include <tangency/geometry/near/sorted_by_pair.hpp>

namespace tangency::inline v0 {

NearPairSearch::NearPairSearch(std::span<const Vec3> centres, std::span<const double> reaches,
                               const Lattice& lattice)
    : grids_(std::make_unique<const detail::NearGrids>(centres, reaches, lattice)) {}
NearPairSearch::~NearPairSearch() = default;
NearPairSearch::NearPairSearch(NearPairSearch&&) noexcept = default;
NearPairSearch& NearPairSearch::operator=(NearPairSearch&&) noexcept = default;

std::size_t NearPairSearch::size() const noexcept { return grids_->size(); }
double NearPairSearch::margin() const noexcept { return grids_->margin(); }

void NearPairSearch::find(std::size_t first, std::size_t last, std::vector<NearPair>& found) const {
  grids_->find(first, std::min(last, size()), found);
}

std::vector<NearPair> sorted_pairs(std::span<const std::vector<NearPair>> parts,
                                   std::size_t bodies) {
  const auto for_each = [&](const auto& use) {
    for (const auto& part : parts)
      for (const NearPair& pair : part) use(pair);
  };
  return detail::sorted_by_pair<NearPair>(bodies, for_each, std::identity());
}

std::vector<NearPair> near_pairs(std::span<const Vec3> centres, std::span<const double> reaches,
                                 const Lattice& lattice) {
  const NearPairSearch search(centres, reaches, lattice);
  std::vector<std::vector<NearPair>> parts(1);
  search.find(0, search.size(), parts.front());
  return sorted_pairs(parts, search.size());
}

}  // namespace tangency::inline v0
