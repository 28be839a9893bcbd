// SPDX-License-Identifier: GPL-3.0-or-later
//
// Damped impacts against theory: restitution along the normal, head on and oblique, that slide and
// that stick, of spheres, spheroids and walls, by both laws, and where the energy goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/geometry/gap.hpp>

#include "few_bodies.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

/// What scenes promise (dem/scene/scene_keys.cpp), and the largest factor that they promise it for.
constexpr double kPromised = 1e-3, kFactor = 0.04;

constexpr std::array kGiven{0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0};

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

constexpr const char* kLinear = "normal_stiffness = 1e6\n";
constexpr const char* kHertz = "law = \"hertz\"\nyoung_modulus = 1e8\npoisson_ratio = 0.25\n";

/// Two bodies of radius 1 on their way into each other, `way` apart, or one into the wall at x = 0.
std::string head_on(const std::string& law, double restitution, double way, int dimensions = 3,
                    bool wall = false) {
  const std::string at = dimensions == 2 ? ", 5.0, 0.0]\n" : ", 5.0, 5.0]\n";
  const auto body = [&](double x, double velocity) {
    return "[[body]]\ntype = \"ball\"\nposition = [" + number(x) + at + "velocity = [" +
           number(velocity) + ", 0.0, 0.0]\n";
  };
  return "schema = 1\n[cell]\nsize = [20.0, 20.0, " +
         std::string(dimensions == 2 ? "1.0" : "20.0") +
         "]\ndimensions = " + std::to_string(dimensions) + "\n" + (wall ? "walls = \"x\"\n" : "") +
         "[particles.ball]\ncount = " + (wall ? "1" : "2") + "\nmean_radius = 1.0\n[contact" +
         (wall ? "]\n" + law + "[contact.ball-wall]\n" : "]\n" + law) +
         "restitution = " + number(restitution) +
         "\n[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n" +
         (wall ? body(1.0 + way, -1.0) : body(5.0, 0.5) + body(7.0 + way, -0.5)) +
         "[[stage]]\nkind = \"servo\"\nduration = 100000\ndamping = 0.0\ntime_step_factor = " +
         number(kFactor) + "\n";
}

bool touches(const State& state) { return state.contacts.totals().contacts > 0; }

/// Cycles until the bodies have touched and parted.
void let_part(Simulation& simulation) {
  bool touched = false;
  for (int k = 0; !touched || touches(simulation.state()); ++k) {
    ASSERT_LT(k, 20000);
    simulation.step();
    touched = touched || touches(simulation.state());
  }
}

/// The restitution that an impact shows, the farthest of some that begin elsewhere in a step.
double shown(const std::string& law, double given, int dimensions = 3, bool wall = false) {
  double farthest = given;
  for (int k = 0; k < 5; ++k) {
    Simulation simulation(
        parse_scene(head_on(law, given, 0.01 + 2.3e-5 * k, dimensions, wall), "scene.toml"));
    const auto approach = [&] {
      const auto& v = simulation.state().particles.velocity;
      return wall ? -v[0][0] : v[0][0] - v[1][0];
    };
    const double before = approach();
    let_part(simulation);
    const double now = -approach() / before;
    if (std::abs(now - given) > std::abs(farthest - given)) farthest = now;
  }
  return farthest;
}

// dem/contact/contact_law.hpp (5)
TEST(Restitution, OfAHeadOnImpactIsTheGivenOne) {
  std::printf("given   linear   hertz    wall, linear  wall, hertz  disks\n");
  for (const double given : kGiven) {
    const double seen[] = {shown(kLinear, given), shown(kHertz, given),
                           shown(kLinear, given, 3, true), shown(kHertz, given, 3, true),
                           shown(kLinear, given, 2)};
    std::printf("%.2f   ", given);
    for (const double one : seen) {
      std::printf(" %.5f ", one);
      EXPECT_NEAR(one, given, kPromised) << given;
    }
    std::printf("\n");
  }
}

