// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/time_batch.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace tangency::inline v0::c {
namespace {

constexpr std::array<const char*, 3> kNormal{"x", "y", "z"};
constexpr std::array<const char*, 9> kMotion{"vx", "vy", "vz", "wx", "wy", "wz", "rx", "ry", "rz"};

/// What contact_curvature() is for: geometry/curvature.hpp.
constexpr double kMostAspect = 1e70;

/// As a normal of an answer: finite, and unit but for rounding. Of rows beyond a cutoff it is not
/// looked at.
void require_unit(const double* normals, std::size_t count, const int* statuses = nullptr) {
  require_finite_rows("normals", normals, 3, count, kNormal.data());
  for (std::size_t k = 0; k < count; ++k) {
    if (statuses != nullptr && statuses[k] == TANGENCY_STATUS_BEYOND) continue;
    const double length = vectors(normals)[k].norm();
    // 2^-40: far above the rounding of a unit vector, far below what a wrong one is off. Chosen.
    if (!(std::abs(length - 1.0) <= 0x1p-40)) {
      refuse_row("normals", k, "length", length, "must be 1");
    }
  }
}

/// The trace's answer in the words of the other definitions.
OtherGap traced(const TraceContact& found) {
  return {found.gap,
          found.normal,
          found.arm_a,
          found.arm_b,
          found.status == TraceStatus::ok ? OtherGapStatus::ok : OtherGapStatus::not_applicable,
          0.0};
}

void ask_other_gaps(int definition, const tangency_bodies& bodies, const Pairs& pairs, int threads,
                    const tangency_other_gap_columns& to) {
  const auto ask = [&](const auto& gap_of) {
    const std::vector<Ellipsoid>& all = bodies.prepared().ellipsoids;
    each(pairs.size(), threads, [&](std::size_t k) {
      const Ellipsoid &a = all[pairs[k].a], &b = all[pairs[k].b];
      OtherGap gap = pairs.separated() ? gap_of(a, b, pairs.separation(k)) : gap_of(a, b);
      // What the rounding of a matrix to semi-axes does to these gaps is not bounded.
      if (bodies.rounded(pairs[k].a) || bodies.rounded(pairs[k].b)) {
        gap.gap_error = std::numeric_limits<double>::infinity();
      }
      put_gap(to, k, gap);
    });
  };
  switch (definition) {
    case TANGENCY_DEFINITION_PERRAM_WERTHEIM:
      return ask([](const auto&... pair) { return perram_wertheim_gap(pair...); });
    case TANGENCY_DEFINITION_MIDPOINT_POTENTIAL:
      return ask([](const auto&... pair) { return midpoint_potential_gap(pair...); });
    case TANGENCY_DEFINITION_TRACE:
      return ask([](const auto&... pair) { return traced(trace_contact(pair...)); });
    default:
      refuse_value("definition", definition, "must be a tangency_definition");
  }
}

std::vector<Motion> motions_of(const double* rows, std::size_t count) {
  require_finite_rows("motions", rows, 9, count, kMotion.data());
  std::vector<Motion> motions;
  motions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3* const row = vectors(rows + 9 * i);
    motions.push_back({row[0], row[1], row[2]});
  }
  return motions;
}

void require_frame(double horizon, double tolerance) {
  if (!(horizon >= 0.0 && std::isfinite(horizon))) {
    refuse_value("horizon", horizon, "must be finite and >= 0");
  }
  if (!(tolerance > 0.0)) refuse_value("tolerance", tolerance, "must be > 0");
}

void require_aspects(const std::vector<Ellipsoid>& all, const Pairs& pairs) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Vec3 &a = all[pairs[k].a].semi_axes(), &b = all[pairs[k].b].semi_axes();
    const double longest = a.cwiseMax(b).maxCoeff(), shortest = a.cwiseMin(b).minCoeff();
    if (longest <= kMostAspect * shortest) continue;
    refuse_row("pairs", k, "longest semi-axis", longest,
               "must be at most 1e70 times the shortest, " + tables::to_text(shortest));
  }
}

/// A body by a matrix has no semi-axes that its owner would know.
void leave_out(GapDerivatives& found, int first) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  found.gradient.segment<3>(first).setConstant(kNone);
  found.hessian.middleRows<3>(first).setConstant(kNone);
  found.hessian.middleCols<3>(first).setConstant(kNone);
}

