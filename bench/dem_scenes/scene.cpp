// SPDX-License-Identifier: GPL-3.0-or-later
// One scene, timed in blocks of cycles that bench/dem_scenes/measure asks for by turns:
//
//     printf 'cycles 100\ncycles 100\n' | bench_dem_scene scene.toml
//
// All stages but the last are run to their ends, untimed. Then one line of JSON says what came of
// that, and each command, a line of standard input, is answered by another one. Between two blocks
// the program waits and takes no processor time, so that several of them can be timed by turns.
#include <fcntl.h>
#include <hwy/targets.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/parallel.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/body_table.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/vectors.hpp>

namespace {

using namespace tangency::dem;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kHelp = R"(
Commands, a line of standard input each:
  cycles N          runs N cycles of the last stage: processor and clock time, pairs, stress
  checkpoint FILE   saves the state in FILE, and then writes as many plain bytes there instead:
                    clock times of both
  hash              of the state
)";

/// Seconds of processor time of all threads, and on the clock.
struct Times {
  double cpu, wall;
};

Times now() {
  timespec cpu{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec),
          std::chrono::duration<double>(wall).count()};
}

void put_times_since(Json& answer, const Times& start) {
  const Times end = now();
  answer["cpu_seconds"] = end.cpu - start.cpu;
  answer["wall_seconds"] = end.wall - start.wall;
}

/// Of this process so far, in bytes.
std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{1024} * usage.ru_maxrss;
}

void put_assembly(Json& answer, const Simulation& simulation) {
  const Observation seen = simulation.observe();
  answer["particles"] = simulation.state().particles.size();
  answer["listed"] = simulation.state().list.pairs().size();
  answer["touching"] = seen.contacts;
  answer["mean_stress"] = seen.stress.mean();
  answer["mean_overlap"] = seen.mean_overlap;
  answer["porosity"] = seen.porosity;
}

double largest_radius(const Particles& particles) {
  double largest = 0.0;
  for (const tangency::Vec3& axes : particles.semi_axes)
    largest = std::max(largest, axes.maxCoeff());
  return largest;
}

/// "AVX3" and its variants are called avx512, as processors are.
std::string name_of_level(std::int64_t level) {
  std::string name = hwy::TargetName(level);
  if (name.starts_with("AVX3")) name.replace(0, 4, "avx512");
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// @throws std::runtime_error  where this machine or this build has no such level
void use_level(const std::string& wanted) {
  std::string all;
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    const std::string name = name_of_level(level);
    if (name == wanted || (wanted == "avx512" && name.starts_with(wanted))) {
      tangency::bench::force_level(level);
      return;
    }
    all += (all.empty() ? "" : ", ") + name;
  }
  throw std::runtime_error("--level " + wanted + ": this machine and build have " + all);
}

void run_cycle(Simulation& simulation) {
  if (simulation.status() != StageStatus::running)
    throw std::runtime_error("stage " + simulation.stage().name + " is over in cycle " +
                             std::to_string(simulation.state().cycle));
  simulation.step();
}

Json timed_cycles(Simulation& simulation, std::int64_t count) {
  Json answer;
  answer["cycles"] = count;
  double pair_cycles = 0.0;
  const Times start = now();
  for (std::int64_t k = 0; k < count; ++k) {
    run_cycle(simulation);
    pair_cycles += static_cast<double>(simulation.state().list.pairs().size());
  }
  put_times_since(answer, start);
  answer["pair_cycles"] = pair_cycles;
  put_assembly(answer, simulation);
  answer["peak_bytes"] = peak_memory();
  return answer;
}

/// As many bytes of one value, by calls of a mebibyte.
void write_plainly(const fs::path& file, std::uintmax_t bytes) {
  const std::vector<char> block(std::size_t{1} << 20, 'x');
  const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  bool good = out >= 0;
  while (good && bytes > 0) {
    const auto part = static_cast<std::size_t>(std::min<std::uintmax_t>(bytes, block.size()));
    const ssize_t written = ::write(out, block.data(), part);
    good = written > 0;
    if (good) bytes -= static_cast<std::uintmax_t>(written);
  }
  if (out >= 0) good = ::close(out) == 0 && good;
  if (!good) throw std::runtime_error(file.string() + ": cannot be written");
}

Json checkpoint(const Simulation& simulation, const fs::path& file) {
  Json answer;
  const Times start = now();
  save_state(simulation.state(), file);
  put_times_since(answer, start);
  const std::uintmax_t bytes = fs::file_size(file);
  answer["bytes"] = bytes;
  fs::remove(file);
  const Times plain = now();
  write_plainly(file, bytes);
  put_times_since(answer["plain"], plain);
  fs::remove(file);
  answer["peak_bytes"] = peak_memory();
  return answer;
}

Json answer_to(const std::string& line, Simulation& simulation) {
  std::istringstream words(line);
  std::string command, file;
  std::int64_t count = 0;
  words >> command;
  if (command == "cycles" && words >> count && count > 0) return timed_cycles(simulation, count);
  if (command == "checkpoint" && words >> file) return checkpoint(simulation, file);
  if (command == "hash") return {{"state_hash", state_hash(simulation.state())}};
  throw std::runtime_error(line + ": allowed are cycles N, checkpoint FILE and hash");
}

/// Runs all stages but the last to their ends.
void run_up(Simulation& simulation) {
  while (simulation.state().stage + 1 < simulation.scene().stages.size()) {
    if (simulation.status() == StageStatus::done)
      simulation.next_stage();
    else
      run_cycle(simulation);
  }
}

int run(const fs::path& file, const std::string& level, int threads) {
  if (!level.empty()) use_level(level);
  if (threads > 0) set_threads(threads);
  Json ready;
  const Times start = now();
  const SceneFile source(file);
  Scene scene = source.scene();
  read_bodies(scene, source, file);
  Simulation simulation(scene);
  put_times_since(ready["set_up"], start);
  ready["set_up"]["peak_bytes"] = peak_memory();
  put_assembly(ready["placed"], simulation);
  run_up(simulation);
  put_assembly(ready["start"], simulation);
  ready["shears"] = simulation.stage().drive->axial_strain.has_value();
  ready["time_step"] = simulation.time_step();
  ready["largest_radius"] = largest_radius(simulation.state().particles);
  ready["level"] = name_of_level(hwy::SupportedAndGeneratedTargets().front());
  ready["threads"] = threads > 0 ? threads : tangency::dem::threads();
  std::cout << ready.dump() << std::endl;
  for (std::string line; std::getline(std::cin, line);)
    std::cout << answer_to(line, simulation).dump() << std::endl;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::tables::Program program("bench_dem_scene", "One scene, timed in blocks of cycles");
  std::string scene, level;
  int threads = 0;
  program.option("SCENE", scene, "A scene, as for tangency-dem run").required();
  program.option("--level", level, "Instruction set: ssse3, sse4, avx2, avx512 [the best]");
  program.option("--threads", threads, "Number of threads [all]").between(1, 1024);
  program.footer(kHelp);
  program.runs([&] { return run(scene, level, threads); });
  return program.run(argc, argv);
}
