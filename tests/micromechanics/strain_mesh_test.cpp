// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/strain_mesh.hpp>

#include "nets.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

std::vector<Vec3> corners_of(const PeriodicSimplex& simplex, const PeriodicCentres& centres) {
  std::vector<Vec3> corners;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(centres.dimensions); ++k)
    corners.push_back(centres.position[static_cast<std::size_t>(simplex.bodies[k])] +
                      centres.translation(simplex.image[k]));
  return corners;
}

/// Columns: from the first corner to the others.
Mat3 sides_of(const std::vector<Vec3>& corners) {
  Mat3 sides = Mat3::Identity();
  for (std::size_t k = 1; k < corners.size(); ++k)
    sides.col(static_cast<Eigen::Index>(k) - 1) = corners[k] - corners[0];
  return sides;
}

double signed_volume(const std::vector<Vec3>& corners) {
  return sides_of(corners).determinant() / (corners.size() == 3 ? 2.0 : 6.0);
}

using Face = std::vector<std::pair<std::int64_t, PeriodicImage>>;

/// How many simplices have each face, up to images.
std::map<Face, int> faces_of(const std::vector<PeriodicSimplex>& simplices, int dimensions) {
  std::map<Face, int> faces;
  const auto corners = static_cast<std::size_t>(dimensions) + 1;
  for (const PeriodicSimplex& simplex : simplices)
    for (std::size_t opposite = 0; opposite < corners; ++opposite) {
      Face face;
      for (std::size_t k = 0; k < corners; ++k)
        if (k != opposite) face.emplace_back(simplex.bodies[k], simplex.image[k]);
      std::sort(face.begin(), face.end());
      const PeriodicImage first = face.front().second;
      for (auto& [body, image] : face)
        for (std::size_t k = 0; k < 3; ++k) image[k] -= first[k];
      ++faces[face];
    }
  return faces;
}

void expect_to_fill(const Centres& centres, double flat = 0.0) {
  const PeriodicCentres view = centres.view();
  const std::vector<PeriodicSimplex> simplices = delaunay_simplices(view);
  double volume = 0.0;
  std::vector<bool> is_corner(centres.position.size(), false);
  for (const PeriodicSimplex& simplex : simplices) {
    const double part = signed_volume(corners_of(simplex, view));
    EXPECT_GE(part, -flat);
    volume += part;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(view.dimensions); ++k)
      is_corner[static_cast<std::size_t>(simplex.bodies[k])] = true;
  }
  EXPECT_NEAR(volume, view.volume(), 1e-12 * view.volume());
  EXPECT_EQ(std::count(is_corner.begin(), is_corner.end(), true),
            static_cast<std::ptrdiff_t>(is_corner.size()));
  for (const auto& [face, count] : faces_of(simplices, view.dimensions)) EXPECT_EQ(count, 2);
}

/// The largest that a centre is inside the sphere of a simplex, in its radii, by looking at all.
double deepest_centre(const Centres& centres, std::int32_t images) {
  const PeriodicCentres view = centres.view();
  double deepest = -std::numeric_limits<double>::infinity();
  for (const PeriodicSimplex& simplex : delaunay_simplices(view)) {
    const std::vector<Vec3> corners = corners_of(simplex, view);
    const Mat3 sides = sides_of(corners);
    Vec3 squares = 0.5 * sides.colwise().squaredNorm().transpose();
    if (view.dimensions == 2) squares[2] = 0.0;
    const Vec3 middle = corners[0] + sides.transpose().inverse() * squares;
    const double radius = (middle - corners[0]).norm();
    const std::int32_t deep = view.dimensions == 3 ? images : 0;
    for (std::size_t n = 0; n < centres.position.size(); ++n)
      for (std::int32_t x = -images; x <= images; ++x)
        for (std::int32_t y = -images; y <= images; ++y)
          for (std::int32_t z = -deep; z <= deep; ++z) {
            // Of those next to the middle.
            const Vec3 off = centres.edges.inverse() * (middle - centres.position[n]);
            const Vec3 at = centres.position[n] +
                            centres.edges * Vec3(std::round(off[0]) + x, std::round(off[1]) + y,
                                                 view.dimensions == 3 ? std::round(off[2]) + z : 0);
            deepest = std::max(deepest, 1.0 - (at - middle).norm() / radius);
          }
  }
  return deepest;
}

Mat3 branch_area(const StrainMesh& mesh) {
  Mat3 sum = Mat3::Zero();
  for (const MeshEdge& edge : mesh.edges) sum += edge.branch * edge.area.transpose();
  return sum / mesh.volume;
}