TEST(Restitution, IsThatOfTheDampingRatioThatItGives) {
  for (double e = kLeastRestitution; e <= 1.0; e += 1.0 / 512.0) {
    ContactLaw law{1.0, 0.0, 0.0, 0.0};
    law.damping_ratio = damping_ratio_of(e);
    EXPECT_NEAR(law.restitution(), e, 1e-14);
  }
  EXPECT_EQ(damping_ratio_of(1.0), 0.0);
  EXPECT_NEAR(damping_ratio_of(std::exp(-2.0)), 1.0, 1e-7) << "critical damping";
}

constexpr Material kStuff{1e6, 0.3};

/// A law with some damping. Hertz: of the material above.
ContactLaw damped(bool hertz, double stiffness, double restitution, double friction = 0.0) {
  ContactLaw law{stiffness, stiffness, friction, 0.0, {}, damping_ratio_of(restitution)};
  if (hertz) law.hertz = Material{kStuff.young_modulus * stiffness / 1e4, kStuff.poisson_ratio};
  return law;
}

/// Two bodies that just touch, on their way into each other, of any shapes, places and motions.
struct Meeting : FewBodies {
  Vec3 normal, arm_a, arm_b, start, velocity_b;
  Mat3 inverse_mass;  ///< of the relative motion at the contact: velocity = inverse_mass impulse

  /// @param in_plane  all turns are about z, and nothing leaves a plane across it
  Meeting(const ContactLaw& law, const Vec3& radii_a, const Vec3& radii_b, const Vec3& velocity,
          bool in_plane = false)
      : FewBodies(law) {
    const Vec3 shown(1.0, 1.0, in_plane ? 0.0 : 1.0);
    const auto seen = [&](double x, double y, double z) {
      return Vec3(shown.cwiseProduct(Vec3(x, y, z)));
    };
    const auto turn = [&](double w, double x, double y, double z) {
      return in_plane ? Eigen::Quaterniond(w, 0.0, 0.0, z) : Eigen::Quaterniond(w, x, y, z);
    };
    const auto spin = [&](double x, double y, double z) {
      return in_plane ? Vec3(0.0, 0.0, z) : Vec3(x, y, z);
    };
    const Vec3 a = Vec3::Constant(50.0), d = seen(1.4, 0.6, -0.5);
    add(a, turn(0.4, -0.3, 0.7, 0.2), radii_a, seen(0.5, -0.1, 0.2), spin(0.1, -0.3, 0.2));
    add(a + d, turn(0.8, 0.1, 0.2, -0.6), radii_b, shown.cwiseProduct(velocity),
        spin(-0.2, 0.3, 0.4));
    const auto body = [&](std::size_t i) {
      return tangency::Ellipsoid(Vec3::Zero(), particles.semi_axes[i], particles.orientation[i]);
    };
    const tangency::Gap gap = tangency::signed_gap(body(0), body(1), d);
    particles.position[1] -= gap.gap * gap.normal;
    normal = gap.normal;
    arm_a = gap.arm_a;
    arm_b = gap.arm_b;
    const auto of_turns = [&](std::size_t i, const Vec3& arm) -> Mat3 {
      return cross(arm) * inertia(i).inverse() * cross(arm);
    };
    inverse_mass = (1.0 / mass(0) + 1.0 / mass(1)) * Mat3::Identity() - of_turns(0, arm_a) -
                   of_turns(1, arm_b);
    start = relative();
    velocity_b = particles.velocity[1];
    update();
  }
  Vec3 relative() const {
    return particles.velocity[1] + particles.angular_velocity[1].cross(arm_b) -
           particles.velocity[0] - particles.angular_velocity[0].cross(arm_a);
  }
  double effective_mass() const { return 1.0 / normal.dot(inverse_mass * normal); }
  /// Until they part; `parts` steps a radian of the largest stiffness' oscillation.
  void run(double stiffness, double parts) {
    const double dt = std::sqrt(effective_mass() / stiffness) / parts;
    bool touched = false;
    for (int k = 0; !touched || touching() > 0; ++k) {
      ASSERT_LT(k, 300.0 * parts);
      step(dt);
      touched = touched || touching() > 0;
    }
  }
  Vec3 impulse() const { return mass(1) * (particles.velocity[1] - velocity_b); }
};

