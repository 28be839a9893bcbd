// SPDX-License-Identifier: GPL-3.0-or-later
/// States that are broken on purpose, and what `--verify` says of them.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/verification.hpp>

#include "../dem/scenes.hpp"
#include "../tool/process.hpp"

namespace tangency::testing {
namespace {

using dem::ContactColumns;
using dem::Pair;
using dem::Simulation;
using dem::State;
using dem::Verification;
using dem::VerificationFault;

dem::Scene scene_of(const std::string& text) { return dem::parse_scene(text, "scene.toml"); }

/// In the middle of its compression, with contacts that carry shear.
Simulation squeezed(const std::string& text = small_scene()) {
  Simulation running(scene_of(text));
  while (running.status() == dem::StageStatus::running && running.observe().contacts < 40)
    running.step();
  return running;
}

/// What a verification says of a simulation; "" where it finds nothing.
std::string fault_in(const Simulation& simulation, Verification& verification) {
  try {
    verification.check(simulation);
    verification.recount(simulation, true);
  } catch (const VerificationFault& fault) {
    return fault.what();
  }
  return "";
}
std::string fault_in(const Simulation& simulation) {
  Verification verification;
  return fault_in(simulation, verification);
}

/// Its contacts changed.
Simulation with_contacts(const Simulation& simulation,
                         const std::function<void(ContactColumns&, const State&)>& change) {
  State state = simulation.state();
  ContactColumns columns = state.contacts.columns();
  change(columns, state);
  state.contacts.restore(std::move(columns), state.particles, state.list);
  return {simulation.scene(), std::move(state)};
}

/// The first pair that touches, but for walls, and whose depth has its turn in the check.
std::size_t touching_pair(const State& state) {
  for (std::size_t k = 0; k < state.contacts.size(); ++k)
    if (state.contacts.touches(k) &&
        (static_cast<std::int64_t>(k) + state.cycle) % dem::ContactCheck::kDepthTurns == 0)
      return k;
  ADD_FAILURE() << "no contact whose turn it is";
  return 0;
}
std::size_t pair_apart(const State& state) {
  std::size_t k = 0;
  while (state.contacts.touches(k)) ++k;
  return k;
}

/// "particles 3 and 8, ..." as messages name a pair.
std::string name_of(const State& state, std::size_t k) {
  const Pair& pair = state.list.pairs()[k];
  const auto id = [&](std::int32_t i) {
    return std::to_string(state.particles.id[static_cast<std::size_t>(i)]);
  };
  const auto& [x, y, z] = pair.image;
  return "particles " + id(pair.a) + " and " + id(pair.b) + ", image (" + std::to_string(x) + ", " +
         std::to_string(y) + ", " + std::to_string(z) + "): ";
}

void expect_within(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), text.npos) << text << "\nhas no\n" << part;
}

/// Every scene of tests that is short and whose bodies are of another kind.
std::vector<std::string> scenes_of_all_kinds() {
  const std::string plane = growing_scene(2), space = growing_scene(3);
  const std::string spheres = with(small_scene(), "elongation = 1.4", "elongation = 1.0");
  const std::string walls = with(small_scene(), "[cell]\n", "[cell]\nwalls = \"xz\"\n");
  const std::string hertz = with(small_scene(), "normal_stiffness = 1.5e10\n",
                                 "law = \"hertz\"\nyoung_modulus = 1.5e9\npoisson_ratio = 0.3\n");
  return {small_scene(), plane, space, spheres, walls, hertz};
}

// dem/verification.hpp (1)
TEST(Verification, FindsNothingInSoundRunsOfAllKindsOfBodiesAndChangesNothing) {
  for (const std::string& text : scenes_of_all_kinds()) {
    Simulation plain(scene_of(text)), checked(scene_of(text));
    Verification verification;
    for (int k = 0; k < 1500; ++k) {
      for (Simulation* each : {&plain, &checked}) {
        if (each->finished()) continue;
        each->step();
        if (each->status() == dem::StageStatus::done) each->next_stage();
      }
      ASSERT_EQ(fault_in(checked, verification), "") << text;
    }
    EXPECT_EQ(dem::state_hash(checked.state()), dem::state_hash(plain.state()));
    const dem::Verified& found = verification.verified();
    EXPECT_GT(found.pairs.contacts, 1000) << text;
    EXPECT_GT(found.pairs.apart, 100);
    EXPECT_GT(found.pairs.searched, 1000);
    EXPECT_EQ(found.pairs.wrong + found.pairs.missed, 0);
  }
}

TEST(Verification, FindsAContactThatTheRunDoesNotHave) {
  const Simulation sound = squeezed();
  const std::size_t k = touching_pair(sound.state());
  const std::string fault = fault_in(with_contacts(
      sound, [k](ContactColumns& columns, const State&) { columns.overlap[k] = 0.0; }));
  expect_within("cycle " + std::to_string(sound.state().cycle) + ": " + name_of(sound.state(), k) +
                    "the run has no contact; exactly, the interiors meet, gap -",
                fault);
}

