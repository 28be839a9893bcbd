// SPDX-License-Identifier: GPL-3.0-or-later
//
// The displacement profiles of the published study [Ouadfel1998, section 4.4.1]: two equal
// spheroids, b/a = 0.7, in four contacts with the normal z, B moved along it, along x, and turned
// about y and its own centre. Unit of length: the short semi-axis.
#include <array>
#include <cstdint>
#include <string>

#include <tangency/verify/families/families.hpp>
#include <tangency/verify/families/placing.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr double kOverlap = 0.02, kShortOverLong = 0.7;
// Chosen: eight steps go 0.03 along the normal, 0.3 along the tangent and 0.3 radians.
constexpr int kSteps = 8;
constexpr double kAlong = 0.03, kAcross = 0.3;

enum class Motion { normal, tangential, rotation };

// The shortest turn from x, the long body axis, to v.
std::array<double, 4> long_axis_along(double x, double y, double z) {
  const Real length = sqrt(Real(x) * x + Real(y) * y + Real(z) * z);
  return {rounded(length + x), 0, -z, y};
}

struct Contact {
  const char* name;
  std::array<double, 4> a, b;
};

// B turned about y, by the angle, on top of its orientation.
void turn(RawEllipsoid& body, const Real& angle) {
  const Real c = cos(angle / 2), s = sin(angle / 2);
  const auto [w, x, y, z] = body.orientation;
  body.orientation = {rounded(c * w - s * y), rounded(c * x + s * z), rounded(c * y + s * w),
                      rounded(c * z - s * x)};
}

// How a fresh profile differs from the published one.
struct Variant {
  double overlap = kOverlap;
  double phase = 0;  // of a step

  static Variant drawn_from(std::uint64_t seed) {
    if (seed == 0) return {};
    Draw draw(seed);
    const double overlap = draw.log_uniform(kOverlap / 2, 2 * kOverlap);
    return {overlap, draw.real(0, 1)};
  }
};

EllipsoidPair displaced(const Contact& contact, Motion motion, double step, double overlap) {
  const std::array<double, 3> axes{1 / kShortOverLong, 1, 1};
  EllipsoidPair pair{{{}, axes, contact.a}, {{}, axes, contact.b}};
  place_b(pair, {0, 0, 1}, -overlap);
  switch (motion) {
    case Motion::normal:
      pair.b.centre[2] += kAlong * step / kSteps;
      break;
    case Motion::tangential:
      pair.b.centre[0] += kAcross * step / kSteps;
      break;
    case Motion::rotation:
      turn(pair.b, Real(kAcross * step / kSteps));
      break;
  }
  return pair;
}

// Steps 0, 1, -1, 2, -2 and so on.
InputFamily<EllipsoidPair> profile(const Contact& contact, Motion motion, const char* name,
                                   const Variant& variant) {
  return drawn_family(std::string(contact.name) + ' ' + name, 2 * kSteps + 1,
                      [contact, motion, variant, i = 0](Draw&) mutable {
                        const int step = (i % 2 == 1 ? i + 1 : -i) / 2;
                        ++i;
                        return displaced(contact, motion, step + variant.phase, variant.overlap);
                      });
}

}  // namespace

PairFamilies profile_families(std::uint64_t seed) {
  const Variant variant = Variant::drawn_from(seed);
  const auto side = long_axis_along(1, 0, 0), end = long_axis_along(0, 0, 1);
  PairFamilies families;
  for (const Contact& contact :
       {Contact{"side-side", side, side}, Contact{"side-end", side, end},
        Contact{"end-end", end, end},
        // No plane of symmetry is left and neither body turns about an own axis.
        Contact{"skew", long_axis_along(2, 1, 1), long_axis_along(2, -2, 1)}}) {
    families.push_back(profile(contact, Motion::normal, "normal", variant));
    families.push_back(profile(contact, Motion::tangential, "tangential", variant));
    families.push_back(profile(contact, Motion::rotation, "rotation", variant));
  }
  return families;
}

}  // namespace tangency::inline v0::verify
