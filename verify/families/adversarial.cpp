// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/adversarial.hpp>

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <tangency/verify/families/exact_contact.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using namespace construction;

constexpr ExactRelation kSeparate{Relation::separate};
constexpr ExactRelation kTouch{Relation::external_touch};
constexpr ExactRelation kOverlap{Relation::overlap};
constexpr ExactRelation kEqual{Relation::equal};
constexpr ExactRelation kBInA{Relation::b_in_a};
constexpr ExactRelation kInsideA{Relation::internal_touch, Inner::b};

using MaybePair = std::optional<AdversarialPair>;

MaybePair pair(const ExactBody& a, const ExactBody& b, std::optional<ExactRelation> relation,
               int exponent = 0) {
  const auto raw_a = raw(a, exponent);
  const auto raw_b = raw(b, exponent);
  if (!raw_a || !raw_b) return std::nullopt;
  return AdversarialPair{{*raw_a, *raw_b}, {}, relation};
}

ExactRelation touch(bool inside) { return inside ? kInsideA : kTouch; }

// What a touch becomes when B moves by delta (a few ulps): the tangent plane parts the pair, or the
// balls of curvature settle it; the factor 2 covers the rounding of this very estimate.
std::optional<ExactRelation> after_motion(const Contact& c, const Real3& delta) {
  Real3 n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = c.n[i].get_d();
  const Real along = ascent::dot(n, delta), squared = ascent::dot(delta, delta);
  if (squared == 0) return touch(c.inside);
  if (along >= 0) return c.inside ? kOverlap : kSeparate;
  if (c.rho * along / sqrt(ascent::dot(n, n)) + squared < 0) return c.inside ? kBInA : kOverlap;
  return std::nullopt;
}

// ---- families

MaybePair integer_touch_outside(Draw& draw) {
  const auto c = contact(draw, false);
  return c ? pair(c->a, c->b, kTouch) : std::nullopt;
}

MaybePair integer_touch_inside(Draw& draw) {
  const auto c = contact(draw, true);
  return c ? pair(c->a, c->b, kInsideA) : std::nullopt;
}

MaybePair next_float_grid(Draw& draw) {
  const auto c = contact(draw, draw.coin());
  if (!c) return std::nullopt;
  MaybePair p = pair(c->a, c->b, std::nullopt);
  if (!p) return std::nullopt;
  Real3 delta;
  for (std::size_t i = 0; i < 3; ++i) {
    const double start = p->b.centre[i];
    double& value = p->b.centre[i];
    const int steps = draw.integer(-2, 2);
    for (int k = 0; k < std::abs(steps); ++k) {
      value = std::nextafter(value, steps * std::numeric_limits<double>::infinity());
    }
    if (start == 0) value = std::ldexp(static_cast<double>(steps), -40);  // not by subnormals
    delta[i] = Real(value) - start;
  }
  p->relation = after_motion(*c, delta);
  return p;
}

MaybePair far_origin(Draw& draw) {
  auto c = contact(draw, draw.coin());
  if (!c) return std::nullopt;
  const mpz_class far = mpz_class(1'000'000'000'000) + draw.integer(0, 1'000'000);
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class shift = far * draw.integer(-1, 1);
    c->a.centre[i] += shift;
    c->b.centre[i] += shift;
  }
  return pair(c->a, c->b, touch(c->inside));
}

MaybePair extreme_scale(Draw& draw) {  // 2^500 is 3e150, 2^-1000 is 1e-301
  const auto c = contact(draw, draw.coin());
  if (!c) return std::nullopt;
  return pair(c->a, c->b, touch(c->inside), draw.one_of(std::array<int, 4>{500, -500, 960, -1000}));
}

MaybePair unnormalised_quaternion(Draw& draw) {
  const auto c = contact(draw, draw.coin());
  if (!c) return std::nullopt;
  MaybePair p = pair(c->a, c->b, touch(c->inside));
  if (!p) return std::nullopt;
  for (RawEllipsoid* body : {&p->a, &p->b}) {
    const int exponent = draw.integer(-400, 400);
    const double factor = std::ldexp(draw.integer(-99, 98) + 0.5, exponent);
    for (double& v : body->orientation) v *= factor;
  }
  return p;
}