void put_curvature(double* curvature, double* directions, std::size_t k,
                   const PrincipalCurvatures& found) {
  put(curvature, 2 * k, found.curvature[0]);
  put(curvature, 2 * k + 1, found.curvature[1]);
  put(directions, 2 * k, found.direction[0]);
  put(directions, 2 * k + 1, found.direction[1]);
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

int tangency_other_gaps(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                        const double* separations, int definition,
                        const tangency_other_gap_columns* answers, int threads) {
  return guarded([&] {
    const tangency_other_gap_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    ask_other_gaps(definition, *bodies, list, threads, to);
  });
}

int tangency_perram_wertheim_factors(const tangency_bodies* bodies, const unsigned* pairs,
                                     size_t count, const double* separations,
                                     const tangency_factor_columns* answers, int threads) {
  return guarded([&] {
    const tangency_factor_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    each_pair<Separations::of_axes>(
        *bodies, list, threads, [](const auto&... pair) { return perram_wertheim_factor(pair...); },
        [&](std::size_t k, const PerramWertheimFactor& found) {
          put(to.factor, k, found.factor);
          put(to.factor_error, k, found.factor_error);
          put(to.scale, k, found.scale);
          put(to.scale_error, k, found.scale_error);
          put(to.status, k, found.status);
        });
  });
}

int tangency_gap_derivatives(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                             const double* separations, const double* normals, const int* statuses,
                             const tangency_derivative_columns* answers, int threads) {
  return guarded([&] {
    const tangency_derivative_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    if (statuses == nullptr && count > 0) refuse("statuses", "must not be NULL");
    for (std::size_t k = 0; k < count; ++k) {
      if (statuses[k] != TANGENCY_STATUS_OK && statuses[k] != TANGENCY_STATUS_LOCAL &&
          statuses[k] != TANGENCY_STATUS_BEYOND) {
        refuse_row("statuses", k, "status", statuses[k],
                   "must be TANGENCY_STATUS_OK, TANGENCY_STATUS_LOCAL or TANGENCY_STATUS_BEYOND");
      }
    }
    require_unit(normals, count, statuses);
    const std::vector<Ellipsoid>& all = bodies->prepared().ellipsoids;
    each(count, threads, [&](std::size_t k) {
      Gap gap{};  // of which status and normal are used
      gap.normal = vectors(normals)[k];
      gap.status = static_cast<GapStatus>(statuses[k]);
      const Ellipsoid &a = all[list[k].a], &b = all[list[k].b];
      GapDerivatives found = list.separated() ? gap_derivatives(a, b, list.separation(k), gap)
                                              : gap_derivatives(a, b, gap);
      if (bodies->rounded(list[k].a)) leave_out(found, kSemiAxes);
      if (bodies->rounded(list[k].b)) leave_out(found, kOfBodyB + kSemiAxes);
      put(to.gradient, k, found.gradient);
      put(to.hessian, k, found.hessian);
      put(to.least_radius, k, found.least_radius);
      put(to.status, k, found.status);
    });
  });
}

int tangency_contact_curvatures(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                                const double* normals, const tangency_curvature_columns* answers,
                                int threads) {
  return guarded([&] {
    const tangency_curvature_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count);
    require_unit(normals, count);
    const std::vector<Ellipsoid>& all = bodies->prepared().ellipsoids;
    require_aspects(all, list);
    each(count, threads, [&](std::size_t k) {
      const ContactCurvature found =
          contact_curvature(all[list[k].a], all[list[k].b], vectors(normals)[k]);
      put_curvature(to.a, to.a_directions, k, found.a);
      put_curvature(to.b, to.b_directions, k, found.b);
      put_curvature(to.relative, to.relative_directions, k, found.relative);
    });
  });
}

int tangency_common_volumes(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                            const double* separations, double tolerance,
                            const tangency_volume_columns* answers, int threads) {
  return guarded([&] {
    const tangency_volume_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    if (!(tolerance > 0.0)) refuse_value("tolerance", tolerance, "must be > 0");
    each_pair<Separations::of_axes>(
        *bodies, list, threads,
        [&](const auto&... pair) { return common_volume(pair..., tolerance); },
        [&](std::size_t k, const CommonVolume& found) {
          put(to.volume, k, found.volume);
          put(to.volume_error, k, found.volume_error);
          put(to.gradient, k, found.gradient);
          put(to.gradient_error, k, found.gradient_error);
          put(to.status, k, found.status);
        });
  });
}

int tangency_containments(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                          const double* separations, const tangency_containment_columns* answers,
                          int threads) {
  return guarded([&] {
    const tangency_containment_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    if (to.clearance || to.clearance_error || to.normal || to.arm_a || to.arm_b || to.status) {
      each_pair<Separations::of_axes>(
          *bodies, list, threads, [](const auto&... pair) { return clearance(pair...); },
          [&](std::size_t k, const Clearance& found) {
            put(to.clearance, k, found.clearance);
            put(to.clearance_error, k, found.clearance_error);
            put(to.normal, k, found.normal);
            put(to.arm_a, k, found.arm_inner);
            put(to.arm_b, k, found.arm_outer);
            put(to.status, k, found.status);
          });
    }
    if (to.margin || to.margin_error) {
      each_pair<Separations::of_axes>(
          *bodies, list, threads, [](const auto&... pair) { return containment_margin(pair...); },
          [&](std::size_t k, const ContainmentMargin& found) {
            put(to.margin, k, found.margin);
            put(to.margin_error, k, found.margin_error);
          });
    }
  });
}

int tangency_times_of_contact(const tangency_bodies* bodies, const unsigned* pairs, size_t count,
                              const double* separations, const double* motions, double horizon,
                              double tolerance, const tangency_time_columns* answers, int threads) {
  return guarded([&] {
    const tangency_time_columns to = known(answers, "answers");
    const Pairs list(required(bodies), pairs, count, separations);
    require_frame(horizon, tolerance);
    const std::vector<Motion> moving = motions_of(motions, bodies->size());
    if (!bodies->by_matrices()) {
      return times_of_contact(bodies->moving(), moving, list.list(), horizon, tolerance,
                              {.status = values<ContactTimeStatus>(to.status, count),
                               .time = numbers(to.time, count),
                               .latest = numbers(to.latest, count),
                               .resolution = numbers(to.resolution, count),
                               .normal = vectors(to.normal, count)},
                              threads);
    }
    if (list.separated()) refuse("separations", "must be NULL for bodies by matrices");
    each(count, threads, [&](std::size_t k) {
      const auto [a, b] = list[k];
      const TimeOfContact found = time_of_contact(bodies->matrix(a), moving[a], bodies->matrix(b),
                                                  moving[b], horizon, tolerance);
      put(to.status, k, found.status);
      put(to.time, k, found.time);
      put(to.latest, k, found.latest);
      put(to.resolution, k, found.resolution);
      const bool has_normal = found.status != ContactTimeStatus::none &&
                              found.status != ContactTimeStatus::touching_at_start;
      put(to.normal, k, has_normal ? found.gap.normal : Vec3(Vec3::Zero()));
    });
  });
}

}  // extern "C"
