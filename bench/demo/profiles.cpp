// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Overlap against displacement for four kinds of contact and three motions, as computed by
/// follow_gap, as expected, and by other contact schemes. Writes CSV to standard output, one row a
/// displacement:
///   contact, motion, displacement, overlap, expected, published, status, trace, chord
/// Lengths in short semi-axes, angles in radians; a negative overlap is a distance.
/// `expected` and `published`: families/displacement.hpp. `trace`: trace_contact's depth, empty
/// where that has no answer; `chord`: that of the plane scheme on the sections by the common plane
/// of symmetry, empty where there is none (skew). docs/profiles.md shows the curves.
#include <array>
#include <charconv>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/verify/families/displacement.hpp>

namespace {

using namespace tangency;
using verify::Motion;

/// A contact scheme beside the common normal: a further column, and its overlap of a pair, nothing
/// where it has no answer.
struct Scheme {
  std::string_view name;
  std::optional<double> (*overlap)(const Ellipsoid& a, const Ellipsoid& b);
};

std::optional<double> by_trace(const Ellipsoid& a, const Ellipsoid& b) {
  const TraceContact contact = trace_contact(a, b);
  if (contact.status != TraceStatus::ok) return std::nullopt;
  return -contact.gap;
}

constexpr double kParallel = 1e-12;  // rad: rounding of stored axes and centres, generously

/// The section of a body by the plane through its centre along e1 and e2, two of its own axes but
/// for sign and order; nothing where they are not.
std::optional<Ellipse> section(const Ellipsoid& body, const Vec3& e1, const Vec3& e2) {
  const Vec3 across = e1.cross(e2);
  for (int k = 0; k < 3; ++k) {
    if (body.rotation().col(k).cross(across).norm() > kParallel) continue;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Vec3 first = body.rotation().col(i), &centre = body.centre();
    return Ellipse({centre.dot(e1), centre.dot(e2)}, {body.semi_axes()[i], body.semi_axes()[j]},
                   {first.dot(e1), first.dot(e2)});
  }
  return std::nullopt;
}

/// The chord of the sections by the plane of symmetry that both bodies share, if there is one.
std::optional<double> by_chord(const Ellipsoid& a, const Ellipsoid& b) {
  const Vec3 d = b.centre() - a.centre();
  for (int k = 0; k < 3; ++k) {
    const auto axes = a.rotation();
    if (std::abs(axes.col(k).dot(d)) > kParallel * d.norm()) continue;
    const Vec3 e1 = axes.col((k + 1) % 3), e2 = axes.col((k + 2) % 3);
    const std::optional<Ellipse> in_a = section(a, e1, e2), in_b = section(b, e1, e2);
    if (!in_a || !in_b) continue;
    const ChordContact contact = chord_contact(*in_a, *in_b);
    return contact.status == ChordStatus::ok ? std::optional(contact.depth) : std::nullopt;
  }
  return std::nullopt;
}

constexpr std::array<Scheme, 2> kSchemes{{{"trace", by_trace}, {"chord", by_chord}}};

constexpr double kShortOverLong = 0.7;  // the thesis' spheroids
constexpr double kInitialOverlap = 0.02;
constexpr int kSteps = 40;  // either way

/// The largest motion either way, chosen so that overlap, loss of contact and the departure from
/// the expansion all show: in short semi-axes, in radians for the rotation.
double range_of(Motion motion) { return motion == Motion::normal ? 0.03 : 0.3; }

struct Sample {
  double displacement, overlap;
  GapStatus status;
};

/// The contact followed from the start to `end`, without the start.
std::vector<Sample> follow(const verify::DisplacementContact& contact, Motion motion, double end) {
  std::vector<Sample> samples;
  Vec3 normal = contact.normal;
  for (int i = 1; i <= kSteps; ++i) {
    const double displacement = end * i / kSteps;
    const Ellipsoid b = displaced(contact, motion, displacement);
    const Gap gap = follow_gap(contact.a, b, b.centre() - contact.a.centre(), normal);
    samples.push_back({displacement, -gap.gap, gap.status});
    normal = gap.normal;
  }
  return samples;
}

std::vector<Sample> profile(const verify::DisplacementContact& contact, Motion motion) {
  const double range = range_of(motion);
  const std::vector<Sample> backwards = follow(contact, motion, -range);
  std::vector<Sample> all(backwards.rbegin(), backwards.rend());
  const Gap start =
      follow_gap(contact.a, contact.b, contact.b.centre() - contact.a.centre(), contact.normal);
  all.push_back({0.0, -start.gap, start.status});
  const std::vector<Sample> forwards = follow(contact, motion, range);
  all.insert(all.end(), forwards.begin(), forwards.end());
  return all;
}

std::string_view name_of(GapStatus status) { return status == GapStatus::ok ? "ok" : "local"; }

}  // namespace

int main() {
  std::cout << "contact,motion,displacement,overlap,expected,published,status";
  for (const Scheme& scheme : kSchemes) std::cout << ',' << scheme.name;
  std::cout << '\n';
  for (const auto& contact : verify::displacement_contacts(kShortOverLong, kInitialOverlap)) {
    for (const Motion motion : verify::kMotions) {
      const verify::OverlapExpansion expansion = expected_overlap(contact, motion);
      for (const Sample& sample : profile(contact, motion)) {
        const double s = sample.displacement;
        const double expected =
            contact.overlap + s * (expansion.slope + 0.5 * expansion.curvature * s);
        std::cout << contact.name << ',' << to_string(motion) << ',' << tables::to_text(s) << ','
                  << tables::to_text(sample.overlap) << ',' << tables::to_text(expected) << ','
                  << tables::to_text(published_overlap(contact, motion, s)) << ','
                  << name_of(sample.status);
        const Ellipsoid b = displaced(contact, motion, s);
        for (const Scheme& scheme : kSchemes) {
          const std::optional<double> overlap = scheme.overlap(contact.a, b);
          std::cout << ',' << (overlap ? tables::to_text(*overlap) : "");
        }
        std::cout << '\n';
      }
    }
  }
  std::cout.flush();
  return std::cout ? 0 : 1;
}
