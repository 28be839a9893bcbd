// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/verify/batch_part.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::testing {
namespace {

using verify::EllipsoidPair;
using verify::RawEllipsoid;

// One in sixteen is nothing, one in sixteen anywhere; the others have turned by 1e-10 to 0.1 rad,
// and are of any moderate length.
Vec3 turned(verify::Draw& draw, const Vec3& n) {
  const int kind = draw.integer(0, 15);
  const double angle = draw.log_uniform(1e-10, 0.1), length = draw.log_uniform(0.25, 4);
  Vec3 any;
  for (double& x : any) x = draw.real(-1, 1);
  if (kind == 0) return Vec3::Zero();
  if (kind == 1) return any.squaredNorm() > 0 ? any : n;
  const Vec3 across = any.cross(n);
  const double norm = across.norm();
  return length * (norm > 0 ? Vec3(n + angle / norm * across) : n);
}

RawEllipsoid moved_to(RawEllipsoid body, const Vec3& centre) {
  body.centre = {centre[0], centre[1], centre[2]};
  return body;
}

void add_pair(Part& part, const EllipsoidPair& pair, verify::Draw& draw) {
  const Ellipsoid a = verify::to_ellipsoid(pair.a), b = verify::to_ellipsoid(pair.b);
  const Vec3 d = b.centre() - a.centre();
  const Vec3 turn = turned(draw, d.stableNorm() > 0 ? Vec3(d.stableNormalized()) : Vec3::UnitX());
  if (!d.allFinite()) return;
  const Ellipsoid here = a.moved_to(Vec3::Zero()), there = b.moved_to(Vec3::Zero());
  const auto index = static_cast<std::uint32_t>(part.bodies.size());
  part.raw.push_back(pair);
  part.a.push_back(a), part.b.push_back(b);
  part.here.push_back(here), part.there.push_back(there);
  part.bodies.push_back(a), part.bodies.push_back(b);
  part.pairs.push_back({index, index + 1});
  part.separations.push_back(d);
  const Gap placed = signed_gap(a, b), separated = signed_gap(here, there, d);
  // The same draws whatever the gap is.
  const Vec3 previous =
      turn.isZero(0) || !placed.normal.allFinite() ? turn : turned(draw, placed.normal);
  const Gap followed = previous.isZero(0) ? separated : follow_gap(here, there, d, previous);
  part.previous.push_back(previous);
  part.placed.push_back({placed, contact_bounds(a, b, placed)});
  part.separated.push_back({separated, contact_bounds(here, there, d, separated)});
  part.followed.push_back({followed, contact_bounds(here, there, d, followed)});
  part.overlaps.push_back(overlaps(a, b));
  part.overlaps_separated.push_back(overlaps(here, there, d));
}

}  // namespace

Part made_part(const BatchFamily& family, std::uint64_t seed, std::size_t count,
               std::size_t judged) {
  Part part;
  verify::Draw draw(~seed);
  for (const EllipsoidPair& pair : family.pairs(seed, count)) add_pair(part, pair, draw);
  for (std::size_t i = 0; i < std::min(judged, part.size()); ++i) {
    const EllipsoidPair& pair = part.raw[i];
    part.truth.push_back(verify::signed_gap(pair.a, pair.b));
    part.truth_separated.push_back(
        verify::signed_gap(moved_to(pair.a, Vec3::Zero()), moved_to(pair.b, part.separations[i])));
    part.truly_overlap.push_back(verify::exact_overlaps(pair.a, pair.b));
  }
  for (const Ellipsoid& body : part.bodies) {
    part.centres.push_back(body.centre());
    part.semi_axes.push_back(body.semi_axes());
    part.orientations.push_back(body.orientation());
  }
  return part;
}

}  // namespace tangency::testing
