// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <type_traits>
#include <vector>

#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/pencil.hpp>
#include <tangency/geometry/polynomial.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

TEST(FloatingPointEnvironment, OnlyNearestWithSubnormalsIsDefault) {
  for (const auto& environment : testing::all_environments()) {
    bool is_default = false;
    bool probed = false;
    {
      const testing::EnvironmentGuard guard(environment);
      is_default = environment_is_default();
      probed = probe_environment();
    }
    const bool expected = environment.rounding == FE_TONEAREST && !environment.flush;
    EXPECT_EQ(is_default, expected) << environment.name;
    EXPECT_EQ(probed, expected) << environment.name;
  }
}

#if defined(__SSE2_MATH__)
TEST(FloatingPointEnvironment, FlushedResultsAloneAndFlushedOperandsAloneAreNotDefault) {
  for (const unsigned bit : {0x8000u, 0x0040u}) {
    const unsigned old = _mm_getcsr();
    _mm_setcsr(old | bit);
    const bool is_default = environment_is_default();
    const bool probed = probe_environment();
    _mm_setcsr(old);
    EXPECT_FALSE(is_default) << std::hex << bit;
    EXPECT_FALSE(probed) << std::hex << bit;
  }
}
#endif

/// Every number of some answers, as it is stored.
class Bits {
 public:
  template <class... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }
  bool operator==(const Bits&) const = default;

 private:
  void add_one(double x) { bits_.push_back(std::bit_cast<std::uint64_t>(x)); }
  template <class Number>
  requires std::is_integral_v<Number> || std::is_enum_v<Number>
  void add_one(Number x) { bits_.push_back(static_cast<std::uint64_t>(x)); }
  template <class Derived>
  void add_one(const Eigen::DenseBase<Derived>& m) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      for (Eigen::Index i = 0; i < m.rows(); ++i) add_one(m(i, j));
    }
  }
  void add_one(const PrincipalCurvatures& k) {
    add(k.curvature[0], k.curvature[1], k.direction[0], k.direction[1]);
  }
  void add_one(const OtherGap& g) { add(g.gap, g.normal, g.arm_a, g.arm_b, g.status); }
  template <class AnyGap>
  requires requires(const AnyGap& g) { g.gap_error; }
  void add_one(const AnyGap& g) {
    add(g.gap, g.gap_error, g.normal, g.arm_a, g.arm_b, g.status, g.tier);
  }

  std::vector<std::uint64_t> bits_;
};

/// Numbers of one pair, in space and in the plane, and of what else the calls take.
struct Input {
  std::array<double, 3> a_centre, a_axes, b_centre, b_axes, d;
  std::array<double, 4> a_turn, b_turn;
  Vec3 normal;
  double size;
  Vec3 velocity;
  std::array<double, 5> quartic;
  std::array<double, 10> quadric;
};

/// Sizes about 2^-1000, 1 and 2^1000, where answers or their errors are subnormal or nearly
/// overflow; aspects to 1e17, thin faces against spheres, deep and touching pairs.
Input hostile_input(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  const int powers[] = {-1060, -1022, -1010, -1000, 0, 1000, 1015};
  const int power = powers[below(7)] + static_cast<int>(below(8));
  Input in;
  in.size = std::ldexp(1.0, power);
  const double thin[] = {1, 1e-2, 1e-9, 1e-17};
  const auto body = [&](auto& axes, auto& turn) {
    const double least = thin[below(4)];
    const bool sphere = below(4) == 0;
    const double all = uniform(0.1, 1);
    for (double& x : axes) x = std::ldexp(sphere ? all : uniform(0.3, 1), power);
    if (!sphere) axes[below(3)] *= least;
    for (double& x : axes) x = std::max(x, std::numeric_limits<double>::denorm_min());
    for (double& x : turn) x = uniform(-1, 1);
  };
  body(in.a_axes, in.a_turn), body(in.b_axes, in.b_turn);
  const double reach = std::array{0.0, 0.2, 1.0, 1.5, 3.0}[below(5)];
  const auto vector = [&](auto& v, double length) {
    for (int i = 0; i < 3; ++i)
      v[static_cast<std::size_t>(i)] = std::ldexp(uniform(-1, 1) * length, power);
  };
  vector(in.a_centre, below(2)), vector(in.b_centre, reach), vector(in.d, reach);
  in.normal = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)).normalized();
  in.velocity = std::ldexp(1.0, power) * Vec3(uniform(-3, 3), uniform(-3, 3), uniform(-3, 3));
  for (double& x : in.quartic)
    x = std::ldexp(uniform(-1, 1), power / 2 - static_cast<int>(below(40)));
  for (double& x : in.quadric) x = std::ldexp(uniform(-1, 1), power - static_cast<int>(below(40)));
  return in;
}

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The bodies, made in the environment of the calls.
struct Bodies {
  Ellipsoid a, b;
  Vec3 d;