// A's centre at `origin` in every direction, B's placed with the gap along a drawn normal. Requires
// gap > -least semi-axis, so that neither body can be inside the other.
MaybePair manufactured(Draw& draw, const RawEllipsoid& a, const RawEllipsoid& b, double gap,
                       double origin) {
  AdversarialPair p{{a, b}, {}, {}};
  p.a.centre = {origin, -origin, origin / 2};
  Real3 n;
  for (Real& v : n) v = draw.real(-1, 1);
  const double left = rounded(place_b(p, ascent::normalised(n), gap));
  // B is off its place in the tangent plane by at most this. Balls of the least radii of curvature
  // overlap by what is left of the gap, less the slip squared over their radii.
  double slip = 0;
  for (const double c : p.b.centre) slip += std::ldexp(std::abs(c), -53);
  const double rho = least_radii(p);
  if (left > 0) p.relation = kSeparate;
  if (left < 0 && -left < rho / 2 && slip * slip < rho * -left) p.relation = kOverlap;
  return p;
}

std::array<double, 4> any_quaternion(Draw& draw) {
  return {draw.real(-1, 1), draw.real(-1, 1), draw.real(-1, 1), draw.real(0.01, 1)};
}

RawEllipsoid moderate_body(Draw& draw, double size) {
  return {{}, {size * draw.real(1, 5), size * draw.real(1, 5), size}, any_quaternion(draw)};
}

double power_of_ten(int exponent) { return rounded(pow(Real(10), exponent)); }

MaybePair small_gap(Draw& draw) {
  const RawEllipsoid a = moderate_body(draw, 1), b = moderate_body(draw, draw.real(1, 3));
  const double gap = power_of_ten(-draw.integer(6, 17));
  const bool apart = draw.coin();
  return manufactured(draw, a, b, apart ? gap : -gap, draw.real(-1, 1));
}

MaybePair small_gap_far_origin(Draw& draw) {
  const RawEllipsoid a = moderate_body(draw, 1), b = moderate_body(draw, draw.real(1, 3));
  const double gap = power_of_ten(-draw.integer(1, 9));
  const bool apart = draw.coin();
  return manufactured(draw, a, b, apart ? gap : -gap, draw.real(1e11, 1e12));
}

MaybePair extreme_ratios(Draw& draw) {
  const auto body = [&draw](double size) {
    std::array<double, 3> axes{size, size * draw.log_uniform(1, 1e8), size};
    axes[2] = draw.integer(0, 2) == 0 ? axes[1] : size * draw.log_uniform(1, 1e8);
    draw.shuffle(axes);
    return RawEllipsoid{{}, axes, any_quaternion(draw)};
  };
  const RawEllipsoid a = body(1), b = body(draw.log_uniform(1e-8, 1e8));
  const double gap = draw.log_uniform(1e-17, 1) * std::min(least_axis(a), least_axis(b));
  const bool apart = draw.coin();
  return manufactured(draw, a, b, apart ? gap : -gap, 0);
}

MaybePair spheres(Draw& draw) {
  const auto [u, radius] = sphere_point(draw);
  const int times = draw.integer(0, 20);
  const mpz_class distance = radius * times;
  mpz_class r_a = draw.integer(1, 200);
  mpz_class r_b = abs(distance + (2 * draw.integer(0, 1) - 1) * r_a);  // a touch
  if (r_b == 0 || draw.integer(0, 2) == 0) r_b = draw.integer(1, 200);
  ExactBody a{small_vector(draw, 50), {r_a, r_a, r_a}, small_quaternion(draw)};
  ExactBody b{a.centre, {r_b, r_b, r_b}, small_quaternion(draw)};
  for (std::size_t i = 0; i < 3; ++i) b.centre[i] += u[i] * times;
  if (r_b > r_a) {
    std::swap(a, b);
    std::swap(r_a, r_b);
  }
  ExactRelation relation = kOverlap;
  if (distance > r_a + r_b) relation = kSeparate;
  if (distance == r_a + r_b) relation = kTouch;
  if (distance == r_a - r_b) relation = kInsideA;
  if (distance < r_a - r_b) relation = kBInA;
  if (distance == 0 && r_a == r_b) relation = kEqual;
  return pair(a, b, relation);
}