const Vec3 kEgg(1.3, 1.0, 0.8), kLens(0.9, 0.9, 0.6), kBall = Vec3::Ones();
const Vec3 kOnto(-0.9, -0.3, 0.6);

/// Newton's impulse of a smooth eccentric impact: (1 + e) times what stops the approach.
TEST(Restitution, OfSpheroidsThatTurnIsNewtonsInTheLimitOfStiffContacts) {
  for (const bool hertz : {false, true}) {
    std::printf("%s: given, off at two stiffnesses:", hertz ? "hertz" : "linear");
    for (const double given : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      const auto off = [&](double stiffness) {
        Meeting impact(damped(hertz, stiffness, given), kEgg, kLens, kOnto);
        EXPECT_LT(impact.start.dot(impact.normal), -0.5);
        EXPECT_GT(impact.arm_a.cross(impact.normal).norm(), 0.05) << "eccentric";
        const double m = impact.effective_mass();
        const double expected = -(1.0 + given) * m * impact.normal.dot(impact.start);
        impact.run(stiffness, 100.0);
        return (impact.impulse() - expected * impact.normal).norm() / expected;
      };
      const double soft = off(1e6), stiff = off(256e6);
      std::printf("  %.1f %.1e %.1e", given, soft, stiff);
      EXPECT_LT(stiff, kPromised);
      // What is left out is the way made during the contact over a radius: with the square root of
      // a linear stiffness, with the power 2/5 of a Hertz one.
      EXPECT_LT(stiff, 0.3 * soft);
    }
    std::printf("\n");
  }
}

/// Of a body that slides throughout: its impulse along n - mu sliding. Friction turns an eccentric
/// body too, so that the approach is damped as if the law had another damping ratio. In a plane,
/// where what slides keeps its direction, and so fast that the spring soon gives way.
double off_in_sliding(bool hertz, double stiffness, double given, const Vec3& a, const Vec3& b) {
  const double mu = 0.2;
  const ContactLaw law = damped(hertz, stiffness, given, mu);
  const Vec3 n = Meeting(law, a, b, kOnto, true).normal, along = n.cross(Vec3::UnitZ());
  Meeting impact(law, a, b, kOnto + 80.0 * along, true);
  EXPECT_LT(impact.start.dot(n), -0.2);
  EXPECT_GT(impact.start.dot(along), 1.0);
  const Vec3 direction = n - mu * along;
  const double gives = n.dot(impact.inverse_mass * direction);
  ContactLaw seen = law;
  seen.damping_ratio *= std::sqrt(gives * impact.effective_mass());
  const double size = -(1.0 + seen.restitution()) * n.dot(impact.start) / gives;
  EXPECT_GT(along.dot(impact.start + size * (impact.inverse_mass * direction)), 0.1) << "slides";
  impact.run(stiffness, 200.0);
  return (impact.impulse() - size * direction).norm() / size;
}

TEST(Restitution, HoldsInAnObliqueImpactThatSlidesWithACoulombImpulse) {
  for (const bool hertz : {false, true})
    for (const auto& [a, b] : {std::pair(kBall, kBall), std::pair(kEgg, kLens)})
      for (const double given : {0.1, 0.5, 0.9, 1.0}) {
        const double off = off_in_sliding(hertz, 0x1p60, given, a, b);
        std::printf("%s, %s, e %.1f: off %.1e\n", hertz ? "hertz" : "linear",
                    a == kBall ? "spheres" : "spheroids", given, off);
        // A strong damper pushes at once, and the spring across takes a moment to come to the
        // limit.
        EXPECT_LT(off, given < 0.3 ? 3.0 * kPromised : kPromised);
      }
}

