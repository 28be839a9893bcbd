// SPDX-License-Identifier: MIT
#include <tangency/geometry/pencil.hpp>

#include <algorithm>
#include <array>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/bodies/pencil_form.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

/// The three types that the published diagram marks as invalid.
bool is_published_as_empty(QuadricType type) noexcept {
  return type == QuadricType::imaginary_ellipsoid ||
         type == QuadricType::imaginary_elliptic_cylinder ||
         type == QuadricType::imaginary_parallel_planes;
}

}  // namespace

std::vector<PencilMember> pencil_members(const Quadric& a, const Quadric& b) {
  std::array<double, 20> all;
  std::copy(a.coefficients().begin(), a.coefficients().end(), all.begin());
  std::copy(b.coefficients().begin(), b.coefficients().end(), all.begin() + 10);
  const int exponent = exact::common_exponent(all);
  return in_default_environment([&] {
    return exact::pencil_members(exact::quadric_form(a.coefficients(), exponent),
                                 exact::quadric_form(b.coefficients(), exponent));
  });
}

// One common denominator for both, so that f is that of the forms with -1 at the centres.
std::vector<PencilMember> pencil_members(const Ellipsoid& a, const Ellipsoid& b) {
  return in_default_environment([&] {
    const exact::EllipsoidForm form_a = exact::ellipsoid_form(a);
    const exact::EllipsoidForm form_b = exact::ellipsoid_form(b);
    const exact::IntegerForm<4> zero;
    return exact::pencil_members(exact::combine(form_b.denominator, form_a.form, 0, zero),
                                 exact::combine(form_a.denominator, form_b.form, 0, zero));
  });
}

bool published_scan_finds_overlap(std::span<const PencilMember> members) noexcept {
  return std::none_of(members.begin(), members.end(), [](const PencilMember& m) {
    return !m.is_root && is_published_as_empty(m.classification.type);
  });
}

// A symmetric matrix is positive definite if and only if all its e_k are > 0, semidefinite if and
// only if none is < 0.
PencilVerdict scan_solids(std::span<const PencilMember> members) noexcept {
  PencilVerdict verdict = PencilVerdict::overlap;
  for (const PencilMember& m : members) {
    if (!m.is_positive()) continue;
    const int least = *std::min_element(m.signs.begin(), m.signs.end());
    if (least > 0) return PencilVerdict::separate;
    if (least == 0) verdict = PencilVerdict::touch;
  }
  return verdict;
}

}  // namespace tangency::inline v0
