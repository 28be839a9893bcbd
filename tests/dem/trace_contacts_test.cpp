// SPDX-License-Identifier: GPL-3.0-or-later
/// The published scheme of curves as the contacts of a run, beside the certified answers.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/profile.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/geometry/trace_contact.hpp>

#include "../tool/process.hpp"
#include "assembly.hpp"
#include "scenes.hpp"
#include "stages.hpp"

namespace {

using namespace tangency::dem;
using tangency::TraceContact;
using tangency::TraceStatus;
using tangency::Vec3;
using namespace tangency::testing;

constexpr ContactLaw kLaw{100.0, 80.0, 0.5, 0.0};

Moving crowded(Branch branch, std::uint64_t seed = 91) {
  const Cell cell = Cell::box({3.5, 3.6, 3.4});
  Moving made{cell, crowd(40, cell, seed)};
  made.branch = branch;
  made.update(kLaw, 0.0);
  return made;
}

/// What trace_contact() says of a pair, of which the particle first in the scene is A, as the
/// simulator has it.
Contact published(const Moving& sample, const Pair& pair, TraceStatus& status) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const Vec3 branch = branch_vector(pair, sample.particles, sample.cell);
  const bool turned = sample.particles.id[a] > sample.particles.id[b];
  const TraceContact found =
      turned ? trace_contact(body(sample.particles, b), body(sample.particles, a), -branch)
             : trace_contact(body(sample.particles, a), body(sample.particles, b), branch);
  status = found.status;
  Contact contact;
  contact.overlap = -found.gap;
  contact.normal = turned ? Vec3(-found.normal) : found.normal;
  // The middle of PQ from a's centre: of the two arms one starts at b's.
  contact.arm = 0.5 * (found.arm_a + found.arm_b + branch);
  return contact;
}

TEST(TraceContacts, AreThePublishedAnswersWhereThereAreAndElseTheCertifiedOnes) {
  const Moving by_trace = crowded(Branch::trace), by_gap = crowded(Branch::follow);
  ASSERT_EQ(by_trace.list.pairs(), by_gap.list.pairs());
  std::int64_t answered = 0, unanswered = 0;
  for (std::size_t k = 0; k < by_gap.list.pairs().size(); ++k) {
    const Contact contact = by_trace.contacts.records()[k],
                  certified = by_gap.contacts.records()[k];
    ASSERT_EQ(contact.touches(), certified.touches());
    if (!contact.touches()) continue;
    TraceStatus status;
    const Contact wanted = published(by_trace, by_gap.list.pairs()[k], status);
    if (status != TraceStatus::ok) {
      ++unanswered;
      EXPECT_EQ(contact.overlap, certified.overlap);
      EXPECT_EQ(contact.normal, certified.normal);
      EXPECT_EQ(contact.arm, certified.arm);
      continue;
    }
    ++answered;
    EXPECT_NEAR(contact.overlap, wanted.overlap, 1e-13);
    EXPECT_LT((contact.normal - wanted.normal).norm(), 1e-12);
    EXPECT_LT((contact.arm - wanted.arm).norm(), 1e-12);
  }
  EXPECT_GT(answered, 50);
  EXPECT_GT(unanswered, 0) << "a crowd has pairs that the scheme does not answer";
  EXPECT_EQ(by_trace.contacts.unanswered(by_trace.particles, by_trace.cell, by_trace.list),
            unanswered);
}

TEST(TraceContacts, AreCountedInTheProfileWhereTheSchemeHasNoAnswer) {
  Moving sample = crowded(Branch::trace);
  Profile profile;
  sample.contacts.update(sample.particles, sample.cell, sample.list, laws(kLaw), 0.0, Branch::trace,
                         &profile);
  const std::int64_t unanswered =
      sample.contacts.unanswered(sample.particles, sample.cell, sample.list);
  EXPECT_GT(unanswered, 0);
  EXPECT_EQ(profile.unanswered_contacts, unanswered);
  sample.contacts.update(sample.particles, sample.cell, sample.list, laws(kLaw), 0.0,
                         Branch::follow, &profile);
  EXPECT_EQ(profile.unanswered_contacts, unanswered) << "nobody asked the scheme";
}

