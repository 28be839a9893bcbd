// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <string_view>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/bindings/c/same_values.hpp>
#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/quadric.hpp>
#include <tangency/version.hpp>

namespace tangency::inline v0::c {
namespace {

QuadricCoefficients coefficients_at(const Rows& rows, std::size_t k) {
  QuadricCoefficients row;
  rows.column<NumberColumn<10>>().read(k, row.data());
  return row;
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

const char* tangency_version(void) { return tangency::version(); }

const char* tangency_name_of(const char* enumeration, int value) {
  if (enumeration == nullptr) return nullptr;
  for (const EnumerationName& each : kNames) {
    if (each.enumeration == enumeration && each.value == value) return each.name;
  }
  return nullptr;
}

int tangency_level_of_confidence(double confidence, int dimensions, double* level) {
  return guarded([&] {
    if (level == nullptr) refuse("level", "must not be NULL");
    if (!(confidence > 0.0 && confidence < 1.0)) {
      refuse_value("confidence", confidence, "must be > 0 and < 1");
    }
    if (dimensions != 2 && dimensions != 3) {
      refuse_value("dimensions", dimensions, "must be 2 or 3");
    }
    *level = level_of_confidence(confidence, dimensions);
  });
}

int tangency_classify(const double* coefficients, size_t count, ptrdiff_t stride,
                      const tangency_quadric_columns* answers, int threads) {
  return guarded([&] {
    const tangency_quadric_columns to = known(answers, "answers");
    const Rows rows{"coefficients", coefficients, TANGENCY_NUMBER_DOUBLE, count, stride};
    for (std::size_t k = 0; k < count; ++k) {
      if (const auto fault = Quadric::find_fault(coefficients_at(rows, k))) {
        refuse_row("coefficients", k, fault->field, fault->value, fault->rule);
      }
    }
    each(count, threads, [&](std::size_t k) {
      const Classification found = classify(Quadric(coefficients_at(rows, k)));
      put(to.type, k, found.type);
      put(to.rank4, k, found.rank4);
      put(to.rank3, k, found.rank3);
      put(to.tier, k, found.tier);
    });
  });
}

}  // extern "C"
