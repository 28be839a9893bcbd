// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/strain_mesh.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <compare>
#include <string>
#include <utility>

#include "require_length.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

/// A pair as it is looked for: the smaller index first; of one particle the image that is positive
/// in lexicographic order.
struct Key {
  std::array<std::int64_t, 2> bodies;
  PeriodicImage image;

  auto operator<=>(const Key&) const = default;
};

struct Sorted {
  Key key;
  bool turned;  ///< is it the other way round than given?
};

Sorted sorted(const std::array<std::int64_t, 2>& bodies, const PeriodicImage& image) {
  const PeriodicImage back{-image[0], -image[1], -image[2]};
  const bool turned = bodies[0] > bodies[1] || (bodies[0] == bodies[1] && image < back);
  if (turned) return {{{bodies[1], bodies[0]}, back}, true};
  return {{bodies, image}, false};
}

/// Keys of pairs in ascending order, with their places.
std::vector<std::pair<Key, std::size_t>> index_of(const PeriodicPairs& pairs) {
  std::vector<std::pair<Key, std::size_t>> keys;
  keys.reserve(pairs.size());
  for (std::size_t c = 0; c < pairs.size(); ++c)
    keys.emplace_back(sorted(pairs.bodies[c], pairs.image[c]).key, c);
  std::sort(keys.begin(), keys.end());
  return keys;
}

void require_image(const std::string& name, const PeriodicImage& image, int dimensions) {
  for (const std::int32_t k : image)
    if (std::abs(std::int64_t{k}) > kMostImages)
      refuse(name + " = " + std::to_string(k) + ": more than " + std::to_string(kMostImages) +
             " cells away");
  if (dimensions == 2 && image[2] != 0) refuse(name + ": none moves along z in the plane");
}

void require_pair(const PeriodicPairs& pairs, const PeriodicCentres& centres, std::size_t c) {
  const std::string place = "[" + std::to_string(c) + "]";
  const auto& bodies = pairs.bodies[c];
  const auto& image = pairs.image[c];
  for (const std::int64_t body : bodies)
    if (body < 0 || static_cast<std::size_t>(body) >= centres.position.size())
      refuse("bodies" + place + " = " + std::to_string(body) + ", and there are " +
             std::to_string(centres.position.size()) + " centres");
  require_image("image" + place, image, centres.dimensions);
  if (bodies[0] == bodies[1] && image == PeriodicImage{})
    refuse("bodies" + place + ": particle " + std::to_string(bodies[0]) + " with itself");
}

/// Images from centres into the cell are to be small.
void require_near(const PeriodicCentres& centres) {
  Mat3 edges = Mat3::Identity();
  for (int k = 0; k < centres.dimensions; ++k) edges.col(k) = centres.edges.col(k);
  const Mat3 inverse = edges.inverse();
  for (std::size_t i = 0; i < centres.position.size(); ++i)
    for (int k = 0; k < centres.dimensions; ++k)
      if (!(std::abs(inverse.row(k).dot(centres.position[i])) <= kMostCells))
        refuse("position[" + std::to_string(i) + "]: more than " + std::to_string(kMostCells) +
               " cells from the origin along axis " + std::to_string(k) + " of the cell");
}

/// The outward areas of the faces opposite each corner, corners in positive order.
std::array<Vec3, 4> outward_areas(const std::array<Vec3, 4>& x, int dimensions) {
  std::array<Vec3, 4> area{};
  if (dimensions == 2) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = x[(k + 2) % 3] - x[(k + 1) % 3];
      area[k] = Vec3(side[1], -side[0], 0.0);
    }
    return area;
  }
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  area[1] = -0.5 * b.cross(c);
  area[2] = -0.5 * c.cross(a);
  area[3] = -0.5 * a.cross(b);
  area[0] = -(area[1] + area[2] + area[3]);
  return area;
}

/// The edges of one triangle or tetrahedron, with what it adds to their areas.
void add_edges(const PeriodicCentres& centres, const PeriodicSimplex& simplex,
               std::vector<std::pair<Key, Vec3>>& edges) {
  const auto corners = static_cast<std::size_t>(centres.dimensions) + 1;
  std::array<Vec3, 4> x{};
  for (std::size_t k = 0; k < corners; ++k)
    x[k] = centres.branch(
        {simplex.bodies[0], simplex.bodies[k]},
        {simplex.image[k][0] - simplex.image[0][0], simplex.image[k][1] - simplex.image[0][1],
         simplex.image[k][2] - simplex.image[0][2]});
  const std::array<Vec3, 4> outward = outward_areas(x, centres.dimensions);
  const double share = 1.0 / (centres.dimensions * (centres.dimensions + 1));
  for (std::size_t k = 0; k < corners; ++k)
    for (std::size_t l = k + 1; l < corners; ++l) {
      PeriodicImage image{};
      for (std::size_t i = 0; i < 3; ++i) image[i] = simplex.image[l][i] - simplex.image[k][i];
      const Sorted edge = sorted({simplex.bodies[k], simplex.bodies[l]}, image);
      const Vec3 area = share * (outward[k] - outward[l]);
      edges.emplace_back(edge.key, edge.turned ? Vec3(-area) : area);
    }
}

}  // namespace

