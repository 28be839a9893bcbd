// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <tangency/dem/sample.hpp>

namespace tangency::dem {
namespace {

using Sites = Eigen::Array<std::int64_t, 3, 1>;

/// A kind for every site in random order; the surplus is -1, an empty site.
std::vector<std::int32_t> shuffled_kinds(const std::vector<Batch>& batches, std::size_t sites,
                                         std::mt19937_64& random) {
  std::vector<std::int32_t> kinds;
  for (std::size_t k = 0; k < batches.size(); ++k)
    kinds.insert(kinds.end(), batches[k].count, static_cast<std::int32_t>(k));
  kinds.resize(sites, -1);
  for (std::size_t left = sites; left > 1; --left) {
    const auto pick = static_cast<std::size_t>(uniform(random) * static_cast<double>(left));
    std::swap(kinds[left - 1], kinds[pick]);
  }
  return kinds;
}

/// Sites that a lattice may have: a nearly empty one would only waste memory. Chosen.
constexpr double most_sites = 1e8;

/// Relative gap that keeps rounding from making neighbours overlap. Chosen.
constexpr double clearance = 1e-6;

/// The cell and its number of sites along each edge.
struct Lattice {
  Vec3 edges;
  Sites sites;
};

Lattice lattice_for(const std::vector<Batch>& batches, const LatticePlacement& how) {
  std::int64_t particles = 0;
  double largest = 0.0;
  for (const Batch& batch : batches) {
    particles += static_cast<std::int64_t>(batch.count);
    largest = std::max(largest, batch.shape.semi_axes().maxCoeff());
  }
  // Jitter moves two neighbours towards each other by up to twice its size along an edge.
  const double spacing = 2.0 * (largest + how.jitter) * (1.0 + clearance);
  if (!how.cell_size) {
    std::int64_t edge = 1;
    while (edge * edge * edge < particles) ++edge;
    return {Vec3::Constant(spacing * static_cast<double>(edge)), Sites::Constant(edge)};
  }
  const Eigen::Array3d sites = (how.cell_size->array() / spacing).floor();
  std::ostringstream room;
  room << "a cubic lattice in it has " << sites.prod() << " sites";
  if (sites.prod() < static_cast<double>(particles))
    throw DoesNotFit(room.str() + ", fewer than the " + std::to_string(particles) + " particles");
  if (sites.prod() > most_sites) throw DoesNotFit(room.str() + ", more than 1e8");
  return {*how.cell_size, sites.cast<std::int64_t>()};
}

}  // namespace

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Eigen::Quaterniond uniform_rotation(std::mt19937_64& random) {
  const double u = uniform(random);
  const double first = 2.0 * std::numbers::pi * uniform(random);
  const double second = 2.0 * std::numbers::pi * uniform(random);
  const double s = std::sqrt(1.0 - u), t = std::sqrt(u);
  return {t * std::cos(second), s * std::sin(first), s * std::cos(first), t * std::sin(second)};
}

void check_room(const std::vector<Batch>& batches, const LatticePlacement& how) {
  lattice_for(batches, how);
}

Particles place_on_lattice(const std::vector<Batch>& batches, const LatticePlacement& how,
                           Cell& cell) {
  const auto [edges, sites] = lattice_for(batches, how);
  cell = {edges, Vec3::Zero(), edges};
  std::mt19937_64 random(how.seed);
  const auto kinds = shuffled_kinds(batches, static_cast<std::size_t>(sites.prod()), random);

  Particles particles;
  const Vec3 spacing = cell.length.array() / sites.cast<double>();
  for (std::size_t site = 0; site < kinds.size(); ++site) {
    if (kinds[site] < 0) continue;
    const auto index = static_cast<std::int64_t>(site);
    const Sites at(index % sites[0], index / sites[0] % sites[1], index / (sites[0] * sites[1]));
    Vec3 centre = spacing.array() * (at.cast<double>() + 0.5);
    for (int k = 0; k < 3; ++k) centre[k] += how.jitter * (2.0 * uniform(random) - 1.0);
    const Batch& batch = batches[static_cast<std::size_t>(kinds[site])];
    particles.add(centre, uniform_rotation(random), batch.shape.semi_axes(), batch.density,
                  kinds[site]);
  }
  return particles;
}

}  // namespace tangency::dem
