// SPDX-License-Identifier: MIT
/// @file
/// The published contact scheme of curves [Ouadfel1998, section 4.3 and appendix B], in float,
/// double or long double: what trace_contact() does once it knows that the solids overlap.
/// Internal: the public room is trace_contact.hpp, which says what the steps are; the formulas are
/// derived in docs/derivations/trace-contact.md.
///
/// Works on A in its own frame: (theta, phi) is r_x cos theta sin phi, r_y sin theta sin phi,
/// r_z cos phi along three principal axes, z the pole. Nothing here allocates or throws.
#pragma once

#include <array>

#include <tangency/geometry/tier.hpp>
#include <tangency/geometry/trace/frame.hpp>

namespace tangency::inline v0::detail {

struct TraceOptions {
  /// Turn the frame of A to the pair where equal semi-axes leave a choice, and take the longest arc
  /// of a level. If not: the axes as stored, sorted by length, and the first arc found, as the
  /// thesis seems to do.
  bool turned_to_the_pair = true;
  /// How often the phi-curve and the theta-curve through the middle of what was found are cut
  /// again: 0 as published.
  int refinements = 0;
};

template <class Real>
struct TraceFound {
  TraceStatus status;
  Real gap;
  TraceVector<Real> normal, arm_a, arm_b;
  std::array<TraceVector<Real>, 4> corner;  ///< C1, ..., C4 from A's centre
  TraceCone cone;
  bool other_pole;
  int curves;
};

/// For overlapping bodies with the separation d = c_B - c_A, in a unit in which neither squares of
/// lengths nor their inverses overflow.
template <class Real>
TraceFound<Real> trace_scheme(const TraceBody<Real>& a, const TraceBody<Real>& b,
                              const TraceVector<Real>& d, const TraceOptions& options) noexcept;

extern template TraceFound<float> trace_scheme(const TraceBody<float>&, const TraceBody<float>&,
                                               const TraceVector<float>&,
                                               const TraceOptions&) noexcept;
extern template TraceFound<double> trace_scheme(const TraceBody<double>&, const TraceBody<double>&,
                                                const TraceVector<double>&,
                                                const TraceOptions&) noexcept;
extern template TraceFound<long double> trace_scheme(const TraceBody<long double>&,
                                                     const TraceBody<long double>&,
                                                     const TraceVector<long double>&,
                                                     const TraceOptions&) noexcept;

}  // namespace tangency::inline v0::detail
