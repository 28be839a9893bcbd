// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs targets without libFuzzer: on their seeds, on the committed inputs, and on seeded mutations
/// of both. docs/testing.md.
#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/target.hpp>

namespace tangency::testing::fuzz {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> names;
  std::uint64_t runs = 1000, seed = 20261201;
  unsigned seconds = 0;  ///< 0: as many runs as are asked for
  unsigned limit = 0;    ///< 0: none
  std::string input, inputs = std::string(TANGENCY_SOURCE) + "/tests/data/fuzz", findings = ".";
  std::string counts;
  bool list = false;
};

// What a signal's handler needs: it may call little.
struct Current {
  Bytes input;
  char path[4096];
  int messages;  ///< standard error, wherever a target sends it meanwhile
} current;

void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(
      current.messages, text.data(), text.size());  // there is nowhere to say that it failed
}

extern "C" void keep_finding(int signal) {
  const int file = ::open(current.path, O_CREAT | O_WRONLY | O_TRUNC, 0644);
  const bool kept = file >= 0 && ::write(file, current.input.data(), current.input.size()) ==
                                     static_cast<ssize_t>(current.input.size());
  // What was said while standard error went to a file in memory.
  char said[4096];
  const ssize_t size = ::pread(2, said, sizeof said, 0);
  if (size > 0) say({said, static_cast<std::size_t>(size)});
  say(kept ? "the input is in " : "the input cannot be written to ");
  say(current.path);
  say("\n");
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void watch(const Target& target, const Options& options) {
  std::snprintf(current.path, sizeof current.path, "%s/%s-finding", options.findings.c_str(),
                target.name.c_str());
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGVTALRM})
    std::signal(signal, keep_finding);
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw tables::UsageError(path.string() + " cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// From now on the process has so many seconds of a processor; 0: as many as it takes.
void allow(unsigned seconds) {
  const itimerval timer{{0, 0}, {static_cast<time_t>(seconds), 0}};
  ::setitimer(ITIMER_VIRTUAL, &timer, nullptr);
}

void run(const Target& target, const std::string& input, unsigned limit) {
  // A copy that ends where the input ends, for those who look at memory.
  const std::vector<std::uint8_t> copy(input.begin(), input.end());
  current.input = copy;
  count("runs");
  if (limit > 0) allow(limit);
  target.run(copy);
  if (limit > 0) allow(0);
}

/// Inputs to begin with: the target's own, and the committed ones.
std::vector<std::string> pool_of(const Target& target, const Options& options) {
  std::vector<std::string> pool = target.seeds();
  std::vector<fs::path> files;
  const fs::path folder = fs::path(options.inputs) / target.name;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) pool.push_back(bytes_of(file));
  return pool;
}

class Mutations {
 public:
  Mutations(const Target& target, const Options& options, std::uint64_t before)
      : target_(target),
        limit_(options.limit),
        pool_(pool_of(target, options)),
        start_(pool_),
        state_(options.seed) {
    // Another sequence after every run that was counted.
    state_ += before * 0x2545f4914f6cdd1dU;
  }

  void run_pool() const {
    for (const std::string& input : pool_) run(target_, input, limit_);
  }

  void run_one() {
    std::string& input = pool_[below(state_, pool_.size())];
    // Mutations of mutations; most start afresh before they are nothing but noise.
    if (below(state_, 16) == 0) input = start_[below(state_, start_.size())];
    std::string mutated = input;
    mutated.resize(target_.most_bytes);
    const std::size_t size = target_.mutate(reinterpret_cast<std::uint8_t*>(mutated.data()),
                                            std::min(input.size(), target_.most_bytes),
                                            target_.most_bytes, next(state_));
    mutated.resize(size);
    const std::uint64_t refused = counts()["refused"];
    run(target_, mutated, limit_);
    // What was refused is seldom a step to what is not.
    const bool was_refused = counts()["refused"] > refused;
    if (below(state_, was_refused ? 32 : 2) == 0) input = mutated;
  }

 private:
  const Target& target_;
  unsigned limit_;
  std::vector<std::string> pool_, start_;
  std::uint64_t state_;
};

void read_counts(const std::string& path) {
  counts().clear();
  std::ifstream file(path);
  std::uint64_t number = 0;
  for (std::string name; file >> number && std::getline(file >> std::ws, name);)
    count(name, number);
}

/// Beside the file, and renamed, so that what was counted is not lost where this is ended or where
/// nothing can be written.
void write_counts(const std::string& path) {
  if (path.empty()) return;
  const std::string part = path + ".part";
  std::ofstream file(part);
  for (const auto& [name, number] : counts()) file << number << ' ' << name << '\n';
  file.close();
  std::error_code failed;
  if (file) fs::rename(part, path, failed);
  if (!file || failed) throw tables::UsageError("--counts: " + path + " cannot be written");
}