  explicit Bodies(const Input& in)
      : a(vec(in.a_centre), vec(in.a_axes), turn(in.a_turn)),
        b(vec(in.b_centre), vec(in.b_axes), turn(in.b_turn)),
        d(vec(in.d)) {}
  static Eigen::Quaterniond turn(const std::array<double, 4>& q) {
    return {q[0], q[1], q[2], q[3]};
  }
};

void add_gaps(const Input& in, Bits& bits) {
  const Bodies pair(in);
  const auto& [a, b, d] = pair;
  const Gap gap = signed_gap(a, b), apart = signed_gap(a, b, d);
  bits.add(gap, apart, follow_gap(a, b, d, in.normal));
  for (const ContactBounds& bounds : {contact_bounds(a, b, gap), contact_bounds(a, b, d, apart)})
    bits.add(bounds.normal, bounds.arm_a, bounds.arm_b);
  for (const GapDerivatives& g : {gap_derivatives(a, b, gap), gap_derivatives(a, b, d, apart)})
    bits.add(g.gradient, g.hessian, g.least_radius, g.status);
}

void add_relations(const Input& in, Bits& bits) {
  const Bodies pair(in);
  const RelationAnswer found = relation(pair.a, pair.b);
  // Which tier answers the yes/no question may depend on the environment, the answer may not.
  bits.add(found.relation, found.inner, found.tier, overlaps(pair.a, pair.b));
  const std::optional<bool> by_filter = overlaps_by_filter(pair.a, pair.b);
  bits.add(by_filter.has_value(), by_filter.value_or(false));
}

void add_primitives(const Input& in, Bits& bits) {
  const auto& [a, b, d] = Bodies(in);
  const Sphere sphere{b.centre(), b.largest_semi_axis()};
  bits.add(signed_gap(a, sphere), signed_gap(sphere, a),
           signed_gap(Sphere{a.centre(), in.size}, sphere));
  const WallGap wall = signed_gap(a, Plane{in.normal, in.size});
  bits.add(wall.gap, wall.normal, wall.arm_body, wall.arm_wall, wall.gap_error);
  const WallGap sheet = signed_gap(MatrixEllipsoid(a), Sheet{in.normal, in.size});
  bits.add(sheet.gap, sheet.normal, sheet.gap_error);
  const RelationAnswer to_wall = relation(a, Plane{in.normal, in.size});
  bits.add(to_wall.relation, to_wall.inner, to_wall.tier);
  const ClosestPoint closest = closest_point(a, b.centre());
  bits.add(closest.distance, closest.normal, closest.arm, closest.distance_error);
  const RayHit hit =
      intersect(a, {b.centre(), in.normal}, -std::numeric_limits<double>::infinity());
  bits.add(hit.status, hit.count);
  for (const SurfacePoint& p : hit.points) bits.add(p.t, p.arm, p.normal);
  bits.add(surface_curvature(a, in.normal));
  const ContactCurvature k = contact_curvature(a, b, in.normal);
  bits.add(k.a, k.b, k.relative);
  bits.add(a.support(d), a.support_point(in.normal), a.level(b.centre()));
  const Eigen::AlignedBox3d box = a.bounding_box();
  bits.add(box.min(), box.max());
}

