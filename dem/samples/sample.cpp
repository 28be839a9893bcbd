// SPDX-License-Identifier: MIT
#include <tangency/dem/samples/sample.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include <tangency/dem/contact/thin_cell.hpp>
#include <tangency/dem/samples/insertion.hpp>
#include <tangency/dem/samples/placed_balls.hpp>

namespace tangency::inline v0::dem {
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
constexpr double kMostSites = 1e8;

/// Relative gap that keeps rounding from making neighbours overlap. Chosen.
constexpr double kClearance = 1e-6;

/// The cell and its number of sites along each edge.
struct Lattice {
  Vec3 edges;
  Sites sites;
};

Lattice lattice_for(const std::vector<Batch>& batches, const Placement& how) {
  std::int64_t particles = 0;
  double largest = 0.0;
  for (const Coming& one : coming_particles(batches, how.dimensions)) {
    ++particles;
    largest = std::max(largest, one.radius());
  }
  // Jitter moves two neighbours towards each other by up to twice its size along an edge.
  const double spacing = 2.0 * (largest + how.jitter) * (1.0 + kClearance);
  const bool plane = how.dimensions == 2;
  if (!how.cell_size) {
    std::int64_t edge = 1;
    while (edge * edge * (plane ? 1 : edge) < particles) ++edge;
    const double length = spacing * static_cast<double>(edge);
    return {{length, length, plane ? 1.0 : length}, {edge, edge, plane ? 1 : edge}};
  }
  Eigen::Array3d sites = (how.cell_size->array() / spacing).floor();
  if (plane) sites[2] = 1.0;
  std::ostringstream room;
  room << "a " << (plane ? "square" : "cubic") << " lattice in it has " << sites.prod() << " sites";
  if (sites.prod() < static_cast<double>(particles))
    throw DoesNotFit(room.str() + ", fewer than the " + std::to_string(particles) + " particles");
  if (sites.prod() > kMostSites) throw DoesNotFit(room.str() + ", more than 1e8");
  return {*how.cell_size, sites.cast<std::int64_t>()};
}

/// Draws before random placement gives up on a particle. Chosen: of a thousand equal ones at the
/// largest bounding fraction, none took more than 500 in the plane and 1500 in space.
constexpr int kMostDraws = 100000;

/// The cell of a random placement. @throws DoesNotFit
Vec3 room_for(const std::vector<Batch>& batches, const Placement& how) {
  const auto bounding_volume = [](const Coming& one, int dimensions) {
    return volume_of(Vec3::Constant(one.radius()), dimensions);
  };
  return edges_with_room(
      batches, how,
      {how.dimensions == 2 ? "bounding circles" : "bounding spheres", bounding_volume,
       how.bounding_fraction, largest_bounding_fraction(how.dimensions), kClearance});
}

Particles place_bodies(const std::vector<Batch>& batches, const Placement& how, Cell& cell) {
  cell = Cell::box(how.cell_size.value(), how.dimensions, how.walled);
  Particles particles;
  particles.dimensions = how.dimensions;
  for (const Body& body : how.bodies) {
    const Batch& batch = batches[body.type];
    const bool own = !body.semi_axes.isZero(0.0);
    particles.add(body.position, body.orientation,
                  own ? body.semi_axes : batch.shape.semi_axes(how.dimensions), batch.density,
                  static_cast<std::int32_t>(body.type));
    particles.velocity.back() = body.velocity;
    particles.angular_velocity.back() = body.angular_velocity;
  }
  return particles;
}

/// The cell's edges. @throws DoesNotFit
Vec3 edges_for(const std::vector<Batch>& batches, const Placement& how) {
  if (how.arrangement == Arrangement::random) return room_for(batches, how);
  if (how.arrangement == Arrangement::insertion) return insertion_edges(batches, how);
  if (how.arrangement == Arrangement::lattice) return lattice_for(batches, how).edges;
  if (!how.cell_size) throw DoesNotFit("an explicit arrangement needs cell.size");
  return *how.cell_size;
}

}  // namespace

void check_room(const std::vector<Batch>& batches, const Placement& how) {
  edges_for(batches, how);
}