// B is A moved by t / 16 of the diameter through an integer surface point.
MaybePair equal_shapes_parallel_axes(Draw& draw) {
  const auto [u, radius] = sphere_point(draw);
  const Vector axes = small_axes(draw, 9);
  ExactBody a{small_vector(draw, 100), axes, small_quaternion(draw)};
  const Vector x = turned(a.q, {axes[0] * u[0], axes[1] * u[1], axes[2] * u[2]});
  for (mpz_class& axis : a.axes) axis *= radius * norm(a.q) * 8;
  ExactBody b = a;
  const int t = draw.integer(0, 2) == 0 ? 16 : draw.integer(0, 24);
  for (std::size_t i = 0; i < 3; ++i) b.centre[i] += x[i] * t;
  return pair(a, b, t == 0 ? kEqual : t == 16 ? kTouch : t > 16 ? kSeparate : kOverlap);
}

MaybePair coaxial_spheroids(Draw& draw) {
  const Quaternion q = small_quaternion(draw);
  const int scale = norm(q);
  const int a1 = draw.integer(1, 12), c1 = draw.integer(2, 12);
  const int a2 = draw.integer(1, 12), c2 = draw.integer(1, 12);
  const auto on_axis = [&](int z, int equatorial, int polar) {
    const int e = equatorial * scale;
    return ExactBody{turned(q, {0, 0, z}), {e, e, polar * scale}, q};
  };
  if (draw.integer(0, 3) == 0) {  // B is A shrunk towards its pole
    const int k = draw.integer(2, 4);
    return pair(on_axis(0, k * a1, k * c1), on_axis((k - 1) * c1, a1, c1), kInsideA);
  }
  const int distance = draw.coin() ? c1 + c2 : draw.integer(0, 26);
  std::optional<ExactRelation> relation;  // deeper: neither pole tells
  if (distance > c1 + c2) relation = kSeparate;
  if (distance == c1 + c2) relation = kTouch;
  if (distance < c1 + c2 && distance > std::abs(c1 - c2)) relation = kOverlap;
  return pair(on_axis(0, a1, c1), on_axis(distance, a2, c2), relation);
}

MaybePair nested(Draw& draw) {
  AdversarialPair p{{moderate_body(draw, 1), {}}, {}, kBInA};
  p.b = moderate_body(draw, draw.log_uniform(1e-6, 0.1));
  const double room = (1 - most_axis(p.b)) / 2;  // half of what is left inside A's ball
  for (double& v : p.b.centre) v = draw.real(-room, room) / 2;
  return p;
}

// Same centre and orientation, small integer axes: every tie of axes is a touch at two points, a
// circle or everywhere; and crossing surfaces that touch elsewhere.
MaybePair concentric_parallel(Draw& draw) {
  ExactBody a{small_vector(draw, 9), small_axes(draw, 3), small_quaternion(draw)};
  ExactBody b{a.centre, small_axes(draw, 3), a.q};
  int less = 0, more = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    less += b.axes[k] < a.axes[k] ? 1 : 0;
    more += b.axes[k] > a.axes[k] ? 1 : 0;
  }
  if (more > 0 && less == 0) {
    std::swap(a, b);
    std::swap(less, more);
  }
  if (less == 0) return pair(a, b, kEqual);
  return pair(a, b, more > 0 ? kOverlap : less == 3 ? kBInA : kInsideA);
}

MaybePair concentric_turned(Draw& draw) {
  ExactBody a{small_vector(draw, 9), small_axes(draw, 4), small_quaternion(draw)};
  ExactBody b{a.centre, small_axes(draw, 4), small_quaternion(draw)};
  return pair(a, b, std::nullopt);
}

