// SPDX-License-Identifier: GPL-3.0-or-later
//
// FCL. narrowphase/detail/ of version 0.7.0, with either of its solvers:
//
//  collide, no contact   yes or no, by ccdMPRIntersect or by GJK and EPA: the questions below less
//                        what they say of the contact
//  collide, GST_LIBCCD   gjk_libccd-inl.h GJKCollide -> ccdMPRPenetration (libccd's mpr.c):
//  `portal` collide, GST_INDEP    gjk_solver_indep-inl.h: GJK, and EPA where it finds the origin
//  inside. EPA
//                        seeks the nearest face of the difference of the bodies: the common normal.
//                        The depth has the opposite sign of GST_LIBCCD's; here it is its magnitude
//  distance, GST_LIBCCD  gjk_libccd-inl.h ccdGJKSignedDist: GJK apart, EPA overlapping: the common
//                        normal. -1 marks failure of either and is taken as no answer
//  distance, GST_INDEP   GJK apart; -1 where it finds the origin inside. Its signed distance cannot
//                        be had: distance-inl.h seeks the greatest of the negated depths above and
//                        ends the program by an assertion
//
// Tolerances are absolute, in the unit of length of the bodies. Prepared: both shapes and both
// transforms.
#include <fcl/fcl.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/peers/peer.hpp>

namespace tangency::peers {
namespace {

constexpr double kDefault = 1e-6;
/// Two orders above the rounding of bodies of size 100.
constexpr double kTightest = 1e-12;
/// At 1e-9 GST_LIBCCD's signed distance ends the program, by an assertion, for nearly every
/// overlapping pair of class 1; at 1e-8 for none of classes 1 and 2 and 3 % of class 3.
constexpr double kTightestSigned = 1e-8;

enum class Question { overlap, collide, distance };

struct Options {
  Question question;
  fcl::GJKSolverType solver;
  double tolerance;
};

Point point(const fcl::Vector3d& v) { return {v[0], v[1], v[2]}; }

fcl::Transform3d pose(const RawEllipsoid& e) {
  const auto& q = e.orientation;
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  pose.translation() = fcl::Vector3d(e.centre[0], e.centre[1], e.centre[2]);
  return pose;
}

fcl::Ellipsoidd shape(const RawEllipsoid& e) {
  return {e.semi_axes[0], e.semi_axes[1], e.semi_axes[2]};
}

class Pair final : public PeerPair {
 public:
  EIGEN_MAKE_ALIGNED_OPERATOR_NEW

  Pair(const RawEllipsoid& a, const RawEllipsoid& b, const Options& options)
      : shape_a_(shape(a)),
        shape_b_(shape(b)),
        pose_a_(pose(a)),
        pose_b_(pose(b)),
        question_(options.question),
        collision_(1, options.question == Question::collide, 1, false, true, options.solver,
                   options.tolerance),
        distance_(true, options.solver == fcl::GST_LIBCCD, 0, 0, options.tolerance,
                  options.solver) {}

  std::optional<PeerContact> contact() override {
    try {
      return question_ == Question::distance ? distance() : collide();
    } catch (const std::exception&) {
      return {};
    }
  }

 private:
  std::optional<PeerContact> collide() const {
    fcl::CollisionResultd result;
    fcl::collide(&shape_a_, pose_a_, &shape_b_, pose_b_, collision_, result);
    if (!result.isCollision()) return PeerContact{false, {}, {}, {}};
    if (question_ == Question::overlap) return PeerContact{true, {}, {}, {}};
    const fcl::Contactd& touch = result.getContact(0);
    return PeerContact{true, -std::abs(touch.penetration_depth), point(touch.normal),
                       point(touch.pos)};
  }

  std::optional<PeerContact> distance() const {
    fcl::DistanceResultd result;
    fcl::distance(&shape_a_, pose_a_, &shape_b_, pose_b_, distance_, result);
    const double gap = result.min_distance;
    if (gap == -1) {
      if (distance_.enable_signed_distance) return {};
      return PeerContact{true, {}, {}, {}};
    }
    const fcl::Vector3d &p = result.nearest_points[0], &q = result.nearest_points[1];
    return PeerContact{gap < 0, gap, point((gap < 0 ? p - q : q - p).normalized()),
                       point((p + q) / 2)};
  }

  fcl::Ellipsoidd shape_a_, shape_b_;
  fcl::Transform3d pose_a_, pose_b_;
  Question question_;
  fcl::CollisionRequestd collision_;
  fcl::DistanceRequestd distance_;
};

class Fcl final : public Peer {
 public:
  explicit Fcl(const Options& options) : options_(options) {}

  PeerDescription description() const override {
    const bool libccd = options_.solver == fcl::GST_LIBCCD;
    std::array<char, 32> tolerance{};
    std::snprintf(tolerance.data(), tolerance.size(), ", tolerance %.0e", options_.tolerance);
    PeerDescription d{"FCL",
                      FCL_VERSION,
                      "",
                      (libccd ? "GST_LIBCCD" : "GST_INDEP") + std::string(tolerance.data()),
                      Definition::common_normal,
                      GapOf::none};
    switch (options_.question) {
      case Question::overlap:
        d.call = "collide, no contact";
        break;
      case Question::collide:
        d.call = "collide";
        if (libccd) d.definition = Definition::portal;
        d.gap_of = GapOf::overlapping;
        break;
      case Question::distance:
        d.call = libccd ? "distance, signed" : "distance";
        d.gap_of = libccd ? GapOf::all : GapOf::separate;
        break;
    }
    return d;
  }

  std::unique_ptr<PeerPair> prepare(const RawEllipsoid& a, const RawEllipsoid& b) const override {
    return std::make_unique<Pair>(a, b, options_);
  }

 private:
  Options options_;
};

}  // namespace

std::vector<std::unique_ptr<Peer>> fcl_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  for (const auto question : {Question::overlap, Question::collide, Question::distance}) {
    for (const auto solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
      const bool epa = question == Question::distance && solver == fcl::GST_LIBCCD;
      for (const double tolerance : {kDefault, epa ? kTightestSigned : kTightest})
        peers.push_back(std::make_unique<Fcl>(Options{question, solver, tolerance}));
    }
  }
  return peers;
}

}  // namespace tangency::peers