/// Drawn without crossings, with parts that hang and particles that float.
Links random_contacts(Random& random, const Centres& centres, double probability) {
  return some_edges(random, simplex_mesh(centres.view(), delaunay_simplices(centres.view())),
                    probability);
}

std::string refusal(const Centres& centres, const Links& links, const std::vector<Vec3>& arm = {}) {
  try {
    polygon_mesh(centres.view(), links.view(), arm);
  } catch (const NoMesh& error) {
    return error.what();
  }
  return "a net";
}

// dem/micromechanics/strain_mesh.hpp (2)
TEST(DelaunaySimplices, FillEveryCellOnceAndShareTheirFaces) {
  Random random(31);
  for (const int dimensions : {2, 3})
    for (const std::size_t count : {1u, 2u, 3u, 4u, 7u, 40u, 300u})
      for (int repeat = 0; repeat < 3; ++repeat) {
        const Mat3 cell = random_cell(random, dimensions);
        expect_to_fill(random_centres(random, count, cell, dimensions));
      }
}

TEST(DelaunaySimplices, FillThinCells) {
  Random random(32);
  for (const int dimensions : {2, 3})
    for (const std::size_t count : {1u, 2u, 5u, 30u})
      for (const Vec3& size : {Vec3(1.0, 0.05, 1.0), Vec3(0.1, 0.1, 1.0), Vec3(1.0, 1.0, 0.02)})
        expect_to_fill(
            random_centres(random, count, random_cell(random, dimensions, size), dimensions));
}

TEST(DelaunaySimplices, FillLatticesWhereManyCentresLieOnASphere) {
  for (const int dimensions : {2, 3})
    for (const int n : {1, 2, 3, 6}) expect_to_fill(lattice(n, dimensions), 1e-12);
  const double half = 0.5;
  for (const int n : {1, 2, 4}) {
    expect_to_fill(lattice(n, 3, {Vec3::Zero(), Vec3::Constant(half)}), 1e-12);
    expect_to_fill(
        lattice(n, 3,
                {Vec3::Zero(), Vec3(half, half, 0), Vec3(half, 0, half), Vec3(0, half, half)}),
        1e-12);
  }
}

TEST(DelaunaySimplices, MayHaveCentresInOnePlace) {
  Random random(33);
  Centres centres = random_centres(random, 20, random_cell(random, 3), 3);
  centres.position.push_back(centres.position.front());
  expect_to_fill(centres, 1e-6);
}

// dem/micromechanics/strain_mesh.hpp (3)
TEST(DelaunaySimplices, HaveNoCentreInsideTheirSpheres) {
  Random random(34);
  for (const int dimensions : {2, 3})
    for (const std::size_t count : {2u, 5u, 30u}) {
      const Mat3 cell = random_cell(random, dimensions);
      EXPECT_LT(deepest_centre(random_centres(random, count, cell, dimensions), 2), 1e-9);
    }
}

// dem/micromechanics/strain_mesh.hpp (1)
TEST(StrainMesh, BranchesTimesAreasAreTheUnitTensor) {
  Random random(35);
  for (const int dimensions : {2, 3})
    for (const std::size_t count : {1u, 3u, 60u}) {
      const Centres centres =
          random_centres(random, count, random_cell(random, dimensions), dimensions);
      const StrainMesh mesh = simplex_mesh(centres.view(), delaunay_simplices(centres.view()));
      EXPECT_LT((branch_area(mesh) - unit(dimensions)).norm(), 1e-12);
    }
  const Centres plane = random_centres(random, 200, random_cell(random, 2), 2);
  const Links contacts = random_contacts(random, plane, 0.75);
  EXPECT_LT((branch_area(polygon_mesh(plane.view(), contacts.view())) - unit(2)).norm(), 1e-12);
}

TEST(StrainMesh, OfTheSquareAndOfTheCubicLatticeIsKnown) {
  const Centres plane = lattice(3, 2);
  const StrainMesh squares = polygon_mesh(plane.view(), pairs_at(plane, 1.0).view());
  EXPECT_EQ(squares.cells, 9u);
  EXPECT_EQ(squares.edges.size(), 18u);
  for (const MeshEdge& edge : squares.edges)
    EXPECT_LT((edge.area - edge.branch).norm(), 1e-14);  // the square on the left less the other's
  const Centres space = lattice(3, 3);
  const StrainMesh mesh = simplex_mesh(space.view(), delaunay_simplices(space.view()));
  EXPECT_EQ(mesh.centres, 27u);
  // Each centre with its neighbours is a net of contacts, whatever diagonals lie between.
  const auto pairs = pairs_of_edges(mesh, pairs_at(space, 1.0).view());
  EXPECT_EQ(std::count_if(pairs.begin(), pairs.end(), [](const auto& pair) { return !!pair; }), 81);
}

