// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/primitive_truth.hpp>

#include <gmpxx.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <tangency/verify/oracles/newton_ascent.hpp>
#include <tangency/verify/oracles/primitives.hpp>
#include <tangency/verify/oracles/time_of_contact.hpp>

namespace tangency::inline v0::verify {
namespace {

using Rational3 = std::array<mpq_class, 3>;

Real real(const mpq_class& q) {
  Real x;
  mpfr_set_q(x.backend().data(), q.get_mpq_t(), MPFR_RNDN);
  return x;
}

Rational3 exactly(const std::array<double, 3>& v) {
  return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])};
}

mpq_class dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rational3 minus(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// R' v.
Rational3 in_body(const RawEllipsoid& body, const Rational3& v) {
  const mpq_class w(body.orientation[0]), x(body.orientation[1]), y(body.orientation[2]),
      z(body.orientation[3]);
  const mpq_class norm = w * w + x * x + y * y + z * z;
  const std::array<Rational3, 3> columns{
      {{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
       {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
       {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}}};
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = dot(columns[k], v) / norm;
  return result;
}

// diag(1/a) R' v: the body is the unit ball.
Rational3 in_ball(const RawEllipsoid& body, const Rational3& v) {
  Rational3 result = in_body(body, v);
  for (std::size_t k = 0; k < 3; ++k) result[k] /= mpq_class(body.semi_axes[k]);
  return result;
}

Real longest(const RawEllipsoid& body) { return std::ranges::max(body.semi_axes); }

Real3 real3(const Vector120& v) { return {Real(v[0]), Real(v[1]), Real(v[2])}; }

// Those of all closest points: on the focal set the axes as short as the shortest are free.
std::vector<TrueNormals> closest_normals(const RawEllipsoid& body, const NearestTruth& found) {
  using Set = TrueNormals::Set;
  const Real3 n = real3(found.normal);
  const double least = std::ranges::min(body.semi_axes);
  if (found.multiplier != -Digits120(least) * least) return {{Set::point, n, {}}};
  const RealEllipsoid exact = verify::real(body);
  const Shape<Real> shape = separation(exact, exact).a;
  std::vector<Real3> free, others;
  for (std::size_t k = 0; k < 3; ++k)
    (body.semi_axes[k] == least ? free : others).push_back(shape.axes[k]);
  if (free.size() == 3) return {{Set::all, n, n}};
  if (free.size() == 2) {
    const Real along = ascent::dot(n, others.front());
    if (1 - along * along < Real("1e-50")) return {{Set::point, n, {}}};
    return {{Set::circle, n, others.front()}};
  }
  const Real across = ascent::dot(n, free.front());
  if (abs(across) < Real("1e-50")) return {{Set::point, n, {}}};
  const Real3 mirrored = ascent::combined(n, Real(-2 * across), free.front(), Real(0), n);
  std::vector<TrueNormals> both{{Set::point, n, {}}, {Set::point, mirrored, {}}};
  std::ranges::sort(both, std::ranges::greater(), &TrueNormals::normal);
  return both;
}

// Balls that do not turn: |p + t v| = r.
std::optional<TimeTruth> time_of_balls(const MovingPair& question) {
  for (const MovingBody* body : {&question.a, &question.b}) {
    const auto& [x, y, z] = body->body.semi_axes;
    if (x != y || y != z || body->motion.angular_velocity != std::array<double, 3>{})
      return std::nullopt;
  }
  const Rational3 p = minus(exactly(question.b.body.centre), exactly(question.a.body.centre));
  const Rational3 v =
      minus(exactly(question.b.motion.velocity), exactly(question.a.motion.velocity));
  const mpq_class r =
      mpq_class(question.a.body.semi_axes[0]) + mpq_class(question.b.body.semi_axes[0]);
  const mpq_class a = dot(v, v), b = dot(p, v), c = dot(p, p) - r * r, disc = b * b - a * c;
  if (c <= 0) return TimeTruth{"touching_at_start", std::array<Real, 2>{0, 0}};
  if (disc < 0 || b >= 0) return TimeTruth{"none", std::nullopt};
  const Real t = (real(-b) - sqrt(real(disc))) / real(a);
  if (t > question.horizon) return TimeTruth{"none", std::nullopt};
  return TimeTruth{disc == 0 ? "grazing" : "contact", std::array<Real, 2>{t, t}};
}

}  // namespace

PointTruth point_truth(const BodyAndPoint& question) {
  const Vector120 from = from_centre(question.body, question.point);
  const NearestTruth found = nearest(question.body, from);
  PointTruth truth{Real(length(from)) + longest(question.body), Real(found.distance),
                   closest_normals(question.body, found)};
  const Rational3 ball =
      in_ball(question.body, minus(exactly(question.point), exactly(question.body.centre)));
  const int side = sgn(mpq_class(dot(ball, ball) - 1));
  if (side == 0) truth.gap = 0;
  if ((truth.gap > 0) - (truth.gap < 0) != side)
    throw std::logic_error("corpus: distance and exact level contradict each other");
  return truth;
}

WallRowTruth wall_truth(const BodyAndWall& question) {
  const Rational3 n = exactly(question.normal);
  Rational3 m = in_body(question.body, n);
  for (std::size_t k = 0; k < 3; ++k) m[k] *= mpq_class(question.body.semi_axes[k]);
  const mpq_class square = dot(m, m);
  const mpq_class height = dot(n, exactly(question.body.centre)) - mpq_class(question.offset);
  const int side = sgn(height), outside = sgn(mpq_class(height * height - square));
  using enum Relation;
  ExactRelation relation{outside < 0 ? overlap : side > 0 ? separate : a_in_b};
  if (outside == 0)
    relation = side > 0 ? ExactRelation{external_touch} : ExactRelation{internal_touch, Inner::a};
  const Real scale = sqrt(real(dot(n, n)));
  WallRowTruth truth{relation,
                     real(abs(height)) / scale + longest(question.body),
                     (real(height) - sqrt(real(square))) / scale,
                     {real(-n[0]) / scale, real(-n[1]) / scale, real(-n[2]) / scale}};
  if (relation.relation == external_touch) truth.gap = 0;
  return truth;
}

RayTruth ray_truth(const BodyAndRay& question) {
  const Rational3 from = minus(exactly(question.origin), exactly(question.body.centre));
  const Rational3 direction = exactly(question.direction);
  const Rational3 z = in_ball(question.body, from), v = in_ball(question.body, direction);
  const mpq_class a = dot(v, v), b = dot(z, v), c = dot(z, z) - 1, disc = b * b - a * c;
  RayTruth truth{"miss",
                 (sqrt(real(dot(from, from))) + longest(question.body)) /
                     sqrt(real(dot(direction, direction))),
                 {}};
  if (disc < 0) return truth;
  if (disc == 0) {
    if (b > 0) return truth;
    truth.result = "grazing";
    truth.at = {real(-b / a)};
    return truth;
  }
  // The later root from the sum that cancels nothing, the earlier one from their product c / a.
  const Real root = sqrt(real(disc));
  const Real far = b > 0 ? Real(-real(b) - root) : Real(root - real(b));
  std::array<Real, 2> t{far / real(a), real(c) / far};
  if (t[1] < t[0]) std::swap(t[0], t[1]);
  for (const Real& one : t) {
    if (one >= 0) truth.at.push_back(one);
  }
  if (!truth.at.empty()) truth.result = "hit";
  return truth;
}

std::optional<TimeTruth> time_truth(const MovingPair& question) {
  if (const auto exact = time_of_balls(question)) return exact;
  if (exact_relation(question.a.body, question.b.body).relation != Relation::separate)
    return TimeTruth{"touching_at_start", std::array<Real, 2>{0, 0}};
  const FirstContact found =
      first_contact(question.a, question.b, question.horizon, 0x1p-10 * question.tolerance);
  switch (found.status) {
    case FirstContact::Status::none:
      return TimeTruth{"none", std::nullopt};
    case FirstContact::Status::contact:
      return TimeTruth{"contact", std::array<Real, 2>{found.from, found.to}};
    case FirstContact::Status::undecided:
      break;
  }
  return std::nullopt;
}

}  // namespace tangency::inline v0::verify
