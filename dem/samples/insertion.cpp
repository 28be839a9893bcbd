// SPDX-License-Identifier: MIT
#include <tangency/dem/samples/insertion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include <tangency/dem/samples/placed_balls.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Draws that are moved before insertion gives up on a particle, and steps of such a move. Chosen.
constexpr int kMostMovedDraws = 20000, kMostSteps = 24;
/// Of the way out of an overlap that a step goes. Chosen: a step of exactly the way leaves several
/// neighbours that push each other's work back.
constexpr double kStep = 1.2;
/// Particles between two reports of progress. Chosen.
constexpr std::size_t kBetweenReports = 1000;

/// R diag(a^2) R^T, by which the support function is h(n)^2 = n^T S n.
Mat3 spread_of(const Quaternion& orientation, const Vec3& axes) {
  const Mat3 rotation = orientation.toRotationMatrix();
  return rotation * axes.cwiseAbs2().asDiagonal() * rotation.transpose();
}

/// What most looks at a body about the origin need of it, in few cache lines.
struct Extent {
  Mat3 spread;
  double inner, outer;  ///< radii of the spheres within and around it
};

/// A body about the origin.
struct Solid {
  Solid(const Vec3& axes, const Quaternion& orientation)
      : body(Vec3::Zero(), axes, orientation),
        extent{spread_of(orientation, axes), axes.minCoeff(), axes.maxCoeff()} {}
  Ellipsoid body;
  Extent extent;
};

/// The direction in which ellipsoids of these spreads that lie d apart are furthest from each
/// other in the sense of Perram and Wertheim with equal weights: (S + T)^-1 d but for its length.
Vec3 way_apart(const Mat3& sum, const Vec3& d) {
  const Vec3 x = sum.col(0), y = sum.col(1), z = sum.col(2);
  return d[0] * y.cross(z) + d[1] * z.cross(x) + d[2] * x.cross(y);  // the adjugate, symmetric
}

/// What a look at two bodies found.
struct Meeting {
  bool meet;
  Vec3 way_out;  ///< a translation of the first body that takes it out of the second
};

/// The projections on any direction tell bodies apart, and how far to go; where they overlap on
/// this one overlaps() decides.
Meeting look_at(const Solid& a, const Extent& b, const Ellipsoid& body_b, const Vec3& d) {
  const Vec3 n = way_apart(a.extent.spread + b.spread, d);
  const double squared = n.squaredNorm();
  const double reach = std::sqrt(n.dot(a.extent.spread * n)) + std::sqrt(n.dot(b.spread * n));
  const double apart = n.dot(d) - reach;  // times |n|
  if (apart > 0.0) return {false, Vec3::Zero()};
  const double within = a.extent.inner + b.inner;
  if (d.squaredNorm() > within * within && !overlaps(a.body, body_b, d))
    return {false, Vec3::Zero()};
  return {true, squared > 0.0 ? Vec3(n * (apart / squared)) : Vec3::Zero()};
}

/// The places where a particle's centre may be.
struct Room {
  Vec3 low, high;
  std::array<bool, 3> bounded{};  ///< else it is periodic there

  Vec3 draw(std::mt19937_64& random, int dimensions) const {
    Vec3 x = Vec3::Zero();
    for (int k = 0; k < dimensions; ++k) x[k] = low[k] + (high[k] - low[k]) * uniform(random);
    return x;
  }
  /// The nearest place within, along a periodic axis the image within.
  Vec3 brought_back(Vec3 x) const {
    for (int k = 0; k < 3; ++k) {
      if (bounded[static_cast<std::size_t>(k)])
        x[k] = std::clamp(x[k], low[k], high[k]);
      else if (high[k] > 0.0)
        x[k] -= high[k] * std::floor(x[k] / high[k]);
      if (x[k] >= high[k] && high[k] > 0.0)
        x[k] = bounded[static_cast<std::size_t>(k)] ? high[k] : 0.0;
    }
    return x;
  }
};

/// Of the cell, that the bodies of a layer may reach: beyond it by their longest axis at most.
double share_of_layer(const Batch& batch, double longest, double height) {
  return std::min(1.0, batch.layer[1] - batch.layer[0] + 2.0 * longest / height);
}

class Insertion {
 public:
  Insertion(const std::vector<Batch>& batches, const Placement& how, const Vec3& edges)
      : batches_(batches),
        how_(how),
        edges_(edges),
        random_(how.seed),
        coming_(in_order(batches, how.dimensions)),
        balls_(edges, bounding_radii(coming_, kInsertionClearance), how.dimensions) {
    particles_.dimensions = how.dimensions;
    extents_.reserve(coming_.size());
    bodies_.reserve(coming_.size());
  }

  Particles all() {
    for (const Coming& one : coming_) {
      if (how_.progress && particles_.size() % kBetweenReports == 0)
        how_.progress(static_cast<double>(particles_.size()) / static_cast<double>(coming_.size()));
      add(one);
    }
    return std::move(particles_);
  }

 private:
  /// Equal ones in random order, so that no kind comes before another.
  std::vector<Coming> in_order(const std::vector<Batch>& batches, int dimensions) {
    std::vector<Coming> all = coming_particles(batches, dimensions);
    for (std::size_t left = all.size(); left > 1; --left)
      std::swap(all[left - 1],
                all[static_cast<std::size_t>(uniform(random_) * static_cast<double>(left))]);
    sort_largest_first(all);
    return all;
  }