void add_plane(const Input& in, Bits& bits) {
  const auto ellipse = [](const auto& centre, const auto& axes, const auto& turn) {
    return Ellipse({centre[0], centre[1]}, {axes[0], axes[1]}, {turn[0], turn[1]});
  };
  const Ellipse a = ellipse(in.a_centre, in.a_axes, in.a_turn);
  const Ellipse b = ellipse(in.b_centre, in.b_axes, in.b_turn);
  const Vec2 d(in.d[0], in.d[1]), n(in.normal[0], in.normal[2]);
  bits.add(signed_gap(a, b), signed_gap(a, b, d), follow_gap(a, b, d, n));
  const EllipseRelation found = relation(a, b);
  bits.add(found.relation, found.inner, overlaps(a, b), common_area(a, b), common_area(a, b, d));
  const Crossings c = crossings(a, b);
  for (const Crossing& at : c.at) bits.add(c.count, at.arm_a, at.arm_b, at.multiplicity);
  const ChordContact chord = chord_contact(a, b);
  bits.add(chord.status, chord.depth, chord.normal, chord.arm_a, chord.arm_b);
  bits.add(Ellipse::at_angle({0, 0}, {1, 2}, in.velocity[0]).direction());
}

void add_batches(const Input& in, Bits& bits) {
  const Bodies pair(in);
  const std::vector<Ellipsoid> bodies{pair.a, pair.b};
  const BodyArray array(bodies);
  const std::array pairs{IndexedPair{0, 1}, IndexedPair{1, 0}};
  const std::array separations{pair.d, pair.d}, normals{in.normal, in.normal};
  std::array<Gap, 2> gaps;
  for (const Accuracy& accuracy : {Accuracy::fast(), Accuracy::standard(), Accuracy::certified()}) {
    signed_gaps(array, {pairs, {}}, gaps, accuracy);
    bits.add(gaps[0], gaps[1]);
    signed_gaps({&pair.a, 1}, {&pair.b, 1}, {gaps.data(), 1}, accuracy);
    bits.add(gaps[0]);
    follow_gaps(array, {pairs, separations}, normals, gaps, accuracy);
    bits.add(gaps[0], gaps[1]);
  }
  const std::array axes{pair.a.semi_axes(), pair.b.semi_axes()};
  const std::array turns{pair.a.orientation(), pair.b.orientation()};
  const MovingBodies moving(axes, turns);
  const std::array starts{in.normal, Vec3(Vec3::Zero())};  // one followed, one asked afresh
  std::array<double, 2> gap, gap_error;
  std::array<Vec3, 2> normal;
  const GapColumns columns{gap, gap_error, normal, {}, {}, {}};
  follow_gaps(moving, {pairs, separations}, starts, columns);
  bits.add(gap[0], gap[1], gap_error[0], gap_error[1], normal[0], normal[1]);
  std::array<GapDerivatives, 2> derivatives;
  gap_derivatives(array, {pairs, separations}, gaps, derivatives);
  bits.add(derivatives[0].gradient, derivatives[1].status);
  std::array<bool, 2> meet;
  overlaps(array, {pairs, separations}, meet);
  bits.add(meet[0], meet[1]);
}

void add_others(const Input& in, Bits& bits) {
  const auto& [a, b, d] = Bodies(in);
  bits.add(perram_wertheim_gap(a, b), perram_wertheim_gap(a, b, d), midpoint_potential_gap(a, b),
           midpoint_potential_gap(a, b, d));
  const TraceContact trace = trace_contact(a, b);
  bits.add(trace.status, trace.gap, trace.normal, trace.arm_a, trace.arm_b);
  const QuarticRoots roots = quartic_roots(in.quartic);
  for (const QuarticRoot& r : roots.root) bits.add(roots.count, r.x, r.error, r.crosses);
  const Quadric quadric(in.quadric);
  const Classification type = classify(quadric);
  bits.add(type.type, type.tier, quadric.evaluate(in.normal), quadric.gradient(in.normal));
}

