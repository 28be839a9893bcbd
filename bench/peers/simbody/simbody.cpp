// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simbody. SimTKmath/Geometry/src/ContactTracker.cpp of version 3.7: a portal refinement (MPR) to
// 5 % of a quarter of the smaller bounding sphere, then Newton's method with differences on six
// equations: both points on their surfaces, normals parallel, points apart along them. So the depth
// is that of a common normal, our signed gap.
//
//  tracker  ConvexImplicitPair::trackContact, which Simbody itself calls: nothing where the solids
//           are apart, and it reports what Newton's method had when it stopped, converged or not.
//           It has no options.
//  refine   its two steps called one by one, the second one also from the points by which the first
//           one proves a pair separate: the header promises the points of closest approach there.
//           No answer where the accuracy asked for was not reached.
//
// Prepared: both ContactGeometry::Ellipsoid and both transforms.
#include <SimTKmath.h>

#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {
namespace {

SimTK::Vec3 vector(const Point& v) { return {v[0], v[1], v[2]}; }
Point point(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

SimTK::Transform pose(const RawEllipsoid& e) {
  const auto& q = e.orientation;
  // The constructor from four numbers, w first, normalises.
  return {SimTK::Rotation(SimTK::Quaternion(q[0], q[1], q[2], q[3])), vector(e.centre)};
}

/// Below it pairs of unit size begin to be refused (54 of 1024 of class 1 at 2.2e-16).
constexpr double kTightest = 1e-15;

/// Accuracies are the largest norm of the six errors: sines, lengths and values of the level
/// function 1 - x'A x, mixed.
struct Options {
  bool tracker;
  double accuracy;  ///< of refine
};

class Pair final : public PeerPair {
 public:
  Pair(const RawEllipsoid& a, const RawEllipsoid& b, const Options& options)
      : shape_a_(vector(a.semi_axes)),
        shape_b_(vector(b.semi_axes)),
        pose_a_(pose(a)),
        pose_b_(pose(b)),
        options_(options),
        tracker_(shape_a_.getTypeId(), shape_b_.getTypeId()) {}

  std::optional<PeerContact> contact() override {
    try {
      return options_.tracker ? track() : refine();
    } catch (const std::exception&) {
      return {};
    }
  }

 private:
  std::optional<PeerContact> track() const {
    const SimTK::UntrackedContact before(SimTK::ContactSurfaceIndex(0),
                                         SimTK::ContactSurfaceIndex(1));
    SimTK::Contact now;
    if (!tracker_.trackContact(before, pose_a_, shape_a_, pose_b_, shape_b_, 0, now)) return {};
    if (now.isEmpty()) return PeerContact{false, {}, {}, {}};
    const auto& touch = SimTK::EllipticalPointContact::getAs(now);
    const SimTK::Transform& frame = touch.getContactFrame();
    return PeerContact{true, -touch.getDepth(), point(pose_a_.R() * SimTK::Vec3(frame.R().z())),
                       point(pose_a_ * frame.p())};
  }

  std::optional<PeerContact> refine() const {
    using Tracker = SimTK::ContactTracker;
    const SimTK::Transform b_in_a = ~pose_a_ * pose_b_;
    SimTK::Vec3 p, q;  // on A and on B, each in its body's frame
    SimTK::UnitVec3 direction;
    int iterations = 0;
    const bool may_touch = Tracker::estimateConvexImplicitPairContactUsingMPR(
        shape_a_, shape_b_, b_in_a, p, q, direction, iterations);
    double reached = 0;
    if (!Tracker::refineImplicitPair(shape_a_, p, shape_b_, q, b_in_a, options_.accuracy, reached,
                                     iterations))
      return {};
    const SimTK::UnitVec3 normal = shape_a_.calcSurfaceUnitNormal(p);
    const double gap = SimTK::dot(b_in_a * q - p, normal);
    return PeerContact{may_touch && gap < 0, gap, point(pose_a_.R() * SimTK::Vec3(normal)),
                       point(pose_a_ * ((p + b_in_a * q) / 2.0))};
  }

  SimTK::ContactGeometry::Ellipsoid shape_a_, shape_b_;
  SimTK::Transform pose_a_, pose_b_;
  Options options_;
  SimTK::ContactTracker::ConvexImplicitPair tracker_;
};

class Simbody final : public Peer {
 public:
  explicit Simbody(const Options& options) : options_(options) {}

  PeerDescription description() const override {
    int major = 0, minor = 0, build = 0;
    SimTK_version_SimTKcommon(&major, &minor, &build);
    std::array<char, 32> accuracy{};
    std::snprintf(accuracy.data(), accuracy.size(), "accuracy %.1e", options_.accuracy);
    return {"Simbody",
            std::to_string(major) + "." + std::to_string(minor),
            options_.tracker ? kSimbodyTracker : "estimate...UsingMPR + refineImplicitPair",
            options_.tracker ? "no options" : accuracy.data(),
            Definition::common_normal,
            options_.tracker ? GapOf::overlapping : GapOf::all};
  }

  std::unique_ptr<PeerPair> prepare(const RawEllipsoid& a, const RawEllipsoid& b) const override {
    return std::make_unique<Pair>(a, b, options_);
  }

 private:
  Options options_;
};

}  // namespace

std::vector<std::unique_ptr<Peer>> simbody_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(std::make_unique<Simbody>(Options{true, SimTK::SignificantReal}));
  for (const double accuracy : {SimTK::SignificantReal, kTightest})
    peers.push_back(std::make_unique<Simbody>(Options{false, accuracy}));
  return peers;
}

}  // namespace tangency::peers