  /// Of a body that is turned so: away from walls by its true extent.
  Room room_of(const Batch& batch, const Solid& solid) const {
    Room room{Vec3::Zero(), edges_};
    for (int k = 0; k < how_.dimensions; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const bool layered = k == how_.dimensions - 1 && batch.layer != std::array{0.0, 1.0};
      if (layered) {
        room.low[k] = batch.layer[0] * edges_[k];
        room.high[k] = batch.layer[1] * edges_[k];
      }
      room.bounded[axis] = layered || how_.walled[axis];
      if (!how_.walled[axis]) continue;
      const double extent = std::sqrt(solid.extent.spread(k, k));
      room.low[k] = std::max(room.low[k], extent);
      room.high[k] = std::min(room.high[k], edges_[k] - extent);
    }
    if (how_.dimensions == 2) room.high[2] = 0.0;
    return room;
  }

  /// Moves the centre to where the body meets no other, if some steps lead there.
  bool find_room(const Solid& solid, const Room& room, int steps, Vec3& centre) const {
    for (int step = 0;; ++step) {
      Vec3 way_out = Vec3::Zero();
      bool meets = false;
      balls_.any_meets(centre, solid.extent.outer, [&](std::size_t ball, const Vec3& d) {
        const Meeting meeting = look_at(solid, extents_[ball], bodies_[ball], d);
        meets = meets || meeting.meet;
        way_out += meeting.way_out;
        return meets && step == steps;
      });
      if (!meets) return true;
      if (step == steps) return false;
      centre = room.brought_back(centre + kStep * way_out);
    }
  }

  void add(const Coming& one) {
    const Batch& batch = batches_[one.batch];
    const Vec3 axes = one.axes * (1.0 + kInsertionClearance);
    for (int draw = 0; draw < kPlainDraws + kMostMovedDraws; ++draw) {
      const Quaternion orientation =
          how_.axes.draw(random_, batch.directed_axis, how_.dimensions).normalized();
      const Solid solid(axes, orientation);
      const Room room = room_of(batch, solid);
      Vec3 centre = room.draw(random_, how_.dimensions);
      if (!(room.low.array() <= room.high.array()).all() ||
          !find_room(solid, room, draw < kPlainDraws ? 0 : kMostSteps, centre))
        continue;
      balls_.add(centre, solid.extent.outer);
      extents_.push_back(solid.extent);
      bodies_.push_back(solid.body);
      particles_.add(centre, orientation, one.axes, batch.density,
                     static_cast<std::int32_t>(one.batch));
      return;
    }
    refuse(one);
  }

  /// Says how full the layer of the body is: it may be full where the cell is not.
  [[noreturn]] void refuse(const Coming& one) const {
    const Batch& batch = batches_[one.batch];
    const int across = how_.dimensions - 1;
    const double low = batch.layer[0] * edges_[across], high = batch.layer[1] * edges_[across];
    double volume = 0.0;
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (particles_.position[i][across] >= low && particles_.position[i][across] <= high)
        volume += volume_of(particles_.semi_axes[i], how_.dimensions);
    const double share = share_of_layer(batch, one.radius(), edges_[across]);
    std::ostringstream text;
    text << "insertion found no room for particle " << particles_.size() + 1 << " of "
         << coming_.size() << ", the volume fraction " << (share < 1.0 ? "of its layer " : "")
         << "being " << volume / (share * edges_.prod())
         << "; a lower one, or another seed, may do";
    throw DoesNotFit(text.str());
  }

  const std::vector<Batch>& batches_;
  const Placement& how_;
  Vec3 edges_;
  std::mt19937_64 random_;
  std::vector<Coming> coming_;
  PlacedBalls balls_;
  std::vector<Extent> extents_;  ///< of bodies made larger by the clearance, and these
  std::vector<Ellipsoid> bodies_;
  Particles particles_;
};

/// Refuses a layer that its own bodies would fill too far, or of which walls leave nothing.
void check_layer(const Batch& batch, const Placement& how, const Vec3& edges) {
  const int across = how.dimensions - 1;
  const double low = batch.layer[0] * edges[across], high = batch.layer[1] * edges[across];
  double volume = 0.0, longest = 0.0, thinnest = 0.0;
  for (const Coming& one : coming_particles({batch}, how.dimensions)) {
    volume += volume_of(one.axes, how.dimensions);
    longest = std::max(longest, one.radius());
    thinnest = std::max(thinnest, one.axes[across]);
  }
  std::ostringstream text;
  text << "the layer from " << batch.layer[0] << " to " << batch.layer[1];
  const double share = share_of_layer(batch, longest, edges[across]);
  const double filled = volume / (share * edges.prod());
  if (!(filled <= kMostInserted * (1.0 + kInsertionClearance))) {
    text << " would be filled to " << filled << ", more than " << kMostInserted;
    throw DoesNotFit(text.str());
  }
  if (how.walled[static_cast<std::size_t>(across)] &&
      !(std::max(low, thinnest) <= std::min(high, edges[across] - thinnest))) {
    text << " lies nearer to a wall than its particles are thick, " << thinnest << " to a side";
    throw DoesNotFit(text.str());
  }
}

}  // namespace

Vec3 insertion_edges(const std::vector<Batch>& batches, const Placement& how) {
  const auto volume = [](const Coming& one, int dimensions) {
    return volume_of(one.axes, dimensions);
  };
  const Vec3 edges = edges_with_room(
      batches, how,
      {"the particles", volume, how.volume_fraction, kMostInserted, kInsertionClearance});
  for (const Batch& batch : batches) check_layer(batch, how, edges);
  return edges;
}

Particles insert(const std::vector<Batch>& batches, const Placement& how, Cell& cell) {
  const Vec3 edges = insertion_edges(batches, how);
  cell = Cell::box(edges, how.dimensions, how.walled);
  return Insertion(batches, how, edges).all();
}

}  // namespace tangency::inline v0::dem