// dem/micromechanics/strain_mesh.hpp (4)
TEST(PolygonMesh, HasAsManyContactsAsPolygonsAndParticles) {
  Random random(36);
  for (const std::size_t count : {1u, 2u, 5u, 50u, 400u})
    for (const double probability : {1.0, 0.75, 0.6}) {
      if (count < 50 && probability < 1.0) continue;
      const Centres centres = random_centres(random, count, random_cell(random, 2), 2);
      const Links contacts = random_contacts(random, centres, probability);
      const StrainMesh mesh = polygon_mesh(centres.view(), contacts.view());
      EXPECT_EQ(mesh.cells + mesh.centres, mesh.edges.size());
      EXPECT_LE(mesh.centres, count);
      // Areas of polygons from their definition: half the sum of h x z over both their sides.
      double area = 0.0;
      for (const MeshEdge& edge : mesh.edges) area += 0.5 * edge.branch.dot(edge.area);
      EXPECT_NEAR(area, mesh.volume, 1e-12 * mesh.volume);
    }
}

TEST(PolygonMesh, LeavesOutWhatDoesNotBear) {
  // A square lattice with a particle that touches nothing, one that hangs by one contact, a
  // triangle that does, and a pair apart.
  Centres centres = lattice(4, 2);
  Links contacts = pairs_at(centres, 1.0);
  const std::size_t bearing = contacts.bodies.size();
  const auto add = [&](double x, double y) {
    centres.position.emplace_back(x, y, 0.0);
    return static_cast<std::int64_t>(centres.position.size()) - 1;
  };
  const auto link = [&](std::int64_t a, std::int64_t b) {
    contacts.add({{a, b}, {}, Vec3::Zero(), Vec3::Zero()});
  };
  add(0.5, 0.5);
  link(0, add(0.3, 0.4));
  const std::int64_t t = add(1.2, 1.2), u = add(1.4, 1.2), v = add(1.2, 1.4);
  link(5, t);
  link(t, u);
  link(u, v);
  link(v, t);
  link(add(2.3, 2.3), add(2.6, 2.6));
  const StrainMesh mesh = polygon_mesh(centres.view(), contacts.view());
  EXPECT_EQ(mesh.centres, 16u);
  EXPECT_EQ(mesh.cells, 16u);
  ASSERT_EQ(mesh.edges.size(), bearing);
  for (const MeshEdge& edge : mesh.edges) EXPECT_LT((edge.area - edge.branch).norm(), 1e-13);
}

TEST(PolygonMesh, IsRefusedWhereContactsDoNotSpanTheCell) {
  const Centres centres = lattice(3, 2);
  Links rows;
  const Links all = pairs_at(centres, 1.0);
  for (std::size_t c = 0; c < all.bodies.size(); ++c)
    if (std::abs(centres.view().branch(all.bodies[c], all.image[c])[1]) < 0.5) {
      rows.bodies.push_back(all.bodies[c]);
      rows.image.push_back(all.image[c]);
    }
  EXPECT_EQ(refusal(centres, rows),
            "contacts do not span the cell along both axes: it has no polygons");
  EXPECT_EQ(refusal(centres, {}),
            "contacts do not span the cell along both axes: it has no polygons");
}

TEST(PolygonMesh, IsRefusedWhereStraightEdgesCrossAndTakenWhereBentOnesDoNot) {
  const Centres centres = lattice(3, 2);
  Links contacts = pairs_at(centres, 1.0);
  const auto diagonal = [&](std::int64_t a, std::int64_t b) {
    contacts.add({{a, b}, {}, Vec3::Zero(), Vec3::Zero()});
  };
  diagonal(0, 4);
  EXPECT_EQ(refusal(centres, contacts), "a net");
  diagonal(3, 1);
  EXPECT_EQ(refusal(centres, contacts).substr(0, 11), "edges cross");

  // Two long particles touch at the bottom of the V that they make, and two short ones stand in it,
  // one below and one above the straight line between the centres of the long ones.
  Centres bent{{{-1, 1, 0}, {1, 1, 0}, {0, 0.8, 0}, {0, 2, 0}}, Vec3(4, 3, 1).asDiagonal(), 2};
  const Links links{{{0, 1}, {1, 0}, {0, 2}, {1, 2}, {2, 3}, {3, 0}, {3, 1}},
                    {{}, {1, 0, 0}, {}, {}, {}, {0, 1, 0}, {0, 1, 0}}};
  const std::vector<Vec3> point{{0, 0, 0},   {2, 1, 0},      {-0.4, 0.8, 0}, {0.4, 0.8, 0},
                                {0, 1.3, 0}, {-0.2, 2.9, 0}, {0.2, 2.9, 0}};
  std::vector<Vec3> arm;
  for (std::size_t c = 0; c < point.size(); ++c)
    arm.push_back(point[c] - bent.position[static_cast<std::size_t>(links.bodies[c][0])]);
  EXPECT_EQ(refusal(bent, links).substr(0, 11), "edges cross");
  const StrainMesh mesh = polygon_mesh(bent.view(), links.view(), arm);
  EXPECT_EQ(mesh.cells, 3u);
  EXPECT_LT((branch_area(mesh) - unit(2)).norm(), 1e-14);
}