/// Overlap and its rate, displacement across and its rate, and the force across.
using Spring = std::array<double, 5>;

/// An oblique impact of two equal spheres that sticks, by Runge and Kutta until the push ends:
/// velocity across at the end, over that at the start.
double stuck(const ContactLaw& law, double mass, double radius, double approach) {
  const double modulus = law.hertz ? law.hertz->contact_modulus() : 0.0;
  const auto stiffness = [&](double s) {
    return law.hertz ? 2.0 * modulus * std::sqrt(radius * s) : law.normal_stiffness;
  };
  const auto of_shear = [&](double s) {
    if (!law.hertz) return law.shear_stiffness;
    return 4.0 * law.hertz->shear_modulus() / (2.0 - law.hertz->poisson_ratio) *
           std::sqrt(radius * s);
  };
  const auto push = [&](const Spring& x) {
    const double s = std::max(x[0], 0.0), k = stiffness(s);
    const double viscosity =
        2.0 * law.damping_ratio * (law.hertz ? std::sqrt(5.0 / 6.0) : 1.0) * std::sqrt(mass * k);
    return (law.hertz ? 2.0 / 3.0 : 1.0) * k * s + viscosity * x[1];
  };
  const auto rate = [&](const Spring& x) -> Spring {
    // Unloaded a Hertz contact gives shear force back in proportion to its stiffness.
    const double back = law.hertz && x[1] < 0.0 && x[0] > 0.0 ? 0.5 * x[1] / x[0] * x[4] : 0.0;
    return {x[1], -push(x) / mass, x[3], 3.5 * x[4] / mass,
            -of_shear(std::max(x[0], 0.0)) * x[3] + back};
  };
  Spring x{0.0, approach, 0.0, 1.0, 0.0};
  const double dt = 1e-4 * std::sqrt(mass / law.normal_stiffness);
  const auto plus = [](Spring a, const Spring& b, double h) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] += h * b[k];
    return a;
  };
  for (double t = 0.0; t == 0.0 || push(x) > 0.0; t += dt) {
    const Spring a = rate(x), b = rate(plus(x, a, 0.5 * dt)), c = rate(plus(x, b, 0.5 * dt)),
                 d = rate(plus(x, c, dt));
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] += dt / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
  }
  return x[3];
}

TEST(Restitution, HoldsInAnObliqueImpactThatSticksAndTheSpringsSayWhatTurns) {
  const double stiffness = 1e8, no_slip = 1e9;
  for (const bool hertz : {false, true})
    for (const double given : {0.1, 0.3, 0.5, 0.8, 1.0}) {
      const ContactLaw law = damped(hertz, stiffness, given, no_slip);
      Meeting impact(law, kBall, kBall, kOnto);
      const Vec3 n = impact.normal;
      const double approach = -n.dot(impact.start);
      const Vec3 across = impact.start + n * approach;
      const double mass = impact.effective_mass();
      const double expected = stuck(law, mass, 0.5, approach);
      impact.run(stiffness, 300.0);
      const Vec3 end = impact.start + impact.inverse_mass * impact.impulse();
      EXPECT_NEAR(n.dot(end) / approach, given, kPromised) << hertz;
      const double shown = across.dot(end) / across.squaredNorm();
      std::printf("%s e %.1f: across %.4f, by the springs %.4f\n", hertz ? "hertz" : "linear",
                  given, shown, expected);
      // The shear force ends at once: the impulse is off by that of a step, 1/300 of a radian.
      EXPECT_NEAR(shown, expected, 0.01);
      if (hertz) continue;
      // By hand: a spring without damping, for as long as the damped one pushes.
      const double z = law.damping_ratio;
      if (z < 1.0) {
        const double lasts = 2.0 * std::acos(z) / std::sqrt(1.0 - z * z);  // over the radian
        EXPECT_NEAR(expected, std::cos(std::sqrt(3.5) * lasts), 1e-3);
      }
    }
}

