// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Perram-Wertheim loop [PerramWertheim1985] as simulation codes write it for themselves: in
// double, the inverse of a 3x3 matrix an evaluation, a maximum found by Brent's method to a fixed
// number of bits, and no thought of what rounding does. F < 1 is an overlap, the gap is
// (1 - 1/sqrt F) n.d; where the centres coincide there is no normal and no gap.
//
// Prepared: both shape matrices.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/math/tools/minima.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {
namespace {

/// Half of a double's digits: where a maximum is flat to rounding.
constexpr int kBits = 26;
constexpr int kMostIterations = 100;

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

Vector vector(const Point& v) { return {v[0], v[1], v[2]}; }

Matrix shape(const RawEllipsoid& e) {
  const auto& q = e.orientation;
  const Matrix r = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return r * vector(e.semi_axes).cwiseAbs2().asDiagonal() * r.transpose();
}

class Pair final : public PeerPair {
 public:
  Pair(const RawEllipsoid& a, const RawEllipsoid& b)
      : a_(shape(a)), b_(shape(b)), d_(vector(b.centre) - vector(a.centre)) {}

  std::optional<PeerContact> contact() override {
    std::uintmax_t iterations = kMostIterations;
    const auto [s, lowest] = boost::math::tools::brent_find_minima(
        [this](double at) { return -at * (1 - at) * d_.dot(direction(at)); }, 0.0, 1.0, kBits,
        iterations);
    const double f = -lowest;
    if (!(f > 0)) return PeerContact{true, {}, {}, {}};
    const Vector n = direction(s).normalized();
    return PeerContact{f < 1, (1 - 1 / std::sqrt(f)) * n.dot(d_), Point{n[0], n[1], n[2]}, {}};
  }

 private:
  Vector direction(double s) const { return ((1 - s) * a_ + s * b_).inverse() * d_; }

  Matrix a_, b_;
  Vector d_;
};

class PlainPerramWertheim final : public Peer {
 public:
  PeerDescription description() const override {
    return {"Plain Perram-Wertheim loop",
            "",
            "Brent's method",
            "in double, " + std::to_string(kBits) + " bits",
            Definition::perram_wertheim,
            GapOf::all};
  }
  std::unique_ptr<PeerPair> prepare(const RawEllipsoid& a, const RawEllipsoid& b) const override {
    return std::make_unique<Pair>(a, b);
  }
};

}  // namespace

std::vector<std::unique_ptr<Peer>> plain_perram_wertheim_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(std::make_unique<PlainPerramWertheim>());
  return peers;
}

}  // namespace tangency::peers
