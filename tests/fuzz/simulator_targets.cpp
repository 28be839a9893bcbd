// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/contact/thin_cell.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/saved/stream_hash.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/history.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/tests/dem/scenes.hpp>
#include <tangency/tests/fuzz/memory_file.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/target.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::testing::fuzz {
namespace {

using namespace dem;

/// A refusal: one line that names its file.
void require_message(const std::string& text, const std::string& target, const std::string& file) {
  const bool is_line = std::none_of(
      text.begin(), text.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); });
  require(is_line && text.starts_with(file), target, "a refusal: " + text);
  count("refused");
}

/// One cycle, and what a run is told when it cannot go on.
void step(Simulation& simulation) {
  try {
    if (!simulation.finished()) simulation.step();
    count("stepped");
  } catch (const Diverged&) {
    count("diverged");
  } catch (const CellTooThin&) {
    count("cell too thin");
  } catch (const DoesNotFit&) {
    count("does not fit");
  }
}

void run_scene(Bytes input) {
  constexpr std::size_t kMostParticles = 200;
  const std::string text(input.begin(), input.end()), name = "scene.toml";
  try {
    const Scene scene = parse_scene(text, name);
    const bool has_file = !scene.stages.front().place->file.empty();
    if (has_file || scene.particle_count() > kMostParticles) return count("not run");
    Simulation simulation(scene);
    simulation.observe();
    step(simulation);
    count("ran");
  } catch (const SceneError& error) {
    require_message(error.what(), "scene", name);
  } catch (const DoesNotFit&) {
    count("does not fit");
  } catch (const CellTooThin&) {
    count("cell too thin");
  }
}

std::vector<std::string> scene_seeds() {
  std::vector<std::string> seeds{small_scene(), growing_scene(2), growing_scene(3)};
  for (const char* name : {"assembly-27", "assembly-125", "impact", "settle-1000", "slope",
                           "growth-1000", "unload-1000"}) {
    std::string text = source_file("dem/scenes/" + std::string(name) + ".toml");
    // As few particles as a fuzzer has time for.
    for (const std::string_view many : {"count = 1000", "count = 500", "count = 125"}) {
      for (std::size_t at = text.find(many); at != std::string::npos; at = text.find(many))
        text.replace(at, many.size(), "count = 8");
    }
    seeds.push_back(text);
  }
  return seeds;
}

/// The state of a small scene in the middle of its compression, with contacts that carry shear.
const std::string& state_bytes() {
  static const std::string bytes = [] {
    Simulation simulation(parse_scene(small_scene(), "scene.toml"));
    while (simulation.status() == StageStatus::running && simulation.observe().contacts < 40)
      simulation.step();
    const TemporaryFolder folder;
    save_state(simulation.state(), folder.path("a.state"));
    return read_whole(folder.path("a.state")).value();
  }();
  return bytes;
}

constexpr std::size_t kHead = 12, kHash = sizeof(std::uint64_t);

/// The hash of a state's bytes where the file has it.
std::uint64_t hash_in(Bytes file) {
  std::uint64_t hash = 0;
  std::memcpy(&hash, file.data() + file.size() - kHash, kHash);
  return hash;
}

std::uint64_t right_hash(Bytes file) {
  StreamHash hash;
  hash.add(file.data() + kHead, file.size() - kHead - kHash);
  return hash.value();
}

/// Any bytes as a state: refused, or a state whose hash is that of the bytes, which goes on or is
/// told why not.
void run_state(Bytes input) {
  static const Scene scene = parse_scene(small_scene(), "scene.toml");
  static MemoryFile file;
  file.set(input);
  try {
    State state = load_state(file.path());
    // Of version 6, which may hold what version 5 would: then it has another one when written.
    const bool is_plain = input[8] == 5;
    require(!is_plain || std::stoull(state_hash(state), nullptr, 16) == hash_in(input), "state",
            "a state with another hash than its bytes");
    count("read");
    Simulation simulation(scene, std::move(state));
    step(simulation);
  } catch (const StateError& error) {
    require_message(error.what(), "state", file.path());
  } catch (const std::invalid_argument&) {
    count("of another scene");
  } catch (const CellTooThin&) {
    count("cell too thin");
  }
}