double PeriodicCentres::volume() const {
  if (dimensions == 2) return std::abs(edges(0, 0) * edges(1, 1) - edges(0, 1) * edges(1, 0));
  return std::abs(edges.determinant());
}

Vec3 PeriodicCentres::translation(const PeriodicImage& image) const {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < dimensions; ++k) sum += image[static_cast<std::size_t>(k)] * edges.col(k);
  return sum;
}

Vec3 PeriodicCentres::branch(const std::array<std::int64_t, 2>& bodies,
                             const PeriodicImage& image) const {
  return position[static_cast<std::size_t>(bodies[1])] -
         position[static_cast<std::size_t>(bodies[0])] + translation(image);
}

void require_sound(const PeriodicCentres& centres) {
  const int dimensions = centres.dimensions;
  if (dimensions != 2 && dimensions != 3)
    refuse("dimensions = " + std::to_string(dimensions) + ": must be 2 or 3");
  for (int k = 0; k < dimensions; ++k)
    if (!centres.edges.col(k).allFinite() || (dimensions == 2 && centres.edges(2, k) != 0.0))
      refuse("edges: column " + std::to_string(k) + " must be finite, and have z = 0 in the plane");
  if (!(centres.volume() > 0.0)) refuse("edges: the cell must have a volume > 0");
  for (std::size_t i = 0; i < centres.position.size(); ++i)
    if (!centres.position[i].allFinite() || (dimensions == 2 && centres.position[i][2] != 0.0))
      refuse("position[" + std::to_string(i) + "]: must be finite, and have z = 0 in the plane");
  require_near(centres);
}

void require_sound(const PeriodicPairs& pairs, const PeriodicCentres& centres) {
  require_sound(centres);
  require_length("image", pairs.image.size(), pairs.size(), "pairs");
  for (std::size_t c = 0; c < pairs.size(); ++c) require_pair(pairs, centres, c);
  const auto keys = index_of(pairs);
  const auto twice = std::adjacent_find(
      keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice != keys.end())
    refuse("bodies[" + std::to_string((twice + 1)->second) +
           "]: the same pair of images as bodies[" + std::to_string(twice->second) + "]");
}

StrainMesh simplex_mesh(const PeriodicCentres& centres,
                        std::span<const PeriodicSimplex> simplices) {
  require_sound(centres);
  const auto corners = static_cast<std::size_t>(centres.dimensions) + 1;
  std::vector<std::pair<Key, Vec3>> parts;
  std::vector<bool> is_corner(centres.position.size(), false);
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    const PeriodicSimplex& simplex = simplices[i];
    for (std::size_t k = 0; k < corners; ++k) {
      const std::int64_t body = simplex.bodies[k];
      const std::string place = "simplices[" + std::to_string(i) + "]";
      require_image(place + ".image[" + std::to_string(k) + "]", simplex.image[k],
                    centres.dimensions);
      if (body < 0 || static_cast<std::size_t>(body) >= is_corner.size())
        refuse(place + ": particle " + std::to_string(body) + ", and there are " +
               std::to_string(is_corner.size()) + " centres");
      is_corner[static_cast<std::size_t>(body)] = true;
    }
    add_edges(centres, simplex, parts);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  StrainMesh mesh{centres.dimensions, centres.volume(), {}, simplices.size(), 0};
  mesh.centres = static_cast<std::size_t>(std::count(is_corner.begin(), is_corner.end(), true));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Key& key = parts[i].first;
    if (i == 0 || parts[i - 1].first != key)
      mesh.edges.push_back(
          {key.bodies, key.image, centres.branch(key.bodies, key.image), Vec3::Zero()});
    mesh.edges.back().area += parts[i].second;
  }
  return mesh;
}

std::vector<std::optional<std::size_t>> pairs_of_edges(const StrainMesh& mesh,
                                                       const PeriodicPairs& pairs) {
  const auto keys = index_of(pairs);
  std::vector<std::optional<std::size_t>> found;
  found.reserve(mesh.edges.size());
  for (const MeshEdge& edge : mesh.edges) {
    const Key key = sorted(edge.bodies, edge.image).key;
    const auto at = std::lower_bound(keys.begin(), keys.end(), key,
                                     [](const auto& a, const Key& b) { return a.first < b; });
    if (at != keys.end() && at->first == key)
      found.emplace_back(at->second);
    else
      found.emplace_back();
  }
  return found;
}

}  // namespace tangency::inline v0::micromechanics
