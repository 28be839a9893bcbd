// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/saved/stream_hash.hpp>
#include <tangency/dem/whole_file.hpp>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::testing::small_scene;
using tangency::testing::TemporaryFolder;
using tangency::testing::with;

/// A run in the middle of its compression, with contacts that carry shear.
const Simulation& half_way() {
  static const Simulation simulation = [] {
    Simulation running(parse_scene(small_scene(), "scene.toml"));
    while (running.status() == StageStatus::running && running.observe().contacts < 40)
      running.step();
    return running;
  }();
  return simulation;
}

std::string failure(const std::filesystem::path& file) {
  try {
    load_state(file);
  } catch (const StateError& error) {
    return error.what();
  }
  return "";
}

TEST(StateFile, ReadsBackToTheSameState) {
  const TemporaryFolder folder;
  const State& state = half_way().state();
  save_state(state, folder.path("a.state"));
  const State read = load_state(folder.path("a.state"));
  EXPECT_EQ(state_hash(read), state_hash(state));
  EXPECT_EQ(read.particles.position, state.particles.position);
  EXPECT_EQ(read.particles.angular_velocity, state.particles.angular_velocity);
  EXPECT_EQ(read.list.pairs(), state.list.pairs());
  EXPECT_EQ(read.contacts.resultants().force, state.contacts.resultants().force);
  EXPECT_EQ(read.cycle, state.cycle);
}

/// Columns of more than one slice, which pass by their own way.
const Simulation& large() {
  static const Simulation simulation(
      parse_scene("schema = 1\n[cell]\n[particles.grain]\ncount = 24000\nmean_radius = 1.0\n"
                  "[contact]\nnormal_stiffness = 1e6\n[[stage]]\nkind = \"place\"\n"
                  "[[stage]]\nkind = \"compress\"\nmean_stress = 1e3\nmax_strain_rate = 0.01\n",
                  "large.toml"));
  return simulation;
}

TEST(StateFile, OfManySlicesReadsBackToTheSameStateAlsoFromAPipe) {
  const TemporaryFolder folder;
  const State& state = large().state();
  ASSERT_GT(state.particles.size() * sizeof(tangency::Vec3), std::size_t{1} << 19);
  const std::string file = folder.path("a.state"),
                    pipe = tangency::testing::make_pipe(folder.path("p"));
  save_state(state, file);
  const State read = load_state(file);
  EXPECT_EQ(state_hash(read), state_hash(state));
  EXPECT_EQ(read.particles.position, state.particles.position);
  EXPECT_EQ(read.particles.id, state.particles.id);

  const std::string bytes = read_whole(file).value();
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
  EXPECT_EQ(state_hash(load_state(pipe)), state_hash(state));
  writer.join();
}

// The hash of the file is that of the state, and of its bytes alone.
TEST(StateFile, EndsWithTheHashOfItsBytes) {
  const TemporaryFolder folder;
  for (const Simulation* simulation : {&half_way(), &large()}) {
    save_state(simulation->state(), folder.path("a.state"));
    const std::string bytes = read_whole(folder.path("a.state")).value();
    StreamHash hash;
    for (std::size_t at = 12; at < bytes.size() - 8; at += 1000)
      hash.add(bytes.data() + at, std::min<std::size_t>(1000, bytes.size() - 8 - at));
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes.data() + bytes.size() - 8, 8);
    EXPECT_EQ(stored, hash.value());
    EXPECT_EQ(std::stoull(state_hash(simulation->state()), nullptr, 16), stored);
  }
}

// As `xxhsum -H3` prints them.
TEST(StreamHash, IsXxh3) {
  EXPECT_EQ(StreamHash().value(), 0x2d06800538d394c2u);
  StreamHash hash;
  hash.add("xxhash", 6);
  EXPECT_EQ(hash.value(), 0xaa4c2b42ae6b13deu);
}

TEST(StateFile, WithATailOrADamageAnywhereIsRefused) {
  const TemporaryFolder folder;
  save_state(half_way().state(), folder.path("a.state"));
  const std::string bytes = read_whole(folder.path("a.state")).value();
  const auto refusal = [&](const std::string& changed) {
    const std::string file = folder.write("c.state", changed), why = failure(file);
    return why.starts_with(file + ": ") ? why.substr(file.size() + 2) : "";
  };
  // Lengths of columns, whatever they say, as well as numbers.
  for (std::size_t at = 12; at < bytes.size(); at += 1 + at % 97) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (at % 2 == 0 ? 0x80 : 0x01));
    ASSERT_EQ(refusal(changed), "damaged: its hash is wrong") << "byte " << at;
  }
  for (const std::size_t size :
       {std::size_t{12}, std::size_t{19}, std::size_t{20}, bytes.size() - 8, bytes.size() - 1})
    EXPECT_EQ(refusal(bytes.substr(0, size)), "damaged: its hash is wrong") << size;
  EXPECT_EQ(refusal(bytes + "12345678"), "damaged: its hash is wrong");
  // One with the right hash and more than a state in it.
  std::string more = bytes.substr(0, bytes.size() - 8) + std::string(9, '\0');
  StreamHash hash;
  hash.add(more.data() + 12, more.size() - 12);
  const std::uint64_t value = hash.value();
  more.append(reinterpret_cast<const char*>(&value), sizeof value);
  EXPECT_EQ(refusal(more), "damaged: it is not a whole state");
}