/// Makes the folder of an option. At the start: at the end what was found would be lost.
void make_folder(const std::string& option, const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || !fs::is_directory(folder))
    throw tables::UsageError(option + ' ' + folder + ": must be a folder, or a place for one");
}

void print_counts(const Target& target) {
  std::printf("%s:", target.name.c_str());
  const char* separator = " ";
  for (const auto& [name, number] : counts()) {
    std::printf("%s%s %llu", separator, name.c_str(), static_cast<unsigned long long>(number));
    separator = ", ";
  }
  std::printf("\n");
  std::fflush(stdout);
}

void fuzz(const Target& target, const Options& options) {
  using Clock = std::chrono::steady_clock;
  counts().clear();
  const std::string file = options.counts.empty() ? "" : options.counts + "/" + target.name;
  if (!file.empty()) {
    read_counts(file);
    write_counts(file);  // where it cannot be, nothing is run
  }
  watch(target, options);
  if (!options.input.empty()) {
    run(target, bytes_of(options.input), options.limit);
    return print_counts(target);
  }
  Mutations mutations(target, options, counts().contains("runs") ? counts()["runs"] : 0);
  mutations.run_pool();
  if (options.seconds > 0) {
    const auto start = Clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(Clock::now() - start).count();
    };
    for (double written = 0; elapsed() < options.seconds;) {
      for (int k = 0; k < 64; ++k) mutations.run_one();
      if (elapsed() < written + 5) continue;  // seconds; chosen
      written = elapsed();
      write_counts(file);
    }
    count("seconds", static_cast<std::uint64_t>(elapsed()));
  } else {
    for (std::uint64_t k = 0; k < options.runs; ++k) mutations.run_one();
  }
  write_counts(file);
  print_counts(target);
}

int run_all(const Options& options) {
  std::vector<const Target*> chosen;
  for (const std::string& name : options.names) {
    chosen.push_back(target_named(name));
    if (chosen.back() == nullptr)
      throw tables::UsageError(name + " is no target; --list names them");
  }
  if (chosen.empty()) {
    for (const Target& target : targets()) chosen.push_back(&target);
  }
  if (options.list) {
    for (const Target* target : chosen)
      std::printf("%-14s %s\n", target->name.c_str(), target->what.c_str());
    return 0;
  }
  if (!options.input.empty() && chosen.size() != 1)
    throw tables::UsageError("--input is for one target");
  make_folder("--findings", options.findings);
  if (!options.counts.empty()) make_folder("--counts", options.counts);
  current.messages = ::dup(2);
  std::printf("seed %llu\n", static_cast<unsigned long long>(options.seed));
  for (const Target* target : chosen) fuzz(*target, options);
  return 0;
}

}  // namespace
}  // namespace tangency::testing::fuzz

int main(int argc, char** argv) {
  using namespace tangency::testing::fuzz;
  tangency::tables::Program program(
      "fuzz",
      "Runs fuzz targets on their seeds, on committed inputs and on mutations of both.\n"
      "A finding ends it: one line says what was broken, and where the input is.");
  Options options;
  program.option("TARGET", options.names, "Which; all of them where none is named").type_name("");
  program.flag("--list", options.list, "Names the targets and what each holds");
  program.option("--runs", options.runs, "Mutated inputs a target").shows_default().type_name("N");
  program.option("--seconds", options.seconds, "Of wall time a target, in place of --runs")
      .type_name("S");
  program
      .option(
          "--limit", options.limit,
          "An input that takes more seconds of a processor is a finding, which ends the process "
          "by SIGVTALRM (default: none is)")
      .type_name("S");
  program.option("--seed", options.seed, "Of the mutations").shows_default().type_name("N");
  program.option("--input", options.input, "Runs this input alone, once").type_name("FILE");
  program
      .option(
          "--inputs", options.inputs,
          "Inputs to begin with beside the seeds, in a folder a target (default: tests/data/fuzz)")
      .type_name("DIR");
  program
      .option("--findings", options.findings,
              "Where a finding's input goes; made where it is missing")
      .shows_default()
      .type_name("DIR");
  program
      .option(
          "--counts", options.counts,
          "A file a target here, in a folder that is made where it is missing, is read first and "
          "written at the end: another run goes on with other mutations and adds to its counts")
      .type_name("DIR");
  program.runs([&] { return run_all(options); });
  return program.run(argc, argv);
}