/// Every other time with the right hash behind it, so that what is read matters.
std::size_t mutate_state(std::uint8_t* data, std::size_t size, std::size_t most,
                         std::uint64_t seed) {
  std::uint64_t state = seed;
  const std::size_t changed = mutate_bytes(data, size, most, next(state));
  if (changed < kHead + kHash || below(state, 2) == 0) return changed;
  const std::uint64_t hash = right_hash({data, changed});
  std::memcpy(data + changed - kHash, &hash, kHash);
  return changed;
}

/// Changes of a good file: each a place of four bytes and what is added to the byte there; an
/// odd number of bytes cuts the file there. Whatever changes it is found.
void run_state_changes(Bytes input) {
  static MemoryFile file;
  constexpr std::size_t kChange = 5;
  const std::string& good = state_bytes();
  std::string bytes = good;
  for (std::size_t at = 0; at + kChange <= input.size(); at += kChange) {
    std::uint32_t place = 0;
    std::memcpy(&place, input.data() + at, sizeof place);
    char& byte = bytes[place % bytes.size()];
    byte = static_cast<char>(byte + input[at + sizeof place]);
  }
  if (input.size() % kChange == 3)
    bytes.resize((std::size_t{input.back()} << 8 | input.front()) % bytes.size());
  file.set({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  bool is_read = false;
  try {
    load_state(file.path());
    is_read = true;
  } catch (const StateError& error) {
    require_message(error.what(), "state-changes", file.path());
  }
  require(is_read == (bytes == good), "state-changes", "a change that is not found");
  count(is_read ? "unchanged" : "changes found");
}

/// One to three changes, or a place to cut.
std::size_t mutate_changes(std::uint8_t* data, std::size_t, std::size_t, std::uint64_t seed) {
  std::uint64_t state = seed;
  const std::size_t size = below(state, 8) == 0 ? 3 : 5 * (1 + below(state, 3));
  for (std::size_t k = 0; k < size; ++k) data[k] = static_cast<std::uint8_t>(next(state));
  return size;
}

std::vector<std::string> change_seeds() {
  std::vector<std::string> seeds;
  for (const std::uint32_t place : {0U, 8U, 12U, 20U, 1000U, 4294967295U}) {
    std::string& seed = seeds.emplace_back(sizeof place, '\0');
    std::memcpy(seed.data(), &place, sizeof place);
    seed += '\x01';
  }
  seeds.emplace_back("cut");
  return seeds;
}

void run_history(Bytes input) {
  static MemoryFile file;
  file.set(input);
  try {
    const History history(file.path());
    const std::vector<StageRows> stages = stages_of(history);
    std::size_t rows = 0;
    for (const StageRows& stage : stages) {
      require(stage.first == rows && stage.end > stage.first, "history", "rows of a stage");
      rows = stage.end;
      require(peaks_of_stage(history, stage.name).has_value(), "history", "peaks of a stage");
    }
    require(rows == history.size(), "history", "rows in no stage");
    count("read");
  } catch (const tables::Error& error) {
    require_message(error.what(), "history", file.path());
  }
}

std::vector<std::string> history_seeds() {
  std::string header, row, other;
  for (const Field& field : history_fields(0, 0.0, "", 0, Observation{})) {
    header += (header.empty() ? "" : ",") + std::string(field.name);
    const bool is_stage = std::string_view(field.name) == "stage";
    row += std::string(row.empty() ? "" : ",") + (is_stage ? "shear" : "0.5");
    other += std::string(other.empty() ? "" : ",") + (is_stage ? "shear" : "-1.25");
  }
  return {header + '\n' + row + '\n' + other + '\n' + row + '\n', header + '\n'};
}

}  // namespace

std::vector<Target> simulator_targets() {
  constexpr std::size_t kText = 4096, kState = std::size_t{1} << 17, kChanges = 64;
  return {{"scene", "any text as a scene: refused, or it runs", kText, scene_seeds, run_scene,
           mutate_text},
          {"state", "any bytes as a state: refused, or it goes on", kState,
           [] { return std::vector{state_bytes()}; }, run_state, mutate_state},
          {"state-changes", "any change of the bytes of a state is found", kChanges, change_seeds,
           run_state_changes, mutate_changes},
          {"history", "any text as history.csv", kText, history_seeds, run_history, mutate_text}};
}

}  // namespace tangency::testing::fuzz
