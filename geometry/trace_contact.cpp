// SPDX-License-Identifier: MIT
#include <tangency/geometry/trace_contact.hpp>

#include <cmath>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/trace/scheme.hpp>

namespace tangency::inline v0 {
namespace {

TraceContact nothing(TraceStatus status) {
  // One by one: of `{}` Eigen's vectors would hold whatever was there.
  const Vec3 zero = Vec3::Zero();
  return {status, 0.0, zero, zero, zero, {zero, zero, zero, zero}, TraceCone{}, false, 0};
}

/// The scheme for a pair known to overlap, in the caller's unit.
TraceContact solve(const detail::ScaledPair<Ellipsoid>& pair) {
  const auto found = detail::trace_scheme<double>(detail::trace_body<double>(pair.a),
                                                  detail::trace_body<double>(pair.b), pair.d, {});
  TraceContact result = nothing(found.status);
  result.cone = found.cone;
  result.other_pole = found.other_pole;
  result.curves = found.curves;
  if (found.status != TraceStatus::ok) return result;
  result.gap = scaled_by_power(found.gap, pair.exponent);
  result.normal = found.normal;
  result.arm_a = scaled_by_power(found.arm_a, pair.exponent);
  result.arm_b = scaled_by_power(found.arm_b, pair.exponent);
  for (std::size_t k = 0; k < 4; ++k) {
    result.corners[k] = scaled_by_power(found.corner[k], pair.exponent);
  }
  return result;
}

}  // namespace

const char* to_string(TraceStatus status) noexcept {
  switch (status) {
    case TraceStatus::ok:
      return "ok";
    case TraceStatus::not_overlapping:
      return "not_overlapping";
    case TraceStatus::concentric:
      return "concentric";
    case TraceStatus::no_arc:
      return "no_arc";
    case TraceStatus::several_arcs:
      return "several_arcs";
    case TraceStatus::no_tangent_plane:
      return "no_tangent_plane";
    case TraceStatus::no_overlap_on_the_line:
      break;
  }
  return "no_overlap_on_the_line";
}

TraceContact trace_contact(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] {
    if (relation(a, b).relation != Relation::overlap) return nothing(TraceStatus::not_overlapping);
    return solve(detail::scaled_pair<Ellipsoid>({a, b}));
  });
}

TraceContact trace_contact(const Ellipsoid& a, const Ellipsoid& b,
                           const Vec3& separation) noexcept {
  return trace_contact(a.moved_to(Vec3::Zero()), b.moved_to(separation));
}

}  // namespace tangency::inline v0
