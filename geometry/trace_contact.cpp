// SPDX-License-Identifier: MIT
#include <tangency/geometry/trace_contact.hpp>

#include <cmath>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/trace/scheme.hpp>

namespace tangency {
namespace {

TraceContact nothing(TraceStatus status) {
  TraceContact result{};
  result.status = status;
  return result;
}

/// The scheme for a pair known to overlap, times 2^exponent.
TraceContact solve(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, int exponent) {
  const auto found = detail::trace_scheme<double>(detail::trace_body<double>(a),
                                                  detail::trace_body<double>(b), d, {});
  TraceContact result = nothing(found.status);
  result.cone = found.cone;
  result.other_pole = found.other_pole;
  result.curves = found.curves;
  if (found.status != TraceStatus::ok) return result;
  const auto scaled = [exponent](const Vec3& v) {
    return Vec3(v.unaryExpr([exponent](double c) { return std::scalbn(c, exponent); }));
  };
  result.gap = std::scalbn(found.gap, exponent);
  result.normal = found.normal;
  result.arm_a = scaled(found.arm_a);
  result.arm_b = scaled(found.arm_b);
  for (std::size_t k = 0; k < 4; ++k) result.corners[k] = scaled(found.corner[k]);
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
    const detail::ScaledPair pair = detail::scaled_pair(a, b);
    return solve(pair.a, pair.b, pair.d, pair.exponent);
  });
}

TraceContact trace_contact(const Ellipsoid& a, const Ellipsoid& b,
                           const Vec3& separation) noexcept {
  return trace_contact(a.moved_to(Vec3::Zero()), b.moved_to(separation));
}

}  // namespace tangency
