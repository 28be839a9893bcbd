// SPDX-License-Identifier: MIT
// Periodic Delaunay simplices by Qhull, of the centres in the cell and of their images around it.
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/strain_mesh.hpp>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace tangency::inline v0::micromechanics {
namespace {

/// By how much centres, and the cell, are moved in one try after the other, in mean distances.
/// Chosen: Qhull takes points for cospherical within some 1e-13 of the extent, a hundred distances
/// or less; and a thousandth is no other packing.
constexpr double kMoves[] = {0.0, 1e-6, 1e-5, 1e-4, 1e-3};

/// Images are taken from this far around the cell at first, in mean distances, and from farther
/// where spheres reach out of that. Chosen: most packings need no more.
constexpr double kFirstMargin = 1.5;

/// How far volumes of simplices may be off that of the cell, relatively: rounding of a million.
constexpr double kSameVolume = 1e-9;

/// A corner: a centre and its image.
using Corner = std::pair<std::int64_t, PeriodicImage>;
/// Of triangles, which have no fourth; after all others in order.
const Corner kNoCorner{std::numeric_limits<std::int64_t>::max(), {}};

PeriodicImage less(const PeriodicImage& a, const PeriodicImage& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Centres inside the cell, moved. In the plane the third edge is a unit along z.
struct Moved {
  std::vector<Vec3> position;
  Mat3 edges = Mat3::Identity();
  int dimensions = 3;

  Vec3 at(const Corner& corner) const {
    const auto& [n, image] = corner;
    return position[static_cast<std::size_t>(n)] + edges * Vec3(image[0], image[1], image[2]);
  }
  Vec3 heights() const { return edges.inverse().rowwise().norm().cwiseInverse(); }
  double distance() const {  ///< the mean one
    const double volume = std::abs(edges.determinant());
    return std::pow(volume / static_cast<double>(position.size()), 1.0 / dimensions);
  }
};

/// Cells from where a centre is given to inside the cell.
PeriodicImage wrap_of(const Mat3& inverse_edges, const Vec3& x, int dimensions) {
  PeriodicImage image{};
  for (int k = 0; k < dimensions; ++k)
    image[static_cast<std::size_t>(k)] =
        static_cast<std::int32_t>(std::floor(inverse_edges.row(k).dot(x)));
  return image;
}

/// In [-1, 1); the same numbers everywhere.
double signed_unit(std::mt19937_64& random) {
  return std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0;
}

/// All images of a centre move alike. The cell is moved too: of a lattice of one centre a cell
/// nothing else would change.
void move(Moved& moved, double by, std::uint64_t seed) {
  if (by == 0.0) return;
  std::mt19937_64 random(seed);
  const double distance = moved.distance();
  Mat3 stretch = Mat3::Identity();
  for (int i = 0; i < moved.dimensions; ++i)
    for (int j = 0; j < moved.dimensions; ++j) stretch(i, j) += by * signed_unit(random);
  moved.edges = stretch * moved.edges;
  for (Vec3& x : moved.position) {
    x = stretch * x;
    for (int k = 0; k < moved.dimensions; ++k) x[k] += by * distance * signed_unit(random);
  }
}

/// The centres of the cell and those around it, up to a distance from its faces.
/// @throws NoMesh where they are more than kMostCells, which Qhull's and our indices have room for
std::vector<Corner> corners_around(const Moved& moved, double margin) {
  const Vec3 pad = margin * moved.heights().cwiseInverse();
  const Mat3 inverse = moved.edges.inverse();
  const double images = (1.0 + 2.0 * pad.head(moved.dimensions).array()).prod();
  if (!(images * static_cast<double>(moved.position.size()) <= kMostCells))
    throw NoMesh("the cell is too thin for its Delaunay simplices: more than " +
                 std::to_string(kMostCells) + " images of centres are around it");
  std::vector<Corner> corners;
  for (std::size_t n = 0; n < moved.position.size(); ++n) {
    const Vec3 at = inverse * moved.position[n];
    PeriodicImage low{}, high{}, image{};
    for (int k = 0; k < moved.dimensions; ++k) {
      low[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::ceil(-pad[k] - at[k]));
      high[static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(std::floor(1.0 + pad[k] - at[k]));
    }
    for (image[0] = low[0]; image[0] <= high[0]; ++image[0])
      for (image[1] = low[1]; image[1] <= high[1]; ++image[1])
        for (image[2] = low[2]; image[2] <= high[2]; ++image[2])
          corners.emplace_back(static_cast<std::int64_t>(n), image);
  }
  return corners;
}

/// Indices of points.
struct QhullCells {
  bool gave_up = false;
  std::vector<std::array<std::size_t, 4>> simplices;
  std::vector<std::size_t> cospherical;  ///< corners of cells that have more than n + 1
};

std::size_t index_of(qhT* qh, const setT* corners, int k) {
  return static_cast<std::size_t>(
      qh_pointid(qh, static_cast<const vertexT*>(corners->e[k].p)->point));
}

QhullCells by_qhull(const Moved& moved, const std::vector<Corner>& corners) {
  const int dimensions = moved.dimensions;
  std::vector<coordT> points;
  points.reserve(corners.size() * static_cast<std::size_t>(dimensions));
  for (const Corner& corner : corners) {
    const Vec3 x = moved.at(corner);
    for (int k = 0; k < dimensions; ++k) points.push_back(x[k]);
  }
  const auto state = std::make_unique<qhT>();
  qhT* const qh = state.get();
  // Its messages are of no use here: what it found is checked.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages(std::tmpfile(), &std::fclose);
  qh_zero(qh, messages.get());
  char command[] = "qhull d Qbb Qc Q12";
  const int status = qh_new_qhull(qh, dimensions, static_cast<int>(corners.size()), points.data(),
                                  False, command, nullptr, messages.get());
  QhullCells cells;
  cells.gave_up = status != qh_ERRnone;
  const facetT* facet = cells.gave_up ? nullptr : qh->facet_list;
  for (; facet && facet->next; facet = facet->next) {
    if (facet->upperdelaunay) continue;
    if (!facet->simplicial) {
      for (int k = 0; k < qh_setsize(qh, facet->vertices); ++k)
        cells.cospherical.push_back(index_of(qh, facet->vertices, k));
      continue;
    }
    std::array<std::size_t, 4> simplex{};
    for (int k = 0; k <= dimensions; ++k)
      simplex[static_cast<std::size_t>(k)] = index_of(qh, facet->vertices, k);
    cells.simplices.push_back(simplex);
  }
  qh_freeqhull(qh, !qh_ALL);
  int left = 0, left_long = 0;
  qh_memfreeshort(qh, &left, &left_long);
  return cells;
}

std::array<Vec3, 4> places_of(const Moved& moved, const std::array<Corner, 4>& simplex) {
  std::array<Vec3, 4> x{};
  for (std::size_t k = 0; k <= static_cast<std::size_t>(moved.dimensions); ++k)
    x[k] = moved.at(simplex[k]);
  return x;
}

/// Columns: from the first corner to the others; z along z in the plane.
Mat3 sides_of(const std::array<Vec3, 4>& x, int dimensions) {
  Mat3 sides = Mat3::Identity();
  for (int k = 0; k < dimensions; ++k) sides.col(k) = x[static_cast<std::size_t>(k) + 1] - x[0];
  return sides;
}

/// How far the sphere of the corners reaches out of where images were taken from; <= 0: it does
/// not, so that no centre that was left out lies in it.
double reach_of(const Moved& moved, const std::array<Corner, 4>& simplex, double margin) {
  const std::array<Vec3, 4> x = places_of(moved, simplex);
  const Mat3 sides = sides_of(x, moved.dimensions);
  Vec3 squares = 0.5 * sides.colwise().squaredNorm().transpose();
  if (moved.dimensions == 2) squares[2] = 0.0;
  const Vec3 middle = sides.transpose().fullPivLu().solve(squares);
  const double radius = middle.norm() * (1.0 + 1e-6);  // with room for rounding
  if (!std::isfinite(radius)) return std::numeric_limits<double>::infinity();
  const Vec3 reduced = moved.edges.inverse() * (x[0] + middle), heights = moved.heights();
  double reach = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < moved.dimensions; ++k) {
    reach = std::max(reach, radius - margin - reduced[k] * heights[k]);
    reach = std::max(reach, radius - margin - (1.0 - reduced[k]) * heights[k]);
  }
  return reach;
}

struct Found {
  bool degenerate = false;  ///< more than n + 1 centres on a sphere, as far as Qhull can tell
  std::vector<std::array<Corner, 4>> simplices;  ///< one of each with all its images
  double reach = 0.0;                            ///< the largest reach_of()
};

Found simplices_around(const Moved& moved, double margin) {
  const std::vector<Corner> corners = corners_around(moved, margin);
  Found found;
  found.reach = -std::numeric_limits<double>::infinity();
  const QhullCells cells = by_qhull(moved, corners);
  found.degenerate = cells.gave_up;
  for (const std::size_t point : cells.cospherical)
    found.degenerate = found.degenerate || corners[point].second == PeriodicImage{};
  if (found.degenerate) return found;
  for (const auto& indices : cells.simplices) {
    std::array<Corner, 4> simplex{kNoCorner, kNoCorner, kNoCorner, kNoCorner};
    bool in_cell = false;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(moved.dimensions); ++k) {
      simplex[k] = corners[indices[k]];
      in_cell = in_cell || simplex[k].second == PeriodicImage{};
    }
    if (!in_cell) continue;
    found.reach = std::max(found.reach, reach_of(moved, simplex, margin));
    std::sort(simplex.begin(), simplex.end());
    // Of all its images one has its first corner in the cell.
    if (simplex[0].second != PeriodicImage{}) continue;
    const Mat3 sides = sides_of(places_of(moved, simplex), moved.dimensions);
    if (sides.determinant() < 0.0)
      std::swap(simplex[static_cast<std::size_t>(moved.dimensions) - 1],
                simplex[static_cast<std::size_t>(moved.dimensions)]);
    found.simplices.push_back(simplex);
  }
  return found;
}

/// Is each face that of two simplices, up to images?
bool faces_are_shared(const Moved& moved, const std::vector<std::array<Corner, 4>>& simplices) {
  const auto count = static_cast<std::size_t>(moved.dimensions);
  std::vector<std::array<Corner, 3>> faces;
  for (const auto& simplex : simplices)
    for (std::size_t opposite = 0; opposite <= count; ++opposite) {
      std::array<Corner, 3> face{kNoCorner, kNoCorner, kNoCorner};
      for (std::size_t k = 0, to = 0; k <= count; ++k)
        if (k != opposite) face[to++] = simplex[k];
      std::sort(face.begin(), face.end());
      const PeriodicImage first = face[0].second;
      for (std::size_t k = 0; k < count; ++k) face[k].second = less(face[k].second, first);
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 0; i < faces.size(); i += 2) {
    if (i + 1 == faces.size() || faces[i] != faces[i + 1]) return false;
    if (i + 2 < faces.size() && faces[i] == faces[i + 2]) return false;
  }
  return true;
}

/// Do they fill the cell once, with every centre a corner?
bool fill_the_cell(const Moved& moved, const std::vector<std::array<Corner, 4>>& simplices) {
  std::vector<bool> is_corner(moved.position.size(), false);
  double volume = 0.0;
  for (const auto& simplex : simplices) {
    const double part = sides_of(places_of(moved, simplex), moved.dimensions).determinant();
    if (!(part >= 0.0)) return false;
    volume += part / (moved.dimensions == 2 ? 2.0 : 6.0);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(moved.dimensions); ++k)
      is_corner[static_cast<std::size_t>(simplex[k].first)] = true;
  }
  const double whole = std::abs(moved.edges.determinant());
  return std::abs(volume - whole) <= kSameVolume * whole &&
         std::find(is_corner.begin(), is_corner.end(), false) == is_corner.end() &&
         faces_are_shared(moved, simplices);
}

/// Images from farther and farther away, until no sphere reaches out of where they are from.
/// Empty: the centres are degenerate. `margin` stays for the next try.
std::vector<std::array<Corner, 4>> complete_simplices(const Moved& moved, double& margin) {
  // No empty sphere is larger than the cell with its images next to it.
  const double most = 4.0 * moved.edges.colwise().norm().sum();
  bool once_more = true;  // a hole that is larger than the margin has no simplex at all
  while (margin <= most) {
    Found found = simplices_around(moved, margin);
    if (found.degenerate) return {};
    if (found.reach <= 0.0) {
      if (fill_the_cell(moved, found.simplices)) return std::move(found.simplices);
      if (!found.simplices.empty() && !std::exchange(once_more, false)) return {};
    }
    margin = std::min(2.0 * margin, margin + std::max(found.reach, 0.5 * moved.distance()) * 1.01);
  }
  margin = most;
  return {};
}

}  // namespace