TEST(StrainMesh, InputThatIsNotWhatItSaysIsRefusedByNameAndPlace) {
  const auto message = [](const Centres& centres, const Links& links) {
    try {
      polygon_mesh(centres.view(), links.view());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Centres plane = lattice(3, 2);
  Links good = pairs_at(plane, 1.0), bad = good;
  bad.bodies[3][1] = 9;
  EXPECT_EQ(message(plane, bad), "bodies[3] = 9, and there are 9 centres");
  bad = good;
  bad.image[2][2] = 1;
  EXPECT_EQ(message(plane, bad), "image[2]: none moves along z in the plane");
  bad = good;
  bad.bodies.push_back({good.bodies[0][1], good.bodies[0][0]});
  bad.image.push_back({-good.image[0][0], -good.image[0][1], 0});
  EXPECT_EQ(message(plane, bad), "bodies[18]: the same pair of images as bodies[0]");
  bad = good;
  bad.bodies[5] = {4, 4};
  bad.image[5] = {};
  EXPECT_EQ(message(plane, bad), "bodies[5]: particle 4 with itself");
  bad = good;
  bad.image.pop_back();
  EXPECT_EQ(message(plane, bad), "image: 17 entries, and there are 18 pairs");
  Centres off = plane;
  off.position[1][2] = 0.5;
  EXPECT_EQ(message(off, good), "position[1]: must be finite, and have z = 0 in the plane");
  off = plane;
  off.edges.col(1) = off.edges.col(0);
  EXPECT_EQ(message(off, good), "edges: the cell must have a volume > 0");
  off = plane;
  off.edges(2, 1) = 0.1;
  EXPECT_EQ(message(off, good), "edges: column 1 must be finite, and have z = 0 in the plane");
  EXPECT_EQ(message(lattice(3, 3), good), "dimensions = 3: polygons are of the plane");
  EXPECT_THROW(delaunay_simplices({}), NoMesh);
}

TEST(StrainMesh, ImagesBeyondTheMostAreRefused) {
  Random random(37);
  const auto message = [](auto call) {
    try {
      call();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Centres centres = random_centres(random, 5, random_cell(random, 3), 3);
  const Vec3 near = centres.position[2];
  const Mat3 edges = centres.edges;
  const auto simplices = [&] { return delaunay_simplices(centres.view()); };
  const std::string place = "position[2]: more than 67108864 cells from the origin along axis ";
  for (int axis = 0; axis < 3; ++axis)
    for (const double by : {1.001 * kMostCells, -1.001 * kMostCells, 1e10, -1e300}) {
      centres.position[2] = near + by * edges.col(axis);
      EXPECT_EQ(message(simplices).substr(0, place.size()), place) << by;
    }
  centres.position[2] = near + 0.99 * kMostCells * edges.col(1);
  EXPECT_EQ(message(simplices), "");
  centres.position[2] = near;

  std::vector<PeriodicSimplex> some = simplices();
  some[3].image[2][1] = kMostImages + 1;
  EXPECT_EQ(message([&] { simplex_mesh(centres.view(), some); }),
            "simplices[3].image[2] = 268435457: more than 268435456 cells away");
  some[3].image[2][1] = std::numeric_limits<std::int32_t>::min();
  EXPECT_EQ(message([&] { simplex_mesh(centres.view(), some); }),
            "simplices[3].image[2] = -2147483648: more than 268435456 cells away");

  const Centres thin{{Vec3::Zero()}, Vec3(1.0, 1e-20, 1.0).asDiagonal(), 3};
  EXPECT_EQ(message([&] { delaunay_simplices(thin.view()); }),
            "the cell is too thin for its Delaunay simplices: more than 67108864 images of centres "
            "are around it");
}

}  // namespace