void check_thickness(const std::vector<Batch>& batches, const Placement& how) {
  const Vec3 edges = edges_for(batches, how);
  LeastCell least;
  for (const Coming& one : coming_particles(batches, how.dimensions)) least.add(one.axes);
  const auto thin = thin_place(Cell::box(edges, how.dimensions, how.walled), least);
  if (!thin) return;
  std::ostringstream text;
  text << thin->what;
  if (!how.cell_size) {
    const bool inserted = how.arrangement == Arrangement::insertion;
    const double most = (inserted ? how.volume_fraction : how.bounding_fraction) *
                        std::pow(thin->length / thin->least, how.dimensions);
    text << (inserted ? "; volume_fraction can be " : "; bounding_fraction can be ")
         << std::floor(1e3 * most) / 1e3;
  }
  throw DoesNotFit(text.str());
}

Particles place(const std::vector<Batch>& batches, const Placement& how, Cell& cell) {
  check_room(batches, how);
  if (how.arrangement == Arrangement::random) return place_at_random(batches, how, cell);
  if (how.arrangement == Arrangement::insertion) return insert(batches, how, cell);
  if (how.arrangement == Arrangement::lattice) return place_on_lattice(batches, how, cell);
  return place_bodies(batches, how, cell);
}

Particles place_on_lattice(const std::vector<Batch>& batches, const Placement& how, Cell& cell) {
  const auto [edges, sites] = lattice_for(batches, how);
  cell = Cell::box(edges, how.dimensions, how.walled);
  std::mt19937_64 random(how.seed);
  const auto kinds = shuffled_kinds(batches, static_cast<std::size_t>(sites.prod()), random);

  Particles particles;
  particles.dimensions = how.dimensions;
  const Vec3 spacing = edges.array() / sites.cast<double>();
  std::vector<std::size_t> placed(batches.size(), 0);
  for (std::size_t site = 0; site < kinds.size(); ++site) {
    if (kinds[site] < 0) continue;
    const auto index = static_cast<std::int64_t>(site);
    const Sites at(index % sites[0], index / sites[0] % sites[1], index / (sites[0] * sites[1]));
    Vec3 centre = Vec3::Zero();
    for (int k = 0; k < how.dimensions; ++k)
      centre[k] = spacing[k] * (static_cast<double>(at[k]) + 0.5) +
                  how.jitter * (2.0 * uniform(random) - 1.0);
    const auto kind = static_cast<std::size_t>(kinds[site]);
    const Batch& batch = batches[kind];
    particles.add(centre, how.axes.draw(random, batch.directed_axis, how.dimensions),
                  batch.shape_of(placed[kind]++).semi_axes(how.dimensions), batch.density,
                  kinds[site]);
  }
  return particles;
}

Particles place_at_random(const std::vector<Batch>& batches, const Placement& how, Cell& cell) {
  const Vec3 edges = room_for(batches, how);
  cell = Cell::box(edges, how.dimensions, how.walled);
  std::vector<Coming> coming = coming_particles(batches, how.dimensions);
  sort_largest_first(coming);
  PlacedBalls placed(edges, bounding_radii(coming, kClearance), how.dimensions);
  std::mt19937_64 random(how.seed);
  Particles particles;
  particles.dimensions = how.dimensions;
  for (const Coming& one : coming) {
    const Batch& batch = batches[one.batch];
    const double radius = Vec3(one.axes * (1.0 + kClearance)).maxCoeff();
    Vec3 centre = Vec3::Zero();
    int draws = 0;
    do {
      if (++draws > kMostDraws)
        throw DoesNotFit("random placement found no room for particle " +
                         std::to_string(particles.size() + 1) + " in " +
                         std::to_string(kMostDraws) + " draws; another seed may");
      for (int axis = 0; axis < how.dimensions; ++axis)
        centre[axis] = how.walled[static_cast<std::size_t>(axis)]
                           ? radius + (edges[axis] - 2.0 * radius) * uniform(random)
                           : edges[axis] * uniform(random);
    } while (placed.any_meets(centre, radius, [](std::size_t, const Vec3&) { return true; }));
    placed.add(centre, radius);
    particles.add(centre, how.axes.draw(random, batch.directed_axis, how.dimensions), one.axes,
                  batch.density, static_cast<std::int32_t>(one.batch));
  }
  return particles;
}

}  // namespace tangency::inline v0::dem