std::vector<PeriodicSimplex> delaunay_simplices(const PeriodicCentres& centres) {
  require_sound(centres);
  if (centres.position.empty()) throw NoMesh("no particle, and no net without one");
  Moved given;
  given.dimensions = centres.dimensions;
  for (int k = 0; k < centres.dimensions; ++k) given.edges.col(k) = centres.edges.col(k);
  const Mat3 inverse = given.edges.inverse();
  std::vector<PeriodicImage> wrap;
  for (const Vec3& x : centres.position) {
    wrap.push_back(wrap_of(inverse, x, centres.dimensions));
    given.position.push_back(x - centres.translation(wrap.back()));
  }
  double margin = kFirstMargin * given.distance();
  std::uint64_t seed = 1;
  for (const double by : kMoves) {
    Moved moved = given;
    move(moved, by, seed++);
    const auto found = complete_simplices(moved, margin);
    if (found.empty()) continue;
    std::vector<PeriodicSimplex> simplices;
    simplices.reserve(found.size());
    for (const auto& corners : found) {
      PeriodicSimplex simplex;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(centres.dimensions); ++k) {
        simplex.bodies[k] = corners[k].first;
        simplex.image[k] =
            less(corners[k].second, wrap[static_cast<std::size_t>(corners[k].first)]);
      }
      simplices.push_back(simplex);
    }
    return simplices;
  }
  throw NoMesh(
      "the Delaunay simplices of the centres were not found: Qhull cannot tell them apart");
}

}  // namespace tangency::inline v0::micromechanics