TEST(Restitution, LosesTheEnergyOfTheApproachAndTheAccountHasIt) {
  for (const char* law : {kLinear, kHertz})
    for (const double given : {0.1, 0.5, 0.9}) {
      Simulation simulation(parse_scene(head_on(law, given, 0.01), "scene.toml"));
      const double mass = 0.5 * simulation.state().particles.mass[0];
      let_part(simulation);
      const Observation seen = simulation.observe();
      const double start = seen.account.start, lost = 0.5 * mass * (1.0 - given * given);
      EXPECT_NEAR(seen.account.viscous, lost, 2.0 * kPromised * start);
      // The account is leapfrog's: what is not in it is how far mean forces work from energies.
      EXPECT_NEAR(seen.energy_error, 0.0, kPromised * start);
    }
}

TEST(Restitution, OfAnImpactThatIsSavedAndResumedHasTheSameBits) {
  const auto file = std::filesystem::path(testing::TempDir()) / "restitution.state";
  for (const char* law : {kLinear, kHertz}) {
    const Scene scene = parse_scene(head_on(law, 0.4, 0.01), "scene.toml");
    Simulation whole(scene);
    while (!touches(whole.state())) whole.step();
    for (int k = 0; k < 5; ++k) whole.step();
    save_state(whole.state(), file);
    Simulation resumed(scene, load_state(file));
    EXPECT_EQ(resumed.changed_laws(), "");
    let_part(whole);
    let_part(resumed);
    EXPECT_EQ(state_hash(resumed.state()), state_hash(whole.state()));
    const Simulation other(parse_scene(head_on(law, 0.5, 0.01), "scene.toml"), load_state(file));
    EXPECT_EQ(other.changed_laws(), "contact.ball-ball.restitution = 0.4, and here 0.5");
  }
  std::filesystem::remove(file);
}

TEST(Restitution, WithoutTurnsCountsTheMassAlone) {
  // The bodies of an eccentric impact that may not turn part as if they met head on.
  const double given = 0.5;
  const auto text = [&](const char* rotation) {
    return "schema = 1\n[cell]\nsize = [20.0, 20.0, 20.0]\n[motion]\nrotation = \"" +
           std::string(rotation) +
           "\"\n[particles.egg]\ncount = 2\nmean_radius = 1.0\nelongation = 1.5\n[contact]\n"
           "normal_stiffness = 1e8\nrestitution = 0.5\n[[stage]]\nkind = \"place\"\n"
           "arrangement = \"explicit\"\n[[body]]\ntype = \"egg\"\nposition = [5.0, 5.0, 5.0]\n"
           "velocity = [0.5, 0.0, 0.0]\norientation = [0.9, 0.0, 0.0, 0.4]\n[[body]]\n"
           "type = \"egg\"\nposition = [7.6, 5.3, 5.0]\nvelocity = [-0.5, 0.0, 0.0]\n"
           "[[stage]]\nkind = \"servo\"\nduration = 100000\ndamping = 0.0\n"
           "time_step_factor = 0.04\n";
  };
  Simulation still(parse_scene(text("none"), "scene.toml"));
  const Vec3 before = still.state().particles.velocity[1] - still.state().particles.velocity[0];
  let_part(still);
  const Vec3 after = still.state().particles.velocity[1] - still.state().particles.velocity[0];
  const Vec3 n = (after - before).normalized();
  EXPECT_GT(std::abs(n[1]), 0.05) << "eccentric";
  EXPECT_NEAR(-n.dot(after) / n.dot(before), given, 5e-3);
  Simulation turning(parse_scene(text("full"), "scene.toml"));
  let_part(turning);
  const auto& velocity = turning.state().particles.velocity;
  EXPECT_GT(std::abs(n.dot(velocity[1] - velocity[0]) / n.dot(before) + given), 0.02);
}

}  // namespace