// Centres so close that squares of their separation are nothing: nested, since the sizes differ by
// far more.
MaybePair nearly_concentric(Draw& draw) {
  const double size = std::ldexp(1.0, draw.integer(-50, 50));
  const int closeness = draw.integer(60, 1000);
  const double offset = size * std::ldexp(draw.real(0.5, 1), -closeness);
  const double growth = 1 + std::ldexp(1.0, -draw.integer(1, 40));
  RawEllipsoid a{{}, {}, any_quaternion(draw)}, b{{}, {}, {}};
  const bool spheres = !draw.coin();
  for (std::size_t k = 0; k < 3; ++k) {
    a.semi_axes[k] = spheres ? size : size * draw.log_uniform(1, 4);
    b.semi_axes[k] = a.semi_axes[k] / growth;
    b.centre[k] = offset * draw.real(-1, 1);
  }
  b.orientation = spheres ? any_quaternion(draw) : a.orientation;
  return AdversarialPair{{a, b}, {}, kBInA};
}

// The same point set: axes permuted and the quaternion that undoes it, signs, scale; spheres and
// spheroids turned about their axis.
MaybePair equal_sets(Draw& draw) {
  struct Relabelling {
    Quaternion p;  // R(p) e_k = +-e_sigma(k)
    std::array<std::size_t, 3> sigma;
  };
  static constexpr std::array<Relabelling, 7> kRelabellings{{{{1, 1, 1, 1}, {1, 2, 0}},
                                                             {{-1, 1, 1, 1}, {2, 0, 1}},
                                                             {{1, 1, 0, 0}, {0, 2, 1}},
                                                             {{1, 0, 1, 0}, {2, 1, 0}},
                                                             {{1, 0, 0, -1}, {1, 0, 2}},
                                                             {{0, 0, 1, 0}, {0, 1, 2}},
                                                             {{-3, 0, 0, 0}, {0, 1, 2}}}};
  ExactBody a{small_vector(draw, 9), small_axes(draw, 5), small_quaternion(draw)};
  ExactBody b = a;
  const auto multiply = [](const Quaternion& q, const Quaternion& p) -> Quaternion {
    return {q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3],
            q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
            q[0] * p[2] - q[1] * p[3] + q[2] * p[0] + q[3] * p[1],
            q[0] * p[3] + q[1] * p[2] - q[2] * p[1] + q[3] * p[0]};
  };
  if (draw.integer(0, 3) == 0) {
    a.axes[1] = a.axes[0];
    b.axes = a.axes;
    b.q = multiply(b.q, {draw.integer(1, 9), 0, 0, draw.integer(-9, 9)});
  }
  const auto& [p, sigma] = draw.one_of(kRelabellings);
  b.q = multiply(b.q, p);
  const Vector axes = b.axes;
  for (std::size_t k = 0; k < 3; ++k) b.axes[k] = axes[sigma[k]];
  return pair(a, b, kEqual);
}

// B shares A's vertex +a1 and the directions of its axes, with p < a1. B is inside A if and only if
// its radii of curvature there, s^2/p, do not exceed A's, b^2/a1; equal ones osculate.
MaybePair vertex_touch(Draw& draw, bool osculating) {
  const Quaternion q = small_quaternion(draw);
  const int j = draw.integer(2, 5), i = draw.integer(1, j - 1), m = draw.integer(1, 4);
  const int a1 = m * j * j, p = m * i * i;  // with b = l j and s = l i the radii are equal
  std::array<int, 2> b{}, s{};
  bool fits = true;
  for (std::size_t k = 0; k < 2; ++k) {
    const int l = draw.integer(1, 6);
    b[k] = l * j;
    s[k] = osculating && (k == 0 || !draw.coin()) ? l * i : draw.integer(1, 2 * l * i);
    fits = fits && s[k] * s[k] * a1 <= b[k] * b[k] * p;
  }
  ExactBody outer{small_vector(draw, 99), {a1, b[0], b[1]}, q};
  ExactBody inner{outer.centre, {p, s[0], s[1]}, q};
  const Vector along = turned(q, {a1 - p, 0, 0});
  for (std::size_t k = 0; k < 3; ++k) {
    outer.axes[k] *= norm(q);
    inner.axes[k] *= norm(q);
    inner.centre[k] += along[k];
  }
  return pair(outer, inner, fits ? kInsideA : kOverlap);
}

