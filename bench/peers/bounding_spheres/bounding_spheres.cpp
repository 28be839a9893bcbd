// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounding spheres: each body is the sphere about its centre with its longest semi-axis, as a broad
// phase has it. An overlap that it denies is none; one that it claims need not be. It is the least
// that a code can know, and the board's lowest row.
//
// Definition: held to the common normal. The gap is that of the spheres, the normal the line of
// centres; where the centres coincide there is no normal. It has no options.
//
// Prepared: both radii.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {
namespace {

double radius(const RawEllipsoid& e) {
  return *std::max_element(e.semi_axes.begin(), e.semi_axes.end());
}

class Pair final : public PeerPair {
 public:
  Pair(const RawEllipsoid& a, const RawEllipsoid& b)
      : d_{b.centre[0] - a.centre[0], b.centre[1] - a.centre[1], b.centre[2] - a.centre[2]},
        reach_(radius(a) + radius(b)) {}

  std::optional<PeerContact> contact() override {
    const double distance = std::hypot(d_[0], d_[1], d_[2]);
    const double gap = distance - reach_;
    PeerContact seen{gap < 0, gap, {}, {}};
    if (distance > 0) seen.normal = Point{d_[0] / distance, d_[1] / distance, d_[2] / distance};
    return seen;
  }

 private:
  Point d_;
  double reach_;
};

class BoundingSpheres final : public Peer {
 public:
  PeerDescription description() const override {
    return {"Bounding spheres",        "",        "sum of the longest semi-axes", "no options",
            Definition::common_normal, GapOf::all};
  }
  std::unique_ptr<PeerPair> prepare(const RawEllipsoid& a, const RawEllipsoid& b) const override {
    return std::make_unique<Pair>(a, b);
  }
};

}  // namespace

std::vector<std::unique_ptr<Peer>> bounding_spheres_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(std::make_unique<BoundingSpheres>());
  return peers;
}

}  // namespace tangency::peers