TEST(StateFile, HashSeesTheLastBitOfAnyNumber) {
  State state = half_way().state();
  const std::string before = state_hash(state);
  double& number = state.particles.angular_velocity.back()[2];
  number = std::nextafter(number, 1.0);
  EXPECT_NE(state_hash(state), before);
  EXPECT_EQ(before.size(), 16u);
}

TEST(StateFile, OfAnotherVersionDamagedOrOfAnotherKindIsRefused) {
  const TemporaryFolder folder;
  save_state(half_way().state(), folder.path("a.state"));
  const std::string bytes = read_whole(folder.path("a.state")).value();
  std::string changed = bytes;
  changed[8] = 3;
  EXPECT_EQ(failure(folder.write("v.state", changed)),
            folder.path("v.state") + ": state of version 3: this program reads version 5, 7 or 8");
  changed = bytes;
  changed[bytes.size() / 2] ^= 1;
  EXPECT_EQ(failure(folder.write("d.state", changed)),
            folder.path("d.state") + ": damaged: its hash is wrong");
  EXPECT_EQ(failure(folder.write("s.state", bytes.substr(0, bytes.size() / 3))),
            folder.path("s.state") + ": damaged: its hash is wrong");
  const std::string none = ": no state of tangency-dem: final.state or checkpoint.state of a run";
  EXPECT_EQ(failure(folder.write("t.state", small_scene())), folder.path("t.state") + none);
  EXPECT_EQ(failure(folder.write("e.state", "")), folder.path("e.state") + none);
  EXPECT_EQ(failure(folder.path("missing.state")),
            folder.path("missing.state") + ": cannot be read: No such file or directory");
}

TEST(StateFile, OfAnotherSceneIsRefused) {
  const std::string more = with(small_scene(), "count = 27", "count = 28");
  EXPECT_THROW(Simulation(parse_scene(more, "scene.toml"), half_way().state()),
               std::invalid_argument);
}

TEST(StateFile, OfOtherParticlesIsRefusedWithWhatDiffers) {
  const auto refusal = [](const std::string& before, const std::string& after) -> std::string {
    try {
      Simulation(parse_scene(with(small_scene(), before, after), "scene.toml"), half_way().state());
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const std::string state = "a state with particles.grain.";
  EXPECT_EQ(refusal("radius = 10.0", "radius = 10.1"),
            state + "mean_radius = 10; the scene has 10.1");
  EXPECT_EQ(refusal("elongation = 1.4", "elongation = 1.5"),
            state + "elongation = 1.4; the scene has 1.5");
  EXPECT_EQ(refusal("elongation = 1.4", "elongation = 1.4\nflatness = 1.2"),
            state + "flatness = 1; the scene has 1.2");
  EXPECT_EQ(refusal("count = 27", "density = 1001.0\ncount = 27"),
            state + "density = 1000; the scene has 1001");
  EXPECT_EQ(refusal("count = 27", "count = 28"), state + "count = 27; the scene has 28");
  EXPECT_EQ(refusal("count = 27\nmean_radius = 10.0\nelongation = 1.4\n",
                    "count = 26\nmean_radius = 10.0\nelongation = 1.4\n"
                    "[particles.other]\ncount = 1\nmean_radius = 10.0\nelongation = 1.4\n"),
            state + "count = 27; the scene has 26");
  EXPECT_EQ(refusal("friction_coefficient = 0.5", "friction_coefficient = 0.4"), "");
}

TEST(StateFile, WithAnImpossibleNumberIsRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.path("a.state");
  const auto refusal = [&](auto&& change) {
    State state = half_way().state();
    change(state);
    save_state(state, file);
    return failure(file);
  };
  const std::string damaged = file + ": damaged: it holds a ";
  EXPECT_EQ(refusal([](State& s) { s.stage = 0; }),
            file + ": damaged: its stage is 0, and a run's are counted from 1");
  EXPECT_EQ(refusal([](State& s) { s.particles.velocity[3][1] = NAN; }),
            damaged + "number that is not finite");
  EXPECT_EQ(refusal([](State& s) { s.time = INFINITY; }), damaged + "number that is not finite");
  EXPECT_EQ(refusal([](State& s) { s.particles.semi_axes[3][1] = 0.0; }),
            damaged + "length that is not > 0");
  EXPECT_EQ(refusal([](State& s) { s.cell.edges(2, 2) = -1.0; }),
            damaged + "length that is not > 0");
  EXPECT_EQ(refusal([](State& s) { s.particles.mass[0] = 0.0; }), damaged + "mass that is not > 0");
}

TEST(StateFile, AfterTheLastStageOfItsSceneIsRefused) {
  State state = half_way().state();
  state.stage = 4;
  EXPECT_THROW(Simulation(parse_scene(small_scene(), "scene.toml"), state), std::invalid_argument);
}

TEST(StateFile, ThatCannotBeWrittenLeavesTheOldOneAndNothingElse) {
  const TemporaryFolder folder;
  // A directory in the file's place: the rename fails after all has been written.
  std::filesystem::create_directory(folder.path("a.state"));
  EXPECT_THROW(save_state(half_way().state(), folder.path("a.state")), std::runtime_error);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.state"});
}

}  // namespace
