// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the golden displacement profiles to standard output:
//   profiles_golden > tests/data/profiles/displacement.csv
// One row a displacement, in columns that `tangency contact` reads (a., b.), the bodies being the
// stored doubles, and further
//   contact, motion, displacement   of verify/families/displacement.hpp
//   overlap                         minus the signed gap of those doubles, found in 150 digits
//                                   (verify/oracles/gap.hpp), rounded to double; proven global
//   trace                           the depth of the scheme of curves in long double, to 12 digits,
//                                   which is what its arithmetic and libm leave; empty where none
#include <array>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <string>

#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/trace/scheme.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/displacement.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace {

using namespace tangency;

constexpr int kSteps = 8;  // either way
constexpr double kOverlap = 0.02, kShortOverLong = 0.7;

void write_body(const Ellipsoid& e) {
  const Eigen::Quaterniond q = e.orientation();
  for (const Vec3& v : {e.centre(), e.semi_axes()}) {
    for (const double c : v) std::cout << tables::to_text(c) << ',';
  }
  for (const double c : {q.w(), q.x(), q.y(), q.z()}) std::cout << tables::to_text(c) << ',';
}

std::string trace_of(const Ellipsoid& a, const Ellipsoid& b) {
  if (relation(a, b).relation != Relation::overlap) return {};
  using Real = long double;
  const auto found = detail::trace_scheme<Real>(
      detail::trace_body<Real>(a), detail::trace_body<Real>(b), b.centre().cast<Real>(), {});
  if (found.status != TraceStatus::ok) return {};
  return tables::formatted("%.11Le", -found.gap);
}

/// 0.03 along the normal and 0.3 else: bench/demo/profiles.cpp.
double displacement_of(verify::Motion motion, int step) {
  return (motion == verify::Motion::normal ? 0.03 : 0.3) * step / kSteps;
}

}  // namespace

int main() {
  std::cout << "# SPDX-License-Identifier: GPL-3.0-or-later\n"
               "# Made by profiles_golden > tests/data/profiles/displacement.csv\n";
  for (const char* body : {"a.", "b."}) {
    for (const char* field : {"x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"}) {
      std::cout << body << field << ',';
    }
  }
  std::cout << "contact,motion,displacement,overlap,trace\n";
  for (const auto& contact : verify::displacement_contacts(kShortOverLong, kOverlap)) {
    for (const verify::Motion motion : verify::kMotions) {
      for (int step = -kSteps; step <= kSteps; ++step) {
        const double s = displacement_of(motion, step);
        const Ellipsoid b = displaced(contact, motion, s);
        const auto truth = verify::signed_gap(verify::to_raw(contact.a), verify::to_raw(b));
        if (!truth.global) {
          std::cerr << contact.name << ", " << to_string(motion) << ' ' << s << ": not proven\n";
          return 1;
        }
        write_body(contact.a);
        write_body(b);
        std::cout << contact.name << ',' << to_string(motion) << ',' << tables::to_text(s) << ','
                  << tables::to_text(-static_cast<double>(truth.gap)) << ','
                  << trace_of(contact.a, b) << '\n';
      }
    }
  }
  std::cout.flush();
  return std::cout ? 0 : 1;
}