MaybePair osculating(Draw& draw) { return vertex_touch(draw, true); }
MaybePair shared_vertex(Draw& draw) { return vertex_touch(draw, false); }

// A sphere off the centre of an ellipsoid (a, b, b' >= b) with a^2 - b^2 = c^2: centred at x0 =
// c cos t it has the radius b sin t and touches at x = a^2 cos t / c, at two points or (b' = b) on
// a circle, as long as a cos t < c.
MaybePair two_points_or_circle(Draw& draw) {
  static constexpr std::array<std::array<int, 3>, 5> kTriples{
      {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {7, 24, 25}, {20, 21, 29}}};
  auto legs = draw.one_of(kTriples), angle = draw.one_of(kTriples);
  if (draw.coin()) std::swap(legs[0], legs[1]);
  if (draw.coin()) std::swap(angle[0], angle[1]);
  const auto [b, c, a] = legs;
  const auto [cosine, sine, one] = angle;
  if (a * cosine >= c * one) return std::nullopt;
  const Quaternion q = small_quaternion(draw);
  const int scale = one * norm(q), r = b * sine * norm(q);
  const int other = b + (draw.coin() ? 0 : draw.integer(1, 9));
  ExactBody outer{small_vector(draw, 99), {a * scale, b * scale, other * scale}, q};
  ExactBody inner{outer.centre, {r, r, r}, small_quaternion(draw)};
  const Vector along = turned(q, {c * cosine, 0, 0});
  for (std::size_t k = 0; k < 3; ++k) inner.centre[k] += along[k];
  return pair(outer, inner, kInsideA);
}

struct Family {
  std::string_view name;
  MaybePair (*make)(Draw&);
};

constexpr std::array kFamilies{
    Family{"integer_touch_outside", integer_touch_outside},
    Family{"integer_touch_inside", integer_touch_inside},
    Family{"next_float_grid", next_float_grid},
    Family{"small_gap", small_gap},
    Family{"small_gap_far_origin", small_gap_far_origin},
    Family{"far_origin", far_origin},
    Family{"extreme_scale", extreme_scale},
    Family{"extreme_ratios", extreme_ratios},
    Family{"unnormalised_quaternion", unnormalised_quaternion},
    Family{"spheres", spheres},
    Family{"equal_shapes_parallel_axes", equal_shapes_parallel_axes},
    Family{"coaxial_spheroids", coaxial_spheroids},
    Family{"nested", nested},
    Family{"concentric_parallel", concentric_parallel},
    Family{"nearly_concentric", nearly_concentric},
    Family{"concentric_turned", concentric_turned},
    Family{"equal_sets", equal_sets},
    Family{"osculating", osculating},
    Family{"shared_vertex", shared_vertex},
    Family{"two_points_or_circle", two_points_or_circle},
};

void exchange_bodies(AdversarialPair& p) {
  std::swap(p.a, p.b);
  if (!p.relation) return;
  auto& [relation, inner] = *p.relation;
  if (relation == Relation::b_in_a) relation = Relation::a_in_b;
  if (inner == Inner::b) inner = Inner::a;  // the constructions put B inside
}

}  // namespace

std::span<const std::string_view> adversarial_family_names() {
  static constexpr auto kNames = [] {
    std::array<std::string_view, kFamilies.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kFamilies[i].name;
    return names;
  }();
  return kNames;
}

void for_each_adversarial_pair(std::uint64_t seed, std::size_t count,
                               const std::function<void(const AdversarialPair&)>& use) {
  Draw draw(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const Family& family = kFamilies[i % kFamilies.size()];
    MaybePair p;
    while (!p) p = family.make(draw);  // some draws do not fit into doubles: draw again
    p->family = family.name;
    if (draw.coin()) exchange_bodies(*p);
    use(*p);
  }
}

}  // namespace tangency::inline v0::verify