// The scheme has other answers for (b, a), but a contact does not have two.
TEST(TraceContacts, DoNotDependOnTheOrderOfParticlesInMemory) {
  const Moving one = crowded(Branch::trace);
  std::vector<std::uint32_t> order(one.particles.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    order[k] = static_cast<std::uint32_t>(order.size() - 1 - k);
  Moving other{one.cell, one.particles};
  other.branch = Branch::trace;
  other.particles.permute(order);
  other.update(kLaw, 0.0);
  const auto total = [](const Moving& sample) { return sample.contacts.totals(); };
  ASSERT_EQ(total(one).contacts, total(other).contacts);
  EXPECT_NEAR(total(one).overlap, total(other).overlap, 1e-11 * total(one).overlap);
  EXPECT_LT((one.contacts.sums().force_branch - other.contacts.sums().force_branch).norm(),
            1e-11 * one.contacts.sums().force_branch.norm());
}

// One particle that is none has them all measured as ellipsoids.
TEST(TraceContacts, OfSpheresAreThoseOfTheGapToRounding) {
  const auto balls = [](Branch branch) {
    const Cell cell = Cell::box({3.5, 3.6, 3.4});
    Moving made{cell, crowd(40, cell, 92)};
    for (Vec3& axes : made.particles.semi_axes) axes.setConstant(0.8 * axes[0]);
    made.particles.semi_axes[0] = {0.5, 0.4, 0.3};
    made.branch = branch;
    made.update(kLaw, 0.0);
    return made;
  };
  const Moving by_trace = balls(Branch::trace), by_gap = balls(Branch::follow);
  ASSERT_EQ(by_trace.list.pairs(), by_gap.list.pairs());
  int touching = 0;
  for (std::size_t k = 0; k < by_gap.list.pairs().size(); ++k) {
    const Pair& pair = by_gap.list.pairs()[k];
    if (pair.a == 0 || pair.b == 0 || !by_gap.contacts.touches(k)) continue;
    const Contact contact = by_trace.contacts.records()[k], wanted = by_gap.contacts.records()[k];
    EXPECT_NEAR(contact.overlap, wanted.overlap, 1e-12);
    EXPECT_LT((contact.normal - wanted.normal).norm(), 1e-10);
    EXPECT_LT((contact.arm - wanted.arm).norm(), 1e-10);
    ++touching;
  }
  EXPECT_GT(touching, 50);
}

/// Spheroids of the published shape, compacted without friction and sheared.
std::string sheared(const std::string& contacts, std::size_t count) {
  const std::string held = "mean_stress = 50e6\ntime_step_factor = 0.3\n";
  return "schema = 1\n[motion]\ncontacts = \"" + contacts +
         "\"\n[particles.grain]\ncount = " + std::to_string(count) +
         "\nmean_radius = 10.0\nelongation = 1.43\n[contact]\nnormal_stiffness = 1.5e10\n"
         "friction_coefficient = 0.5\n[[stage]]\nkind = \"place\"\n"
         "[[stage]]\nkind = \"compress\"\nfriction_coefficient = 0.0\nmax_strain_rate = 0.1\n" +
         held +
         "[[stage]]\nkind = \"relax\"\nfriction_coefficient = 0.0\nmax_strain_rate = 0.1\n"
         "max_unbalanced_ratio = 0.05\n" +
         held + "[[stage]]\nkind = \"shear\"\naxial_strain_rate = 0.02\naxial_strain = 0.03\n" +
         held;
}

constexpr std::size_t kSheared = 27;

/// At the start of the shear, by the certified answers.
const State& at_rest() {
  static const State state = at_stage(sheared("follow", kSheared), 3).state();
  return state;
}

struct Shear {
  Observation start, end;  ///< after the first cycle, and at the end
  double largest_angle = 0.0;
  Profile profile;

  explicit Shear(const std::string& contacts) {
    Simulation simulation(parse_scene(sheared(contacts, kSheared), "scene.toml"), at_rest());
    simulation.record(&profile);
    while (simulation.status() == StageStatus::running) {
      simulation.step();
      const Observation seen = simulation.observe();
      if (simulation.state().stage_cycle == 1) start = seen;
      largest_angle =
          std::max(largest_angle, friction_angle_deg(seen.stress.tensor, seen.stress.dimensions));
      end = seen;
    }
    std::cout << contacts << ": largest angle " << largest_angle << ", coordination "
              << end.coordination_number << ", porosity " << end.porosity << ", energy error "
              << end.energy_error << " of " << end.account.boundary << ", unanswered "
              << profile.unanswered_contacts << " of " << profile.touching_pairs << "\n";
  }
};

TEST(TraceContacts, OfAShearAreNearTheFollowedOnes) {
  const Shear trace("trace"), follow("follow");
  // Depths that are a little less: so the stress of one and the same sample.
  EXPECT_NE(trace.start.stress.mean(), follow.start.stress.mean());
  EXPECT_NEAR(trace.start.stress.mean(), follow.start.stress.mean(),
              0.1 * follow.start.stress.mean());
  EXPECT_NEAR(trace.largest_angle, follow.largest_angle, 2.0);
  EXPECT_NEAR(trace.end.coordination_number, follow.end.coordination_number, 0.5);
  EXPECT_NEAR(trace.end.porosity, follow.end.porosity, 0.01);
  EXPECT_LT(trace.profile.unanswered_contacts, trace.profile.touching_pairs / 100);
  EXPECT_EQ(follow.profile.unanswered_contacts, 0);
}

// A body inside another one: the scheme answers for those that overlap.
TEST(TraceContacts, WithoutAnAnswerAreInTheSummaryAndTheProfileOfARun) {
  const auto summary_of = [](const std::string& contacts) {
    const TemporaryFolder folder;
    const std::string scene = folder.write(
        "scene.toml",
        "schema = 1\n[cell]\nsize = [90.0, 90.0, 90.0]\n[motion]\ncontacts = \"" + contacts +
            "\"\n[particles.large]\ncount = 1\nmean_radius = 20.0\nelongation = 1.3\n"
            "[particles.small]\ncount = 1\nmean_radius = 5.0\nelongation = 1.4\n[contact]\n"
            "normal_stiffness = 1e10\n[[stage]]\nkind = \"place\"\narrangement = \"explicit\"\n"
            "[[body]]\ntype = \"large\"\nposition = [40.0, 40.0, 40.0]\n"
            "[[body]]\ntype = \"small\"\nposition = [42.0, 41.0, 42.0]\n"
            "[[stage]]\nkind = \"servo\"\nduration = 1\n[output]\nframe_interval = 0\n");
    const std::string out = folder.path("out");
    EXPECT_EQ(run_tool({"run", scene, "--out", out, "--quiet", "--profile"}).status, 0);
    return nlohmann::json::parse(read_file(out + "/summary.json"));
  };
  const auto trace = summary_of("trace"), follow = summary_of("follow");
  EXPECT_EQ(trace["unanswered_contacts"], 1);
  EXPECT_EQ(trace["profile"]["unanswered_contacts_a_cycle"], 1.0);
  EXPECT_EQ(trace["state_hash"], follow["state_hash"]) << "the certified answer is taken";
  EXPECT_FALSE(follow.contains("unanswered_contacts"));
  EXPECT_FALSE(follow["profile"].contains("unanswered_contacts_a_cycle"));
}

void run_cycles(Simulation& simulation, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) simulation.step();
}

Simulation dense(std::size_t count) {
  return Simulation(
      parse_scene(with(sheared("trace", count), "max_strain_rate = 0.1", "max_strain_rate = 1.0"),
                  "scene.toml"));
}

TEST(TraceContacts, HaveTheSameStateAtEveryThreadCountAndResumeBitForBit) {
  const TemporaryFolder folder;
  std::string hash[2];
  for (const int threads : {1, 2}) {
    set_threads(threads);
    Simulation simulation = dense(512);
    run_cycles(simulation, 120);
    save_state(simulation.state(), folder.path("a.state"));
    Simulation resumed(simulation.scene(), load_state(folder.path("a.state")));
    run_cycles(simulation, 60);
    run_cycles(resumed, 60);
    ASSERT_GT(simulation.observe().contacts, 400);
    hash[threads - 1] = state_hash(simulation.state());
    EXPECT_EQ(state_hash(resumed.state()), hash[threads - 1]);
  }
  set_threads(0);
  EXPECT_EQ(hash[0], hash[1]);
}

}  // namespace