TEST(Verification, FindsAContactThatIsNone) {
  const Simulation sound = squeezed();
  const std::size_t k = pair_apart(sound.state());
  const std::string fault = fault_in(with_contacts(
      sound, [k](ContactColumns& columns, const State&) { columns.overlap[k] = 0.25; }));
  expect_within(
      name_of(sound.state(), k) + "the run has a contact, overlap 0.25; exactly, no interiors meet",
      fault);
}

TEST(Verification, FindsAnOverlapThatIsTooSmallOrTooLargeOrAlongAnotherNormal) {
  const Simulation sound = squeezed();
  const std::size_t k = touching_pair(sound.state());
  const auto fault = [&](const std::function<void(ContactColumns&, const State&)>& change) {
    return fault_in(with_contacts(sound, change));
  };
  const std::string claim = name_of(sound.state(), k) + "the run has an overlap of ";
  const std::string less =
      fault([k](ContactColumns& columns, const State&) { columns.overlap[k] *= 1.0 - 1e-9; });
  expect_within(claim, less);
  expect_within("exactly, the two still meet after a move by it", less);
  const std::string more =
      fault([k](ContactColumns& columns, const State&) { columns.overlap[k] *= 1.0 + 1e-9; });
  expect_within("exactly, they part earlier; along it they are ", more);
  const std::string turned = fault([k](ContactColumns& columns, const State&) {
    columns.normal[k] =
        (columns.normal[k] + 1e-2 * columns.normal[k].unitOrthogonal()).normalized();
  });
  expect_within("exactly, the two still meet after a move by it", turned);
  expect_within("the run has the centres ", fault([k](ContactColumns& columns, const State&) {
                  columns.branch[k] *= 1.0 + 1e-9;
                }));
}

/// Without any neighbours, and with skins that never wear out, so that none is looked for again.
State without_neighbours(const Simulation& simulation) {
  State state = simulation.state();
  dem::NeighbourList::Reference reference = state.list.reference();
  for (double& skin : reference.skin) skin = 1e9;
  state.contacts.carry_over(state.list.pairs(), {});
  state.list.restore(std::move(reference), {});
  state.contacts.add_up(state.particles, state.list);
  return state;
}

TEST(Verification, FindsAPairThatIsNotListed) {
  const Simulation sound = squeezed();
  const Simulation blind(sound.scene(), without_neighbours(sound));
  expect_within("the run does not list them as neighbours; exactly, the interiors meet, gap -",
                fault_in(blind));
}

TEST(Verification, FindsAWallThatIsNotListed) {
  Simulation sound(scene_of(with(small_scene(), "[cell]\n", "[cell]\nwalls = \"xz\"\n")));
  // The body that touches a wall first.
  const auto at_a_wall = [&]() -> std::optional<std::int32_t> {
    const State& state = sound.state();
    for (std::size_t k = 0; k < state.contacts.size(); ++k)
      if (const Pair& pair = state.list.pairs()[k];
          state.contacts.touches(k) && static_cast<std::size_t>(pair.b) >= state.particles.size())
        return pair.a;
    return std::nullopt;
  };
  while (!at_a_wall()) sound.step();
  State state = sound.state();
  const std::vector<Pair> before = state.list.pairs();
  std::vector<Pair> without;
  for (const Pair& pair : before)
    if (static_cast<std::size_t>(pair.b) < state.particles.size()) without.push_back(pair);
  state.contacts.carry_over(before, without);
  state.list.restore(dem::NeighbourList::Reference(state.list.reference()), without);
  state.contacts.add_up(state.particles, state.list);
  // Its turn to have its neighbours looked for.
  state.cycle = *at_a_wall() / static_cast<std::int32_t>(Verification::kSearchedBodies);
  const std::string fault = fault_in(Simulation(sound.scene(), std::move(state)));
  expect_within(" and wall ", fault);
  expect_within("the run does not list them as neighbours", fault);
}

TEST(Verification, FindsForcesThatAreNotThoseOfTheLaw) {
  const Simulation sound = squeezed();
  const std::size_t k = touching_pair(sound.state()), apart = pair_apart(sound.state());
  expect_within("; stiffness times overlap is ",
                fault_in(with_contacts(sound, [k](ContactColumns& columns, const State&) {
                  columns.normal_force[k] *= 1.0 + 1e-6;
                })));
  expect_within("; friction bears at most ",
                fault_in(with_contacts(sound, [k](ContactColumns& columns, const State&) {
                  columns.shear_force[k] =
                      0.51 * columns.normal_force[k] * columns.normal[k].unitOrthogonal();
                })));
  expect_within(" apart with a force of ",
                fault_in(with_contacts(sound, [apart](ContactColumns& columns, const State&) {
                  columns.shear_force[apart] = Vec3::UnitX();
                })));
}

