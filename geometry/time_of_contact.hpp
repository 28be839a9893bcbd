// SPDX-License-Identifier: MIT
/// @file
/// When two ellipsoids in motion first touch.
///
/// How a body moves: motion.hpp.
///
/// (1) Exchanging the bodies leaves status and times, up to the tolerance.
/// (2) A velocity common to both bodies changes nothing, up to the tolerance.
/// (3) The first contact is no earlier than (distance of the solids) / (greatest closing speed).
/// (4) A longer horizon leaves a contact where it is, up to the tolerance.
/// (5) Another unit of time, or of length, that is a power of two changes nothing but the unit.
#pragma once

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/motion.hpp>

namespace tangency::inline v0 {

/// Turning about a fixed axis through a point while moving along it.
/// @param body              at t = 0
/// @param axis_point        a point of the axis
/// @param angular_velocity  along the axis, radians per time; not 0
/// @param speed             along the axis, length per time
Motion screw(const Ellipsoid& body, const Vec3& axis_point, const Vec3& angular_velocity,
             double speed) noexcept;

/// The body at time t, rounded: within 16 u (1 + |w| t) of the size of its path and of itself.
Ellipsoid moved(const Ellipsoid& body, const Motion& motion, double t) noexcept;

/// What is known of the first contact within the horizon.
enum class ContactTimeStatus {
  none,               ///< apart throughout [0, horizon]
  contact,            ///< apart before `time`, in contact at some moment of [time, latest]
  touching_at_start,  ///< the closed solids have a common point at t = 0: exact
  grazing,            ///< apart before `time`, when they are too close for rounding to tell
  not_converged,      ///< apart before `time`; the rest was not looked at
};

/// The first moment at which two moving bodies share a point.
struct TimeOfContact {
  ContactTimeStatus status;  ///< what is known
  double time;    ///< never after the first contact, whatever the status; the horizon for `none`
  double latest;  ///< for `contact`: the first contact is no later; else `time`
  double resolution;  ///< the gap, at `time`, below which rounding hides whether there is one
  Gap gap;            ///< at `time`
  int steps;          ///< positions looked at
};

/// First contact of the closed solids in 0 <= t <= horizon, by conservative advancement.
///
/// Up to `time` the solids are proven to be apart: each step keeps a direction (fixed in space, or
/// turning with either body) along which they stay separated for the whole of the step
/// (docs/derivations/time-of-contact.md). So `time` is never late, and for `contact` it is at most
/// `tolerance` early, since an overlap is proven at `latest` <= time + tolerance.
///
/// What neither can be said of is `grazing`: at `time` the gap is below `resolution` = 128 u times
/// the sizes of bodies and paths, and no overlap deeper than half of it occurs within the
/// tolerance. That is a pass whose least gap or greatest depth is lost in rounding, an approach
/// slower than 2 resolution / tolerance, or a start that is apart by less. A pass whose least gap
/// is above `resolution` is `none`.
///
/// Any scale of lengths and times. Of a body that turns by 2^100 rad or more within the horizon, or
/// that moves by more than 2^1400 times a semi-axis, nothing is known beyond the start, and the
/// status is `not_converged` or `touching_at_start`.
///
/// Does not allocate, but where only the exact relation can tell a start or a pass from a touch.
/// @param a,b  the bodies, in this order
/// @param motion_a, motion_b  finite (asserted)
/// @param horizon    time, finite and >= 0 (asserted)
/// @param tolerance  time, > 0 (asserted)
TimeOfContact time_of_contact(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                              const Motion& motion_b, double horizon, double tolerance) noexcept;

/// The same with the separation d = c_B - c_A at t = 0 given, in place of the centres: for periodic
/// images.
/// @param a  the first body
/// @param motion_a  of the first body
/// @param b  the second body
/// @param motion_b  of the second body
/// @param horizon  until when it is asked, > 0
/// @param tolerance  > 0, in time
/// @param separation  finite
TimeOfContact time_of_contact(const Ellipsoid& a, const Motion& motion_a, const Ellipsoid& b,
                              const Motion& motion_b, const Vec3& separation, double horizon,
                              double tolerance) noexcept;

/// Of bodies given by matrices. `touching_at_start` is exact for their numbers as they were given,
/// `none` and `time` are proven for bodies around them, and an overlap at `latest` for bodies
/// inside them: these are larger and smaller by MatrixEllipsoid::relative_rounding(). So `latest`
/// may be later than time + tolerance, by up to another tolerance and the time in which the bodies
/// close by their roundings, and what touches the larger ones only is `grazing`. Gap and
/// resolution are those of the larger ones.
TimeOfContact time_of_contact(const MatrixEllipsoid& a, const Motion& motion_a,
                              const MatrixEllipsoid& b, const Motion& motion_b, double horizon,
                              double tolerance) noexcept;

}  // namespace tangency::inline v0