/// Calls that may take milliseconds.
void add_slow(const Input& in, Bits& bits) {
  const auto& [a, b, d] = Bodies(in);
  const Motion flight{in.velocity, in.normal, Vec3::Zero()};
  const TimeOfContact t = time_of_contact(a, flight, b, {}, 1.0, 1e-6);
  bits.add(t.status, t.time, t.latest, t.resolution, t.gap, t.steps);
  bits.add(moved(a, flight, 0.5).centre(), screw(a, d, in.normal, in.size).velocity);
  for (const PencilMember& m : pencil_members(Quadric(in.quadric), Quadric(in.quadric).negated()))
    bits.add(m.f, m.low, m.high, m.is_root, m.classification.type);
}

/// Subnormals flushed or not, each rounding mode: that of `seed`, never the default one.
testing::FloatingPointEnvironment environment_of(std::uint64_t seed) {
  return testing::all_environments()[1 + seed % 7];
}

/// Do the calls answer in an environment, to the bit, as in the default one, and leave it behind?
template <class Calls>
void expect_same(const Calls& calls, const testing::FloatingPointEnvironment& environment) {
  Bits expected, found;
  calls(expected);
  bool restored = false;
  {
    const testing::EnvironmentGuard guard(environment);
    calls(found);
    restored = !environment_is_default() && std::fegetround() == environment.rounding;
  }
  RC_LOG() << environment.name;
  RC_ASSERT(restored);
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(FloatingPointEnvironment, EveryCallAnswersInAnyAsInTheDefaultOne,
              (std::uint64_t seed)) {
  using Calls = void (*)(const Input&, Bits&);
  constexpr Calls kCalls[] = {add_gaps,    add_relations, add_primitives, add_plane,
                              add_batches, add_others,    add_slow};
  std::mt19937_64 random(seed);
  const Input in = hostile_input(random());
  const std::uint64_t which = random();
  const Calls calls = kCalls[which % 32 == 0 ? 6 : which % 6];
  expect_same([&](Bits& bits) { calls(in, bits); }, environment_of(random()));
}

RC_GTEST_PROP(FloatingPointEnvironment, SignedGapAnswersInAnyAsInTheDefaultOne,
              (std::uint64_t seed)) {
  const Input in = hostile_input(seed);
  const auto gap = [&](Bits& bits) {
    const Bodies pair(in);
    bits.add(signed_gap(pair.a, pair.b));
  };
  expect_same(gap, environment_of(seed));
}

#if defined(__SSE2_MATH__)
// With subnormals flushed these gave `ok` with an error of 0.
TEST(FloatingPointEnvironment, AGapOfBodiesOfSubnormalSizeKeepsItsErrorWhereSubnormalsAreFlushed) {
  const Ellipsoid a({0, 0, 0}, {0x1p-1020, 0x1.8p-1021, 0x1.2p-1021}, {0.9, 0.1, 0.2, 0.3});
  const Ellipsoid b({0x1.8p-1019, 0x1p-1021, 0}, {0x1p-1021, 0x1.4p-1020, 0x1p-1020});
  const Gap expected = signed_gap(a, b);
  Gap found;
  {
    const testing::EnvironmentGuard guard({"", FE_TONEAREST, true});
    found = signed_gap(a, b);
  }
  EXPECT_EQ(found.gap, expected.gap);
  EXPECT_EQ(found.gap_error, expected.gap_error);
  EXPECT_GT(found.gap_error, 0.0);
  EXPECT_EQ(found.status, GapStatus::ok);
}
#endif

}  // namespace
}  // namespace tangency