TEST(Verification, FindsEnergyThatCameFromNowhere) {
  const Simulation sound = squeezed();
  State state = sound.state();
  state.energy.damping += 0.5 * state.energy.boundary;
  expect_within("the run has an energy error of ",
                fault_in(Simulation(sound.scene(), std::move(state))));
}

// dem/verification.hpp (2)
TEST(Verification, SaysTheSameAtEveryNumberOfThreads) {
  const std::string text = with(small_scene(), "count = 27", "count = 729");
  const Simulation sound(scene_of(text));
  State broken = sound.state();
  broken.cell.edges *= 0.8;  // many overlap then, that the state has apart
  const Simulation simulation(sound.scene(), std::move(broken));
  std::vector<std::string> said;
  for (const int threads : {1, 2, 3}) {
    dem::set_threads(threads);
    Verification verification;
    said.push_back(fault_in(simulation, verification) + dem::text_of(verification.verified()));
  }
  dem::set_threads(0);
  EXPECT_EQ(said[0], said[1]);
  EXPECT_EQ(said[0], said[2]);
  expect_within("exactly, the interiors meet", said[0]);
}

TEST(VerifiedRun, SaysWhatItChecked) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene()), out = folder.path("out");
  const Finished run = run_tool({"run", scene, "--out", out, "--quiet", "--verify"});
  EXPECT_EQ(run.status, 0) << run.err;
  expect_within("tangency-dem: verified ", run.err);
  expect_within(" contacts certified, 0 wrong, 0 missed; ", run.err);
  const std::string summary = read_file(out + "/summary.json");
  expect_within("\"verified\": {\n    \"states\": ", summary);
  expect_within("\"wrong\": 0,\n    \"missed\": 0,", summary);
}

TEST(VerifiedRun, CountsAgainAtEachRowAlsoAtTheEndOfAStage) {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("scene.toml", small_scene() + "history_interval = 1000000\n");
  const std::string out = folder.path("out");
  const Finished run = run_tool({"run", scene, "--out", out, "--quiet", "--verify"});
  EXPECT_EQ(run.status, 0) << run.err;
  // The start, and the ends of two stages.
  expect_within("\"recounts\": 3,", read_file(out + "/summary.json"));
}

TEST(VerifiedRun, EndsAtAFaultWithTheStatus3AndLeavesWhatWasSaved) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene() + "checkpoint_interval = 1\n");
  const std::string out = folder.path("out"), state = folder.path("blind.state");
  // Before the first contact: its check finds nothing yet, and the run never looks for neighbours.
  dem::save_state(without_neighbours(Simulation(scene_of(small_scene()))), state);
  const Finished run =
      run_tool({"run", scene, "--out", out, "--quiet", "--verify", "--resume", state});
  EXPECT_EQ(run.status, 3) << run.err;
  expect_within("tangency-dem: fault: cycle ", run.err);
  expect_within("the run does not list them as neighbours; exactly, the interiors meet, gap -",
                run.err);
  expect_within("the state is in " + out + "/fault.state", run.err);
  expect_within(" 0 wrong, 1 missed; ", run.err);
  const std::int64_t cycle = dem::load_state(out + "/fault.state").cycle;
  EXPECT_GT(cycle, 1);
  EXPECT_EQ(dem::load_state(out + "/checkpoint.state").cycle, cycle - 1);
  EXPECT_FALSE(std::filesystem::exists(out + "/final.state"));
  // Without --verify nobody notices.
  const std::string plain = folder.write("plain.toml", small_scene());
  const Finished blind =
      run_tool({"run", plain, "--out", folder.path("blind"), "--quiet", "--resume", state});
  EXPECT_NE(blind.status, 3);
  EXPECT_EQ(blind.err.find("fault"), blind.err.npos) << blind.err;
}

TEST(VerifiedRun, OfAStateThatIsWrongTouchesNothing) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", small_scene());
  const std::string state = folder.path("wrong.state");
  const Simulation sound = squeezed();
  const std::size_t k = touching_pair(sound.state());
  dem::save_state(
      with_contacts(sound, [k](ContactColumns& columns, const State&) { columns.overlap[k] = 0.0; })
          .state(),
      state);
  const Finished run = run_tool(
      {"run", scene, "--out", folder.path("out"), "--quiet", "--verify", "--resume", state});
  EXPECT_EQ(run.status, 3);
  expect_within("tangency-dem: fault before the first cycle: cycle ", run.err);
  expect_within("; nothing was written\n", run.err);
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
}

}  // namespace
}  // namespace tangency::testing
