// SPDX-License-Identifier: GPL-3.0-or-later
// Hunts our own kernel by calls (docs/hunt.md): as many answers of each call as asked for, each
// beside the truth. The merge gate runs a part of it; docs/testing.md names the whole.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/tests/verify/kernel_subject.hpp>
#include <tangency/verify/hunt/findings.hpp>

namespace {

using namespace tangency;
using namespace tangency::testing;
using Clock = std::chrono::steady_clock;

struct Options {
  unsigned long answers = 1'000'000, kinds = 0;
  std::string only, state;
};

/// s of the processor that this program has had.
double processor_time() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A search that is kept in FOLDER/CALL.json, where a folder is given.
class KeptSearch {
 public:
  KeptSearch(verify::Judge& judge, const Options& options, std::string_view call,
             std::uint64_t seed)
      : search_(judge, verify::family_sources(), seed),
        question_("kernel_hunt " + std::string(call) + " --seed " + std::to_string(seed)) {
    if (options.state.empty()) return;
    std::filesystem::create_directories(options.state);
    path_ = options.state + '/' + std::string(call) + ".json";
    if (!std::filesystem::exists(path_)) return;
    std::ifstream file(path_, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    if (const std::string problem = search_.resume(text, question_); !problem.empty()) {
      throw std::runtime_error(path_ + ": " + problem);
    }
  }

  /// Whole generations, until there are so many answers at least, or so many kinds of faults.
  /// @param kinds  0: however many there are
  void run(verify::Subject& subject, std::size_t answers, std::size_t kinds) {
    constexpr double kBetween = 10;  // s; chosen: little is lost, and little time
    const std::size_t before = search_.answers();
    const double begin = processor_time();
    Clock::time_point saved = Clock::now();
    const auto ends = [&] { return kinds > 0 && search_.faults().size() >= kinds; };
    while (search_.answers() < answers && !ends() && search_.step(subject, answers)) {
      if (seconds_since(saved) < kBetween) continue;
      save();
      saved = Clock::now();
      std::fprintf(stderr,
                   "%zu of %zu answers, %.0f a second of the processor, %zu kinds of faults\n",
                   search_.answers(), answers,
                   static_cast<double>(search_.answers() - before) / (processor_time() - begin),
                   search_.faults().size());
    }
    save();
    rate_ = static_cast<double>(search_.answers() - before) / (processor_time() - begin);
  }

  const verify::Search& search() const { return search_; }
  double rate() const { return rate_; }

 private:
  void save() const {
    if (path_.empty()) return;
    tables::OutputFile file(path_);
    file.write(search_.saved(question_));
    file.commit();
  }

  verify::Search search_;
  std::string question_, path_;
  double rate_ = 0;
};

/// @returns whether no fault was found
bool hunt(std::string_view name, Call call, const Options& options, std::uint64_t seed) {
  const bool has_bounds = call != Call::relation && call != Call::yes_no;
  verify::Judge judge(has_bounds ? verify::Goal::certificate : verify::Goal::relation, {});
  KeptSearch kept(judge, options, name, seed);
  KernelSubject subject(call);
  kept.run(subject, options.answers, options.kinds);
  const verify::OracleCounts& counts = judge.counts();
  const verify::Search& search = kept.search();
  double worst = 0;
  for (const auto& [kind, elite] : search.archive()) {
    if (has_bounds && kind.first.empty()) worst = std::max(worst, elite.error);
  }
  std::printf("%-10s %12zu %12zu %12zu %10zu %6zu %8.3f %8zu %10.0f\n", std::string(name).c_str(),
              search.answers(), counts.brackets, counts.relations, counts.gaps, counts.open, worst,
              search.faults().size(), kept.rate());
  std::fflush(stdout);
  const auto found = verify::findings(search, subject, 12, 5000);
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::printf("%s", verify::finding_text(found[i], i + 1).c_str());
    std::printf("  as found\n%s", verify::pair_text(found[i].before).c_str());
  }
  return search.faults().empty();
}

bool agree(const Options& options, std::uint64_t seed) {
  std::printf("%-10s %12s %12s %12s %10s %6s %8s %8s %10s\n", "call", "answers", "by brackets",
              "by integers", "100 digits", "open", "of bound", "faults", "a second");
  bool right = true, any = false;
  for (const auto& [name, call] : kCalls) {
    if (!options.only.empty() && options.only != name) continue;
    any = true;
    right = hunt(name, call, options, seed) && right;
  }
  return right && any;
}

}  // namespace

int main(int argc, char** argv) {
  AgreementProgram program("kernel_hunt", "Hunt for pairs that the kernel answers wrongly");
  Options options;
  program.option("--answers", options.answers, "answers of each call");
  program.option("--kinds", options.kinds, "kinds of faults after which a call is done; 0: none");
  program.option("--only", options.only, "one call: relation, single, yes-no, lanes, fast, moving");
  program.option("--state", options.state, "folder where the hunts are kept, to go on from");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(options, seed); });
}
